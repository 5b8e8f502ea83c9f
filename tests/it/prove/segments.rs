//! Gouraud on grids: the enclosures hold the value of the second arithmetic and of f64, and coverage does not depend on the
//! number of cells.

use shadetrade::questions::prove::nearest;
use shadetrade::reference::{Reference, Rule, Seen};

use super::arithmetic::compare;
use super::naive::Scene;
use super::{enclosures, enclosures_without};
use crate::support::prelude::*;
use crate::support::random_scene::case;

const SIZE: [usize; 2] = [48, 36];

/// Numbers of cells along an edge, one for each scene in turn.
const COUNTS: [u32; 6] = [2, 3, 7, 30, 101, 256];

fn on_grid(view: View, segments: u32) -> View {
    let segments = Segments::new(segments);
    View { segments, ..view }
}

#[test]
fn enclosures_on_grids_hold_the_value_and_are_narrow() {
    let (mut widest, mut compared) = (0.0_f64, 0);
    let count = cases(6);
    for (case, segments) in values(&case(ShadingMode::Gouraud), count).zip(COUNTS.iter().cycle()) {
        let (world, view) = case.build(SIZE, 0.0);
        let view = on_grid(view, *segments);
        let pixels = enclosures(&world, &view);
        let found = compare(&Scene::new(&world, &view), SIZE[0], &pixels, 37);
        (widest, compared) = (widest.max(found.0), compared + found.1);
    }
    println!("{compared} pixels, widest enclosure {widest:.1e}");
    assert!(compared > 15 * count, "{compared} pixels were compared");
    assert!(widest < 1e-6, "an enclosure {widest} wide");
}

#[test]
fn f64_lies_in_the_enclosures_and_every_grid_covers_the_same_pixels() {
    let scenes = case(ShadingMode::Gouraud);
    for (case, segments) in values(&scenes, cases(12)).zip(COUNTS.iter().cycle()) {
        let (world, view) = case.build(SIZE, 0.0);
        let [one, many] = [1, *segments].map(|segments| on_grid(view, segments));
        let faces = |seen: &Vec<Seen<_>>| seen.iter().map(Seen::face).collect::<Vec<_>>();
        for rule in [None, Some(Rule::PerspectiveCorrect)] {
            let floats = Reference::<f64>::without(&world, &many, rule);
            let coarse = enclosures_without(&world, &one, rule);
            let fine = enclosures_without(&world, &many, rule);
            for (pixel, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
                let at = [pixel % SIZE[0], pixel / SIZE[0]];
                let float = floats.at(at)[0];
                let error = nearest(float.face(), float.levels, fine);
                let what = format!("{segments} at {at:?}, {rule:?}: {case:?}");
                let is_near = error.is_some_and(|[least, most]| least < 1e-9 && most < 0.01);
                assert!(is_near, "{error:?}, {what}");
                let mut both = [faces(coarse), faces(fine)];
                both.iter_mut().for_each(Vec::dedup);
                assert_eq!(both[0], both[1], "{what}");
            }
        }
    }
}
