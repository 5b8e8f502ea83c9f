//! The words of the verdict, which must agree with the numbers.

use serde::Deserialize;
use serde_json::Value;
use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::output::words::pace;
use shadetrade::questions::trade::Measurement;
use shadetrade::questions::trade::verdict::{is_sure, sentence, verdict};
use shadetrade::shading::Method;

use super::example;
use crate::support::random::Random;

/// The milliseconds and the largest errors of Gouraud, Phong at tolerance 0.5, and exact Phong.
type Trade = [(f64, f64); 3];
/// Gouraud saves half of the time, and tolerance 0.5 saves half of it again.
const USUAL: Trade = [(0.2, 165.0), (0.46, 0.5), (1.0, 0.0)];
const ALIKE: Trade = [(0.2, 165.0), (0.201, 0.5), (1.0, 0.0)];
const EXACT_IS_AS_FAST: Trade = [(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)];
const EXACT_IS_FASTER: Trade = [(0.2, 165.0), (0.46, 0.5), (0.3, 0.0)];
const INVISIBLE: Trade = [(0.2, 0.31), (0.46, 0.2), (1.0, 0.0)];
const TOO_SHORT: Trade = [(0.0, 165.0), (0.46, 0.5), (1.0, 0.0)];

fn measured(trade: Trade) -> Vec<Measurement> {
    let methods = [(Gouraud, 0.5), (Phong, 0.5), (Phong, 0.0)];
    let measurement = |((mode, tolerance), (time, error))| {
        example::live(Method::of(mode, tolerance), time, error)
    };
    methods.into_iter().zip(trade).map(measurement).collect()
}

/// For each trade and method (0 is Gouraud, 1 half a level, 2 exact): parts of the sentence, and parts that are not in it.
const SENTENCES: &str = "\
usual 0: 2.3 times as fast as|half a level|off by 165 -- no measurable
usual 1: 2.2 times as fast as exact Phong|off by 0.500|Gouraud: 2.3 times as fast as this, off by 165 -- slow
usual 2: 2.2 times as slow as Phong within half a level|off by 0 |Gouraud: 5 to 5.1 times as fast -- 2.3
alike 0: no measurable difference|half a level|off by 165 -- times
as-fast 0: 2.3 times as fast as Phong within half a level -- exact
as-fast 1: no measurable difference in time from exact Phong|Gouraud: 2.3 times -- slow
as-fast 2: no measurable difference in time from Phong within half a level|Gouraud: 2.3 times -- 2.2
faster 1: 1.5 times as slow|exact Phong -- as fast as exact
alike 1: Gouraud: no measurable difference in time from this, off by 165 -- 2.3
invisible 0: 2.3 times as fast|0.310 -- this|slow
too-short 0: faster -- times|inf|NaN";

#[test]
fn the_sentence_states_only_measured_facts() {
    let trades = [
        ("usual", USUAL),
        ("alike", ALIKE),
        ("as-fast", EXACT_IS_AS_FAST),
        ("faster", EXACT_IS_FASTER),
        ("invisible", INVISIBLE),
        ("too-short", TOO_SHORT),
    ];
    for row in SENTENCES.lines() {
        let (shown, parts) = row.split_once(": ").expect("a trade");
        let (name, index) = shown.split_once(' ').expect("a method");
        let (says, hides) = parts.split_once(" -- ").expect("other parts");
        let (_, trade) = trades.iter().find(|it| it.0 == name).expect(name);
        let measured = measured(*trade);
        let method = measured[index.parse::<usize>().expect("a number")].method;
        let text = sentence(&measured, method).expect("it is measured");
        assert!(says.split('|').all(|it| text.contains(it)), "{row}\n{text}");
        let hides = hides.split('|').all(|it| !text.contains(it));
        assert!(hides, "{row}\n{text}");
    }
    assert_eq!(sentence(&measured(USUAL), Method::of(Phong, 0.7)), None);
    // Wide intervals allow no verdict, whether they overlap or not.
    for width in [1.2, 1.3, 20.0] {
        let mut noisy = measured(USUAL);
        for one in &mut noisy {
            one.timing.interval = [one.timing.median, width * one.timing.median];
        }
        for one in &noisy {
            let text = sentence(&noisy, one.method).expect("it is measured");
            let is_told = width * width <= 1.5;
            assert_eq!(text.contains("not sure"), !is_told, "{text}");
            assert_eq!(text.contains("times as"), is_told, "{text}");
            assert_eq!(is_sure(&noisy, one.method), is_told, "{text}");
        }
    }
}

#[test]
fn times_within_noise_are_called_neither_faster_nor_slower() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut one = || (random.within(0.996, 1.004), random.within(0.0, 3.0));
        let measured = measured([one(), one(), one()]);
        let sentences = measured
            .iter()
            .filter_map(|it| sentence(&measured, it.method));
        for text in sentences.chain([verdict(&measured)]) {
            let is_neither = !text.contains("fast") && !text.contains("slow");
            assert!(is_neither, "{text}");
        }
    }
}

#[test]
fn the_verdict_is_about_the_methods_that_were_measured() {
    let usual = "Gouraud|163|xact Phong|unit vectors|171";
    for (report, words, others) in [
        (example::report(), usual, "Exact Phong"),
        (example::empty_report(), "othing is drawn", "off by"),
    ] {
        let text = verdict(&report.methods);
        assert!(words.split('|').all(|word| text.contains(word)), "{text}");
        assert!(!text.contains(others), "{text}");
        let alone = verdict(&report.methods[..1]);
        let mut others = ["fast", "unit"].into_iter();
        assert!(!others.any(|word| alone.contains(word)), "{alone}");
    }
    // The time of the shortcut is not comparable.
    let (measured, shortcut) = (example::report().methods, Method::of(UnitVectors, 0.0));
    let text = sentence(&measured, shortcut).expect("it is measured");
    assert!(!text.contains("Phong"), "{text}");
}

#[test]
fn the_front_page_has_the_words_of_its_measurement() {
    let report = include_str!("../../../assets/trade/trade.json");
    let report: Value = serde_json::from_str(report).expect("JSON");
    let times = |id: &str| {
        let methods = report["methods"].as_array().expect("a list");
        let one = methods.iter().find(|it| it["id"] == id).expect(id);
        <[f64; 2]>::deserialize(&one["ms"]["interval"]).expect("a range")
    };
    let page = include_str!("../../../README.md");
    let page: Vec<&str> = page.split_whitespace().collect();
    for (one, id, other) in [
        ("Gouraud is", "gouraud-0.5", "phong-0.5"),
        ("Phong within half a level is", "phong-0.5", "phong-0"),
    ] {
        let words = format!("{one} {} Phong", pace(times(id), times(other)));
        assert!(page.join(" ").contains(&words), "{words}");
    }
}
