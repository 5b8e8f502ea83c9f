//! Random events in windows of any size: nothing panics, everything can be undone, and saved files are read again.

use std::time::Duration;

use egui::{Key, Modifiers, pos2};
use shadetrade::window::inspector::Tab;
use shadetrade::window::keys::{Action, keys};

use super::Window;
use crate::support::prelude::*;
use crate::support::window::default_scene;

/// Events of a storm.
const EVENTS: usize = 40;
/// The window's sides are below these. In the small one all questions about the picture are answered.
const LARGE: [f64; 2] = [1200.0, 900.0];
const SMALL: [f64; 2] = [110.0, 80.0];

/// A window under random events, with the record and the name of its scene when that was opened.
struct Storm {
    window: Window,
    first: SceneRecord,
    name: String,
    random: Random,
    most: [f64; 2],
}

impl Storm {
    fn new(seed: u64, most: [f64; 2]) -> Self {
        let size = most.map(|side| side as usize / 2);
        let window = Window::of(default_scene(), size);
        Storm {
            first: SceneRecord::of(&default_scene().world),
            name: window.app.document.scene.name.clone(),
            window,
            random: Random(seed),
            most,
        }
    }

    fn choice(&mut self, count: usize) -> usize {
        self.random.within(0.0, count as f64) as usize
    }

    fn place(&mut self) -> egui::Pos2 {
        let [width, height] = self.window.size.map(|side| side as f64);
        let at = [width, height].map(|side| self.random.within(-0.02 * side, 1.02 * side) as f32);
        pos2(at[0], at[1])
    }

    /// Sends one random event and checks the window after it.
    fn blow(&mut self) {
        match self.choice(12) {
            0..=4 => self.press_any(),
            5 | 6 => {
                let at = self.place();
                self.window.click(at);
            }
            7 => {
                let (from, to) = (self.place(), self.place());
                let steps = 1 + self.choice(4);
                self.window.modifiers.shift = self.choice(2) == 0;
                self.window.drag(from, to, steps);
            }
            8 => {
                let (at, notches) = (self.place(), self.random.within(-5.0, 5.0).round());
                self.window.modifiers.command = self.choice(2) == 0;
                self.window.wheel(at, notches as f32);
            }
            9 => {
                let text = [
                    "1",
                    "0.5",
                    "-1e30",
                    "1e300",
                    "nan",
                    "a",
                    "\u{e9}\u{4e2d}",
                    "",
                ][self.choice(8)];
                self.window.enter(text);
            }
            10 => {
                let most = self.most;
                self.window.size = most.map(|side| self.random.within(1.0, side) as usize);
                self.window.step(Vec::new());
            }
            _ => {
                let wait = self.random.within(0.0, 2.5);
                self.window.wait(Duration::from_secs_f64(wait));
            }
        }
        self.window.modifiers = Modifiers::NONE;
        if self.most == LARGE {
            self.fold_slow_answers();
        }
        let name = &self.window.app.document.scene.name;
        if *name != self.name
            && let Ok(scene) = Scene::load(Some(name))
            && scene.path.is_none()
        {
            self.first = SceneRecord::of(&scene.world);
        }
        self.name.clone_from(name);
        self.window.app.desk.quits = false;
        self.window.record().check().expect("a legal scene");
    }

    fn press_any(&mut self) {
        let keys = keys().filter(|(.., action)| self.most == SMALL || !is_slow(*action));
        let keys: Vec<_> = keys.collect();
        let (modifiers, key, _) = *keys[self.choice(keys.len())];
        self.window.press_with(modifiers, key);
        if self.choice(4) == 0 {
            let keys = [
                Key::Tab,
                Key::Enter,
                Key::Backspace,
                Key::Delete,
                Key::ArrowDown,
            ];
            let key = keys[self.choice(keys.len())];
            self.window.press(key);
        }
    }

    /// Closes the tabs with proofs, which take long for large pictures.
    fn fold_slow_answers(&mut self) {
        let open = &mut self.window.app.desk.tabs;
        open.retain(|tab| !matches!(tab, Tab::Required | Tab::Proof));
    }
}

fn is_slow(action: Action) -> bool {
    use shadetrade::components::ViewMode;
    matches!(
        action,
        Action::Tab(Tab::Required)
            | Action::View(ViewMode::Error)
            | Action::WipeExact
            | Action::Blink
    )
}

#[test]
fn after_a_storm_everything_can_be_undone_and_the_saved_file_is_read_again() {
    let sizes = [SMALL, LARGE].into_iter().cycle();
    for (seed, most) in (0..).zip(sizes).take(cases(2)) {
        let mut storm = Storm::new(seed, most);
        (0..EVENTS).for_each(|_| storm.blow());
        let window = &mut storm.window;
        window.size = [90, 70];
        window.app.desk.help = false;
        window.app.run(Action::SaveAs);
        let path = window.app.document.scene.path.clone().expect("a file");
        let read = Scene::load_path(&path).unwrap_or_else(|error| panic!("{seed}: {error}"));
        assert_eq!(SceneRecord::of(&read.world), window.record(), "{seed}");
        window.wait(Duration::from_secs(2));
        while window.message() != "nothing to undo" {
            window.app.run(Action::Undo);
            window.step(Vec::new());
        }
        // Undo does not change these.
        let (mut first, present) = (storm.first, window.record());
        first.view.turned = present.view.turned;
        first.view.pixel = present.view.pixel;
        assert_eq!(present, first, "{seed}");
    }
}
