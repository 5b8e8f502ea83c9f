//! A measured scaling in, the texts of `scale.json` and `scale.csv` out.
//!
//! Rule: every key and column is there for every quantity; what does not exist is `null` or "-".

use serde_json::{Value, json};

use super::growth::{exponents, summary, upper_range, verdict};
use super::{Point, Quantity, Scaling, Series};
use crate::trade::csv::quoted;
use crate::trade::json::{document, milliseconds};

/// The scaling as JSON text.
pub fn json(scaling: &Scaling) -> String {
    let all: Vec<Value> = scaling
        .series
        .iter()
        .map(|one| series(scaling, one))
        .collect();
    document(
        &summary(scaling),
        &scaling.subject,
        [("series", all.into())],
    )
}

fn series(scaling: &Scaling, series: &Series) -> Value {
    let from = upper_range(&series.points).first();
    let exponents = exponents(series, scaling.methods.len()).into_iter();
    let fits = exponents.zip(&scaling.methods).map(|(exponent, method)| {
        json!({ "id": method.id, "exponent": exponent, "from": from.map(|point| point.number) })
    });
    let points = series.points.iter();
    json!({
        "quantity": series.quantity.name(),
        "verdict": verdict(scaling, series),
        "fits": fits.collect::<Vec<_>>(),
        "points": points.map(|one| point(scaling, series, one)).collect::<Vec<_>>(),
    })
}

fn point(scaling: &Scaling, series: &Series, point: &Point) -> Value {
    let methods = scaling.methods.iter().enumerate().map(|(index, method)| {
        json!({
            "id": method.id,
            "mode": method.mode.name(),
            "tolerance": method.tolerance,
            "ms": milliseconds(&point.timings[index]),
            series.quantity.cost(): series.cost(point, index),
        })
    });
    json!({
        series.quantity.name(): point.number,
        "size": point.size,
        "threads": point.threads,
        "covered_pixels": point.covered_pixels,
        "methods": methods.collect::<Vec<_>>(),
    })
}

/// The scaling as CSV (RFC 4180), a line for each method in each setting; the first line names the columns.
pub fn csv(scaling: &Scaling) -> String {
    let mut text = String::from(
        "scene,camera,projection,quantity,number,width,height,covered_pixels,threads,method,mode,tolerance,samples,\
         median_ms,mad_ms,min_ms,p99_ms,cost,unit\n",
    );
    for series in &scaling.series {
        let [scene, camera] = match series.quantity {
            Quantity::Pixels | Quantity::Threads => {
                [&scaling.subject.scene, &scaling.subject.camera].map(|name| quoted(name))
            }
            Quantity::Lights | Quantity::Cuboids => ["-", "-"].map(str::to_owned),
        };
        for point in &series.points {
            for (index, method) in scaling.methods.iter().enumerate() {
                let timing = &point.timings[index];
                let cost = series.cost(point, index);
                let cells = [
                    scene.clone(),
                    camera.clone(),
                    scaling.subject.projection.name().to_owned(),
                    series.quantity.name().to_owned(),
                    point.number.to_string(),
                    point.size[0].to_string(),
                    point.size[1].to_string(),
                    point.covered_pixels.to_string(),
                    point.threads.to_string(),
                    method.id.to_owned(),
                    method.mode.name().to_owned(),
                    method.tolerance.to_string(),
                    timing.samples.to_string(),
                    timing.median.to_string(),
                    timing.mad.to_string(),
                    timing.min.to_string(),
                    timing.p99.to_string(),
                    cost.map_or("-".to_owned(), |cost| cost.to_string()),
                    series.quantity.cost().to_owned(),
                ];
                text += &(cells.join(",") + "\n");
            }
        }
    }
    text
}
