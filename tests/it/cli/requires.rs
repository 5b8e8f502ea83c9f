//! The command `requires`.

use serde::Deserialize;
use shadetrade::components::{Camera, Mesh, names};
use shadetrade::scene::Scene;

use super::{SCENE, cube, decode, folder, get, json, listing, put, run, said};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Found {
    scene: String,
    tolerance: f64,
    views: usize,
    parts: Vec<LeftOut>,
    bits: Vec<Rounded>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LeftOut {
    part: String,
    largest_error: [f64; 2],
    pixels: u64,
    #[serde(deserialize_with = "Option::deserialize")]
    time_share: Option<f64>,
    required: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rounded {
    stage: String,
    bits: u64,
    largest_error: f64,
    formats: Vec<Tried>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tried {
    format: String,
    largest_error: f64,
    keeps: bool,
}

#[test]
fn json_has_every_part_in_order_and_requires_those_that_are_not_proven() {
    let line = "requires --size 32x24 --shading phong --tolerance 4 --lights white,ambient --json";
    let (status, found) = json(folder().path(), line);
    assert_eq!(status, Some(0));
    let found: Found = serde_json::from_value(found).expect("the keys of the contract");
    assert_eq!(
        (&*found.scene, found.tolerance, found.views),
        ("cuboid", 4.0, 1)
    );
    // Whether the renderer can draw without it, so that its time is known.
    let expected = [
        ("light white", true),
        ("light ambient", true),
        ("specular gate", false),
        ("unit normal", false),
        ("every pixel emerald", true),
        ("perspective-correct interpolation", false),
        ("depth test", false),
        ("near plane", false),
        ("cuboid emerald", true),
        ("f64 set-up", false),
    ];
    let parts = found
        .parts
        .iter()
        .map(|it| (&*it.part, it.time_share.is_some()));
    assert_eq!(parts.collect::<Vec<_>>(), expected);
    for part in &found.parts {
        let [least, most] = part.largest_error;
        assert!([0.0, least, most, 255.0].is_sorted(), "{part:?}");
        assert_eq!(part.required, most > 4.0, "{part:?}");
        assert_eq!(part.pixels > 0, least > 4.0, "{part:?}");
        assert!(part.time_share.is_none_or(|share| share < 1.0), "{part:?}");
    }
    // Most of the frame's time is spent on the only cuboid.
    let cuboid = &found.parts[8];
    assert!(cuboid.time_share > Some(0.2), "{cuboid:?}");
    assert_eq!((found.bits.len(), &*found.bits[1].stage), (6, "normals"));
    for stage in &found.bits {
        let is_proven = (2..=24).contains(&stage.bits) && stage.largest_error <= 4.0;
        assert!(is_proven, "{stage:?}");
        let names = stage.formats.iter().map(|it| &*it.format);
        assert_eq!(names.collect::<Vec<_>>(), ["f16", "bf16", "f32"]);
        let is_right = |it: &Tried| it.keeps == (it.largest_error <= 4.0);
        assert!(stage.formats.iter().all(is_right), "{stage:?}");
    }
}

#[test]
fn the_table_has_its_rows_in_order_and_the_least_scene_draws_the_same_picture() {
    let folder = folder();
    let folder = folder.path();
    // Each may be left out, both together may not.
    let ambient = |name, intensity| {
        format!(
            "[[light]]\nname = \"{name}\"\nkind = \"ambient\"\ncolor = [1.0, 1.0, 1.0]\nintensity = {intensity}\n"
        )
    };
    let faint = ambient("faint", 1.0) + &ambient("dim", 1.2);
    let hidden = cube("hidden \\u001b\\n", [0.0; 3]);
    put(folder, "full.toml", format!("{SCENE}\n{faint}\n{hidden}"));
    let view = "full.toml --camera 2 --lights white,ambient,faint,dim --size 24x18";
    let output = run(folder, &format!("requires {view} -o least.toml"));
    let said = said(&output);
    assert!(said.starts_with("wrote least.toml: ") && said.contains("cuboid hidden"));
    assert!(!said.contains('\u{1b}') && !output.stdout.contains(&0x1b));
    let table = String::from_utf8(output.stdout).expect("text");
    let rows = [
        "cuboid emerald",
        "light ambient",
        "near plane",
        "positions",
        "sum",
    ];
    let places = rows.map(|row| table.find(&format!("\n{row} ")));
    assert!(places[0].is_some() && places.is_sorted(), "{table}");
    // Below 0.001 an interval is one number.
    assert!(!table.contains("to <0.001"), "{table}");
    let is_narrow = table.lines().all(|line| line.chars().count() <= 100);
    assert!(is_narrow, "{table}");
    assert_eq!(listing(folder), ["full.toml", "least.toml"]);

    let text = String::from_utf8(get(folder, "least.toml")).expect("text");
    let comments: Vec<&str> = text.lines().take_while(|it| it.starts_with('#')).collect();
    let comments = comments.join("\n");
    for word in [
        "full.toml",
        "camera 2",
        "0.5",
        "light faint",
        "cuboid hidden",
        // The faint light adds 0.3 levels, rounded up.
        "at most 0.3001 levels",
    ] {
        assert!(comments.contains(word), "{word} in {comments}");
    }
    assert!(!comments.contains("light dim"), "{comments}");
    let least = Scene::parse("least", &text).expect("a scene");
    assert_eq!(names::<Mesh>(&least.world), ["emerald"]);
    assert_eq!(names::<Camera>(&least.world), ["2"]);

    let [full, least] = [view, "least.toml --size 24x18"].map(|view| {
        let line = format!("render {view} --tolerance 0 -o -");
        decode(&run(folder, &line).stdout).2
    });
    let near = |(full, least): (&u8, &u8)| full.abs_diff(*least) <= 1;
    assert!(full.iter().zip(&least).all(near));
    assert_ne!(full, least, "the faint light is off");
}
