//! The memory of the window: buffers of a large window are given back by a small one, and a step in which nothing changes
//! copies no scene.

use egui::Key;
use shadetrade::scene::{Scene, SceneRecord};

use super::{PAUSE, Window};
use crate::support::window::default_scene;

#[test]
fn a_small_window_keeps_no_buffers_of_a_large_one() {
    const SMALL: [usize; 2] = [480, 320];
    const LARGE: [usize; 2] = [1500, 1100];
    let mut window = Window::of(default_scene(), SMALL);
    for key in [Key::F2, Key::F3, Key::F4, Key::F5, Key::F6] {
        // The window gets small before another picture is shown, or after.
        for gets_small_first in [true, false] {
            let mut look = |key, size| {
                window.press(key);
                window.size = size;
                window.wait(PAUSE);
            };
            look(Key::F5, SMALL);
            let kept = allocation_counter::measure(|| {
                look(key, LARGE);
                let between = if gets_small_first { key } else { Key::F5 };
                look(between, [LARGE, SMALL][usize::from(gets_small_first)]);
                look(Key::F5, SMALL);
            });
            // A buffer of the large window has 6.6 MB.
            assert!(kept.bytes_current < 1_000_000, "{key:?}: {kept:?}");
        }
    }
}

#[test]
fn a_step_in_which_nothing_changes_takes_no_memory_for_a_cuboid() {
    let bytes = |cuboids: usize| {
        let mut record = SceneRecord::of(&default_scene().world);
        record.cuboid = vec![record.cuboid[0].clone(); cuboids];
        for (place, cuboid) in record.cuboid.iter_mut().enumerate() {
            cuboid.name = format!("{place:5}");
        }
        let scene = Scene::spawn("many".to_owned(), &record);
        let mut window = Window::of(scene, [640, 480]);
        // The editor, with an edit that is not saved.
        window.press(Key::E);
        window.app.document.scene.world = {
            record.background.x += 1.0;
            record.spawn()
        };
        for _ in 0..5 {
            window.wait(PAUSE);
        }
        assert!(window.app.document.is_edited());
        allocation_counter::measure(|| window.wait(PAUSE)).bytes_total
    };
    let (few, many) = (bytes(100), bytes(1100));
    assert!(many < few + 10_000, "{few} and {many}");
}
