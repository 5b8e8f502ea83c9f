//! Every extreme passes, also those that need a generator or are compared with a scene without the extreme.
//!
//! `SHADETRADE_EXTREMES=full` proves the whole pictures, and a sixteenth of them at the other SIMD levels of this machine. It
//! draws the largest picture of 16384 x 16384 pixels, which takes a gigabyte of memory.

mod crowds;
mod same;

use rayon::prelude::*;
use shadetrade::questions::extremes::{Extreme, KnownFact, Outcome, SIZE, named, run, table};
use shadetrade::scene::EXTREMES;
use shadetrade::shading::simd;

use crate::support::prelude::*;

const MATERIAL: Material = grey([0.3, 0.6, 0.7], 76.8);

pub fn is_full() -> bool {
    std::env::var("SHADETRADE_EXTREMES").is_ok_and(|size| size == "full")
}

/// Twice these sides in a full run.
pub fn enlarged(sides: [usize; 2]) -> [usize; 2] {
    sides.map(|side| if is_full() { 2 * side } else { side })
}

fn levels() -> Vec<Level> {
    if is_full() {
        simd::NAMES.into_iter().filter_map(simd::named).collect()
    } else {
        vec![Level::new()]
    }
}

/// Every extreme; unless `whole`, in one mode by turns, and in a sixteenth of the pixels if the picture has the usual shape.
fn extremes(whole: bool) -> Vec<Extreme> {
    let mut extremes = table();
    for (number, extreme) in extremes.iter_mut().enumerate().filter(|_| !whole) {
        let [width, height] = extreme.size;
        if width * SIZE[1] == height * SIZE[0] {
            extreme.size = [width / 4, height / 4];
        }
        let turn = number % extreme.modes.len();
        extreme.modes = vec![extreme.modes[turn]];
    }
    extremes
}

#[test]
fn every_extreme_passes() {
    for level in levels() {
        // Most of an extreme runs on one core.
        let name = simd::name(level);
        let extremes = extremes(is_full() && name == simd::name(Level::new()));
        let extremes = extremes.par_iter().with_max_len(4);
        let outcomes = extremes.map(|extreme| (extreme, extreme.outcome(level)));
        // Few pixels of cuboids prove little.
        let is_seen = |extreme: &Extreme, outcome: &Outcome| {
            let pixels = outcome.observed.split(' ').next();
            let pixels: usize = pixels.and_then(|it| it.parse().ok()).unwrap_or(0);
            extreme.fact.is_some() || 70 * pixels >= extreme.size[0] * extreme.size[1]
        };
        let failed = outcomes.filter(|(extreme, it)| !it.pass || !is_seen(extreme, it));
        let failed: Vec<String> = failed.map(|(_, outcome)| outcome.to_string()).collect();
        assert!(failed.is_empty(), "{name}\n{}", failed.join("\n"));
    }
}

#[test]
fn a_wrong_fact_fails_and_only_a_pixel_that_is_known_may_be_undecided() {
    let outcome = |name: &str, fact| {
        let mut extremes = named(&[name.to_owned()]).expect("it is built in");
        extremes[0].fact = fact;
        extremes[0].outcome(Level::new())
    };
    let undecided = "point-over-a-light-an-ulp-under-it";
    let pixel = |level: f64| KnownFact::Pixel {
        at: [7, 4],
        levels: [level; 3],
    };
    for (name, fact, expected) in [
        ("assignment", Some(KnownFact::Cuboid(0)), true),
        ("assignment", Some(KnownFact::Cuboid(1)), false),
        ("assignment", Some(KnownFact::Background), false),
        ("assignment", Some(KnownFact::Everywhere(1.0)), false),
        (undecided, Some(pixel(30.0)), true),
        (undecided, Some(pixel(31.0)), false),
        (undecided, None, false),
    ] {
        assert_eq!(outcome(name, fact).pass, expected, "{fact:?}");
    }
    let observed = outcome("assignment", None).observed;
    assert!(observed.contains("in 24 pictures"), "{observed}");
    let observed = outcome("slab-1e4", None).observed;
    let mut words = ["e-5 level at tolerance 0, ", ", 0.4"].iter();
    assert!(words.all(|word| observed.contains(word)), "{observed}");
}

#[test]
fn extremes_are_chosen_by_name_with_or_without_their_folder() {
    let chosen = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        named(&names).map(|extremes| extremes.iter().map(|it| it.name).collect::<Vec<_>>())
    };
    let two = chosen(&["eye-inside", "extremes/assignment"]).ok();
    assert_eq!(two, Some(vec!["assignment", "eye-inside"]));
    assert_eq!(chosen(&[]).map(|all| all.len()).ok(), Some(EXTREMES.len()));
    assert!(EXTREMES.len() > 100, "the table is whole");
    assert!(EXTREMES.iter().all(|(_, text)| text.starts_with("# ")));
    assert!(chosen(&["eye-inside", "eye"]).is_err());
}

#[test]
fn an_outcome_that_fails_is_said_and_an_error() {
    let outcomes = [("four", true), ("five", false)].map(|(observed, pass)| Outcome {
        name: "two by two",
        expected: "four".to_owned(),
        observed: observed.to_owned(),
        pass,
    });
    let mut extremes = named(&["assignment".to_owned()]).expect("it is built in");
    extremes[0].fact = Some(KnownFact::Background);
    assert!(run(&extremes, Level::new(), false).is_err());
    for (outcome, words) in outcomes.iter().zip([["pass", "four"], ["FAIL", "five"]]) {
        let line = outcome.to_string();
        let words = words.into_iter().chain(["two by two", "four"]);
        assert!({ words }.all(|word| line.contains(word)), "{line}");
    }
}
