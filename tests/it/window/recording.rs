//! Recordings are written and replayed without loss, and mistakes in them are found.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use egui::Key;
use fearless_simd::Level;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use serde_json::json;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::window::recording::{Log, Recorder, patch};
use shadetrade::window::replay::{Player, draw, hash};

use super::{FRAME, Window};
use crate::scene::random;
use crate::support::cases::config;
use crate::support::window::default_scene;

/// A file in memory with a limited length.
#[derive(Clone)]
struct File(Rc<RefCell<Vec<u8>>>, usize);

impl Write for File {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut file = self.0.borrow_mut();
        if file.len() + bytes.len() > self.1 {
            return Err(io::Error::other("the disk is full"));
        }
        file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl File {
    fn new(most: usize) -> Self {
        File(Rc::default(), most)
    }

    fn text(&self) -> String {
        String::from_utf8(self.0.borrow().clone()).expect("a log is text")
    }
}

const SIZE: [usize; 2] = [480, 320];

/// A window that records into a file.
fn recorded(file: &File) -> Window {
    let mut window = Window::of(default_scene(), SIZE);
    window.app.recorder = Some(Recorder::new(file.clone()));
    window
}

fn read(text: &str) -> anyhow::Result<Log> {
    Log::read("a.log", text.as_bytes(), Duration::from_secs(2))
}

/// The time, the state and the hash of the picture of every frame.
fn replayed(log: &Log, threads: usize, level: Level) -> Vec<(Duration, Arc<SceneRecord>, u64)> {
    let mut frames = Vec::new();
    let drawing = log.drawing(threads, level);
    draw(log, drawing, |app, frame| {
        frames.push((frame.time, Arc::clone(&app.state), hash(&app.shown())));
        Ok(())
    })
    .expect("there is memory");
    frames
}

#[test]
fn a_pause_delays_the_frames_of_a_replay() {
    let off = r#"1.000 patch [{"op":"replace","path":"/light/0/on","value":false}]"#;
    let log = read(&log(&format!("{off}\n3.000 say \"end\"\n"))).expect("a valid log");
    let mut window = Window::of(default_scene(), SIZE);
    let space = [window.key_event(Key::Space, true)];
    let mut player = Player::new(&log);
    let seconds = Duration::from_secs;
    for (now, presses, next, is_on) in [
        (0, false, seconds(1), true),
        (0, true, Duration::MAX, true),
        (9, true, seconds(10), true),
        (10, false, seconds(12), false),
    ] {
        let events = &space[..usize::from(presses)];
        let played = player.play(&mut window.app, seconds(now), events);
        assert_eq!(played.expect("a valid log"), next);
        assert_eq!(window.record().light[0].on, is_on, "{now}");
    }
}

/// A log of a scene, followed by these lines.
fn log(lines: &str) -> String {
    let scene = json!({ "name": "cuboid", "scene": SceneRecord::of(&default_scene().world) });
    format!("0.000 scene {scene}\n{lines}")
}

proptest! {
    #![proptest_config(config(1))]

    #[test]
    fn a_window_is_replayed_unchanged(keys in vec(select(vec![
        Key::W, Key::R, Key::Num3, Key::A, Key::G, Key::P, Key::OpenBracket, Key::CloseBracket, Key::C, Key::O,
        Key::ArrowLeft, Key::ArrowUp, Key::Plus, Key::Home, Key::F2, Key::F3, Key::F4, Key::F5, Key::F6,
        Key::E, Key::Escape,
    ]), 4..8)) {
        let file = File::new(usize::MAX);
        let mut window = recorded(&file);
        let mut expected: Vec<(Duration, Arc<SceneRecord>, u64)> = Vec::new();
        for key in std::iter::once(None).chain(keys.into_iter().map(Some)) {
            let now = window.now + FRAME;
            let events = key.map(|key| [true, false].map(|pressed| window.key_event(key, pressed)));
            window.step_at(now, events.into_iter().flatten().collect());
            // Answers are shown a step after they are found.
            for _ in 0..3 {
                window.step_at(now, Vec::new());
            }
            let app = &window.app;
            if expected.last().is_none_or(|(_, state, _)| *state != app.state) {
                expected.push((now, Arc::clone(&app.state), hash(&app.shown())));
            }
        }
        let log = read(&file.text()).expect("it was recorded");
        prop_assert_eq!(log.frames[0].size(), Some(SIZE));
        prop_assert_eq!(log.frames.len(), expected.len());
        // Every level draws the same bits with any number of threads; other tests show it.
        prop_assert_eq!(&replayed(&log, 2, Level::baseline()), &expected);
    }
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn a_patch_turns_one_record_into_the_other(before in random::record(), mut after in random::record(), is_near: bool) {
        if is_near {
            let changed = std::mem::replace(&mut after, before.clone());
            after.view.divider = changed.view.divider;
            after.background = changed.background;
            after.cuboid[0].size = changed.cuboid[0].size;
            after.camera[0].near = changed.camera[0].near;
            for (light, changed) in after.light.iter_mut().zip(&changed.light) {
                light.color = changed.color;
            }
        }
        let found = patch(&before, &after);
        let [mut patched, other] = [&before, &after].map(|record| json!(record));
        json_patch::patch(&mut patched, &found).unwrap();
        prop_assert_eq!(patched, other);
        prop_assert!(patch(&after, &after.clone()).is_empty());
    }

    #[test]
    fn no_wrong_byte_and_no_cut_causes_a_panic(place: prop::sample::Index, byte: u8, cuts: bool) {
        let text = log(LINES);
        let mut bytes = text.clone().into_bytes();
        let place = place.index(bytes.len());
        if cuts {
            bytes.truncate(place);
        } else {
            bytes[place] = byte;
        }
        // A mistake is reported with its place.
        if let Err(error) = Log::read("a.log", &bytes, Duration::ZERO) {
            prop_assert!(error.to_string().starts_with("a.log:"), "{}", error);
        }
    }
}

/// Lines that may follow a scene.
const LINES: &str = r#"0.000 size [320,200]
0.500 patch [{"op":"replace","path":"/light/0/on","value":false}]
0.500 patch [{"op":"add","path":"/view/pixel","value":[16383,16383]},{"op":"remove","path":"/light/1"}]
10.5 say "words"
11.000 patch [{"op":"add","path":"/view/show","value":"wipe"}]
11.000 size [1,1]
"#;

#[test]
fn a_change_of_one_number_is_one_operation_with_its_name() {
    let before = SceneRecord::of(&default_scene().world);
    let mut after = before.clone();
    after.light[2].on = false;
    let expected = json!([{ "op": "replace", "path": "/light/2/on", "value": false }]);
    assert_eq!(json!(patch(&before, &after)), expected);
}

#[test]
fn a_log_cut_anywhere_keeps_its_complete_lines() {
    let text = log(LINES);
    let head = text.find('\n').unwrap() + 1;
    for cut in head..=text.len() {
        let log = read(&text[..cut]).expect("the rest is left out");
        // The last line may lack its newline.
        let (kept, rest) = text.split_at(cut);
        let is_cut = !kept.ends_with('\n') && !rest.starts_with('\n');
        let lines = kept.lines().count();
        assert_eq!(log.cut_off, is_cut.then_some(lines));
        let times = [1, 1, 2, 2, 3, 4, 4];
        assert_eq!(log.frames.len(), times[lines - 1 - usize::from(is_cut)]);
    }
    assert!(read(&text[..head - 2]).is_err());
}

#[test]
fn the_limits_of_a_log_are_drawn() {
    let log = read(&log(LINES)).expect("it is valid");
    let frames = replayed(&log, 1, Level::new());
    assert_eq!(frames.len(), 4);
}

#[test]
fn the_lessons_are_valid() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/lessons");
    for name in ["why-the-plane-stays-dull", "what-a-tolerance-buys"] {
        let text = std::fs::read_to_string(format!("{folder}/{name}.log"));
        let log = read(&text.expect("a lesson")).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(log.frames.len() > 8 && log.cut_off.is_none());
    }
}

#[test]
fn long_pauses_are_shortened_but_not_below_the_time_to_read_words() {
    // A hundred letters take six seconds.
    let (words, size) = ("a".repeat(100), "size [300,200]");
    let lines = format!("0.5 {size}\n0.75 {size}\n99 say {words:?}\n100 {size}\n199 {size}\n");
    let log = read(&log(&lines)).expect("it is valid");
    let (times, played): (Vec<_>, Vec<_>) = log
        .frames
        .iter()
        .map(|frame| (frame.time.as_secs_f64(), frame.at.as_secs_f64()))
        .unzip();
    assert_eq!(times, [0.0, 0.5, 0.75, 99.0, 100.0, 199.0]);
    assert_eq!(played, [0.0, 0.5, 0.75, 2.75, 3.75, 8.75]);
}

/// Third lines of a log, and words of their error.
const MISTAKES: &str = r#"
 ¦ seconds
x say "a" ¦ seconds from 1
nan say "a" ¦ "nan"
-1 say "a" ¦ seconds
1e300 say "a" ¦ 1000000000
0.999 say "a" ¦ seconds from 1 to
2 ¦ `say`
2 quit ¦ `scene`, `patch`, `size`, `say`
2 say words ¦ expected value
2 say 3 ¦ string
2 size [0,1] ¦ 16384
2 size [16385,1] ¦ 16384
2 size [1.5,1] ¦ 1.5
2 size [1,1,1] ¦ trailing characters
2 scene {"name":"é","scene":{}} ¦ missing field `cuboid`
2 scene {"lamp":3} ¦ unknown field `lamp`
2 patch {} ¦ sequence
2 patch [{"op":"remove","path":"/light/9"}] ¦ /light/9
2 patch [{"op":"remove","path":"/camera"}] ¦ `camera`
2 patch [{"op":"copy","from":"","path":"/light/-"}] ¦ copies
2 patch [{"op":"replace","path":"/cuboid/0/size/0","value":-4}] ¦ -4
2 patch [{"op":"replace","path":"/light/0/name","value":"red"}] ¦ red
"#;

#[test]
fn mistakes_are_reported_with_their_place() {
    let error = |text: &str| {
        let error = read(text).err();
        error.map_or_else(|| panic!("{text}"), |error| error.to_string())
    };
    for row in MISTAKES.lines().skip(1) {
        let (line, words) = row.split_once(" ¦ ").expect("a line and its error");
        let error = error(&log(&format!("1.000 say \"ok\"\n{line}\n")));
        let is_told = error.starts_with("a.log:3: ") && error.contains(words);
        assert!(is_told && !error.contains(" at line"), "{line}: {error}");
    }
    for text in [
        "",
        "0 say \"a\"",
        "0 say \"a\"\n",
        "\n",
        "shadetrade log 1\n",
    ] {
        assert!(error(text).starts_with("a.log:1:"), "{text}");
    }
}

#[test]
fn a_failed_write_ends_the_recording_and_the_window_reports_it() {
    let file = File::new(4000);
    let mut window = recorded(&file);
    (0..100).for_each(|_| window.press(Key::W));
    assert!(window.app.recorder.is_none());
    assert!(window.message().contains("the disk is full"));
    assert!(read(&file.text()).is_ok_and(|log| log.frames.len() > 1));
}

#[test]
fn another_scene_is_recorded_completely() {
    let file = File::new(usize::MAX);
    let mut window = recorded(&file);
    window.press(Key::W);
    let other = Scene::load(Some("bench-far"));
    window.app.open(other.expect("it is built in"));
    window.press(Key::W);
    let log = read(&file.text()).expect("it was recorded");
    let frames = replayed(&log, 1, Level::new());
    assert_eq!(frames.last().map(|frame| &frame.1), Some(&window.app.state));
    assert!(file.text().contains("scene {\"name\":\"bench-far\""));
}
