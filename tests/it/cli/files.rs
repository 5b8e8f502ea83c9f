//! Files are written completely or not at all, and no other file changes.

use std::fs;

use shadetrade::scene::Scene;

use super::{assert_works, decode, folder, get, listing, put, run, said};

/// The arguments for a small picture; the name of the file follows.
const SMALL: &str = "render --size 16x12 --threads 1 -o";

#[test]
fn a_file_is_made_or_replaced_and_nothing_is_left_beside_it() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).expect("it is made");
    put(folder.path(), "a.png", vec![b'x'; 100_000]);
    let absolute = folder.path().join("absolute.png");
    let absolute = absolute.to_str().expect("it is UTF-8");
    let long = "n".repeat(251) + ".png";
    let names = "./a.png sub/../b.PNG ./- no-extension c.v2.png".split(' ');
    for path in names.chain([absolute, &long]) {
        assert_works(folder.path(), &format!("{SMALL} {path}"));
        decode(&get(folder.path(), path));
    }
    assert_eq!(listing(folder.path()).len(), 8, "seven files and a folder");
}

#[test]
fn standard_output_holds_the_file_alone() {
    let folder = folder();
    for (line, words) in [
        ("render -o -", "standard output"),
        ("render -o /dev/stdout", "standard output"),
        ("prove -o -", "proven     192 of 192 pixels"),
    ] {
        let output = run(folder.path(), &format!("{line} --size 16x12"));
        let (width, height, _) = decode(&output.stdout);
        assert_eq!((width, height), (16, 12));
        assert!(output.stdout.ends_with(b"IEND\xae\x42\x60\x82"));
        assert!(String::from_utf8_lossy(&output.stderr).contains(words));
    }
    let output = run(folder.path(), "requires --lights none --size 9x9 -o -");
    let scene = String::from_utf8_lossy(&output.stdout);
    assert!(Scene::parse("least", &scene).is_ok(), "{scene}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("\ncuboid emerald "));
    assert_eq!(listing(folder.path()), [""; 0]);
}

#[test]
fn of_files_that_belong_together_all_are_written_or_none() {
    let folder = folder();
    // A folder has the name of the last file.
    let trade = "trade --quick --size 16x12 --methods phong-1";
    let vary = "vary camera.1.fov=20..30 --size 16x12 --steps 2 --methods phong-1";
    for (line, last) in [
        ("figures", "components.png"),
        (trade, "trade.svg"),
        (vary, "vary.svg"),
    ] {
        let place = folder.path().join(last);
        fs::create_dir_all(place.join("kept")).expect("it is made");
        let output = run(folder.path(), &format!("{line} -o ."));
        assert_eq!(output.status.code(), Some(1), "{}", said(&output));
        assert_eq!(listing(folder.path()), [last]);
        fs::remove_dir_all(place).expect("it is there");
    }
}

#[cfg(unix)]
mod unix {
    use std::io::Read;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::os::unix::process::CommandExt;
    use std::path::Path;
    use std::process::Command;

    use super::*;
    use crate::cli::{assert_failed, in_shell};

    fn mode(path: &Path) -> u32 {
        let metadata = fs::metadata(path).expect("it is there");
        metadata.permissions().mode() & 0o7777
    }

    fn set_mode(path: &Path, mode: u32) {
        let permissions = fs::Permissions::from_mode(mode);
        fs::set_permissions(path, permissions).expect("it is ours");
    }

    #[test]
    fn a_new_file_has_the_default_permissions_and_a_replaced_one_keeps_its_own() {
        let folder = folder();
        let [plain, file] = ["plain", "a.png"].map(|name| folder.path().join(name));
        for umask in ["022", "077"] {
            let script =
                format!("rm -f a.png plain; umask {umask}; : > plain; exec $0 {SMALL} a.png");
            let output = in_shell(folder.path(), &script);
            assert!(output.status.success(), "{}", said(&output));
            assert_eq!(mode(&file), mode(&plain), "umask {umask}");
        }
        for kept in [0o600, 0o755] {
            set_mode(&file, kept);
            assert_works(folder.path(), &format!("{SMALL} a.png"));
            assert_eq!(mode(&file), kept);
        }
    }

    #[test]
    fn a_link_stays_a_link_and_its_target_is_replaced() {
        let folder = folder();
        fs::create_dir(folder.path().join("sub")).expect("it is made");
        put(folder.path(), "sub/target.png", "old");
        for (target, name) in [
            ("target.png", "sub/inner.png"),
            ("sub/inner.png", "outer.png"),
            ("sub/new.png", "dangling.png"),
            ("loop.png", "loop.png"),
            ("absent/a.png", "astray.png"),
        ] {
            symlink(target, folder.path().join(name)).expect("it is made");
        }
        for (link, target) in [
            ("outer.png", "sub/target.png"),
            ("dangling.png", "sub/new.png"),
        ] {
            assert_works(folder.path(), &format!("{SMALL} {link}"));
            assert!(folder.path().join(link).is_symlink());
            assert!(!folder.path().join(target).is_symlink());
            decode(&get(folder.path(), target));
        }
        for (link, reason) in [("loop.png", "symbolic links"), ("astray.png", "no folder")] {
            let output = run(folder.path(), &format!("{SMALL} {link}"));
            assert_failed(&output, 1, &format!("{link}|{reason}"));
        }
        let sub = listing(&folder.path().join("sub"));
        assert_eq!(sub, ["inner.png", "new.png", "target.png"]);
        assert_eq!(listing(folder.path()).len(), 5);
    }

    #[test]
    fn pipes_and_devices_are_written_directly() {
        let folder = folder();
        let pipe = folder.path().join("pipe.fifo");
        let made = Command::new("mkfifo").arg(&pipe).status();
        assert!(made.expect("there is such a program").success());
        let path = pipe.clone();
        let reader = std::thread::spawn(move || {
            let mut bytes = Vec::new();
            let read = fs::File::open(path).and_then(|mut pipe| pipe.read_to_end(&mut bytes));
            read.map(|_| bytes)
        });
        assert_works(folder.path(), &format!("{SMALL} pipe.fifo"));
        decode(&reader.join().expect("no panic").expect("it is read"));
        assert!(!pipe.is_file());
        assert_works(folder.path(), &format!("{SMALL} /dev/null"));
        let output = run(folder.path(), &format!("{SMALL} /dev/full"));
        assert_failed(&output, 1, "/dev/full|No space left");
        assert_eq!(listing(folder.path()), ["pipe.fifo"]);
        let script = format!("$0 {SMALL} - | $0 prove --picture -");
        let judged = in_shell(folder.path(), &script);
        assert!(judged.status.success(), "{}", said(&judged));
    }

    /// The superuser ignores permissions, so the program is run as another user then.
    #[test]
    fn a_folder_or_file_without_write_permission_is_an_error() {
        let folder = folder();
        let program = folder.path().join("program");
        // Not `fs::copy`: a test that starts a program meanwhile would hold the copy open for writing, and so busy.
        let mut copy = Command::new("cp");
        let copied = copy
            .arg(env!("CARGO_BIN_EXE_shadetrade"))
            .arg(&program)
            .status();
        assert!(copied.is_ok_and(|it| it.success()));
        for name in ["kept.png", "old.png"] {
            put(folder.path(), name, "old");
        }
        let refused = |line: &str, name: &str| {
            let mut command = Command::new(&program);
            command.current_dir(folder.path()).args(line.split(' '));
            if fs::metadata(folder.path()).expect("it is there").uid() == 0 {
                command.uid(65_534).gid(65_534);
            }
            let output = command.output().expect("it starts");
            assert_failed(&output, 1, &format!("{name}|ermission denied"));
        };
        set_mode(folder.path(), 0o777);
        set_mode(&folder.path().join("kept.png"), 0o444);
        refused(&format!("{SMALL} kept.png"), "kept.png");
        set_mode(folder.path(), 0o555);
        for name in ["a.png", "old.png"] {
            refused(&format!("{SMALL} {name}"), name);
        }
        refused("figures -o new", "new");
        set_mode(folder.path(), 0o755);
        let left = listing(folder.path());
        assert_eq!(left, ["kept.png", "old.png", "program"]);
        assert_eq!(get(folder.path(), "kept.png"), b"old");
    }
}
