//! `prove` and `extremes`: their JSON, their exit status, and pictures of other programs.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use image::{DynamicImage, ImageFormat, RgbImage};
use serde_json::json;
use shadetrade::scene::EXTREMES;

use super::{SCENE, assert_works, cube, folder, json, keys, put, run, said, shadetrade};

const SMALL: &str = "--shading phong --tolerance 0";

/// Exit status, arguments, words of the text with bars between, and words that are not in it.
const TEXTS: &str = "\
1 ¦ prove two.toml --picture drawn.png ¦ perspective, 96x72, scene, tolerance 0.5|largest proven|where 1 is allowed|is refuted, \
aside, face  ¦ instead of
1 ¦ prove --picture wide.png ¦ proven     0 of ¦ largest
0 ¦ prove extremes/eye-inside --size 9x9 ¦ proven     81 of ¦ e0 levels";

#[test]
fn a_picture_of_any_8_bit_colour_type_is_judged() {
    let folder = folder();
    let folder = folder.path();
    assert_works(folder, &format!("render {SMALL} --size 96x72 -o drawn.png"));
    let drawn = image::open(folder.join("drawn.png")).expect("a PNG");
    let mut one = drawn.to_rgb8();
    one.get_pixel_mut(48, 36).0[1] ^= 0x80;
    // And how many pixels are refuted at least.
    let pictures: [(&str, DynamicImage, usize); 6] = [
        ("rgb.png", drawn.to_rgb8().into(), 0),
        ("rgba.png", drawn.to_rgba8().into(), 0),
        ("one.png", one.into(), 1),
        ("grey.png", drawn.to_luma8().into(), 100),
        ("grey-alpha.png", drawn.to_luma_alpha8().into(), 100),
        ("wide.png", RgbImage::new(16_384, 1).into(), 16_384),
    ];
    for (name, picture, refuted) in pictures {
        let size = [picture.width(), picture.height()];
        let saved = picture.save_with_format(folder.join(name), ImageFormat::Png);
        saved.expect("it is written");
        let line = format!("prove {SMALL} --picture {name} --json -o map.png");
        let (status, proof) = json(folder, &line);
        assert_eq!(proof["size"], json!(size));
        assert_eq!(proof["limit"], json!(0.55));
        if refuted > 0 {
            assert_eq!(status, Some(1));
            assert!(proof["refuted"].as_u64() >= Some(refuted as u64), "{proof}");
            let examples = proof["examples"].as_array().expect("a list");
            let errors = examples.iter().map(|it| it["error"][0].as_f64());
            assert_eq!(examples.len(), refuted.min(10));
            assert!(errors.is_sorted_by(|a, b| a >= b));
            let of_example = "pixel verdict drawn enclosure error face drawn_face";
            assert_eq!(keys(&examples[0]), of_example);
            assert_eq!(examples[0]["verdict"], "refuted");
        }
        let map = image::open(folder.join("map.png")).expect("a PNG");
        assert_eq!([map.width(), map.height()], size);
        if refuted == 0 {
            assert_eq!((status, &proof["proven"]), (Some(0), &json!(96 * 72)));
            // A proven pixel of the background, (236, 238, 240), is darkened to a half less an eighth.
            assert_eq!(map.to_rgb8().get_pixel(0, 0).0, [89, 90, 90]);
        }
    }
    // A cube that is not in the picture, as text.
    let two = format!("{SCENE}\n{}", cube("aside", [-3.0, 1.0, -3.0]));
    put(folder, "two.toml", two);
    for row in TEXTS.lines() {
        let cells: Vec<&str> = row.split(" ¦ ").collect();
        let [status, line, words, others] = cells[..] else {
            panic!("{row}");
        };
        let output = run(folder, line);
        assert_eq!(output.status.code(), status.parse().ok(), "{row}");
        assert_eq!(said(&output).contains("not proven: "), status == "1");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(words.split('|').all(|it| text.contains(it)), "{text}");
        assert!(!others.split('|').any(|it| text.contains(it)), "{text}");
    }
}

#[test]
fn a_drawn_picture_is_proven() {
    let (status, proof) = json(folder().path(), "prove --size 96x72 --json");
    assert_eq!((status, &proof["proven"]), (Some(0), &proof["pixels"]));
    let of_proof = "scene camera projection size mode tolerance limit pixels proven refuted undecided gaps outline \
                    covered own own_proven in_squares worst widest_enclosure reference_error examples causes seconds";
    assert_eq!(keys(&proof), of_proof);
    let names = ["scene", "camera", "projection", "mode"].map(|key| &proof[key]);
    assert_eq!(names, ["cuboid", "1", "perspective", "gouraud"]);
    let number = |key: &str| proof[key].as_f64().expect("a number");
    assert!((1e-6..=0.5).contains(&number("worst")) && number("covered") > 1000.0);
    assert!((1e-20..1e-6).contains(&number("reference_error")));
}

/// The middle pixel shows the middle of an edge between two visible faces.
const EDGE: &str = "
[[cuboid]]
name = \"c\"
size = [2, 2, 2]
material = { ambient = [1, 1, 1], diffuse = [1, 1, 1], specular = [0, 0, 0], shininess = 1 }
[[light]]
name = \"a\"
kind = \"ambient\"
color = [1, 1, 1]
intensity = 100
[[camera]]
name = \"1\"
position = [4, 2, 5]
target = [1, 0, 1]
fov = 30
height = 4
";

#[test]
fn a_pixel_that_is_undecided_or_a_gap_is_a_failure() {
    let folder = folder();
    let folder = folder.path();
    put(folder, "edge.toml", EDGE);
    assert_works(folder, "render edge.toml --size 9x9 -o drawn.png");
    let drawn = image::open(folder.join("drawn.png")).expect("a PNG");
    let mut holed = drawn.to_rgb8();
    holed.put_pixel(4, 4, [0; 3].into());
    holed.save(folder.join("holed.png")).expect("it is written");
    // The direction to a light at the visible point is not enclosed.
    let light = "[[light]]\nname = \"d\"\nkind = \"diffuse\"\ncolor = [1, 1, 1]\nintensity = 9\nposition = [1, 0, 1]\n";
    put(folder, "lit.toml", format!("{EDGE}{light}"));
    for (line, color, counts) in [
        ("edge.toml --picture drawn.png", 0x0026_5a78, [81, 0, 0]),
        ("edge.toml --picture holed.png", 0x00e0_40ff, [80, 0, 1]),
        (
            "lit.toml --shading phong --size 9x9",
            0x00ff_d500,
            [80, 1, 0],
        ),
    ] {
        let line = format!("prove {line} --json -o map.png");
        let (status, proof) = json(folder, &line);
        let found = ["proven", "undecided", "gaps"].map(|key| &proof[key]);
        assert_eq!(found, counts, "{line}");
        assert_eq!(status, Some(i32::from(counts[0] < 81)), "{line}");
        let map = image::open(folder.join("map.png")).expect("a PNG");
        let [red, green, blue] = map.to_rgb8().get_pixel(4, 4).0;
        assert_eq!(u32::from_be_bytes([0, red, green, blue]), color, "{line}");
    }
    let output = run(folder, "prove edge.toml --picture holed.png");
    let text = String::from_utf8_lossy(&output.stdout);
    let told = "4,4 is a gap, background instead of c, face +";
    assert!(text.contains(told), "{text}");
}

/// `render` draws the whole picture on all threads, `prove` bands of it.
#[test]
fn what_render_writes_is_proven() {
    let folder = folder();
    let folder = folder.path();
    let two = format!("{SCENE}\n{}", cube("aside", [-1.5, 1.0, 1.0]));
    put(folder, "two.toml", two);
    for options in [
        "cuboid --shading gouraud --size 97x131",
        "two.toml --shading phong --tolerance 0 --size 131x65",
        "bench-close --shading phong --size 1x77",
    ] {
        assert_works(folder, &format!("render {options} -o drawn.png"));
        let (options, _) = options.split_once(" --size").expect("a size");
        assert_works(folder, &format!("prove {options} --picture drawn.png"));
    }
}

#[test]
fn several_pictures_have_a_line_each_with_what_is_wrong() {
    let folder = folder();
    let folder = folder.path();
    let bright = "--shading phong --set light.ambient.intensity=120";
    for (name, options) in [
        ("right.png", "--shading phong"),
        ("vertices.png", "--shading gouraud"),
        ("bright.png", bright),
    ] {
        assert_works(folder, &format!("render {options} --size 96x72 -o {name}"));
    }
    put(folder, "no\u{1b}.png", "text");
    let pictures = "right.png vertices.png bright.png no\u{1b}.png";
    let line = format!("prove --shading phong --picture {pictures}");
    let (status, records) = json(folder, &format!("{line} --json"));
    assert_eq!(status, Some(1));
    let records = records.as_array().expect("an array");
    let names = records.iter().map(|it| it["picture"].as_str());
    let names: Vec<&str> = names.flatten().collect();
    assert_eq!(names.join(" "), pictures.replace('\u{1b}', "\\u{1b}"));
    let causes = records
        .iter()
        .map(|it| it["causes"].as_array().map(Vec::len));
    assert!(causes.eq([Some(0), Some(1), Some(0), None]));
    let error = records[3]["error"].as_str();
    assert!(error.is_some_and(|it| it.contains("not a PNG")));
    let output = run(folder, &line);
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    for (row, words) in [
        ("right.png ", "100.0 %"),
        ("vertices.png ", "the picture of gouraud"),
        ("bright.png ", " -"),
        ("no\\u{1b}.png ", "not a PNG"),
    ] {
        let row = table.lines().find(|line| line.starts_with(row));
        assert!(row.is_some_and(|it| it.contains(words)), "{words}: {table}");
    }
    assert!(said(&output).contains("3 of 4 pictures"));
    assert_works(
        folder,
        "prove --shading phong --picture right.png right.png",
    );
    // Of one picture the worst pixel comes first.
    let one = run(folder, "prove --shading phong --picture vertices.png");
    let text = String::from_utf8_lossy(&one.stdout).into_owned();
    let lines = ["\nworst ", "\nright ", "\ncause ", "\nproven "].map(|it| text.find(it));
    assert!(lines[0].is_some() && lines.is_sorted(), "{text}");
}

#[test]
fn an_extreme_is_proven_and_drawn_by_its_name() {
    let folder = folder();
    let (status, outcomes) = json(folder.path(), "extremes picture-1x1 extremes/speck --json");
    assert_eq!(status, Some(0));
    for (outcome, name) in [(&outcomes[0], "picture-1x1"), (&outcomes[1], "speck")] {
        assert_eq!(
            (&outcome["name"], &outcome["pass"]),
            (&json!(name), &json!(true))
        );
    }
    let line = "render extremes/eye-on-an-edge --size 64x48 -o a.png";
    assert_works(folder.path(), line);
}

#[test]
fn extremes_are_listed_with_a_sentence_and_a_line_is_printed_as_each_is_proven() {
    let folder = folder();
    let listed = String::from_utf8(run(folder.path(), "extremes --list").stdout);
    let listed = listed.expect("it is UTF-8");
    let lines: Vec<&str> = listed.lines().collect();
    assert_eq!(lines.len(), EXTREMES.len());
    for (line, (path, text)) in lines.iter().zip(EXTREMES) {
        let (name, sentence) = line.split_once("  ").expect("a name and a sentence");
        assert_eq!(format!("extremes/{name}"), *path);
        let head = text.replace("\n# ", " ");
        assert!(sentence.ends_with('.') && head.contains(sentence.trim()));
    }
    let (_, listed) = json(folder.path(), "extremes --list --json speck");
    assert_eq!(keys(&listed[0]), "name says");
    assert_eq!(listed[0]["name"], "speck");

    // The first line is there long before the last scene is proven.
    let mut program = shadetrade(folder.path());
    let program = program.arg("extremes").stdout(Stdio::piped()).spawn();
    let mut program = program.expect("it starts");
    let mut line = String::new();
    let output = program.stdout.as_mut().expect("it is piped");
    let read = BufReader::new(output).read_line(&mut line);
    read.expect("it can be read");
    let is_going_on = program.try_wait().expect("its state is known").is_none();
    program.kill().expect("it is ours");
    program.wait().expect("it ends");
    assert!(line.starts_with("pass  assignment ") && is_going_on);
}
