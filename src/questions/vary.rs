//! The command `vary`: one number of a scene against error and time.
//!
//! ```text
//! KEY=FROM..TO --variable--> scenes --picture--> errors, proven --curve--> ranges that keep the tolerance --export--> table, plot
//!                                  '--timing--> times
//! ```
//! For each value the scene is drawn by each contender, and every pixel is compared with an interval that encloses the exact
//! level. Where a contender ceases to keep the tolerance is then searched by bisection.

pub mod curve;
pub mod export;
pub mod picture;
mod plot;
pub mod refined;
pub mod variable;

use std::path::Path;
use std::time::Duration;

use serde::Serialize;

pub use self::curve::{Curve, Point};
use self::picture::{Compared, Contender, Error, errors};
use self::variable::Variable;
use crate::components::alike;
use crate::output::progress::with_bar;
use crate::output::{self, Monitor, finished, one_line, print, say};
use crate::questions::job::{Drawing, Heading};
use crate::questions::trade::batch::time_here;
use crate::questions::trade::timing::of_batches;
use crate::questions::trade::{self, is_timed};
use crate::scene::{Scene, SceneRecord};
use crate::shading::limit;

/// The files of a report.
const FILES: [&str; 2] = ["vary.json", "vary.svg"];

/// The numbers to vary, and the methods.
pub struct Request {
    pub drawing: Drawing,
    pub variables: Vec<Variable>,
    pub contenders: Vec<Contender>,
    /// The number of values of each variable, at least 2.
    pub steps: usize,
    /// The time for timing the frames of all methods; `None` times nothing.
    pub time: Option<Duration>,
}

/// The curves of one variable, one for each contender.
#[derive(Clone, Debug, Serialize)]
pub struct Panel {
    #[serde(flatten)]
    pub variable: Variable,
    pub curves: Vec<Curve>,
}

impl Panel {
    /// Whether the errors are the same at every value.
    pub fn is_still(&self) -> bool {
        let mut curves = self.curves.iter();
        curves.all(|curve| alike(curve.points.iter().map(|it| it.found)).is_some())
    }

    /// A sentence about where nothing is drawn.
    pub fn emptiness(&self) -> Option<String> {
        let places = self.curves.first()?.emptiness()?;
        Some(format!("Nothing is drawn {places}."))
    }
}

/// The result of the command.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    #[serde(flatten)]
    pub heading: Heading,
    /// The tolerance that is to be kept, in levels.
    pub tolerance: f64,
    pub keys: Vec<Panel>,
}

impl Request {
    /// The scene with a value of a variable. Options of the command line are part of it.
    fn scene(&self, variable: &Variable, value: f64) -> anyhow::Result<SceneRecord> {
        let record = SceneRecord::of(&self.drawing.scene.world);
        variable.scene(&record, value)
    }

    fn errors(&self, record: &SceneRecord, contenders: &[Contender]) -> anyhow::Result<Vec<Error>> {
        let drawing = &self.drawing;
        finished(errors(
            record,
            drawing.size,
            contenders,
            drawing.level,
            Compared::All,
            Monitor::NONE,
        ))
    }

    /// The median times of a frame by contender, in milliseconds, measured in `time`; `None` of what is no method or not timed.
    async fn times(
        &self,
        record: &SceneRecord,
        time: Duration,
        monitor: Monitor<'_>,
    ) -> anyhow::Result<Vec<Option<f64>>> {
        let timed = |it: &Contender| it.method.filter(|method| is_timed(*method));
        let request = trade::Request {
            drawing: Drawing {
                scene: Scene::spawn(self.drawing.scene.name.clone(), record),
                ..self.drawing
            },
            methods: self.contenders.iter().filter_map(timed).collect(),
            time,
            is_report: false,
        };
        let batch = async |number| time_here(&request, number, monitor).await;
        let mut timings = of_batches(batch, |_| ()).await?.into_iter();
        let median = |it: &Contender| timed(it).and_then(|_| timings.next()).map(|it| it.median);
        Ok(self.contenders.iter().map(median).collect())
    }

    /// Varies one key.
    async fn panel(
        &self,
        variable: &Variable,
        [done, all]: [usize; 2],
        monitor: Monitor<'_>,
    ) -> anyhow::Result<Panel> {
        let values = variable.values(self.steps);
        let evaluate = |number: usize| {
            let scene = self.scene(variable, values[number])?;
            self.errors(&scene, &self.contenders)
        };
        let step = "drawing and enclosing";
        let found = monitor.in_parallel(step, 0..values.len(), [done, all], evaluate);
        let found = found.await?;
        let mut times = Vec::new();
        if let Some(time) = self.time {
            for (number, value) in values.iter().enumerate() {
                (monitor.progress)("timing frames", number as f64 / values.len() as f64);
                let record = self.scene(variable, *value)?;
                let of_value = self.times(&record, time / values.len() as u32, monitor);
                times.push(of_value.await?);
            }
        }
        let limit = limit(self.drawing.view().tolerance);
        let is_zoom = variable.is_zoom(&self.drawing.scene.world);
        let mut curves = Vec::new();
        for (index, contender) in self.contenders.iter().enumerate() {
            let point = |(place, value): (usize, &f64)| Point {
                value: *value,
                found: found[place][index],
                milliseconds: times.get(place).and_then(|times| times[index]),
            };
            let points = values.iter().enumerate().map(point).collect();
            let mut find = |value: f64| {
                monitor.check()?;
                let record = self.scene(variable, value)?;
                let found = self.errors(&record, std::slice::from_ref(contender))?;
                Ok(found.first().copied())
            };
            let curve = Curve::new(contender, variable, points, limit, is_zoom, &mut find)?;
            curves.push(curve);
            monitor.rest().await;
        }
        Ok(Panel {
            variable: variable.clone(),
            curves,
        })
    }
}

/// Varies every key of the request.
///
/// # Errors
/// If a value makes no scene, a picture does not fit in memory, or the work is cancelled.
pub async fn measure(request: &Request, monitor: Monitor<'_>) -> anyhow::Result<Report> {
    let variables = request.variables.iter();
    let all = variables.map(|it| it.values(request.steps).len()).sum();
    let (mut keys, mut done) = (Vec::new(), 0);
    for variable in &request.variables {
        let panel = request.panel(variable, [done, all], monitor).await?;
        done += variable.values(request.steps).len();
        keys.push(panel);
    }
    let drawing = &request.drawing;
    Ok(Report {
        heading: drawing.heading(),
        tolerance: drawing.view().tolerance,
        keys,
    })
}

/// The command: varies, prints the ranges, and writes the files into the folder `out` if there is one.
///
/// # Errors
/// If nothing can be varied, or a file cannot be written.
pub fn run(request: &Request, out: Option<&Path>, as_json: bool) -> anyhow::Result<()> {
    if let Some(folder) = out {
        crate::output::files::make_folder(folder)?;
    }
    let report = with_bar(async |monitor| measure(request, monitor).await)?;
    print(&report, as_json, None, || export::text(&report))?;
    for panel in report.keys.iter().filter(|panel| panel.is_still()) {
        say(&format!("no error depends on {}", panel.variable.key));
    }
    if let Some(folder) = out {
        let texts = [output::json(&report)?, plot::svg(&report)?];
        output::write_into(folder, FILES.into_iter().zip(texts))?;
        say(&format!(
            "wrote vary.json and vary.svg into {}",
            one_line(folder)
        ));
    }
    Ok(())
}
