//! Shapes and letters on pixels.

use shadetrade::canvas::{Canvas, FACES, Ink, Rect, fit};

const WHITE: Ink = Ink::solid(0x00ff_ffff);

/// The pixels that `draw` touches on a canvas of 8 x 6, whatever is clipped away, as a picture.
fn drawn(clip: Rect, draw: impl Fn(&mut Canvas)) -> Vec<String> {
    let mut pixels = vec![0; 8 * 6];
    draw(&mut Canvas::new(&mut pixels, [8, 6]).clipped(clip));
    let sign = |pixel: &u32| match pixel & 0xff {
        0 => '.',
        255 => '#',
        _ => '+',
    };
    pixels
        .chunks(8)
        .map(|row| row.iter().map(sign).collect())
        .collect()
}

const WHOLE: Rect = Rect {
    x: 0,
    y: 0,
    width: 8,
    height: 6,
};

#[test]
fn a_rectangle_covers_its_pixels_and_no_other() {
    let rows = drawn(WHOLE, |canvas| canvas.fill(Rect::new(1, 2, 3, 2), WHITE));
    assert_eq!(
        rows,
        [
            "........", "........", ".###....", ".###....", "........", "........"
        ]
    );
}

#[test]
fn a_disc_is_hollow_as_an_outline_and_filled_otherwise() {
    let disc = Rect::new(1, 0, 6, 6);
    let filled = drawn(WHOLE, |canvas| canvas.rounded(disc, 3, WHITE));
    assert_eq!(
        filled,
        [
            "..++++..", ".+####+.", ".+####+.", ".+####+.", ".+####+.", "..++++.."
        ]
    );
    let hollow = drawn(WHOLE, |canvas| canvas.outline(disc, 3, 1.0, WHITE));
    assert_eq!(hollow[2..4], [".++..++.", ".++..++."]);
    assert_eq!(hollow[0], filled[0]);
}

#[test]
fn nothing_is_drawn_outside_of_the_clip() {
    let clip = Rect::new(2, 1, 3, 2);
    let everything = |canvas: &mut Canvas| {
        let large = Rect::new(-50, -50, 100, 100);
        canvas.fill(large, WHITE);
        canvas.rounded(large, 9, WHITE);
        canvas.outline(Rect::new(-1, -1, 10, 8), 2, 3.0, WHITE);
        canvas.text(FACES[6], [-9, -9], WHITE, "WWWWWW");
        canvas.bold(FACES[0], [-3, -3], WHITE, "MMMMMM");
    };
    assert_eq!(
        drawn(clip, everything),
        [
            "........", "..###...", "..###...", "........", "........", "........"
        ]
    );
    assert_eq!(drawn(Rect::new(9, 9, 5, 5), everything), ["........"; 6]);
}

#[test]
fn what_lies_outside_of_the_buffer_is_not_drawn() {
    for rect in [
        Rect::new(9, 2, 3, 1),
        Rect::new(2, 7, 1, 9),
        Rect::new(-5, -5, 2, 2),
    ] {
        let rows = drawn(WHOLE, |canvas| canvas.fill(rect, WHITE));
        assert_eq!(rows, ["........"; 6]);
    }
}

#[test]
fn a_clip_cannot_be_widened_again() {
    let rows = drawn(Rect::new(0, 0, 1, 1), |canvas| {
        canvas.clipped(WHOLE).fill(WHOLE, WHITE);
    });
    assert_eq!(rows.concat().matches('#').count(), 1);
}

#[test]
fn glass_lets_through_what_is_below() {
    let mut pixels = [0x00ff_0000, 0x0000_00ff];
    Canvas::new(&mut pixels, [2, 1]).fill(WHOLE, Ink::glass(0x0000_ff00, 127));
    // 127 of 255 are 127 of 256 parts: 255 * 129 / 256 = 128 and 255 * 127 / 256 = 126.
    assert_eq!(pixels, [0x0080_7e00, 0x0000_7e80]);
    Canvas::new(&mut pixels, [2, 1]).fill(WHOLE, Ink::solid(0x0012_3456));
    assert_eq!(pixels, [0x0012_3456; 2]);
}

#[test]
fn letters_the_font_lacks_show_as_question_marks() {
    let text = |text: &str| {
        let mut pixels = vec![0; 40 * 20];
        let end = Canvas::new(&mut pixels, [40, 20]).text(FACES[0], [0, 0], WHITE, text);
        (pixels, end)
    };
    assert_eq!(text("\u{4e2d}"), text("?"));
    assert_ne!(text("\u{b5}"), text("?"));
    assert_eq!(text("abc").1, FACES[0].width(3));
}

#[test]
fn words_that_are_cut_end_in_dots() {
    assert_eq!(fit("perspective", 11), "perspective");
    assert_eq!(fit("perspective", 10), "perspect..");
    assert_eq!(fit("perspective", 3), "per");
    assert_eq!(fit("perspective", 0), "");
}

#[test]
fn a_line_covers_the_pixels_within_half_its_width_and_keeps_to_its_clip() {
    let size = [40_usize, 30];
    for (from, to, width) in [
        ([5.0, 5.0], [33.0, 21.0], 3.0_f32),
        ([30.5, 2.5], [8.5, 27.5], 2.0),
        ([10.0, 10.0], [10.0, 10.0], 6.0),
        ([-20.0, 15.0], [90.0, 16.0], 4.0),
    ] {
        let mut pixels = vec![0; size[0] * size[1]];
        let clip = Rect::new(3, 4, 34, 20);
        let mut canvas = Canvas::new(&mut pixels, size);
        canvas
            .clipped(clip)
            .line(from, to, width, Ink::solid(0x00ff_ffff));
        for (index, pixel) in pixels.iter().enumerate() {
            let [x, y] = [(index % size[0]) as i32, (index / size[0]) as i32];
            // The distance from many points of the line, the nearest of which is near enough.
            let distance = (0..=10_000)
                .map(|step| {
                    let share = step as f32 / 10_000.0;
                    let at = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
                    (x as f32 + 0.5 - at[0]).hypot(y as f32 + 0.5 - at[1])
                })
                .fold(f32::INFINITY, f32::min);
            let inside = clip.contains([x, y]);
            if !inside || distance > width / 2.0 + 0.6 {
                assert_eq!(*pixel, 0, "{x},{y}");
            } else if distance < width / 2.0 - 0.6 {
                assert_eq!(*pixel, 0x00ff_ffff, "{x},{y}");
            }
        }
    }
}
