//! Reading scene files: values, defaults, the order of entities, lights that are switched, and files that cannot be read.

use std::io::Write as _;

use proptest::prelude::*;
use shadetrade::scene::{BUILT_IN, CuboidRecord, LightRecord};

use super::LEAST;
use crate::support::cases::config;
use crate::support::prelude::*;

fn scene(text: &str) -> Scene {
    Scene::parse("test", text).unwrap_or_else(|error| panic!("{error}"))
}

fn record(scene: &Scene) -> SceneRecord {
    SceneRecord::of(&scene.world)
}

fn load(argument: &str) -> Scene {
    Scene::load(Some(argument)).unwrap_or_else(|error| panic!("{error}"))
}

fn complaint(argument: &str) -> String {
    let loaded = Scene::load(Some(argument)).map(drop);
    loaded.expect_err("it is wrong").to_string()
}

/// The position and the camera with this index.
fn seen_by(scene: &Scene, camera: usize) -> Camera {
    Camera::of(&scene.world, ordered::<Camera>(&scene.world)[camera])
}

fn on(scene: &Scene) -> String {
    let record = record(scene);
    record
        .light
        .iter()
        .map(|it| if it.on { '1' } else { '0' })
        .collect()
}

#[test]
fn a_missing_key_has_the_documented_default() {
    let cuboid = CuboidRecord {
        shading: ShadingMode::Gouraud,
        material: Material {
            ambient: DVec3::new(0.1, 0.2, 0.3),
            diffuse: DVec3::new(0.4, 0.5, 0.6),
            specular: DVec3::new(0.7, 0.8, 0.9),
            shininess: 76.8,
        },
        ..records::cuboid("box", [4.0, 3.0, 2.0], [0.0; 3])
    };
    let light = LightRecord {
        color: DVec3::new(1.0, 0.5, 0.0),
        ..records::light("white", LightKind::Diffuse, 10.0, [10.0, 11.0, 12.0])
    };
    let camera = records::camera("1", [7.0, 5.0, 8.0], [0.0; 3], [30.0, 6.3]);
    let expected = SceneRecord {
        background: DVec3::ZERO,
        cuboid: vec![cuboid],
        light: vec![light],
        camera: vec![camera],
        view: Viewer::default(),
    };
    let scene = scene(LEAST);
    assert_eq!(record(&scene), expected);
    assert_eq!(View::of(&scene.world, [1, 1]).tolerance, 0.5);
    let near = seen_by(&scene, 0).near();
    assert!((near - 138.0_f64.sqrt() / 1000.0).abs() < 1e-15);
}

/// Fuzzing found a shininess of -0.0, which Phong did not treat like 0.
#[test]
fn negative_zero_is_read_as_zero() {
    let text = LEAST
        .replace("shininess = 76.8", "shininess = -0.0")
        .replace("target = [0.0, 0.0, 0.0]", "target = [-0.0, -0, 0]");
    let record = record(&scene(&text));
    let target = record.camera[0].target;
    for number in [record.cuboid[0].material.shininess, target.x, target.y] {
        assert_eq!(number.to_bits(), 0.0_f64.to_bits());
    }
}

#[test]
fn every_built_in_scene_has_the_material_and_the_lights_of_the_first_which_is_the_default() {
    let default = built_in();
    assert_eq!(default.name, "cuboid");
    assert_eq!(names::<Camera>(&default.world), ["1", "2"]);
    let lights = ["white", "red", "specular", "ambient"];
    assert_eq!(names::<Light>(&default.world), lights);
    let expected = record(&default);
    for (name, _) in BUILT_IN {
        let scene = load(name);
        let record = record(&scene);
        assert_eq!(scene.name, name);
        assert_eq!(record.light, expected.light);
        assert_eq!(record.cuboid[0].material, expected.cuboid[0].material);
    }
}

#[test]
fn the_assignment_s_cuboid_and_cameras_are_where_it_puts_them() {
    let scene = load("assignment");
    let cuboid = &record(&scene).cuboid[0];
    assert_eq!(cuboid.size, DVec3::new(20.0, 10.0, 15.0));
    assert_eq!(cuboid.position, cuboid.size / 2.0);

    let [first, second] = [seen_by(&scene, 0), seen_by(&scene, 1)];
    assert_eq!(first.position, DVec3::new(0.0, 0.0, 35.0));
    assert_eq!(first.axes()[2], DVec3::NEG_Z);
    assert_eq!((first.fov, first.height), (126.87, 80.0));
    assert_eq!(second.position, DVec3::new(-15.0, -5.0, 10.0));
    assert_eq!(second.axes()[2], DVec3::X);
}

/// A choice of the four built-in lights, or of three whose names differ by a blank, and which of them are on.
const CHOICES: &str = "none -> 0000
ambient, red -> 0101
all -> 1111
white,white -> 1000
key  -> 010
 fill -> 001
key, fill -> 101
 key -> 100
key,key  -> 110";

#[test]
fn lights_are_switched_by_name_all_or_none() {
    let blanks = ["key", "key ", " fill"]
        .map(|name| records::light(name, LightKind::Ambient, 1.0, [0.0; 3]));
    let mut blanks = changed(|record| record.light = blanks.to_vec());
    let mut scene = built_in();
    for row in CHOICES.lines() {
        let (choice, expected) = row.split_once(" -> ").expect("lights");
        let scene = if expected.len() == 4 {
            &mut scene
        } else {
            &mut blanks
        };
        assert!(scene.switch_lights(choice).is_ok(), "{choice:?}");
        assert_eq!(on(scene), expected, "{choice:?}");
    }
    // A refused choice switches no light.
    for (choice, unknown) in [
        ("white,blue", "\"blue\""),
        ("Red", "\"Red\""),
        ("", "\"\""),
        ("white,,red", "\"\""),
        ("red,all", "\"all\""),
    ] {
        let said = scene.switch_lights(choice).expect_err(choice).to_string();
        assert!(said.contains(unknown) && said.contains("\"red\""), "{said}");
        assert_eq!(on(&scene), "1000");
    }
}

/// Whole numbers as written, and their values.
const LARGE: [(&str, f64); 4] = [
    ("-9223372036854775809", -9_223_372_036_854_775_809.0),
    ("18_446_744_073_709_551_616", 18_446_744_073_709_551_616.0),
    ("+100000000000000000000", 1e20),
    // Exactly between two floats without its last bit, which lies beyond 128 bits.
    (
        "0x100000000000008000000000000000000000000000000001",
        3.923_188_584_616_676e56,
    ),
];

#[test]
fn a_whole_number_is_a_number_whatever_its_size() {
    for (written, value) in LARGE {
        let text = LEAST.replace("[10.0, 11.0, 12.0]", &format!("[{written}, {written}, 1]"));
        let position = record(&scene(&text)).light[0].position;
        assert_eq!(position, Some(DVec3::new(value, value, 1.0)), "{written}");
    }
}

proptest! {
    #![proptest_config(config(64))]

    /// The standard library converts decimal digits of any number, and binary ones up to 128.
    #[test]
    fn a_whole_number_is_the_nearest_float(digits in "[1-9][0-9]{0,99}", bits: u128, zeros in 0..128) {
        let bits = bits >> zeros;
        let written = [digits.clone(), format!("{bits:#x}"), format!("{bits:#o}"), format!("{bits:#b}")];
        for (index, written) in written.into_iter().enumerate() {
            let text = LEAST.replace("[10.0,", &format!("[{written},"));
            let x = record(&scene(&text)).light[0].position.map(|it| it.x);
            let expected = if index == 0 { digits.parse().ok() } else { Some(bits as f64) };
            prop_assert_eq!(x, expected, "{}", written);
        }
    }
}

#[test]
fn a_path_is_loaded_and_its_errors_contain_it() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    write!(file, "{LEAST}").unwrap();
    let path = file.path().to_str().unwrap().to_owned();
    assert_eq!(load(&path).name, path);
    writeln!(file, "far = 100.0").unwrap();
    let message = complaint(&path);
    assert!(message.starts_with(&format!("{path}:22:1: ")), "{message}");
    file.write_all(b"# caf\xe9\n").unwrap();
    let message = complaint(&path);
    let place = format!("{path}:23:6: not UTF-8");
    assert!(message.starts_with(&place), "{message}");
}

#[test]
fn an_unreadable_scene_is_reported_with_its_cause() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().unwrap();
    for (path, is_absent) in [("cubiod", true), ("./cuboid", true), (folder, false)] {
        let message = complaint(path);
        assert!(message.contains(&format!("{path:?}")), "{message}");
        assert_eq!(message.contains("bench-far"), is_absent, "{message}");
    }
}

#[cfg(unix)]
#[test]
fn an_endless_device_is_refused_and_a_pipe_is_read() {
    assert!(complaint("/dev/zero").contains("16 MiB"));

    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let path = pipe.to_str().unwrap().to_owned();
    let writer = std::thread::spawn(move || std::fs::write(pipe, LEAST).unwrap());
    assert_eq!(names::<Camera>(&load(&path).world), ["1"]);
    writer.join().unwrap();
}
