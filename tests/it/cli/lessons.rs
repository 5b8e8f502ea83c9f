//! Lessons drawn by the program.

use std::io::Cursor;

use super::{SCENE, assert_works, decode, folder, get, listing, put};

const LESSON: &str = r#"scene = "my.toml"
[[step]]
say = "One."
[[step]]
say = "A sentence of ninety letters takes longer to read than the first, which has only five letters."
set = { view.show = "tiles" }
"#;

#[test]
fn a_lesson_is_drawn_at_its_last_step_or_at_all_for_as_long_as_they_take_to_read() {
    let folder = folder();
    let folder = folder.path();
    put(folder, "my.toml", SCENE);
    put(folder, "lesson.toml", LESSON);
    let draw = |file: &str| {
        let line = format!("lesson lesson.toml --size 480x320 -o {file}");
        let said = assert_works(folder, &line);
        assert!(said.contains("2 steps") && said.contains(file), "{said}");
        get(folder, file)
    };
    let (width, height, last) = decode(&draw("last.png"));
    assert_eq!((width, height), (480, 320));
    let mut reader = png::Decoder::new(Cursor::new(draw("all.APNG"))).read_info();
    let reader = reader.as_mut().expect("a PNG");
    let mut canvas = vec![0; 3 * 480 * 320];
    let mut times = Vec::new();
    for _ in 0..2 {
        let mut part = vec![0; canvas.len()];
        reader.next_frame(&mut part).expect("a frame");
        let frame = *reader.info().frame_control().expect("it is animated");
        times.push(frame.delay_num);
        let [x, y, width, height] = [frame.x_offset, frame.y_offset, frame.width, frame.height];
        let rows = part.chunks(3 * width as usize).take(height as usize);
        for (row, line) in rows.zip(y as usize..) {
            let start = 3 * (480 * line + x as usize);
            canvas[start..start + row.len()].copy_from_slice(row);
        }
    }
    assert!(canvas == last, "the last frame is the last step");
    assert!(times[0] >= 3000 && times[1] > times[0], "{times:?}");
    assert_eq!(
        listing(folder),
        ["all.APNG", "last.png", "lesson.toml", "my.toml"]
    );
    // A lesson is a scene, too.
    assert_works(
        folder,
        "render lessons/what-a-tolerance-buys --size 9x9 -o -",
    );
}
