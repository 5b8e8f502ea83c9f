//! The built-in lessons say what their pictures show: every number in a sentence is computed again.

use shadetrade::scene::{LESSONS, Step};
use shadetrade::shading::SquareKind;
use shadetrade::window::facts::Comparison;

use crate::support::prelude::*;

/// The size of a picture on a sheet.
const SIZE: [usize; 2] = [640, 480];
/// The background of the scene, 0x00RRGGBB.
const BACKGROUND: u32 = 0x00ec_eef0;

/// A step of the lesson whose name holds a word; steps count from 1.
struct Told {
    say: String,
    record: SceneRecord,
}

fn step(word: &str, number: usize) -> Told {
    let lesson = LESSONS.iter().find(|it| it.0.contains(word));
    let scene = Scene::load(lesson.map(|it| it.0)).expect("a lesson");
    told(&scene.lesson[number - 1])
}

fn told(step: &Step) -> Told {
    Told {
        say: step.say.clone(),
        record: SceneRecord::clone(&step.record),
    }
}

impl Told {
    #[track_caller]
    fn says(&self, words: &str) {
        assert!(self.say.contains(words), "{words}: {}", self.say);
    }

    fn with_segments(mut self, count: u32) -> Told {
        self.record.cuboid[0].segments = Segments::new(count).expect("a legal number");
        self
    }

    /// The picture in a mode, 0x00RRGGBB.
    fn pixels(&self, mode: ShadingMode) -> Vec<u32> {
        let mut world = self.record.spawn();
        let view = View::of(&world, SIZE).shaded(mode);
        draw(&mut world, &view, Keep::Display).pixels().to_vec()
    }

    fn comparison(&self, methods: Vec<Method>) -> Comparison {
        let mut world = self.record.spawn();
        let view = View::of(&world, SIZE);
        let level = fearless_simd::Level::new();
        let compared = Comparison::of(&mut world, &view, methods, level, Monitor::NONE);
        finished(compared).expect("it fits")
    }

    /// The largest error of the picture against exact Phong, in levels.
    fn error(&self) -> f64 {
        let worst = self.comparison(Vec::new()).worst;
        worst.expect("a cuboid is seen").error
    }

    /// That of Blinn-Phong, which is right of the line.
    fn blinn_error(&self) -> f64 {
        let blinn = Method::of(ShadingMode::BlinnPhong, 0.0);
        let view = &self.record.view;
        assert_eq!((view.show, view.sides[1]), (ViewMode::Wipe, blinn.into()));
        let sides = self.comparison(vec![blinn]).sides;
        sides[0].1.expect("a cuboid is seen").error
    }

    /// The number of squares of each kind.
    fn squares(&self) -> impl Fn(SquareKind) -> u64 + use<> {
        let mut world = self.record.spawn();
        let view = View::of(&world, SIZE);
        let counts = draw(&mut world, &view, Keep::Display).counts().squares;
        move |kind| {
            let place = SquareKind::ALL.iter().position(|it| *it == kind);
            counts[place.expect("a kind")]
        }
    }
}

/// The largest channel of a pixel.
fn brightness(pixel: u32) -> u8 {
    pixel.to_be_bytes().into_iter().max().unwrap_or_default()
}

/// The middle of the brightest pixels of the cuboid, as shares of the picture; `None` if none is bright.
fn spot(pixels: &[u32]) -> Option<[f64; 2]> {
    let places = || (0..).zip(pixels).filter(|it| *it.1 != BACKGROUND);
    let most = places().map(|it| brightness(*it.1)).max()?;
    let brightest = places().filter(|it| brightness(*it.1) == most);
    let bright: Vec<usize> = brightest.map(|it| it.0).collect();
    let mean = |place: &dyn Fn(usize) -> usize| {
        let sum: usize = bright.iter().map(|it| place(*it)).sum();
        (sum as f64 / bright.len() as f64) + 0.5
    };
    let [x, y] = [mean(&|it| it % SIZE[0]), mean(&|it| it / SIZE[0])];
    (most > 200).then(|| [x / SIZE[0] as f64, y / SIZE[1] as f64])
}

#[test]
fn a_lesson_is_short_and_asks_one_question() {
    for (name, text) in LESSONS {
        let lesson = Scene::load(Some(name)).expect("a lesson").lesson;
        assert!((5..=6).contains(&lesson.len()), "{name}");
        let questions = lesson.iter().filter(|it| it.question.is_some());
        assert_eq!(questions.count(), 1, "{name}");
        assert!(!text.contains("cell"), "{name}: segments is the word");
    }
}

#[test]
fn the_line_of_a_wipe_and_the_cross_are_on_the_bright_spot() {
    let mut seen = 0;
    for (name, _) in LESSONS {
        for step in &*Scene::load(Some(name)).expect("a lesson").lesson {
            let Some([x, y]) = spot(&told(step).pixels(ShadingMode::Phong)) else {
                continue;
            };
            let view = &step.record.view;
            if view.show == ViewMode::Wipe {
                assert!((x - view.divider).abs() < 0.01, "{x}: {}", step.say);
                seen += 1;
            }
            if let Some([right, down]) = view.pixel {
                let aspect = SIZE[0] as f64 / SIZE[1] as f64;
                let away = ((x - 0.5) * aspect - right).hypot(y - 0.5 - down);
                assert!(away < 0.01, "{away}: {}", step.say);
                seen += 1;
            }
        }
    }
    assert!(seen >= 10, "{seen}");
}

#[test]
fn the_plane_is_dull_where_light_is_computed_at_its_corners() {
    for number in [1, 2, 5] {
        let step = step("plane", number);
        let mut levels = step.pixels(ShadingMode::Gouraud);
        levels.retain(|it| *it != BACKGROUND);
        let level = brightness(levels[0]);
        let even = u32::from_be_bytes([0, level, level, level]);
        assert!(levels.iter().all(|it| *it == even), "step {number}");
        if number == 2 {
            step.says(&format!("level {level} of 255 everywhere"));
        }
    }
    let phong = step("plane", 3);
    phong.says("more than 200 of 255");
    assert!(spot(&phong.pixels(ShadingMode::Phong)).is_some());
    let segments = step("plane", 6);
    let count = segments.record.cuboid[0].segments.count();
    segments.says(&format!("{count} segments"));
    assert!(spot(&segments.pixels(ShadingMode::Gouraud)).is_some());
}

#[test]
fn edges_decide_whether_there_is_a_spot() {
    let gouraud = step("edges", 3);
    gouraud.says(&format!("up to {:.0} of 255", gouraud.error()));
    let sharp = step("edges", 4);
    let mut cuboids = sharp.record.cuboid.iter();
    assert!(cuboids.all(|it| it.normals == NormalMode::Face));
    let mut dark = step("edges", 4);
    let lights = dark.record.light.iter_mut();
    let specular = lights.filter(|it| it.kind == LightKind::Specular);
    specular.for_each(|it| it.on = false);
    let [with, without] = [&sharp, &dark].map(|it| it.pixels(ShadingMode::Phong));
    assert!(with == without, "no mirrored light meets the eye");
    let mut smooth = step("edges", 4);
    smooth.record.cuboid[0].normals = NormalMode::Corner;
    assert!(spot(&smooth.pixels(ShadingMode::Phong)).is_some());
    let mut gouraud = step("edges", 5);
    gouraud.says("less than one level");
    gouraud.record.cuboid[0].shading = ShadingMode::Gouraud;
    assert!(gouraud.error() < 1.0);
}

#[test]
fn the_errors_of_segments_are_those_of_the_program() {
    for count in [1, 2] {
        let step = step("vertices", 1).with_segments(count);
        let spot = spot(&step.pixels(ShadingMode::Gouraud));
        assert!(spot.is_none(), "{count}");
    }
    let eight = step("vertices", 2);
    assert!(spot(&eight.pixels(ShadingMode::Gouraud)).is_some());
    eight.says(&format!("up to {:.0} of 255 off", eight.error()));
    let sixteen = step("vertices", 3);
    sixteen.says(&format!("up to {:.0} off", sixteen.error()));
    let all = step("vertices", 4);
    all.says(&format!("64 segments: up to {:.1} off", all.error()));
    let half = all.with_segments(32);
    half.says(&format!("of the {:.0} that 32 segments", half.error()));
    let sharp = step("vertices", 6);
    sharp.says("less than one level off");
    assert!(sharp.error() < 1.0);
}

/// An angle between lamp and eye is twice the angle of incidence in the middle of the box.
#[test]
fn blinn_parts_from_phong_with_the_angle() {
    assert!(step("which", 1).blinn_error() < 2.0, "both agree");
    for (number, angle) in [(2, 30), (3, 45), (4, 60), (5, 45)] {
        let step = step("which", number);
        let lamps = step.record.light.iter();
        let mut lamps = lamps.filter(|it| it.kind == LightKind::Specular);
        let lamp = lamps.next().and_then(|it| it.position).expect("a lamp");
        let eye = step.record.camera[0].position;
        let apart = lamp.angle_between(eye).to_degrees();
        assert!((apart - 2.0 * f64::from(angle)).abs() < 0.01, "{apart}");
        step.says(&format!("{angle} degrees"));
        step.says(&format!("{:.0} o", step.blinn_error()));
    }
    let last = step("which", 5);
    let shininess = last.record.cuboid[0].material.shininess;
    last.says(&format!("shininess {shininess}"));
}

#[test]
fn the_squares_of_a_tolerance_are_those_of_the_program() {
    use SquareKind::{Highlight, Linear, Quadratic, Terminator};
    let count = |kinds: &[SquareKind], squares: &dyn Fn(SquareKind) -> u64| -> u64 {
        kinds.iter().map(|kind| squares(*kind)).sum()
    };
    let nine = [Linear, Quadratic, Terminator];
    let exact = step("tolerance", 1).squares();
    let pixel_by_pixel = count(&nine, &exact) + exact(Highlight) == 0;
    assert!(pixel_by_pixel, "all are computed pixel by pixel");
    let half = step("tolerance", 2).squares();
    let most = 3 * count(&nine, &half) > 2 * count(&SquareKind::ALL, &half);
    assert!(most && half(Quadratic) > 50 && half(Highlight) < 20);
    let eight = step("tolerance", 3).squares();
    let is_blue = eight(Linear) > 50 && eight(Quadratic) < 10;
    assert!(is_blue, "blue replaces yellow");
    let is_pink = eight(Highlight) > half(Highlight);
    assert!(is_pink, "pink reaches into the spot");
    let map = step("tolerance", 5);
    map.says(&format!("about {:.0} off", map.error()));
    let last = step("tolerance", 6);
    last.says("by more than one of 255");
    assert!(last.error() <= 0.5);
    assert_eq!(last.record.view.show, ViewMode::Picture);
}
