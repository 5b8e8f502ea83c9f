//! The memory of the window: buffers of a large window are given back by a small one.

use egui::Key;

use super::{PAUSE, Window};
use crate::support::window::default_scene;

#[test]
fn a_small_window_keeps_no_buffers_of_a_large_one() {
    const SMALL: [usize; 2] = [480, 320];
    const LARGE: [usize; 2] = [1200, 800];
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
            // A buffer of the large window has 3.8 MB.
            assert!(kept.bytes_current < 1_000_000, "{key:?}: {kept:?}");
        }
    }
}
