//! A report in, the text of `trade.csv` out.
//!
//! Rule: one line per method, unrounded, and "-" for what does not exist.

use super::Report;

/// The report as CSV (RFC 4180); the first line names the columns.
pub fn csv(report: &Report) -> String {
    let mut text = String::from(
        "scene,camera,projection,width,height,covered_pixels,method,mode,tolerance,threads,samples,median_ms,mad_ms,\
         min_ms,p99_ms,ns_per_covered_pixel,model_evaluations,specular_evaluations,max_error,mean_error,rmse,p999_error,\
         over_1_level,flip_mean,max_own_error,own_rmse,highlight_kept,edge_pixels,on_front\n",
    );
    for one in &report.methods {
        let (timing, accuracy) = (&one.timing, &one.accuracy);
        let (error, own) = (accuracy.error.error, accuracy.own_error.error);
        let exact = |value: Option<f64>| value.map_or("-".to_owned(), |value| value.to_string());
        let cells = [
            quoted(&report.subject.scene),
            quoted(&report.subject.camera),
            report.subject.projection.name().to_owned(),
            report.subject.size[0].to_string(),
            report.subject.size[1].to_string(),
            report.covered_pixels.to_string(),
            one.method.id.to_owned(),
            one.method.mode.name().to_owned(),
            one.method.tolerance.to_string(),
            one.threads.to_string(),
            timing.samples.to_string(),
            timing.median.to_string(),
            timing.mad.to_string(),
            timing.min.to_string(),
            timing.p99.to_string(),
            exact(one.ns_per_covered_pixel()),
            one.counts.model_evaluations.to_string(),
            one.counts.specular_evaluations.to_string(),
            exact(error.map(|error| error.max)),
            exact(error.map(|error| error.mean)),
            exact(error.map(|error| error.rmse)),
            exact(error.map(|error| error.p999)),
            exact(error.map(|error| error.over_1_level)),
            exact(accuracy.flip_mean),
            exact(own.map(|error| error.max)),
            exact(own.map(|error| error.rmse)),
            exact(accuracy.highlight_kept),
            accuracy.error.edge_pixels.to_string(),
            one.on_front.to_string(),
        ];
        text += &(cells.join(",") + "\n");
    }
    text
}

/// A cell as it must be written to be read as this text.
pub(super) fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
