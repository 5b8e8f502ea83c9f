//! Unusual and hostile names and paths: none reaches the terminal as anything but text.

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;

use super::{SCENE, assert_failed, assert_works, decode, folder, put, run, said, shadetrade};

#[test]
fn the_path_of_a_scene_need_not_be_utf_8() {
    let folder = folder();
    let render = |name: &OsStr| {
        let mut command = shadetrade(folder.path());
        command.args("render --size 9x9 -o -".split(' ')).arg(name);
        command.output().expect("the program starts")
    };
    let name = OsStr::from_bytes(b"caf\xe9.toml");
    std::fs::write(folder.path().join(name), SCENE).expect("it is written");
    decode(&render(name).stdout);
    let output = render(OsStr::from_bytes(b"th\xe9.toml"));
    assert_failed(&output, 2, "th\u{fffd}.toml");
}

#[test]
fn no_name_or_path_moves_the_cursor() {
    let folder = folder();
    let path = "\u{1b}[31mred\u{9b}m\u{7}.toml";
    let scene = SCENE.replace("\"white\"", r#""w\u001b[31m""#);
    put(folder.path(), path, scene);
    for words in [
        vec!["render", path, "--size", "9x9", "-o", "a\u{1b}[2J.png"],
        vec!["render", path, "--lights", "\u{1b}[31m", "-o", "a.png"],
        vec!["render", "\u{1b}[31m.toml", "-o", "a.png"],
        vec!["render", "-o", "absent/\u{1b}[31m.png"],
        vec!["render", path, "--size", "\u{1b}[31m", "-o", "a.png"],
        vec!["--\u{1b}[31m"],
        vec!["figures", "-o", "\u{1b}[31m/\u{1b}[31m"],
        vec!["probe", path, "--pixel", "480,300"],
        vec![path],
    ] {
        let output = shadetrade(folder.path()).args(&words).output();
        let output = output.expect("the program starts");
        for text in [&output.stderr, &output.stdout] {
            let text = String::from_utf8_lossy(text);
            let harmful = |c: char| c.is_control() && c != '\n';
            assert!(!text.contains(harmful), "{words:?}: {text:?}");
        }
    }
}

#[test]
fn a_name_with_a_line_break_takes_one_line() {
    let folder = folder();
    put(folder.path(), "a\nb.toml", SCENE);
    put(folder.path(), "a\nwrong.toml", "colour = 1");
    let scene = SCENE.replace("\"emerald\"", r#""em\nerald""#);
    put(folder.path(), "a.toml", scene);
    let dark = "render a.toml --lights none --size 9x9 -o dark.png";
    assert_works(folder.path(), dark);
    // `⏎` is the line break in a name.
    for (words, told) in [
        ("render a⏎b.toml -o c⏎d.png", "wrote c\\nd.png: "),
        ("render a⏎wrong.toml -o -", "a\\nwrong.toml:1:1: "),
        ("render -o no⏎ne/a.png", "no folder no\\nne\n"),
        ("prove --picture a⏎b.toml", "a\\nb.toml is not a PNG"),
        ("a⏎b.toml", "a\\nb.toml"),
        ("prove a⏎b.toml --size 9x9", "a\\nb.toml, camera"),
        (
            "requires a.toml --size 9x9",
            "\ncuboid em\\nerald |\nem\\nerald ",
        ),
        ("prove a.toml --picture dark.png", ", em\\nerald, face"),
        ("probe a.toml --size 9x9 --pixel 4,4", "4,4: em\\nerald,"),
    ] {
        let words = words.split(' ').map(|it| it.replace('⏎', "\n"));
        let mut command = shadetrade(folder.path());
        let output = command.args(words).output();
        let output = output.expect("the program starts");
        let text = said(&output) + &String::from_utf8_lossy(&output.stdout);
        let is_told = told.split('|').all(|it| text.contains(it));
        assert!(is_told, "{told}: {text}");
    }
}

#[test]
fn a_missing_name_is_answered_with_a_short_list_of_names() {
    let folder = folder();
    let more = |index: usize| {
        format!(
            "[[light]]\nname = \"l{index}\"\nkind = \"ambient\"\ncolor = [0, 0, 0]\nintensity = 0\n\
             [[camera]]\nname = \"c{index}\"\nposition = [1, 2, 3]\ntarget = [0, 0, 0]\nfov = 30\nheight = 1\n"
        )
    };
    let more: String = (0..500).map(more).collect();
    put(folder.path(), "many.toml", SCENE.to_owned() + &more);
    for option in ["--lights", "--camera"] {
        let line = format!("render many.toml -o a.png {option} nope");
        let output = run(folder.path(), &line);
        assert_failed(&output, 2, "\"nope\"| more");
        assert!(said(&output).len() < 1000);
    }
    let line = "render many.toml -o a.png --camera c499 --size 9x9";
    assert_works(folder.path(), line);
}
