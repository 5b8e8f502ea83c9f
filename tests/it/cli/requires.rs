//! The command `requires`.

use serde_json::json;

use super::{cube, decode, folder, get, json, keys, listing, put, run, said};
use crate::support::prelude::*;

#[test]
fn json_has_every_part_in_order_and_requires_those_that_are_not_proven() {
    let line = "requires --size 32x24 --shading phong --tolerance 4 --lights white,ambient --json";
    let (status, found) = json(folder().path(), line);
    assert_eq!(status, Some(0));
    assert_eq!(keys(&found), "scene tolerance views parts segments");
    let of_scene = json!([found["scene"], found["tolerance"], found["views"]]);
    assert_eq!(of_scene, json!(["cuboid", 4.0, 1]));
    let expected = "light white|light ambient|specular gate|diffuse clamp|every highlight by o.r|unit normal|\
                    corner normals emerald|every pixel emerald|perspective-correct interpolation|depth test|near plane|\
                    cuboid emerald|f64 set-up";
    let parts = found["parts"].as_array().expect("a list");
    let names: Vec<&str> = parts.iter().filter_map(|it| it["part"].as_str()).collect();
    assert_eq!(names.join("|"), expected);
    for part in parts {
        assert_eq!(keys(part), "part largest_error pixels required");
        let [least, most] =
            [0, 1].map(|end| part["largest_error"][end].as_f64().expect("a number"));
        assert!([0.0, least, most, 255.0].is_sorted(), "{part:?}");
        assert_eq!(part["required"], json!(most > 4.0), "{part:?}");
        assert_eq!(part["pixels"].as_u64() > Some(0), least > 4.0, "{part:?}");
    }
    let [emerald] = &found["segments"].as_array().expect("a list")[..] else {
        panic!("one cuboid")
    };
    assert_eq!(keys(emerald), "cuboid segments largest_error");
    assert_eq!(emerald["cuboid"], "emerald");
    // The highlight needs many more than two.
    let segments = emerald["segments"].as_u64().expect("a number");
    assert!((2..=256).contains(&segments), "{emerald:?}");
    assert!(emerald["largest_error"][1].as_f64() <= Some(4.0));
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
    let full = format!(
        "{}\n{faint}\n{hidden}\n[view]\nbudget = 0.001",
        text_without_view()
    );
    put(folder, "full.toml", full);
    let view = "full.toml --camera 2 --lights white,ambient,faint,dim --size 24x18";
    let output = run(folder, &format!("requires {view} -o least.toml"));
    let said = said(&output);
    assert!(said.starts_with("wrote least.toml: ") && said.contains("cuboid hidden"));
    assert!(!said.contains('\u{1b}') && !output.stdout.contains(&0x1b));
    let table = String::from_utf8(output.stdout).expect("text");
    let rows = ["cuboid emerald", "light ambient", "near plane", "emerald"];
    let places = rows.map(|row| table.find(&format!("\n{row} ")));
    assert!(places[0].is_some() && places.is_sorted(), "{table}");
    let is_required = |row| (table.lines()).any(|it| it.starts_with(row) && it.ends_with("yes"));
    assert!(is_required("light ambient") && !is_required("light faint"));
    // Below 0.001 an interval is one number.
    assert!(!table.contains("to <0.001"), "{table}");
    let is_narrow = table.lines().all(|line| line.chars().count() <= 100);
    assert!(is_narrow, "{table}");
    assert_eq!(listing(folder), ["full.toml", "least.toml"]);

    let text = String::from_utf8(get(folder, "least.toml")).expect("text");
    let (comments, _) = text.split_once("\n\n").expect("a head");
    // The faint light adds 0.3 levels, rounded up.
    let words = "full.toml|camera 2|0.5|light faint|cuboid hidden|most 0.3001 levels";
    for word in words.split('|') {
        assert!(comments.contains(word), "{word} in {comments}");
    }
    assert!(!comments.contains("light dim"), "{comments}");
    let least = Scene::parse("least", &text).expect("a scene");
    assert_eq!(viewer(&least.world).budget, None);
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
