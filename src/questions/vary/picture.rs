//! The errors of contenders in one picture, between proven bounds.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use fearless_simd::Level;
use hecs::World;

use crate::components::{Segments, ShadingMode, View};
use crate::output::Monitor;
use crate::questions::prove::{nearest, shown};
use crate::reference::{Interval, Real, Reference, Seen};
use crate::scene::SceneRecord;
use crate::shading::{METHODS, Method};
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers};

/// A way to draw a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contender {
    pub id: &'static str,
    /// `None` is Phong by the reference, in f32 or in f64.
    pub method: Option<Method>,
}

/// The formula as a student writes it, in f32 throughout.
pub const TEXTBOOK: Contender = Contender {
    id: "textbook-f32",
    method: None,
};
/// The reference in f64.
pub const REFERENCE: Contender = Contender {
    id: "reference",
    method: None,
};

impl From<Method> for Contender {
    fn from(method: Method) -> Self {
        Contender {
            id: method.id,
            method: Some(method),
        }
    }
}

impl Contender {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Contender> {
        let methods = METHODS.iter().copied().map(Contender::from);
        methods.chain([TEXTBOOK, REFERENCE])
    }

    /// Those of a report, if none are chosen.
    pub fn usual() -> Vec<Contender> {
        let ids = ["gouraud-0.5", "phong-0.5", "phong-unit-vectors"];
        let is_usual = |it: &Contender| ids.contains(&it.id) || it.method.is_none();
        Contender::all().filter(is_usual).collect()
    }
}

/// The bounds of the largest error of a contender, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Error {
    /// Against exact Phong.
    pub error: [f64; 2],
    /// Against the contender's own definition.
    pub own_error: [f64; 2],
}

/// The errors of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errors {
    /// By contender.
    pub of: Vec<Error>,
    /// Of all drawn levels.
    pub hash: u64,
}

/// The pixels of a contender: the face at each, and its levels.
type Shown<'a> = Box<dyn Fn([usize; 2]) -> (Option<usize>, [f64; 3]) + 'a>;

/// Draws the picture of a scene from its active camera by each contender, and compares every pixel with enclosures; also with
/// those of the contender's own definition if `has_own`, else the own errors are 0.
///
/// # Errors
/// If a picture does not fit in memory, or the work is cancelled.
pub async fn errors(
    record: &SceneRecord,
    size: [usize; 2],
    contenders: &[Contender],
    level: Level,
    has_own: bool,
    monitor: Monitor<'_>,
) -> anyhow::Result<Errors> {
    let mut world = record.spawn();
    let view = View::of(&world, size);
    let phong = view.shaded(ShadingMode::Phong);
    let mut frames = Vec::new();
    for contender in contenders {
        let drawn = contender.method.filter(|it| it.mode.is_drawn());
        let frame = drawn.map(|method| {
            let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
            let drawn = systems::draw(&mut world, &method.view(&view), &mut frame);
            drawn.map(|()| frame)
        });
        frames.push(frame.transpose()?);
    }
    let pictures = contenders.iter().zip(&frames).map(|(contender, frame)| {
        frame.as_ref().map_or_else(
            || {
                if *contender == TEXTBOOK {
                    by_reference::<f32>(&world, &phong)
                } else {
                    let view = contender.method.map_or(phong, |it| it.view(&view));
                    by_reference::<f64>(&world, &view)
                }
            },
            |frame| Box::new(move |[x, y]: [usize; 2]| shown(frame, y * size[0] + x)) as Shown,
        )
    });
    let pictures: Vec<Shown> = pictures.collect();
    // The definition of a contender: its mode and its segments.
    let definition = |contender: &Contender| {
        let method = contender.method.filter(|it| it.mode != ShadingMode::Phong);
        method.map(|it| (it.mode, it.segments.map(Segments::count)))
    };
    let mut own = HashMap::new();
    for contender in contenders.iter().filter(|_| has_own) {
        if let Some((definition, method)) = definition(contender).zip(contender.method) {
            let view = method.view(&view);
            own.entry(definition)
                .or_insert_with(|| Reference::<Interval>::new(&world, &view));
        }
    }
    let exact = Reference::<Interval>::new(&world, &phong);
    let mut found = Errors {
        of: vec![Error::default(); contenders.len()],
        hash: 0,
    };
    let mut hasher = DefaultHasher::new();
    for y in 0..size[1] {
        exact.row(y, |x, seen| {
            for (picture, error) in pictures.iter().zip(&mut found.of) {
                let (face, levels) = picture([x, y]);
                levels.map(f64::to_bits).hash(&mut hasher);
                enlarge(&mut error.error, face, levels, seen);
            }
        });
        for (definition_of, reference) in &own {
            reference.row(y, |x, seen| {
                let all = contenders.iter().zip(&pictures).zip(&mut found.of);
                for ((contender, picture), error) in all {
                    if definition(contender).as_ref() == Some(definition_of) {
                        let (face, levels) = picture([x, y]);
                        enlarge(&mut error.own_error, face, levels, seen);
                    }
                }
            });
        }
        monitor.check()?;
        monitor.rest().await;
    }
    for (contender, error) in contenders.iter().zip(&mut found.of) {
        if definition(contender).is_none() {
            error.own_error = error.error;
        }
    }
    found.hash = hasher.finish();
    Ok(found)
}

/// Phong by the reference in another arithmetic.
fn by_reference<'a, R: Real + 'a>(world: &World, view: &View) -> Shown<'a> {
    let reference = Reference::<R>::new(world, view);
    Box::new(move |pixel| {
        let seen = reference.at(pixel)[0];
        (seen.face(), seen.levels.map(|level| level.endpoints()[0]))
    })
}

/// Enlarges the bounds of the largest error by those of a pixel. One that shows another face errs by 255 levels.
fn enlarge(worst: &mut [f64; 2], face: Option<usize>, levels: [f64; 3], seen: &[Seen<Interval>]) {
    let error = nearest(face, levels, seen).unwrap_or([255.0; 2]);
    *worst = [worst[0].max(error[0]), worst[1].max(error[1])];
}
