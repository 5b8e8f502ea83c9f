//! Lessons drawn by the program.

use shadetrade::scene::{LESSONS, first_sentence};

use super::{SCENE, assert_works, decode, folder, get, listing, put, run};

const LESSON: &str = r#"scene = "my.toml"
[[step]]
say = "A sentence that is longer than its picture is wide, so that it has more than one line."
ask = ["left", "right"]
right = 1
then = "So."
[[step]]
say = "Two."
set = { view.show = "wipe", view.divider = 0.25 }
[[step]]
say = "Three."
set = { view.show = "tiles" }
"#;

/// The corner of the first place where a picture has this part.
fn find(part: &(u32, u32, Vec<u8>), all: &(u32, u32, Vec<u8>)) -> Option<[usize; 2]> {
    let row = 3 * part.0 as usize;
    let width = 3 * all.0 as usize;
    let rows: Vec<&[u8]> = part.2.chunks_exact(row).collect();
    let is_there = |at: &usize| {
        let lines = all.2[*at..].chunks(width).zip(&rows);
        at.is_multiple_of(3)
            && lines.clone().count() == rows.len()
            && lines.clone().all(|(line, row)| line.starts_with(row))
    };
    let at = (0..all.2.len()).find(is_there)?;
    Some([at % width / 3, at / width])
}

#[test]
fn a_sheet_has_the_picture_of_each_step_with_the_names_in_it() {
    let folder = folder();
    let folder = folder.path();
    put(folder, "my.toml", SCENE);
    put(folder, "lesson.toml", LESSON);
    let said = assert_works(folder, "lesson lesson.toml --size 240x160 -o sheet.png");
    assert!(said.contains("3 steps") && said.contains("sheet.png"));
    assert_works(folder, "render my.toml --size 240x160 -o picture.png");
    let sheet = decode(&get(folder, "sheet.png"));
    let picture = decode(&get(folder, "picture.png"));
    let [left, top] = find(&picture, &sheet).expect("the picture of the first step");
    let pixel = |x: usize, y: usize| &sheet.2[3 * (sheet.0 as usize * y + x)..][..3];
    // Two columns; the line of the wipe goes from the top to the bottom of the second picture.
    let right = sheet.0 as usize - left - 240;
    assert!(right > left + 240, "{right}");
    let is_line = |y: usize| pixel(right + 60, y).iter().all(|it| *it > 180);
    // Below the names.
    assert!((top + 40..top + 160).all(is_line));
    assert!(!is_line(top - 2) && !is_line(top + 162));
    let names = listing(folder).join(" ");
    assert_eq!(names, "lesson.toml my.toml picture.png sheet.png");
    // A lesson is a scene, too.
    let line = "render lessons/what-a-tolerance-buys --size 9x9 -o -";
    assert_works(folder, line);
}

#[test]
fn the_built_in_lessons_are_listed_in_the_order_in_which_they_are_read() {
    let folder = folder();
    let output = run(folder.path(), "lesson --list");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), LESSONS.len());
    for (line, (name, lesson)) in lines.into_iter().zip(LESSONS) {
        let sentence = first_sentence(lesson);
        assert!(!sentence.is_empty() && line.ends_with(&sentence), "{line}");
        let own = line.split(' ').next().expect("a name");
        assert!(name.ends_with(own), "{line}");
    }
    let words = ["plane", "edges", "vertices", "tolerance"];
    let in_order = words.iter().zip(LESSONS);
    assert!(in_order.clone().all(|(word, it)| it.0.contains(word)));
}
