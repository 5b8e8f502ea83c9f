//! A scene written as a file is read again as the same scene, bit for bit.

use std::fmt::{Debug, Write};

use proptest::prelude::*;
use shadetrade::components::{
    Camera, Light, LightKind, Material, Mesh, Name, ShadingMode, Transform,
};
use shadetrade::scene::{BUILT_IN, Scene};

/// Everything the scene says. Debug writes different floats differently, 0 and -0 too.
fn said(scene: &Scene) -> String {
    let mut text = format!("{:?}\n", scene.background);
    let entities = [&scene.cuboids, &scene.lights, &scene.cameras];
    for &entity in entities.into_iter().flatten() {
        let components = scene.world.entity(entity).expect("an entity of the scene");
        let mut say = |component: Option<&dyn Debug>| writeln!(text, "{component:?}").unwrap();
        say(components.get::<&Name>().as_deref().map(|it| it as _));
        say(components.get::<&Transform>().as_deref().map(|it| it as _));
        say(components.get::<&Mesh>().as_deref().map(|it| it as _));
        say(components.get::<&Material>().as_deref().map(|it| it as _));
        say(components
            .get::<&ShadingMode>()
            .as_deref()
            .map(|it| it as _));
        say(components.get::<&Light>().as_deref().map(|it| it as _));
        say(components.get::<&Camera>().as_deref().map(|it| it as _));
    }
    text
}

fn assert_kept(scene: &Scene) {
    let text = scene.to_toml();
    let again = Scene::parse("again", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(said(&again), said(scene), "{text}");
}

/// A number from `least` to `most`, as a file may write it: as often near 0 as far from it, and sometimes an end.
fn number(least: f64, most: f64) -> impl Strategy<Value = String> {
    let smallest = if least > 0.0 { least } else { 1e-320 };
    let size = (smallest.ln()..most.ln()).prop_map(f64::exp);
    let number = (size, any::<bool>()).prop_map(|(size, below)| if below { -size } else { size });
    prop_oneof![8 => number, 1 => Just(least), 1 => Just(most)]
        .prop_map(move |number| format!("{:e}", number.max(-most.abs()).clamp(least, most)))
}

fn three(least: f64, most: f64) -> impl Strategy<Value = String> {
    prop::collection::vec(number(least, most), 3)
        .prop_map(|three| format!("[{}]", three.join(", ")))
}

/// Lines with these keys; those whose number is not below `required` may be left out.
fn keys<const COUNT: usize>(
    required: usize,
    rows: [(&'static str, BoxedStrategy<String>); COUNT],
) -> impl Strategy<Value = String> {
    let lines = rows.into_iter().enumerate().map(|(index, (key, value))| {
        let line = value.prop_map(move |value| format!("{key} = {value}\n"));
        if index < required {
            line.boxed()
        } else {
            prop_oneof![line, Just(String::new())].boxed()
        }
    });
    lines.collect::<Vec<_>>().prop_map(|lines| lines.concat())
}

fn word(words: &'static [&'static str]) -> BoxedStrategy<String> {
    prop::sample::select(words).prop_map(str::to_owned).boxed()
}

fn cuboid() -> impl Strategy<Value = String> {
    let strength = || three(0.0, 1e30).boxed();
    let outside = keys(
        1,
        [
            ("size", three(1e-100, 1e100).boxed()),
            ("position", three(-1e100, 1e100).boxed()),
            ("rotation", three(f64::MIN, f64::MAX).boxed()),
            ("shading", word(&["'gouraud'", "'phong'"])),
        ],
    );
    let material = keys(
        4,
        [
            ("ambient", strength()),
            ("diffuse", strength()),
            ("specular", strength()),
            ("shininess", number(0.0, 1e6).boxed()),
        ],
    );
    (outside, material)
        .prop_map(|(outside, material)| format!("{outside}[cuboid.material]\n{material}"))
}

fn light() -> impl Strategy<Value = String> {
    let position =
        three(-1e100, 1e100).prop_map(|position| format!("'specular'\nposition = {position}"));
    keys(
        3,
        [
            (
                "kind",
                prop_oneof![Just("'ambient'".to_owned()), position].boxed(),
            ),
            ("color", three(0.0, 1e30).boxed()),
            ("intensity", number(0.0, 1e30).boxed()),
            ("gain", number(0.0, 1e30).boxed()),
            ("on", word(&["true", "false"])),
        ],
    )
}

fn camera() -> impl Strategy<Value = String> {
    keys(
        4,
        [
            ("position", three(-1e100, 1e100).boxed()),
            ("target", three(-1e100, 1e100).boxed()),
            ("fov", number(5e-324, 179.0).boxed()),
            ("height", number(1e-100, 1e100).boxed()),
            ("up", three(-1e100, 1e100).boxed()),
            ("near", number(1e-100, 1e100).boxed()),
        ],
    )
}

/// Tables of a kind, their names being any texts that differ.
fn tables(
    kind: &'static str,
    least: usize,
    table: impl Strategy<Value = String>,
) -> impl Strategy<Value = String> {
    let named = (any::<String>(), table);
    prop::collection::vec(named, least..4).prop_map(move |tables| {
        let tables = tables
            .into_iter()
            .enumerate()
            .map(|(index, (name, table))| {
                let name = toml::Value::String(format!("{index} {}", name.replace(',', "")));
                format!("[[{kind}]]\nname = {name}\n{table}")
            });
        tables.collect()
    })
}

proptest! {
    #[test]
    fn any_scene_is_read_again_as_it_was(
        background in keys(0, [("background", three(0.0, 255.0).boxed())]),
        cuboids in tables("cuboid", 1, cuboid()),
        lights in tables("light", 0, light()),
        cameras in tables("camera", 1, camera()),
    ) {
        // A random view may be along `up`; what else is refused, and that it is, is tried elsewhere.
        match Scene::parse("random", &format!("{background}{cuboids}{lights}{cameras}")) {
            Ok(scene) => assert_kept(&scene),
            Err(error) => prop_assume!(error.to_string().contains("`camera."), "{}", error),
        }
    }
}

#[test]
fn the_built_in_scenes_are_read_again_as_they_were() {
    for (name, _) in BUILT_IN {
        assert_kept(&Scene::load(Some(name)).unwrap_or_else(|error| panic!("{error}")));
    }
}

#[test]
fn what_has_changed_since_is_what_is_written() {
    let mut scene = Scene::load(None).unwrap_or_else(|error| panic!("{error}"));
    scene.background.x = 3.0;
    for (transform, light) in scene.world.query_mut::<(&mut Transform, &mut Light)>() {
        transform.position.y += 0.1;
        light.on = light.kind == LightKind::Specular;
        light.intensity *= 1.0 / 3.0;
    }
    for mode in scene.world.query_mut::<&mut ShadingMode>() {
        *mode = ShadingMode::UnitVectors;
    }
    let saved = Scene::parse("saved", &scene.to_toml()).unwrap_or_else(|error| panic!("{error}"));
    let expected = said(&scene).replace("UnitVectors", "Phong");
    let ambient = said(&saved);
    let differing: Vec<(&str, &str)> = expected
        .lines()
        .zip(ambient.lines())
        .filter(|(before, after)| before != after)
        .collect();
    // The one place that means nothing is that of the ambient light.
    assert_eq!(differing.len(), 1, "{differing:?}");
    assert!(differing[0].0.contains("position"), "{differing:?}");
}
