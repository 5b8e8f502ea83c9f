//! Files are written completely or not at all, and no other file changes.

use std::fs;

use super::{assert_fails, assert_works, decode, folder, listing, run};

/// The arguments for a small picture; the name of the file follows.
const SMALL: &str = "render --size 16x12 --threads 1 -o";

#[test]
fn a_file_is_made_or_replaced_and_nothing_is_left_beside_it() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("a.png"), vec![b'x'; 100_000]).unwrap();
    let absolute = folder.path().join("absolute.png");
    let long = "n".repeat(251) + ".png";
    for path in [
        "./a.png",
        "sub/../b.PNG",
        "./-",
        "no-extension",
        "c.v2",
        absolute.to_str().unwrap(),
        &long,
    ] {
        assert_works(folder.path(), &format!("{SMALL} {path}"));
        decode(&fs::read(folder.path().join(path)).unwrap());
    }
    assert_eq!(listing(folder.path()).len(), 8, "seven files and a folder");
}

#[test]
fn a_path_that_cannot_be_a_file_is_an_error_with_the_reason() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("file"), "mine").unwrap();
    for (path, words) in [
        ("sub", &["sub", "folder"][..]),
        (".", &["folder"]),
        ("absent/", &["absent/", "folder"]),
        ("absent/a.png", &["absent/a.png", "no folder absent"]),
        ("absent/more/a.png", &["no folder absent/more"]),
        ("file/a.png", &["file/a.png"]),
        (&"n".repeat(300), &["too long"]),
    ] {
        assert_fails(folder.path(), &format!("{SMALL} {path}"), 1, words);
    }
    assert_eq!(listing(folder.path()), ["file", "sub"]);
    assert_eq!(fs::read(folder.path().join("file")).unwrap(), b"mine");
}

#[test]
fn standard_output_holds_the_picture_alone() {
    let folder = folder();
    let output = run(folder.path(), &format!("{SMALL} -"));
    let (width, height, _) = decode(&output.stdout);
    assert_eq!((width, height), (16, 12));
    assert!(
        output.stdout.ends_with(b"IEND\xae\x42\x60\x82"),
        "nothing follows the picture"
    );
    assert!(String::from_utf8_lossy(&output.stderr).contains("standard output"));
    assert_eq!(listing(folder.path()), [""; 0]);
}

#[test]
fn a_name_with_the_extension_of_another_format_is_refused() {
    let folder = folder();
    for name in ["a.jpg", "a.GIF"] {
        for line in [
            format!("{SMALL} {name}"),
            format!("prove --size 9x9 -o {name}"),
        ] {
            assert_fails(folder.path(), &line, 2, &[name, "PNG"]);
        }
    }
    assert_eq!(listing(folder.path()), [""; 0]);
}

#[test]
fn a_scene_is_not_replaced_by_its_picture() {
    let folder = folder();
    let scene = include_str!("../../../assets/scenes/cuboid.toml");
    fs::write(folder.path().join("a.toml"), scene).unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for output in ["a.toml", "./sub/../a.toml"] {
        let line = format!("{SMALL} {output} ./a.toml");
        assert_fails(folder.path(), &line, 2, &["a.toml", "scene"]);
        let line = format!("prove --size 9x9 -o {output} a.toml");
        assert_fails(folder.path(), &line, 2, &["a.toml", "scene"]);
    }
    let kept = fs::read_to_string(folder.path().join("a.toml")).unwrap();
    assert_eq!(kept, scene);
    // The scene of that name is built in, so the file is not the scene.
    fs::write(folder.path().join("cuboid"), "mine").unwrap();
    assert_works(folder.path(), &format!("{SMALL} cuboid cuboid"));
}

#[cfg(unix)]
mod unix {
    use std::fs::{File, OpenOptions};
    use std::io::Read;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::path::Path;
    use std::process::Command;

    use super::*;
    use crate::cli::{in_shell, said, shadetrade, stop};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    fn set_mode(path: &Path, mode: u32) {
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    }

    /// Whether the user that runs the tests ignores permissions.
    fn is_root() -> bool {
        fs::metadata(folder().path()).unwrap().uid() == 0
    }

    #[test]
    fn a_new_file_has_the_default_permissions_and_a_replaced_one_keeps_its_own() {
        let folder = folder();
        let [plain, file] = ["plain", "a.png"].map(|name| folder.path().join(name));
        for umask in ["022", "077"] {
            let script = format!("umask {umask}; : > plain; exec $0 {SMALL} a.png");
            let output = in_shell(folder.path(), &script);
            assert!(output.status.success(), "{}", said(&output));
            assert_eq!(mode(&file), mode(&plain), "umask {umask}");
            fs::remove_file(&file).unwrap();
            fs::remove_file(&plain).unwrap();
        }
        fs::write(&file, "old").unwrap();
        for kept in [0o600, 0o755] {
            set_mode(&file, kept);
            assert_works(folder.path(), &format!("{SMALL} a.png"));
            assert_eq!(mode(&file), kept);
        }
    }

    #[test]
    fn a_closed_standard_output_is_an_error() {
        let folder = folder();
        fs::write(folder.path().join("a"), "mine").unwrap();
        for line in [
            &format!("{SMALL} -"),
            "probe --pixel 3,3",
            "completions bash",
        ] {
            let output = in_shell(folder.path(), &format!("exec $0 {line} 1< a"));
            assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
            let words = "error: cannot write to standard output: Bad file descriptor";
            assert!(
                said(&output).starts_with(words),
                "{line}: {}",
                said(&output)
            );
        }
    }

    #[test]
    fn a_link_stays_a_link_and_its_target_is_replaced() {
        let folder = folder();
        fs::create_dir(folder.path().join("sub")).unwrap();
        fs::write(folder.path().join("sub/target.png"), "old").unwrap();
        symlink("target.png", folder.path().join("sub/inner.png")).unwrap();
        symlink("sub/inner.png", folder.path().join("outer.png")).unwrap();
        symlink("sub/new.png", folder.path().join("dangling.png")).unwrap();
        for (link, target) in [
            ("outer.png", "sub/target.png"),
            ("dangling.png", "sub/new.png"),
        ] {
            assert_works(folder.path(), &format!("{SMALL} {link}"));
            assert!(folder.path().join(link).is_symlink());
            let target = folder.path().join(target);
            assert!(!target.is_symlink());
            decode(&fs::read(target).unwrap());
        }
        assert_eq!(
            listing(&folder.path().join("sub")),
            ["inner.png", "new.png", "target.png"]
        );
    }

    #[test]
    fn a_looping_or_dangling_link_is_an_error() {
        let folder = folder();
        symlink("loop.png", folder.path().join("loop.png")).unwrap();
        symlink("absent/a.png", folder.path().join("astray.png")).unwrap();
        for words in [["loop.png", "symbolic links"], ["astray.png", "no folder"]] {
            assert_fails(folder.path(), &format!("{SMALL} {}", words[0]), 1, &words);
        }
        assert_eq!(listing(folder.path()), ["astray.png", "loop.png"]);
    }

    #[test]
    fn a_pipe_is_written_and_stays_a_pipe() {
        let folder = folder();
        let pipe = folder.path().join("pipe");
        assert!(
            Command::new("mkfifo")
                .arg(&pipe)
                .status()
                .unwrap()
                .success()
        );
        let path = pipe.clone();
        let reader = std::thread::spawn(move || {
            let mut bytes = Vec::new();
            File::open(path)
                .and_then(|mut pipe| pipe.read_to_end(&mut bytes))
                .map(|_| bytes)
        });
        assert_works(folder.path(), &format!("{SMALL} pipe"));
        decode(&reader.join().unwrap().unwrap());
        assert_eq!(listing(folder.path()), ["pipe"]);
        assert!(!pipe.is_file());
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn devices_are_written_directly() {
        let folder = folder();
        assert_works(folder.path(), &format!("{SMALL} /dev/null"));
        assert_fails(
            folder.path(),
            &format!("{SMALL} /dev/full"),
            1,
            &["/dev/full", "No space left"],
        );
        let output = run(folder.path(), &format!("{SMALL} /dev/stdout"));
        decode(&output.stdout);
        assert_eq!(listing(folder.path()), [""; 0]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_standard_output_is_an_error() {
        let folder = folder();
        for line in [&format!("{SMALL} -"), "--help", "completions bash"] {
            let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
            let mut program = shadetrade(folder.path());
            let output = program.args(line.split(' ')).stdout(full).output().unwrap();
            let said = said(&output);
            assert_eq!(output.status.code(), Some(1), "{line}: {said}");
            let words = "cannot write to standard output: No space left";
            assert!(said.contains(words), "{line}: {said}");
        }
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_other() {
        let folder = folder();
        let file = folder.path().join("a.png");
        fs::write(&file, "old").unwrap();
        // A limit on the file size stands for a full disk. Its signal is ignored.
        let script = "trap '' XFSZ; ulimit -f 8; exec $0 render --size 960x720 -o a.png";
        let output = in_shell(folder.path(), script);
        assert_eq!(output.status.code(), Some(1), "{}", said(&output));
        assert!(
            said(&output).starts_with("error: cannot write a.png: "),
            "{}",
            said(&output)
        );
        assert_eq!(fs::read(&file).unwrap(), b"old");
        assert_eq!(listing(folder.path()), ["a.png"]);
    }

    #[test]
    fn an_interrupt_leaves_the_old_file_or_the_complete_new_one() {
        let folder = folder();
        let file = folder.path().join("a.png");
        fs::write(&file, "old").unwrap();
        let child = shadetrade(folder.path())
            .args("render --size 4000x4000 --lights all -o a.png".split(' '))
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap();
        // The temporary file shows that the picture is being written.
        let ended = stop(child, "INT", || listing(folder.path()) != ["a.png"]);
        if ended.success() {
            assert_eq!(listing(folder.path()), ["a.png"]);
            decode(&fs::read(&file).unwrap());
        } else {
            assert_eq!(fs::read(&file).unwrap(), b"old");
            let others = listing(folder.path())
                .into_iter()
                .filter(|name| name != "a.png");
            assert!(
                others
                    .into_iter()
                    .all(|name| name.starts_with(".shadetrade-"))
            );
        }
    }

    #[test]
    fn a_folder_or_file_without_write_permission_is_an_error() {
        if is_root() {
            return;
        }
        let folder = folder();
        for name in ["kept.png", "old.png"] {
            fs::write(folder.path().join(name), "old").unwrap();
        }
        set_mode(&folder.path().join("kept.png"), 0o444);
        let refused = |line: &str, name| {
            assert_fails(folder.path(), line, 1, &[name, "ermission denied"]);
        };
        refused(&format!("{SMALL} kept.png"), "kept.png");
        set_mode(folder.path(), 0o555);
        refused(&format!("{SMALL} a.png"), "a.png");
        refused(&format!("{SMALL} old.png"), "old.png");
        refused("figures -o new", "new");
        set_mode(folder.path(), 0o755);
        assert_eq!(listing(folder.path()), ["kept.png", "old.png"]);
    }
}
