//! Clicks so short that minifb sees neither end. minifb tells whether the button is down when it is asked; XInput 2 reports every press
//! of the mouse to whoever asks, over any window.
//!
//! ```text
//! presses that XInput 2 reports - presses that minifb saw = taps that were missed, or presses over other windows
//! ```

use std::iter;

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{ConnectionExt as _, Device, EventMask, XIEventMask};
use x11rb::protocol::xproto::{ConnectionExt as _, Window};
use x11rb::rust_connection::RustConnection;

/// The left button.
const BUTTON: u32 = 1;
/// The version that reports presses while a button is held, too.
const VERSION: (u16, u16) = (2, 2);

/// Counts the presses of the left button.
pub struct Taps {
    server: RustConnection,
    root: Window,
    window: Window,
    count: Count,
}

impl Taps {
    /// Counts for this window. `None` if the server does not report presses.
    pub fn over(window: Window) -> Option<Self> {
        let (server, screen) = RustConnection::connect(None).ok()?;
        let root = server.setup().roots.get(screen)?.root;
        let version = server.xinput_xi_query_version(VERSION.0, VERSION.1).ok()?;
        version.reply().ok()?;
        let mask = EventMask {
            deviceid: Device::ALL_MASTER.into(),
            mask: vec![XIEventMask::RAW_BUTTON_PRESS],
        };
        server
            .xinput_xi_select_events(root, &[mask])
            .ok()?
            .check()
            .ok()?;
        Some(Taps {
            server,
            root,
            window,
            count: Count::default(),
        })
    }

    /// Reads the reports. Call it before minifb is asked, which then knows of each of them.
    pub fn read(&mut self) {
        let next = || self.server.poll_for_event().ok().flatten();
        let is_press =
            |event: &Event| matches!(event, Event::XinputRawButtonPress(it) if it.detail == BUTTON);
        let presses = iter::from_fn(next).filter(is_press).count();
        self.count.reported += presses;
    }

    /// The number of clicks over the window since the last call. `sees_press` tells whether minifb saw the button go down.
    pub fn missed(&mut self, sees_press: bool) -> usize {
        let missed = self.count.missed(sees_press);
        if missed > 0 && self.is_under_mouse() {
            missed
        } else {
            0
        }
    }

    /// Whether no other window covers this one under the mouse.
    fn is_under_mouse(&self) -> bool {
        let child = |window: &Window| {
            let pointer = self.server.query_pointer(*window).ok()?.reply().ok()?;
            Some(pointer.child).filter(|child| *child != x11rb::NONE)
        };
        iter::successors(Some(self.root), child).last() == Some(self.window)
    }
}

/// The balance of presses.
#[derive(Default)]
struct Count {
    reported: usize,
    /// minifb may know of a press before its report is read.
    seen: usize,
}

impl Count {
    fn missed(&mut self, sees_press: bool) -> usize {
        self.seen += usize::from(sees_press);
        let missed = self.reported.saturating_sub(self.seen);
        self.seen += missed;
        missed
    }
}

/// The ends of missed clicks, and the change that minifb saw: whether the button goes down at each.
pub fn changes(was_down: bool, missed: usize, is_down: bool) -> impl Iterator<Item = bool> {
    let taps = iter::repeat_n([!was_down, was_down], missed).flatten();
    taps.chain((is_down != was_down).then_some(is_down))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_press_is_missed_if_it_is_reported_and_not_seen() {
        let mut count = Count::default();
        // Both in one frame, and the report a frame later.
        for reports in [[1, 0], [0, 1]] {
            count.reported += reports[0];
            assert_eq!(count.missed(true), 0);
            count.reported += reports[1];
            assert_eq!(count.missed(false), 0);
        }
        count.reported += 1;
        assert_eq!([count.missed(false), count.missed(false)], [1, 0]);
        // Two clicks, of which the second is held.
        count.reported += 2;
        assert_eq!(count.missed(true), 1);
    }

    #[test]
    fn missed_clicks_come_before_the_change_that_was_seen() {
        let all = |was, missed, is| changes(was, missed, is).collect::<Vec<bool>>();
        assert!(all(false, 0, false).is_empty());
        assert_eq!(all(false, 1, false), [true, false]);
        assert_eq!(all(false, 1, true), [true, false, true]);
        assert_eq!(all(true, 1, true), [false, true]);
        assert_eq!(all(true, 1, false), [false, true, false]);
    }
}
