//! Logs that are cut off, wrong or extreme, and the animation made of one. Storms are recorded in `storms.rs`.

use std::fs;
use std::io::{self, Cursor};
use std::path::Path;
use std::time::Duration;

use fearless_simd::Level;
use image::AnimationDecoder;
use image::codecs::png::PngDecoder;
use shadetrade::drawing::Drawing;
use shadetrade::output::Animation;
use shadetrade::scene::Scene;
use shadetrade::simd;
use shadetrade::window::bindings::{Action, StepSize};
use shadetrade::window::recording::{Event, Log, Recorder, Start};
use shadetrade::window::replay::Player;

use super::drawing;

fn start() -> Start {
    let scene = Scene::load(None).expect("the built-in scene is valid");
    let mut start = Start::new(&drawing(scene));
    start.size = [64, 48];
    start
}

/// The log of these actions, one every tenth of a second.
fn log_of(actions: &[Action]) -> String {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("a.log");
    let mut recorder = Recorder::create(&path, &start()).expect("it can be written");
    for (index, action) in (1..).zip(actions) {
        let time = Duration::from_millis(100 * index);
        let noted = recorder.note(time, &Event::Action(*action));
        noted.expect("it can be written");
    }
    fs::read_to_string(&path).expect("it was written")
}

fn parse(text: &str) -> anyhow::Result<Log> {
    Log::parse("a.log", text, 1, Level::new())
}

fn error(text: &str) -> String {
    let error = parse(text).err();
    error.unwrap_or_else(|| panic!("{text}")).to_string()
}

#[test]
fn a_log_that_is_cut_off_anywhere_has_the_lines_that_ended() {
    let text = log_of(&[Action::Light(0), Action::NextCamera, Action::View(2)]);
    let header = text.find('\n').expect("lines") + 1;
    let start = header + text[header..].find('\n').expect("lines") + 1;
    for end in 0..text.len() {
        if !text.is_char_boundary(end) {
            continue;
        }
        let cut = &text[..end];
        if end < start {
            assert!(error(cut).starts_with("a.log:"), "{cut}");
            continue;
        }
        let log = parse(cut).unwrap_or_else(|error| panic!("{error}"));
        // The window as it opens is a frame too.
        let lines = cut[start..].matches('\n').count();
        assert_eq!(log.frames.len(), lines + 1, "{cut}");
        let whole = cut.ends_with('\n');
        assert_eq!(log.cut_off, (!whole).then_some(lines + 3), "{cut}");
    }
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let text = log_of(&[]);
    let begun = |line: &str| error(&format!("{text}{line}\n"));
    for (line, place, word) in [
        ("x light 0", "a.log:3:1: ", "seconds"),
        ("-1 light 0", "a.log:3:1: ", "seconds"),
        ("1e30 light 0", "a.log:3:1: ", "1000000"),
        ("1.0", "a.log:3:4: ", "what happened"),
        ("1.0 lihgt 0", "a.log:3:11: ", "`light`"),
        ("1.0 light zero", "a.log:3:11: ", "expected"),
        ("1.0 light", "a.log:3:10: ", "light 0"),
        ("1.0 light -1", "a.log:3:11: ", "-1"),
        ("1.0 quit", "a.log:3:9: ", "quit"),
        ("1.0 say words", "a.log:3:9: ", "expected"),
        ("1.0 size [0,1]", "a.log:3:10: ", "16384"),
        ("1.0 size [1,16385]", "a.log:3:10: ", "16384"),
        ("1.0 orbit {\"azimuth\":1}", "a.log:3:11: ", "elevation"),
        (
            "1.0 scene {\"name\":\"b.toml\",\"scene\":\"size = 3\"}",
            "a.log:3:11: ",
            "b.toml:1:1",
        ),
    ] {
        let said = begun(line);
        assert!(said.starts_with(place), "{line}: {said}");
        assert!(said.contains(word), "{line}: {said}");
    }
    assert!(begun("2 time\n1 time").contains("a.log:4:1: times do not go back"));
    assert!(error("shadetrade log 2\n").contains("a.log:1:1"));
    assert!(error("").contains("a.log:1:1"));
    for (from, to) in [
        ("\"camera\":\"1\"", "\"camera\":\"7\""),
        ("\"tolerance\":0.5", "\"tolerance\":300"),
        ("\"size\":[64,48]", "\"size\":[64,0]"),
        ("\"name\":", "\"extra\":1,\"name\":"),
    ] {
        assert!(text.contains(from), "{from}");
        let said = error(&text.replace(from, to));
        assert!(said.starts_with("a.log:2:13: "), "{to}: {said}");
    }
}

#[test]
fn no_number_of_a_log_is_too_large() {
    let largest = [f64::MAX, f64::MIN, 1e300, 0.0];
    let mut actions = vec![Action::Editor];
    for steps in [i32::MIN, -1, i32::MAX] {
        actions.extend([
            Action::View(steps),
            Action::Row(steps),
            Action::Tolerance(steps),
            Action::Zoom(steps.clamp(-1_000_000, 1_000_000)),
        ]);
        actions.extend(
            [None, Some(0), Some(1), Some(usize::MAX)].map(|row| Action::Step {
                row,
                steps,
                size: StepSize::Coarse,
            }),
        );
    }
    for azimuth in largest {
        actions.push(Action::DragDivider(azimuth));
        actions.push(Action::EndDrag);
        for elevation in largest {
            actions.push(Action::Orbit { azimuth, elevation });
            actions.push(Action::DragLight {
                light: 1,
                by: [azimuth, elevation],
                in_depth: azimuth == elevation,
            });
        }
    }
    actions.extend([Action::Light(usize::MAX), Action::ChooseRow(usize::MAX)]);
    actions.push(Action::Letters(usize::MAX));
    actions.push(Action::Probe(Some([usize::MAX; 2])));
    actions.extend([Action::Type('\u{1f600}'), Action::Enter, Action::Erase]);
    let log = parse(&log_of(&actions)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(log.frames.len(), actions.len() + 1);
    let mut player = Player::new(log.start).expect("there are threads");
    for frame in log.frames {
        player.play(frame).expect("a small picture fits");
        assert_eq!(player.shown.len(), 64 * 48);
    }
}

#[test]
fn what_is_read_is_what_was_written_to_the_last_bit() {
    let azimuth = 0.1 + 0.2;
    let orbit = Action::Orbit {
        azimuth,
        elevation: 1e-300,
    };
    let log =
        parse(&log_of(&[orbit, Action::Screenshot])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(log.frames.len(), 2, "a screenshot changes nothing");
    assert!(matches!(log.frames[1].events[..], [Event::Action(action)] if action == orbit));
    assert_eq!(log.frames[1].time, Duration::from_millis(100));
}

#[test]
fn the_lessons_replay_alike_however_they_are_drawn() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let mut lessons = 0;
    for entry in fs::read_dir(folder).expect("there are lessons") {
        let path = entry.expect("it can be read").path();
        if path.extension().is_none_or(|extension| extension != "log") {
            continue;
        }
        lessons += 1;
        let text = fs::read_to_string(&path).expect("it can be read");
        let fallback = simd::named("fallback").expect("every machine has it");
        let ways = [(1, fallback), (3, Level::new())];
        let replayed = ways.map(|(threads, level)| {
            let log = Log::parse("lesson", &text, threads, level);
            let log = log.unwrap_or_else(|error| panic!("{error}"));
            let start = Drawing {
                size: [200, 150],
                ..log.start
            };
            let mut player = Player::new(start).expect("there are threads");
            let frames = log.frames.into_iter().map(|frame| {
                player.play(frame).expect("a small picture fits");
                player.shown.clone()
            });
            frames.collect::<Vec<_>>()
        });
        assert!(replayed[0] == replayed[1], "{}", path.display());
        let steps = replayed[0].windows(2).filter(|it| it[0] != it[1]);
        assert!(steps.count() > 8, "{}", path.display());
    }
    assert_eq!(lessons, 2);
}

#[test]
fn a_recording_replaces_no_file() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("a.log");
    fs::write(&path, "mine").expect("written");
    let refused = Recorder::create(&path, &start()).err();
    assert_eq!(
        refused.map(|error| error.kind()),
        Some(io::ErrorKind::AlreadyExists)
    );
    assert_eq!(fs::read_to_string(&path).expect("read"), "mine");
}

#[test]
fn an_animation_shows_every_frame_as_it_was_given() {
    let size = [5, 4];
    let mut frames = vec![vec![0x0012_3456; 20]];
    let mut changed = |changes: &[(usize, u32)]| {
        let mut frame = frames[frames.len() - 1].clone();
        for (pixel, color) in changes {
            frame[*pixel] = *color;
        }
        frames.push(frame);
    };
    changed(&[(7, 0x00ff_0000)]);
    changed(&[]);
    changed(&[(0, 1), (19, 2)]);
    changed(&[(11, 3), (12, 4), (17, 5)]);
    let mut bytes = Vec::new();
    let mut animation =
        Animation::new(&mut bytes, size, frames.len() + 1).expect("memory can be written");
    for frame in &frames {
        let added = animation.add(frame, size, Duration::from_millis(40));
        added.expect("memory can be written");
    }
    // A smaller one stands in the corner, on black.
    let small = animation.add(&[6; 6], [3, 2], Duration::from_secs(1000));
    small.expect("memory can be written");
    animation.finish().expect("all frames are there");
    let mut corner = vec![0; 20];
    for pixel in [0, 1, 2, 5, 6, 7] {
        corner[pixel] = 6;
    }
    frames.push(corner);
    let decoder = PngDecoder::new(Cursor::new(bytes)).expect("a PNG");
    let decoded = decoder.apng().expect("animated").into_frames();
    let decoded: Vec<Vec<u32>> = decoded
        .map(|frame| {
            let frame = frame.expect("whole").into_buffer();
            let color = |pixel: &image::Rgba<u8>| {
                let [red, green, blue, _] = pixel.0;
                u32::from_be_bytes([0, red, green, blue])
            };
            frame.pixels().map(color).collect()
        })
        .collect();
    assert_eq!(decoded, frames);
}
