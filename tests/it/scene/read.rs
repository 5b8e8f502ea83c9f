//! Reading scene files: their values, defaults, components and queries.

use std::fmt::Write as _;
use std::io::Write as _;

use glam::DVec3;
use shadetrade::components::{
    Background, Camera, Light, LightKind, Material, Mesh, Name, Normals, ShadingMode, Transform,
    VertexColors, View, Viewpoint, names, ordered, overwrite,
};
use shadetrade::scene::{BUILT_IN, LightChoice, Scene};

use super::{LEAST, MOST};

fn scene(text: &str) -> Scene {
    Scene::parse("test", text).unwrap_or_else(|error| panic!("{error}"))
}

fn load(argument: Option<&str>) -> Scene {
    Scene::load(argument).unwrap_or_else(|error| panic!("{error}"))
}

fn complaint(argument: &str) -> String {
    match Scene::load(Some(argument)) {
        Ok(_) => panic!("{argument} was loaded"),
        Err(error) => error.to_string(),
    }
}

/// [`LEAST`] without its light.
fn dark() -> Scene {
    let light = LEAST.find("[[light]]").unwrap()..LEAST.find("[[camera]]").unwrap();
    scene(&LEAST.replace(&LEAST[light], ""))
}

/// The scene with `count` cuboids, whose names and sizes are their numbers.
fn many(count: usize) -> String {
    let (material, camera) = LEAST.split_at(LEAST.find("[[light]]").unwrap());
    let material = &material[material.find("[cuboid.material]").unwrap()..];
    let mut text = String::new();
    for number in 1..=count {
        write!(
            text,
            "[[cuboid]]\nname = \"{number}\"\nsize = [{number}, 1, 1]\n{material}"
        )
        .unwrap();
    }
    text + camera
}

fn value<T: hecs::Component + Clone>(scene: &Scene, entity: hecs::Entity) -> T {
    (*scene.world.get::<&T>(entity).unwrap()).clone()
}

fn change<T: hecs::Component>(scene: &Scene, entity: hecs::Entity, how: impl FnOnce(&mut T)) {
    how(&mut scene.world.get::<&mut T>(entity).unwrap());
}

fn background(scene: &Scene) -> DVec3 {
    View::of(&scene.world, [1, 1]).background
}

/// The position and the camera with this index.
fn viewpoint(scene: &Scene, camera: usize) -> Viewpoint {
    Viewpoint::of(&scene.world, ordered::<Camera>(&scene.world)[camera])
}

fn on(scene: &Scene) -> Vec<bool> {
    let is_on = |&light| value::<Light>(scene, light).on;
    ordered::<Light>(&scene.world).iter().map(is_on).collect()
}

#[test]
fn a_missing_key_has_the_documented_default() {
    let scene = scene(LEAST);
    assert_eq!(scene.name, "test");
    assert_eq!(background(&scene), DVec3::ZERO);
    let (cuboid, light) = (
        ordered::<Mesh>(&scene.world)[0],
        ordered::<Light>(&scene.world)[0],
    );

    assert_eq!(value::<Name>(&scene, cuboid), Name("box".to_owned()));
    assert_eq!(value::<Transform>(&scene, cuboid), Transform::default());
    let mesh = Mesh::cuboid(DVec3::new(4.0, 3.0, 2.0));
    assert_eq!(value::<Mesh>(&scene, cuboid), mesh);
    let mode = value::<ShadingMode>(&scene, cuboid);
    assert_eq!(mode, ShadingMode::Gouraud);
    let material = Material {
        ambient: DVec3::new(0.1, 0.2, 0.3),
        diffuse: DVec3::new(0.4, 0.5, 0.6),
        specular: DVec3::new(0.7, 0.8, 0.9),
        shininess: 76.8,
    };
    assert_eq!(value::<Material>(&scene, cuboid), material);
    assert!(scene.world.satisfies::<(&Normals, &VertexColors)>(cuboid));

    let expected = Light {
        kind: LightKind::Diffuse,
        color: DVec3::new(1.0, 0.5, 0.0),
        intensity: 10.0,
        gain: 1.0,
        on: true,
    };
    assert_eq!(value::<Light>(&scene, light), expected);
    let position = value::<Transform>(&scene, light).position;
    assert_eq!(position, DVec3::new(10.0, 11.0, 12.0));

    let expected = Camera {
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov: 30.0,
        height: 6.3,
        near: None,
    };
    let viewpoint = viewpoint(&scene, 0);
    assert_eq!(viewpoint.camera, expected);
    assert_eq!(viewpoint.position, DVec3::new(7.0, 5.0, 8.0));
    assert!((viewpoint.near() - 138.0_f64.sqrt() / 1000.0).abs() < 1e-15);
}

#[test]
fn every_key_is_read_and_integers_are_numbers() {
    let scene = scene(MOST);
    let (cuboid, light) = (
        ordered::<Mesh>(&scene.world)[0],
        ordered::<Light>(&scene.world)[0],
    );
    assert_eq!(background(&scene), DVec3::new(0.0, 255.0, 1.5));

    assert_eq!(value::<Name>(&scene, cuboid), Name("é".to_owned()));
    let expected = Transform {
        position: DVec3::new(-1.0, 2.0, 300.0),
        rotation: DVec3::new(10.0, 20.0, -720.0),
    };
    assert_eq!(value::<Transform>(&scene, cuboid), expected);
    let mesh = Mesh::cuboid(DVec3::new(1.0, 2.0, 4.0));
    assert_eq!(value::<Mesh>(&scene, cuboid), mesh);
    let mode = value::<ShadingMode>(&scene, cuboid);
    assert_eq!(mode, ShadingMode::Phong);
    let material = Material {
        ambient: DVec3::new(1.0, 2.0, 3.0),
        diffuse: DVec3::new(4.0, 5.0, 6.0),
        specular: DVec3::new(7.0, 8.0, 9.0),
        shininess: 0.0,
    };
    assert_eq!(value::<Material>(&scene, cuboid), material);

    let expected = Light {
        kind: LightKind::Specular,
        color: DVec3::new(16.0, 15.0, 3.0),
        intensity: 1000.0,
        gain: 1e18,
        on: false,
    };
    assert_eq!(value::<Light>(&scene, light), expected);
    let position = value::<Transform>(&scene, light).position;
    assert_eq!(position, DVec3::new(1.0, 2.0, 3.0));

    let expected = Camera {
        target: DVec3::Z,
        up: DVec3::X,
        fov: 179.0,
        height: 2.0,
        near: Some(3.0),
    };
    assert_eq!(viewpoint(&scene, 0).camera, expected);
    assert_eq!(viewpoint(&scene, 0).near(), 3.0);
}

/// Fuzzing found a shininess of -0.0, which Phong did not treat like 0.
#[test]
fn negative_zero_is_read_as_zero() {
    let text = LEAST
        .replace("shininess = 76.8", "shininess = -0.0")
        .replace("target = [0.0, 0.0, 0.0]", "target = [-0.0, -0, 0]");
    let scene = scene(&text);
    let shininess = value::<Material>(&scene, ordered::<Mesh>(&scene.world)[0]).shininess;
    let target = value::<Camera>(&scene, ordered::<Camera>(&scene.world)[0]).target;
    for number in [shininess, target.x, target.y] {
        assert_eq!(number.to_bits(), 0.0_f64.to_bits());
    }
}

#[test]
fn an_ambient_light_has_no_position() {
    let ambient = LEAST.replace("\"diffuse\"", "\"ambient\"");
    let scene = scene(&ambient.replace("position = [10.0, 11.0, 12.0]\n", ""));
    let kind = value::<Light>(&scene, ordered::<Light>(&scene.world)[0]).kind;
    assert_eq!(kind, LightKind::Ambient);
}

#[test]
fn every_built_in_scene_loads_and_the_first_is_the_default() {
    for (name, _) in BUILT_IN {
        assert_eq!(load(Some(name)).name, name);
    }
    let scene = load(None);
    assert_eq!(scene.name, "cuboid");
    assert_eq!(names::<Camera>(&scene.world), ["1", "2"]);
    assert_eq!(
        names::<Light>(&scene.world),
        ["white", "red", "specular", "ambient"]
    );
    assert_eq!(on(&scene), [true; 4]);
}

/// The relative luminance of sRGB levels (WCAG 2).
fn luminance(levels: DVec3) -> f64 {
    let linear = levels.to_array().map(|level| {
        let level = level / 255.0;
        if level <= 0.04045 {
            level / 12.92
        } else {
            ((level + 0.055) / 1.055).powf(2.4)
        }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

#[test]
fn faces_in_ambient_light_stand_out_from_the_background() {
    for name in ["cuboid", "assignment"] {
        let scene = load(Some(name));
        let ambient = value::<Material>(&scene, ordered::<Mesh>(&scene.world)[0]).ambient;
        let light = value::<Light>(&scene, ordered::<Light>(&scene.world)[3]);
        let face = ambient * light.color * light.intensity * light.gain;
        let mut both = [face, background(&scene)].map(luminance);
        both.sort_by(f64::total_cmp);
        let contrast = (both[1] + 0.05) / (both[0] + 0.05);
        assert!(contrast >= 3.0, "{name}: {contrast}");
    }
}

#[test]
fn all_built_in_scenes_have_the_default_material_and_lights() {
    let values = |scene: &Scene| {
        let place = |&light| value::<Transform>(scene, light);
        let places: Vec<Transform> = ordered::<Light>(&scene.world).iter().map(place).collect();
        let light = |&light| value::<Light>(scene, light);
        let lights: Vec<Light> = ordered::<Light>(&scene.world).iter().map(light).collect();
        let material = value::<Material>(scene, ordered::<Mesh>(&scene.world)[0]);
        let names = names::<Light>(&scene.world);
        (names, places, lights, material)
    };
    let expected = values(&load(None));
    for (name, _) in BUILT_IN {
        assert_eq!(values(&load(Some(name))), expected, "{name}");
    }
}

#[test]
fn the_bench_scenes_see_the_same_height_in_both_projections() {
    let far = viewpoint(&load(Some("bench-far")), 0);
    let close = viewpoint(&load(Some("bench-close")), 0);
    assert_eq!(far.position, DVec3::new(7.0, 5.0, 8.0));
    assert!((close.position - far.position * 0.4).length() < 1e-15);
    for viewpoint in [far, close] {
        let camera = viewpoint.camera;
        assert_eq!(
            (camera.fov, camera.target, camera.up),
            (40.0, DVec3::ZERO, DVec3::Y)
        );
        assert_eq!(viewpoint.near(), 0.1);
        let seen = 2.0 * viewpoint.position.length() * 20.0_f64.to_radians().tan();
        assert!((camera.height - seen).abs() < 1e-4, "{seen}");
    }
}

#[test]
fn the_assignment_s_cuboid_and_cameras_are_where_it_puts_them() {
    let scene = load(Some("assignment"));
    let cuboid = ordered::<Mesh>(&scene.world)[0];
    let corners = value::<Mesh>(&scene, cuboid).corners;
    let centre = value::<Transform>(&scene, cuboid).position;
    assert_eq!(centre + corners[0], DVec3::ZERO);
    assert_eq!(centre + corners[7], DVec3::new(20.0, 10.0, 15.0));

    let [first, second] = [viewpoint(&scene, 0), viewpoint(&scene, 1)];
    assert_eq!(first.position, DVec3::new(0.0, 0.0, 35.0));
    assert_eq!(first.axes()[2], DVec3::NEG_Z);
    assert_eq!((first.camera.fov, first.camera.height), (126.87, 80.0));
    assert_eq!(second.position, DVec3::new(-15.0, -5.0, 10.0));
    assert_eq!(second.axes()[2], DVec3::X);
}

#[test]
fn queries_give_the_cuboids_in_file_order() {
    let mut scene = scene(&many(300));
    let expected: Vec<String> = (1..=300).map(|number| number.to_string()).collect();
    assert_eq!(names::<Mesh>(&scene.world), expected);

    // As in a frame: values change, and no components are added or removed.
    for (normals, mesh) in scene.world.query_mut::<(&mut Normals, &Mesh)>() {
        normals.0 = mesh.corners;
    }
    for scene in [&scene, &scene.snapshot()] {
        let mut query = scene.world.query::<(&Name, &Mesh)>();
        let queried: Vec<String> = query.iter().map(|(name, _)| name.0.clone()).collect();
        assert_eq!(queried, expected);
    }
}

#[test]
fn a_snapshot_has_the_present_values_and_is_independent() {
    let mut scene = load(None);
    let (cuboid, light, camera) = (
        ordered::<Mesh>(&scene.world)[0],
        ordered::<Light>(&scene.world)[1],
        ordered::<Camera>(&scene.world)[0],
    );
    let turned = |degrees| Transform {
        rotation: DVec3::X * degrees,
        ..Transform::default()
    };
    overwrite(&mut scene.world, &Background(DVec3::ONE));
    change(&scene, cuboid, |at| *at = turned(30.0));
    change(&scene, cuboid, |mode| *mode = ShadingMode::UnitVectors);
    change(&scene, light, |light: &mut Light| light.on = false);
    change(&scene, camera, |camera: &mut Camera| camera.fov = 50.0);

    let copy = scene.snapshot();
    change(&scene, cuboid, |at| *at = turned(60.0));
    change(&scene, light, |light: &mut Light| light.on = true);
    change(&scene, camera, |at| *at = turned(90.0));

    assert_eq!(copy.name, "cuboid");
    assert_eq!(background(&copy), DVec3::ONE);
    let at: Transform = value(&copy, ordered::<Mesh>(&copy.world)[0]);
    assert_eq!(at, turned(30.0));
    let mode: ShadingMode = value(&copy, ordered::<Mesh>(&copy.world)[0]);
    assert_eq!(mode, ShadingMode::UnitVectors);
    assert_eq!(on(&copy), [true, false, true, true]);
    assert_eq!(viewpoint(&copy, 0).camera.fov, 50.0);
    assert_eq!(viewpoint(&copy, 0).position, DVec3::new(7.0, 5.0, 8.0));
    assert_eq!(names::<Light>(&copy.world), names::<Light>(&scene.world));
    assert_eq!(names::<Camera>(&copy.world), names::<Camera>(&scene.world));

    let elsewhere = std::thread::spawn(move || viewpoint(&copy, 1).position);
    assert_eq!(elsewhere.join().unwrap(), DVec3::new(9.0, 6.0, -4.0));
}

#[test]
fn lights_are_switched_by_name_all_or_none() {
    let mut scene = load(None);
    let mut switch = |choice: &str| {
        let choice: LightChoice = choice.parse().unwrap();
        scene
            .switch_lights(&choice)
            .map_err(|error| error.to_string())?;
        Ok(on(&scene))
    };
    assert_eq!(switch("none"), Ok(vec![false; 4]));
    assert_eq!(switch("ambient,red"), Ok(vec![false, true, false, true]));
    assert_eq!(switch("all"), Ok(vec![true; 4]));
    assert_eq!(switch("white,white"), Ok(vec![true, false, false, false]));

    let lights = "the scene's lights are \"white\", \"red\", \"specular\", \"ambient\"";
    for (choice, unknown) in [("red,blue", "blue"), ("Red", "Red")] {
        let message = format!("no light is named {unknown:?}; {lights}");
        assert_eq!(switch(choice), Err(message));
    }
    assert_eq!(switch("red"), Ok(vec![false, true, false, false]));
    // A refused choice switches no light.
    switch("white,blue").unwrap_err();
    assert_eq!(on(&scene), [false, true, false, false]);
}

#[test]
fn a_choice_of_lights_has_no_empty_name_and_all_and_none_stand_alone() {
    for (choice, wrong) in [
        ("", "a name is missing"),
        (",", "a name is missing"),
        ("red,", "a name is missing"),
        ("white,,red", "a name is missing"),
        ("red,all", "`all` stands by itself"),
        ("none,red", "`none` stands by itself"),
    ] {
        let said = choice.parse::<LightChoice>().unwrap_err().to_string();
        assert!(said.starts_with(wrong), "{choice}: {said}");
    }
}

#[test]
fn a_scene_may_have_no_light() {
    let mut dark = dark();
    assert!(ordered::<Light>(&dark.world).is_empty());
    dark.switch_lights(&LightChoice::All).unwrap();
    let unknown = dark.switch_lights(&"white".parse().unwrap()).unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "no light is named \"white\"; the scene has no lights"
    );
}

#[test]
fn a_file_of_ten_thousand_cuboids_is_loaded() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    write!(file, "{}", many(10_000)).unwrap();
    let path = file.path().to_str().unwrap();
    assert_eq!(
        load(Some(path)).world.query::<&Mesh>().iter().count(),
        10_000
    );
}

#[test]
fn a_path_is_loaded_and_its_errors_contain_it() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    write!(file, "{LEAST}").unwrap();
    let path = file.path().to_str().unwrap().to_owned();
    assert_eq!(load(Some(&path)).name, path);
    writeln!(file, "far = 100.0").unwrap();
    let message = complaint(&path);
    assert!(
        message.starts_with(&format!("{path}:22:1: `camera`: unknown field `far`")),
        "{message}"
    );
    file.write_all(b"# caf\xe9\n").unwrap();
    let message = complaint(&path);
    let expected = format!("{path}:23:6: a scene must be UTF-8 text; found the byte 0xe9");
    assert!(message.starts_with(&expected), "{message}");
}

#[test]
fn an_unreadable_scene_is_reported_with_its_cause() {
    let message = complaint("cubiod");
    assert!(
        message.starts_with("cannot read the scene \"cubiod\": "),
        "{message}"
    );
    assert!(
        message.contains("; built in are cuboid, bench-far, bench-close, assignment"),
        "{message}"
    );
    let message = complaint("./cuboid");
    assert!(
        message.starts_with("cannot read the scene \"./cuboid\": "),
        "{message}"
    );
    assert!(!message.contains("built in"), "{message}");
    let folder = tempfile::tempdir().unwrap();
    complaint(folder.path().to_str().unwrap());
    complaint("");
}

#[cfg(unix)]
#[test]
fn an_endless_device_is_refused_and_a_pipe_is_read() {
    let message = complaint("/dev/zero");
    assert_eq!(
        message,
        "cannot read the scene \"/dev/zero\": it is larger than 64 MiB"
    );

    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    let path = pipe.to_str().unwrap().to_owned();
    let writer = std::thread::spawn(move || std::fs::write(pipe, LEAST).unwrap());
    assert_eq!(names::<Camera>(&load(Some(&path)).world), ["1"]);
    writer.join().unwrap();
}
