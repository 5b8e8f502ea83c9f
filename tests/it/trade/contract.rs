//! The format of `trade.json`: the keys of its tables, and figures that follow from others.

use serde_json::Value;

use crate::cli::keys;

const OF_REPORT: &str =
    "machine command scene camera projection size covered_pixels methods left_out";
const OF_MACHINE: &str = "cpu cores lanes os rustc profile";
const OF_METHOD: &str = "id mode segments tolerance threads ms ns_per_covered_pixel counts error own_error edge_pixels \
                         highlight_kept on_front";
const OF_TIMING: &str = "samples median interval min raw";
const OF_ERROR: &str = "max max_pixel mean rmse p999 over_1_level";
const OF_LEFT_OUT: &str = "id mode segments tolerance reason";

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().expect("a list");
    values.iter().map(number).collect()
}

/// Reads a report; panics if it violates the format.
pub fn read(text: &str) -> Value {
    let report: Value = serde_json::from_str(text).expect("JSON");
    let machine = &report["machine"];
    assert_eq!(
        (keys(&report), keys(machine)),
        (OF_REPORT.into(), OF_MACHINE.into())
    );
    for text in ["cpu", "lanes", "os", "rustc", "profile"] {
        assert!(machine[text].as_str().is_some_and(|it| !it.is_empty()));
    }
    assert!(machine["cores"].as_u64() > Some(0) && report["command"].is_string());
    assert_eq!(
        (&report["camera"], &report["projection"]),
        (&"1".into(), &"perspective".into())
    );
    let methods = report["methods"].as_array().expect("a list");
    for method in methods {
        check_method(method, &report);
    }
    for out in report["left_out"].as_array().expect("a list") {
        assert_eq!(keys(out), OF_LEFT_OUT);
        assert!(out["reason"].as_str().is_some_and(|it| !it.is_empty()));
    }
    let is_covered = report["covered_pixels"].as_u64() > Some(0);
    let has_front = methods.iter().any(|it| it["on_front"] == true);
    let has_time = methods.iter().any(|it| !it["ms"].is_null());
    assert_eq!(has_front, is_covered && has_time);
    report
}

fn check_method(method: &Value, report: &Value) {
    let what = method["id"].as_str().expect("a name");
    assert_eq!(keys(method), OF_METHOD, "{what}");
    let counts = keys(&method["counts"]);
    assert_eq!(counts, "model_evaluations specular_evaluations", "{what}");
    let covered = number(&report["covered_pixels"]);
    let is_timed = !["phong-unit-vectors", "blinn-phong"].contains(&what);
    assert_eq!(method["ms"].is_object(), is_timed, "{what}");
    let mut expected = None;
    if is_timed {
        let ms = &method["ms"];
        assert_eq!(keys(ms), OF_TIMING, "{what}");
        let (raw, interval) = (numbers(&ms["raw"]), numbers(&ms["interval"]));
        assert_eq!(number(&ms["samples"]), raw.len() as f64, "{what}");
        let [median, least] = ["median", "min"].map(|key| number(&ms[key]));
        assert_eq!(raw.into_iter().reduce(f64::min), Some(least), "{what}");
        // An end may lie a step of the clock below the least time.
        let is_sorted = [0.0, interval[0], interval[1]].is_sorted() && least <= median;
        assert!(is_sorted, "{what}");
        expected = (covered > 0.0).then_some(median * 1e6 / covered);
    }
    assert_eq!(method["ns_per_covered_pixel"].as_f64(), expected, "{what}");
    for error in ["error", "own_error"].map(|key| &method[key]) {
        assert_eq!(error.is_object(), covered > 0.0, "{what}");
        assert!(error.is_null() || keys(error) == OF_ERROR, "{what}");
    }
}
