//! Pixels seen larger: which one is where, and what keys and mouse do to that.

use proptest::prelude::*;
use shadetrade::window::bindings::{Action, Modifiers};
use shadetrade::window::hud::Hud;
use shadetrade::window::input::Gesture;
use shadetrade::window::magnifier::{MAX_SCALE, Magnifier};

use super::fit::drawn;
use super::{SIZE, default_session, does, press};
use minifb::Key;

fn any_magnifier() -> impl Strategy<Value = (Magnifier, [usize; 2])> {
    let size = [1..800_usize, 1..600_usize];
    let corner = [any::<usize>(), any::<usize>()];
    (any::<usize>(), corner, size).prop_map(|(scale, corner, size)| {
        let scale = scale % 200;
        (Magnifier { scale, corner }.within(size), size)
    })
}

proptest! {
    #[test]
    fn a_pixel_is_seen_in_its_place((magnifier, size) in any_magnifier(), at in [0..800_i32, 0..600_i32]) {
        prop_assert!(magnifier.scale.is_power_of_two() && magnifier.scale <= MAX_SCALE);
        let pixel = magnifier.pixel(at);
        prop_assert_eq!(magnifier.pixel(magnifier.place(pixel.map(|it| it as i32))), pixel);
        // The whole area shows the picture.
        let last = magnifier.pixel(size.map(|side| side as i32 - 1));
        prop_assert!(last[0] < size[0] && last[1] < size[1], "{:?} {:?}", last, size);
    }

    #[test]
    fn what_is_under_the_cursor_stays_there(
        (magnifier, size) in any_magnifier(),
        steps in -9..9_i32,
        share in [0.0..1.0, 0.0..1.0],
    ) {
        let at = [0, 1].map(|axis| (share[axis] * size[axis] as f64) as i32);
        let pixel = magnifier.pixel(at);
        let next = magnifier.stepped(steps, at, size);
        prop_assert_eq!(next, next.within(size));
        for axis in 0..2 {
            // At the picture's edge it cannot.
            let last = size[axis] - size[axis].div_ceil(next.scale);
            let stays = next.pixel(at)[axis] == pixel[axis];
            prop_assert!(stays || next.corner[axis] == 0 || next.corner[axis] == last);
        }
    }

    #[test]
    fn the_picture_follows_a_drag((magnifier, size) in any_magnifier(), by in [-300..300_i32, -300..300_i32]) {
        let panned = magnifier.panned(by, size);
        prop_assert_eq!(panned, panned.within(size));
        prop_assert_eq!(panned.scale, magnifier.scale);
        for axis in 0..2 {
            let moved = panned.corner[axis] as i32 - magnifier.corner[axis] as i32;
            prop_assert!(moved == 0 || moved.signum() == -by[axis].signum());
            prop_assert!((moved * magnifier.scale as i32).abs() <= by[axis].abs() + magnifier.scale as i32);
        }
    }
}

#[test]
fn the_wheel_with_control_magnifies_and_a_click_probes_what_is_seen() {
    let mut session = default_session();
    let control = Modifiers {
        control: true,
        ..Modifiers::default()
    };
    drawn(&mut session, SIZE);
    let hud = Hud::new(&session, SIZE);
    let at = [hud.picture.x + 311, 203];
    let wheel = Gesture::Wheel {
        at,
        notches: 3,
        modifiers: control,
    };
    does(&mut session, wheel);
    assert_eq!(session.state.magnifier.scale, 8);
    assert_eq!(session.orbit().zoom, 0);
    // A pixel is eight of the window's across.
    for (beside, expected) in [([0, 0], [311, 203]), ([16, -8], [313, 202])] {
        does(
            &mut session,
            Gesture::Click([at[0] + beside[0], at[1] + beside[1]]),
        );
        drawn(&mut session, SIZE);
        let probed = session
            .probe
            .as_ref()
            .expect("it is a pixel of the picture");
        assert_eq!(probed.pixel, expected);
    }
    does(&mut session, Gesture::Command(Action::Probe(None)));
    let corner = session.state.magnifier.corner;
    let drag = Gesture::Drag {
        from: [at[0] + 200, at[1] + 300],
        by: [-16, 24],
        modifiers: control,
    };
    does(&mut session, drag);
    assert_eq!(
        session.state.magnifier.corner,
        [corner[0] + 2, corner[1] - 3]
    );
    press(&mut session, Key::Home);
    assert_eq!(session.state.magnifier, Magnifier::default());
}

#[test]
fn magnified_pixels_are_squares_of_their_colour_and_the_largest_say_their_bytes() {
    let mut session = default_session();
    press(&mut session, Key::I);
    let size = [256, 192];
    drawn(&mut session, size);
    let picture: Vec<u32> = (0..256 * 192).map(|at| 0x0011_2200 + at % 251).collect();
    let mut shown = Vec::new();
    for (steps, is_plain) in [(1, true), (5, true), (6, false)] {
        session.apply(Action::Magnify(Magnifier {
            scale: 1 << steps,
            corner: [90, 80],
        }));
        Hud::new(&session, size).draw(&picture, true, &mut shown);
        let magnifier = session.state.magnifier.within(size);
        let differ = (0..256 * 192).filter(|at| {
            let [x, y] = magnifier.pixel([at % 256, at / 256]);
            shown[*at as usize] != picture[y * 256 + x]
        });
        assert_eq!(differ.count() == 0, is_plain, "{steps}");
    }
}
