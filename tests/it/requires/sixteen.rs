//! The sixteen cases of docs/sixteen-cases.md: its scene, its values and its answers.

use shadetrade::questions::requires::{Part, changes};
use shadetrade::reference::Rule::{
    DepthTest, NearPlane, PerspectiveCorrect, SpecularGate, UnitNormal,
};

use crate::extremes::is_full;
use crate::support::prelude::*;

const PAGE: &str = include_str!("../../../docs/sixteen-cases.md");

/// The cells of every row with this number of cells in the tables of the page.
fn rows(columns: usize) -> Vec<Vec<&'static str>> {
    let rows = PAGE.lines().filter(|line| line.starts_with('|'));
    let cells = rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect());
    let rows = cells.filter(|cells: &Vec<_>| cells.len() == columns);
    rows.skip(2).collect()
}

/// The scene of a case, given by its first four cells.
fn scene(case: &[&str]) -> Scene {
    let block = PAGE.split("```toml").nth(1).expect("a block");
    let text = block.split("```").next().expect("its text");
    let mut text = text.replace("KIND", case[3]);
    for value in rows(3) {
        let of = match value[0] {
            "EYE" | "FOV" => case[0],
            "LIGHT" => case[1],
            _ => case[2],
        };
        let is_first = ["near", "turning"].contains(&of);
        text = text.replace(value[0], value[if is_first { 1 } else { 2 }]);
    }
    Scene::parse("case", &text).expect("a scene")
}

#[test]
fn every_answer_of_the_page_is_confirmed() {
    let cases = rows(7);
    assert_eq!(cases.len(), 16);
    for case in cases {
        let scene = scene(&case);
        let size = if is_full() { [64, 48] } else { [40, 30] };
        let view = View {
            tolerance: 0.5,
            ..view_from(&scene, 0, size)
        };
        let rules = [
            UnitNormal,
            PerspectiveCorrect,
            SpecularGate,
            DepthTest,
            NearPlane,
        ];
        let mut parts = vec![Part::EveryPixel(0)];
        parts.extend(rules.map(Part::Rule));
        parts.push(Part::Light(0));
        let left_out: Vec<_> = parts.iter().map(|part| vec![*part]).collect();
        let found = done(changes(&scene, &view, &left_out, Monitor::NONE));
        let answers = case[4..].iter().chain(&["no"; 3]);
        for ((part, change), answer) in parts.iter().zip(&found).zip(answers) {
            let [least, most] = change.largest_error;
            let is_proven = match *answer {
                "yes" => least > 0.5,
                "no" => most <= 0.5,
                other => panic!("{other:?} is no answer"),
            };
            assert!(is_proven, "{case:?}, {part:?}: {least} to {most}");
        }
        assert!(found[6].largest_error[0] > 100.0, "{case:?} is lit");
    }
}
