//! The shape of `trade.json`, as the contract gives it: every key, its type and its range.

use serde_json::{Map, Value};

/// What is measured at least.
pub const LADDER: [&str; 9] = [
    "gouraud-0",
    "gouraud-0.5",
    "phong-0",
    "phong-0.25",
    "phong-0.5",
    "phong-1",
    "phong-2",
    "phong-4",
    "phong-unit-vectors",
];

/// Panics with the place where `text` departs from the contract.
pub fn assert_holds(text: &str) {
    let value: Value = serde_json::from_str(text).expect("it is JSON");
    let report = Place::root(&value);
    let machine = report.at("machine");
    for key in ["cpu", "lanes", "os", "rustc", "profile"] {
        machine.at(key).is_text();
    }
    machine.at("cores").is_count(1);
    for key in ["command", "scene", "camera"] {
        report.at(key).is_text();
    }
    report
        .at("projection")
        .is_one_of(&["perspective", "orthographic"]);
    let sides = report.at("size").list();
    assert_eq!(sides.len(), 2, "size has two sides");
    for side in sides {
        side.is_count(1);
    }
    let covered = report.at("covered_pixels");
    covered.is_count(0);
    let something_is_drawn = covered.value.as_u64() > Some(0);

    let methods = report.at("methods").list();
    for method in &methods {
        assert_method_holds(method, something_is_drawn);
    }
    let on_front = |method: &Place| method.at("on_front").value == &Value::Bool(true);
    let anything_on_front = methods.iter().any(on_front);
    assert_eq!(
        anything_on_front, something_is_drawn,
        "the front is empty exactly where nothing is drawn"
    );
}

fn assert_method_holds(method: &Place, something_is_drawn: bool) {
    method.at("mode").is_one_of(&["gouraud", "phong"]);
    method.at("tolerance").is_within(0.0, 255.0);
    method.at("threads").is_count(1);
    method.at("on_front").is_flag();
    method.at("edge_pixels").is_count(0);

    let ms = method.at("ms");
    ms.at("samples").is_count(30);
    let [min, median, p99] = ["min", "median", "p99"].map(|key| ms.at(key).number());
    ms.at("mad").is_within(0.0, f64::MAX);
    assert!(
        0.0 <= min && min <= median && median <= p99,
        "{}: min, median, p99 are out of order",
        ms.path
    );
    let raw: Vec<f64> = ms.at("raw").list().iter().map(Place::number).collect();
    assert_eq!(Some(raw.len() as u64), ms.at("samples").value.as_u64());
    let least = raw.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(least, min, "{}: min is the least of raw", ms.path);
    let interval: Vec<f64> = ms.at("interval").list().iter().map(Place::number).collect();
    assert!(
        interval.len() == 2 && min <= interval[0] && interval[0] <= interval[1],
        "{}: the interval is {interval:?}",
        ms.path
    );
    let stages = method.at("stages");
    assert!(!stages.object().is_empty(), "{} has stages", stages.path);
    for name in stages.object().keys() {
        stages.at(name).is_within(0.0, f64::MAX);
    }
    for key in ["model_evaluations", "specular_evaluations"] {
        method.at("counts").at(key).is_count(0);
    }

    method
        .at("ns_per_covered_pixel")
        .exists_if(something_is_drawn, 0.0, f64::MAX);
    let error = method.at("error");
    for key in ["max", "mean", "rmse", "p999"] {
        error.at(key).exists_if(something_is_drawn, 0.0, 255.0);
    }
    for key in ["over_1_level", "flip_mean"] {
        error.at(key).exists_if(something_is_drawn, 0.0, 1.0);
    }
    for key in ["max", "rmse"] {
        method
            .at("own_error")
            .at(key)
            .exists_if(something_is_drawn, 0.0, 255.0);
    }
    let kept = method.at("highlight_kept");
    kept.exists_if(!kept.value.is_null(), 0.0, 1.0);
}

/// A value and the way to it, for messages.
struct Place<'a> {
    value: &'a Value,
    path: String,
}

impl<'a> Place<'a> {
    fn root(value: &'a Value) -> Self {
        Place {
            value,
            path: "trade.json".to_owned(),
        }
    }

    fn object(&self) -> &'a Map<String, Value> {
        self.value
            .as_object()
            .unwrap_or_else(|| panic!("{} is no object", self.path))
    }

    fn at(&self, key: &str) -> Place<'a> {
        let value = self.object().get(key);
        let value = value.unwrap_or_else(|| panic!("{} has no {key}", self.path));
        Place {
            value,
            path: format!("{}.{key}", self.path),
        }
    }

    fn list(&self) -> Vec<Place<'a>> {
        let list = self
            .value
            .as_array()
            .unwrap_or_else(|| panic!("{} is no list", self.path));
        let place = |(index, value)| Place {
            value,
            path: format!("{}[{index}]", self.path),
        };
        list.iter().enumerate().map(place).collect()
    }

    fn number(&self) -> f64 {
        self.value
            .as_f64()
            .unwrap_or_else(|| panic!("{} is no number: {}", self.path, self.value))
    }

    fn is_text(&self) {
        assert!(
            self.value.as_str().is_some_and(|text| !text.is_empty()),
            "{} is no text",
            self.path
        );
    }

    fn is_one_of(&self, words: &[&str]) {
        assert!(
            self.value
                .as_str()
                .is_some_and(|word| words.contains(&word)),
            "{} is none of {words:?}",
            self.path
        );
    }

    fn is_flag(&self) {
        assert!(
            self.value.is_boolean(),
            "{} is neither true nor false",
            self.path
        );
    }

    fn is_count(&self, least: u64) {
        assert!(
            self.value.as_u64().is_some_and(|count| count >= least),
            "{} is no count from {least}",
            self.path
        );
    }

    fn is_within(&self, least: f64, most: f64) {
        let number = self.number();
        assert!(
            (least..=most).contains(&number),
            "{} is {number}, not in {least}..={most}",
            self.path
        );
    }

    /// A number within the range where it has a meaning, `null` where it has none.
    fn exists_if(&self, exists: bool, least: f64, most: f64) {
        if exists {
            self.is_within(least, most);
        } else {
            assert!(self.value.is_null(), "{} should not exist", self.path);
        }
    }
}
