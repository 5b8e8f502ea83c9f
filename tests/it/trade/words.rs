//! The words of the verdict, which must agree with the numbers.

use shadetrade::components::ShadingMode::{self, Gouraud, Phong};
use shadetrade::shading::Method;
use shadetrade::trade::Measurement;
use shadetrade::trade::verdict::{sentence, verdict};

use super::example;
use crate::support::random::Random;

/// The milliseconds and the largest errors of Gouraud, Phong at tolerance 0.5, and exact Phong.
type Trade = [(f64, f64); 3];
/// Gouraud saves half of the time, and tolerance 0.5 saves half of it again.
const USUAL: Trade = [(0.2, 165.0), (0.46, 0.5), (1.0, 0.0)];

const NOTHING: &str = "nothing to trade";
const ALIKE: &str = "about as fast";

fn measured(trade: Trade) -> Vec<Measurement> {
    let methods = [(Gouraud, 0.5), (Phong, 0.5), (Phong, 0.0)];
    let measurement = |((mode, tolerance), (time, error))| {
        example::live(Method::of(mode, tolerance), time, error)
    };
    methods.into_iter().zip(trade).map(measurement).collect()
}

/// A trade, the method on screen, and parts of the sentence that are in it and that are not, each with a bar between.
type Row = (Trade, (ShadingMode, f64), &'static str, &'static str);

#[test]
fn the_sentence_states_only_measured_facts() {
    let [gouraud, half, exact] = [(Gouraud, 0.5), (Phong, 0.5), (Phong, 0.0)];
    let alike: Trade = [(0.2, 165.0), (0.201, 0.5), (1.0, 0.0)];
    let exact_is_as_fast: Trade = [(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)];
    let exact_is_faster: Trade = [(0.2, 165.0), (0.46, 0.5), (0.3, 0.0)];
    let invisible: Trade = [(0.2, 0.31), (0.46, 0.2), (1.0, 0.0)];
    let too_short: Trade = [(0.0, 165.0), (0.46, 0.5), (1.0, 0.0)];
    let rows: [Row; 11] = [
        (
            USUAL,
            gouraud,
            "2.3 times faster|half a level|but off by 165",
            ALIKE,
        ),
        (
            USUAL,
            half,
            "2.3 times slower|330 times more exact",
            "but|nothing to trade",
        ),
        (
            USUAL,
            exact,
            "5 times slower|rounding|2.2 times faster",
            NOTHING,
        ),
        (alike, gouraud, "about as fast|and off by 165", "times|but"),
        (exact_is_as_fast, gouraud, "exact Phong|2.3 times", "half"),
        (
            exact_is_as_fast,
            half,
            "about as fast|nothing to trade",
            "but",
        ),
        (exact_is_as_fast, exact, NOTHING, "2.2"),
        (
            exact_is_faster,
            half,
            "1.5 times faster|nothing to trade",
            "as fast",
        ),
        (invisible, gouraud, "2.3 times faster|0.310", "but"),
        (invisible, half, "2.3 times slower|0.200", "more exact"),
        (too_short, gouraud, "faster", "times|inf|NaN"),
    ];
    for (trade, (mode, tolerance), says, hides) in rows {
        let text = sentence(&measured(trade), Method::of(mode, tolerance)).expect("it is measured");
        for part in says.split('|') {
            assert!(text.contains(part), "{part:?} is not in {text:?}");
        }
        for part in hides.split('|') {
            assert!(!text.contains(part), "{part:?} is in {text:?}");
        }
    }
    assert_eq!(sentence(&measured(USUAL), Method::of(Phong, 0.7)), None);
    // Intervals that are so wide that they overlap allow no verdict.
    for (trade, says) in [(USUAL, "not measurably"), (exact_is_as_fast, "")] {
        let mut noisy = measured(trade);
        for one in &mut noisy {
            one.timing.interval = [0.1, 2.0];
        }
        for one in &noisy {
            let text = sentence(&noisy, one.method).expect("it is measured");
            assert!(text.contains(says) && !text.contains(NOTHING), "{text}");
        }
    }
}

#[test]
fn times_within_noise_are_called_neither_faster_nor_slower() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut one = || {
            (
                1.0 + 0.004 * random.within(-1.0, 1.0),
                random.within(0.0, 3.0),
            )
        };
        let measured = measured([one(), one(), one()]);
        let sentences = measured
            .iter()
            .filter_map(|it| sentence(&measured, it.method));
        for text in sentences.chain([verdict(&measured)]) {
            assert!(
                !text.contains("faster") && !text.contains("slower"),
                "{text}"
            );
        }
    }
}

#[test]
fn the_verdict_is_about_the_methods_that_were_measured() {
    for (report, words, others) in [
        (
            example::report(),
            "Gouraud|163|xact Phong|unit vectors|171",
            "nothing is drawn",
        ),
        (example::empty_report(), "othing is drawn", "off by"),
    ] {
        let text = verdict(&report.methods);
        assert!(words.split('|').all(|word| text.contains(word)), "{text}");
        assert!(!text.contains(others), "{text}");
        let alone = verdict(&report.methods[..1]);
        assert!(
            !alone.contains("faster") && !alone.contains("unit"),
            "{alone}"
        );
    }
}
