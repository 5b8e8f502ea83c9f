//! The command `requires`.

use std::fs;

use serde_json::Value;
use shadetrade::components::{Camera, Mesh, names};
use shadetrade::scene::Scene;

use super::{assert_works, folder, listing, run, said};

/// The JSON that `line` prints.
#[track_caller]
fn json(folder: &std::path::Path, line: &str) -> Value {
    let output = run(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", said(&output));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

fn part_names(found: &Value) -> Vec<&str> {
    let parts = found["parts"].as_array().expect("a list");
    parts
        .iter()
        .map(|part| part["part"].as_str().expect("a name"))
        .collect()
}

#[test]
fn json_has_every_part_in_order_and_requires_those_that_are_not_proven() {
    let folder = folder();
    let found = json(
        folder.path(),
        "requires --size 48x36 --shading phong --tolerance 4 --lights white,ambient --json",
    );
    assert_eq!(
        part_names(&found),
        [
            "light white",
            "light ambient",
            "specular gate",
            "unit normal",
            "every pixel emerald",
            "perspective-correct interpolation",
            "depth test",
            "near plane",
            "cuboid emerald",
            "f64 set-up",
        ]
    );
    assert_eq!(found["scene"], "cuboid");
    assert_eq!(found["tolerance"], 4.0);
    for part in found["parts"].as_array().unwrap() {
        let [least, most] = [0, 1].map(|end| part["largest_error"][end].as_f64().unwrap());
        assert!(0.0 <= least && least <= most && most <= 255.0, "{part}");
        assert_eq!(part["required"], most > 4.0, "{part}");
        assert_eq!(part["pixels"].as_u64().unwrap() > 0, least > 4.0, "{part}");
        let is_timed = ["light", "every", "cuboid", "depth"]
            .contains(&part["part"].as_str().unwrap().split(' ').next().unwrap());
        assert_eq!(part["time_share"].is_number(), is_timed, "{part}");
    }
    let stages = found["bits"].as_array().expect("a list");
    assert_eq!(stages.len(), 6);
    for stage in stages {
        assert!(
            (2..=24).contains(&stage["bits"].as_u64().unwrap()),
            "{stage}"
        );
        assert!(stage["largest_error"].as_f64().unwrap() <= 4.0, "{stage}");
        for (index, name) in ["f16", "bf16", "f32"].into_iter().enumerate() {
            let format = &stage["formats"][index];
            let error = format["largest_error"].as_f64().unwrap();
            assert_eq!(format["keeps"], error <= 4.0, "{stage}");
            assert_eq!(format["format"], name);
        }
    }
    assert_eq!(stages[1]["stage"], "normals");
}

#[test]
fn the_table_has_a_row_for_every_part_with_the_largest_error_first() {
    let folder = folder();
    let output = run(folder.path(), "requires --size 48x36");
    assert!(output.stderr.is_empty(), "{}", said(&output));
    assert!(!output.stdout.contains(&0x1b));
    let table = String::from_utf8(output.stdout).unwrap();
    let place = |part: &str| {
        table
            .find(&format!("\n{part} "))
            .unwrap_or_else(|| panic!("{part} in {table}"))
    };
    assert!(place("cuboid emerald") < place("light ambient"));
    assert!(place("light ambient") < place("near plane"));
    assert!(place("near plane") < place("positions") && place("positions") < place("sum"));
    assert!(
        table.lines().all(|line| line.chars().count() <= 100),
        "{table}"
    );
}

#[test]
fn the_least_scene_lists_the_parts_left_out_and_draws_the_same_picture() {
    let folder = folder();
    let text = fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/assets/scenes/cuboid.toml"
    ))
    .unwrap();
    let faint = "[[light]]\nname = \"faint \\u001b\\n\"\nkind = \"ambient\"\ncolor = [1.0, 1.0, 1.0]\nintensity = 1.0\n";
    let hidden = "[[cuboid]]\nname = \"hidden\"\nsize = [1.0, 1.0, 1.0]\nshading = \"phong\"\n[cuboid.material]\nambient = [1.0, 1.0, 1.0]\ndiffuse = [0.0, 0.0, 0.0]\nspecular = [0.0, 0.0, 0.0]\nshininess = 1.0\n";
    fs::write(
        folder.path().join("full.toml"),
        format!("{text}\n{faint}\n{hidden}"),
    )
    .unwrap();
    let line = "requires full.toml --camera 2 --size 48x36 -o least.toml";
    let message = assert_works(folder.path(), line);
    assert!(
        !message.contains('\u{1b}') && message.contains("cuboid hidden"),
        "{message}"
    );
    assert_eq!(listing(folder.path()), ["full.toml", "least.toml"]);

    let text = fs::read_to_string(folder.path().join("least.toml")).unwrap();
    let comments: Vec<&str> = text
        .lines()
        .take_while(|line| line.starts_with('#'))
        .collect();
    let comments = comments.join("\n");
    for word in [
        "full.toml",
        "camera 2",
        "0.5",
        "light faint",
        "cuboid hidden",
        "levels",
    ] {
        assert!(comments.contains(word), "{word} in {comments}");
    }
    let least = Scene::parse("least", &text).expect("a scene");
    assert_eq!(names::<Mesh>(&least.world), ["emerald"]);
    assert_eq!(names::<Camera>(&least.world), ["2"]);

    for scene in ["full.toml --camera 2", "least.toml"] {
        assert_works(
            folder.path(),
            &format!(
                "render {scene} --size 48x36 --tolerance 0 -o {}.png",
                &scene[..4]
            ),
        );
    }
    let [full, least] = ["full.png", "leas.png"].map(|name| {
        let png = fs::read(folder.path().join(name)).unwrap();
        crate::cli::decode(&png).2
    });
    let far = full
        .iter()
        .zip(&least)
        .filter(|(full, least)| full.abs_diff(**least) > 1);
    assert_eq!(far.count(), 0);
    assert_ne!(full, least, "the faint light is off");
}
