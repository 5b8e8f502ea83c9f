//! Pictures saved from the window.

use std::fs;

use shadetrade::window::saving::save_picture as save;

const PIXELS: [u32; 6] = [
    0x0000_0000,
    0x00ff_0000,
    0x0000_ff00,
    0x0000_00ff,
    0x0012_3456,
    0x00ff_ffff,
];

#[test]
fn a_picture_holds_the_bytes_shown() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = save(folder.path(), &PIXELS, [3, 2]).expect("saved");
    assert_eq!(path.file_name().expect("a name"), "shadetrade-001.png");
    let picture = image::open(&path).expect("a picture").to_rgb8();
    assert_eq!(picture.dimensions(), (3, 2));
    let expected: Vec<u8> = PIXELS
        .iter()
        .flat_map(|pixel| pixel.to_be_bytes()[1..].to_vec())
        .collect();
    assert_eq!(picture.into_raw(), expected);
}

#[test]
fn the_next_free_number_is_taken_and_nothing_is_overwritten() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for taken in ["shadetrade-001.png", "shadetrade-003.png"] {
        fs::write(folder.path().join(taken), "mine").expect("written");
    }
    let names: Vec<_> = (0..2)
        .map(|_| save(folder.path(), &PIXELS, [3, 2]).expect("saved"))
        .map(|path| path.file_name().expect("a name").to_owned())
        .collect();
    assert_eq!(names, ["shadetrade-002.png", "shadetrade-004.png"]);
    assert_eq!(
        fs::read(folder.path().join("shadetrade-003.png")).expect("read"),
        b"mine"
    );
    assert_eq!(
        fs::read_dir(folder.path()).expect("listed").count(),
        4,
        "no temporary file is left"
    );
}

#[test]
fn programs_that_save_at_once_get_a_number_each() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut names: Vec<_> = std::thread::scope(|scope| {
        let savers: Vec<_> = (0..8)
            .map(|_| scope.spawn(|| save(folder.path(), &PIXELS, [3, 2])))
            .collect();
        savers
            .into_iter()
            .map(|saver| saver.join().expect("no panic").expect("saved"))
            .collect()
    });
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 8);
}

#[test]
fn a_folder_that_is_not_there_is_an_error() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let error = save(&folder.path().join("missing"), &PIXELS, [3, 2]).expect_err("it is missing");
    assert!(
        !error.to_string().contains(".tmp"),
        "{error} names our own file"
    );
}
