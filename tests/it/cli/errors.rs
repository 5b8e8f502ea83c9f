//! Wrong command lines, scenes and files: exit status 1 or 2, one paragraph with the reason, and nothing is written.

use std::ffi::OsString;
use std::fs;

use image::{DynamicImage, ImageFormat};
use shadetrade::cli;

use super::{SCENE, assert_failed, assert_works, folder, get, listing, put, run};

/// Exit status, arguments, and words of the message with bars between.
const FAILURES: &str = r#"
2  --size 0x0  ->  '0x0'|1x1 to 16384x16384
2  rendr  ->  'rendr'|'render'
2  --size 16385x1  ->  '16385x1'
2  view --size 960  ->  '960'|such as 960x720
2  render -o b.png --size -5x5  ->  '-5x5'
2  render -o b.png --tolerance 9.9e-5  ->  '9.9e-5'|0.0001 to 255
2  render -o b.png --tolerance nan  ->  'nan'
2  render -o b.png --budget 0  ->  '0'|0.001 to 10000
2  render -o b.png --budget 1 --tolerance 1  ->  --budget|--tolerance
2  render -o b.png --budget 1 --shading phong  ->  --budget|--shading
2  probe --pixel 1,1 --budget 1  ->  --budget
2  render -o b.png --threads 0  ->  '0'|1..=1024
2  render -o b.png --simd sse9  ->  'sse9'|fallback, avx2
2  --camera 3  ->  "3"|"1", "2"
2  view bench-far --lights white,blue  ->  "blue"|"white", "red"
2  render -o b.png --lights white,,red  ->  no light is named ""
2  render -o b.png --set light.white.intensty=1  ->  intensty|intensity, gain
2  render -o b.png --set light.white.gain=-1  ->  light.white.gain|from 0.0 to 1e30
2  render -o b.png --set light.white.on  ->  KEY=VALUE
2  extremes nowhere  ->  "nowhere"|`shadetrade extremes --list`
2  probe --pixel 960,0  ->  960,0|959,719
2  probe --pixel 0,720  ->  0,720|959,719
2  probe --pixel 1,2,3  ->  '1,2,3'|480,300
2  vary  ->  KEY=FROM..TO
2  vary cuboid  ->  KEY=FROM..TO
2  vary light.white.intensty=1..2  ->  intensty|intensity, gain
2  vary light.white.intensity=-1..2  ->  light.white.intensity|from 0.0 to 1e30
2  vary light.white.intensity=2..2  ->  light.white.intensity|one value
2  vary light.white.intensity=2  ->  KEY=FROM..TO
2  vary camera.1.fov=1...5  ->  1...5|three dots
2  vary light."white.intensity=1..2  ->  no key light|light has white
2  vary view.turned=0..360  ->  `view.turned`|359
2  vary camera.1.fov=0..360  ->  `camera.1.fov`|179
2  vary cuboid.emerald.segments=1.5..4  ->  whole numbers
2  vary cuboid.emerald.segments=1..300  ->  cuboid.emerald.segments|256
2  vary cuboid.emerald.shading=1..2  ->  cuboid.emerald.shading|no number
2  vary light.white.intensity=1..2 --steps 1  ->  '1'|2..=1000
2  vary light.white.intensity=1..2 --methods phong-3  ->  textbook-f32
2  trade --shading phong  ->  --shading|trade
2  trade --tolerance 1  ->  --tolerance|trade
2  trade --methods phong-0,phong-3  ->  gouraud-0.5|phong-unit-vectors
1  trade --batch  ->  standard input
# Scenes.
2  render absent.toml -o b.png  ->  absent.toml
2  render absent -o b.png  ->  absent|built in are cuboid, bench-far|`shadetrade extremes --list`
2  render . -o b.png  ->  .
2  render bytes.toml -o b.png  ->  bytes.toml
2  view key.toml  ->  key.toml:1:1: |colour|^^^^^^
# Outputs.
2  render -o b.jpg  ->  b.jpg|.png
2  prove -o b.toml  ->  b.toml|.png
2  requires -o b.png  ->  b.png|.toml
2  requires a.toml -o sub/../a.toml  ->  is the input itself
1  render --size 9x9 -o sub  ->  sub|directory
1  requires -o sub  ->  sub|directory
1  render --size 9x9 -o none/  ->  none/|directory
1  render --size 9x9 -o none/b.png  ->  none/b.png|no folder none
1  render --size 9x9 -o cuboid/b.png  ->  cuboid/b.png
1  render --size 9x9 -o LONG  ->  too long
1  figures -o none/b  ->  none/b|no folder none
1  figures -o cuboid  ->  cuboid is a file
# Pictures to judge.
2  prove --picture deep.png  ->  16 bits
2  prove --picture clear.png  ->  transparent
2  prove --picture half.png  ->  error: half.png is damaged⏎
2  prove --picture flipped.png  ->  error: flipped.png is damaged⏎
2  prove --picture header.png  ->  error: header.png is damaged⏎
2  prove --picture endless.png  ->  error: endless.png is damaged⏎
2  prove --picture wide.png  ->  wide.png has more than 16384x16384 pixels
2  prove --picture text.png  ->  not a PNG
2  prove --picture absent.png  ->  cannot read
2  prove --picture .  ->  cannot read .
2  prove --picture drawn.png --size 96x72  ->  --size
2  prove --picture drawn.png -o drawn.png  ->  the input itself
2  prove --picture drawn.png drawn.png -o map.png  ->  -o shows one picture
# The minus of print.
2  render -o b.png --set light.white.intensity=−0.5  ->  write -
# Lessons.
2  lesson  ->  NAME|FILE
2  lesson --list --size 9x9  ->  --list
2  lesson absent  ->  absent|built in are lessons/
2  lesson step.toml  ->  step.toml:4:22: |there is no key light.withe.on|has white, red
2  lesson step.toml -o step.toml  ->  step.toml|.png
# Without a display a scene is found and read, but not shown.
1  ./render  ->  no display|shadetrade render ./render -o
1  bench-far  ->  no display|shadetrade render bench-far -o
1  view --camera 2  ->  no display|shadetrade render cuboid -o
1  lesson what-a-tolerance-buys  ->  no display|shadetrade lesson lessons/what-a-tolerance-buys -o
"#;

#[test]
fn a_failure_has_its_exit_status_and_its_reason_and_writes_nothing() {
    let folder = folder();
    let folder = folder.path();
    put(folder, "a.toml", SCENE);
    put(folder, "key.toml", format!("colour = 1\n{SCENE}"));
    put(folder, "cuboid", "this is no scene");
    put(folder, "render", SCENE);
    put(folder, "bytes.toml", [0xff, 0xfe, 0x00]);
    put(folder, "text.png", "no picture");
    let step = "scene = \"cuboid\"\n[[step]]\nsay = \"\"\nset.light.withe.on = true";
    put(folder, "step.toml", step);
    fs::create_dir(folder.join("sub")).expect("it is made");
    assert_works(folder, "render --size 96x72 -o drawn.png");
    let png = get(folder, "drawn.png");
    put(folder, "half.png", &png[..png.len() / 2]);
    for (name, at) in [("flipped.png", png.len() / 2), ("header.png", 29)] {
        let mut damaged = png.clone();
        damaged[at] ^= 1;
        put(folder, name, damaged);
    }
    put(folder, "endless.png", &png[..png.len() - 1]);
    let picture = |name, picture: DynamicImage| {
        let saved = picture.save_with_format(folder.join(name), ImageFormat::Png);
        saved.expect("it is written");
    };
    let drawn = image::load_from_memory(&png).expect("a PNG");
    picture("wide.png", DynamicImage::new_rgb8(16_385, 1));
    picture("deep.png", drawn.to_rgb16().into());
    let mut clear = drawn.to_rgba8();
    clear.get_pixel_mut(3, 4).0[3] = 254;
    picture("clear.png", clear.into());

    let before = listing(folder);
    for row in FAILURES.lines().skip(1).filter(|row| !row.starts_with('#')) {
        println!("{row}");
        let (status, rest) = row.split_once("  ").expect("a status");
        let (line, words) = rest.split_once("  ->  ").expect("words");
        let line = line.replace("LONG", &"n".repeat(300));
        let status = status.parse().expect("a number");
        assert_failed(&run(folder, &line), status, &words.replace('⏎', "\n"));
    }
    assert_eq!(listing(folder), before);
    assert_eq!(get(folder, "a.toml"), SCENE.as_bytes());
    assert_eq!(get(folder, "drawn.png"), png);
    // A built-in scene has precedence over a file of its name, which is not the scene.
    assert_works(folder, "render cuboid -o cuboid --size 9x9");
}

#[test]
fn a_simd_level_is_either_used_or_refused() {
    let folder = folder();
    for level in shadetrade::shading::simd::NAMES {
        let line = format!("render -o a.png --size 9x9 --simd {level}");
        if shadetrade::shading::simd::named(level).is_some() {
            assert!(assert_works(folder.path(), &line).contains(level));
        } else {
            let words = format!("{level}|this machine|fallback");
            assert_failed(&run(folder.path(), &line), 2, &words);
        }
    }
}

#[test]
fn no_number_has_a_blank() {
    for words in
        "--size= 1x1|--size=1x1 |--size=1 x1|--tolerance= 1|--budget=1 |--threads= 1".split('|')
    {
        let parsed = cli::parse(["shadetrade", "view", words].map(OsString::from));
        assert!(parsed.is_err(), "{words:?}");
    }
}
