//! The errors of contenders in one picture, between proven bounds.

use std::array::from_fn;
use std::collections::HashMap;
use std::ops::Range;

use fearless_simd::Level;
use hecs::World;
use serde::Serialize;

use crate::components::{Segments, ShadingMode, View};
use crate::output::Monitor;
use crate::output::memory::OutOfMemory;
use crate::questions::prove::{Verdict, nearest, shown};
use crate::reference::{Interval, Real, Reference, Seen};
use crate::scene::{SceneRecord, unseen};
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

    /// The contenders of a report if none are chosen.
    pub fn usual() -> Vec<Contender> {
        let ids = ["gouraud-0.5", "phong-0.5", "phong-unit-vectors"];
        let is_usual = |it: &Contender| ids.contains(&it.id) || it.method.is_none();
        Contender::all().filter(is_usual).collect()
    }

    /// The frame of what the renderer draws.
    fn draw(
        self,
        world: &mut World,
        view: &View,
        level: Level,
    ) -> Result<Option<Frame>, OutOfMemory> {
        let Some(method) = self.method.filter(|it| it.mode.is_drawn()) else {
            return Ok(None);
        };
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw(world, &method.view(view), &mut frame)?;
        Ok(Some(frame))
    }

    /// The pixels of what the reference draws.
    fn by_reference<'a>(self, world: &World, view: &View) -> Shown<'a> {
        let phong = view.shaded(ShadingMode::Phong);
        match self.method {
            Some(method) => by_reference::<f64>(world, &method.view(view)),
            None if self == TEXTBOOK => by_reference::<f32>(world, &phong),
            None => by_reference::<f64>(world, &phong),
        }
    }

    /// Its mode and its segments; `None` is exact Phong.
    fn definition(self) -> Option<Definition> {
        let method = self.method.filter(|it| it.mode != ShadingMode::Phong);
        method.map(|it| (it.mode, it.segments.map(Segments::count)))
    }
}

/// The bounds of the largest error of a contender, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Error {
    /// Against exact Phong.
    pub error: [f64; 2],
    /// Against the contender's own definition.
    pub own_error: [f64; 2],
    /// The compared pixels in which the contender shows a cuboid. Without one the errors are no evidence.
    pub pixels: usize,
    /// The height of the cuboids in the picture, in pixels; `None` if a part of one is not before the eye.
    #[serde(skip)]
    pub height: Option<f64>,
}

impl Error {
    /// Whether a cuboid is seen, and the error against exact Phong is proven to be within the limit.
    pub fn keeps(&self, limit: f64) -> bool {
        self.pixels > 0 && Verdict::of(self.error, limit) == Verdict::Proven
    }
}

/// The pixels of a picture that are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compared {
    /// Each, also with the contender's own definition.
    All,
    /// An even lattice of at most this many near cuboids. The errors against the contender's own definition are left at 0.
    Lattice(usize),
}

/// A mode and the segments under Gouraud.
type Definition = (ShadingMode, Option<usize>);

/// The pixels of a contender: the face at each, and its levels.
type Shown<'a> = Box<dyn Fn([usize; 2]) -> (Option<usize>, [f64; 3]) + 'a>;

/// Draws the picture of a scene from its active camera by each contender, and compares pixels near cuboids with enclosures. The
/// errors are in the order of the contenders.
///
/// # Errors
/// If a picture does not fit in memory, or the work is cancelled.
pub async fn errors(
    record: &SceneRecord,
    size: [usize; 2],
    contenders: &[Contender],
    level: Level,
    compared: Compared,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<Error>> {
    let mut world = record.spawn();
    let view = View::of(&world, size);
    let phong = view.shaded(ShadingMode::Phong);
    let drawn = contenders
        .iter()
        .map(|it| it.draw(&mut world, &view, level));
    let frames = drawn.collect::<Result<Vec<_>, _>>()?;
    let framed = contenders.iter().zip(&frames);
    let pictures: Vec<Shown> = framed
        .map(|(contender, frame)| match frame {
            Some(frame) => by_frame(frame),
            None => contender.by_reference(&world, &view),
        })
        .collect();
    let own = match compared {
        Compared::All => definitions(contenders, &world, &view),
        Compared::Lattice(_) => HashMap::new(),
    };
    let exact = Reference::<Interval>::new(&world, &phong);
    let none = Error {
        height: unseen::height(&world, &view),
        ..Error::default()
    };
    let mut found = vec![none; contenders.len()];
    let [columns, rows] = lattice(bounds(&exact), compared);
    for y in rows {
        exact.part_of_row(y, columns.clone(), |x, seen| {
            for (picture, error) in pictures.iter().zip(&mut found) {
                let (face, levels) = picture([x, y]);
                error.pixels += usize::from(face.is_some());
                enlarge(&mut error.error, face, levels, seen);
            }
        });
        for (definition_of, reference) in &own {
            reference.part_of_row(y, columns.clone(), |x, seen| {
                let all = contenders.iter().zip(&pictures).zip(&mut found);
                for ((contender, picture), error) in all {
                    if contender.definition().as_ref() == Some(definition_of) {
                        let (face, levels) = picture([x, y]);
                        enlarge(&mut error.own_error, face, levels, seen);
                    }
                }
            });
        }
        monitor.check()?;
        monitor.rest().await;
    }
    for (contender, error) in contenders.iter().zip(&mut found) {
        if contender.definition().is_none() {
            error.own_error = error.error;
        }
    }
    Ok(found)
}

/// Enclosures of the contenders' own definitions.
fn definitions(
    contenders: &[Contender],
    world: &World,
    view: &View,
) -> HashMap<Definition, Reference<Interval>> {
    let mut found = HashMap::new();
    for contender in contenders {
        if let Some((definition, method)) = contender.definition().zip(contender.method) {
            found
                .entry(definition)
                .or_insert_with(|| Reference::new(world, &method.view(view)));
        }
    }
    found
}

/// The compared columns and rows of those in which cuboids may be seen.
fn lattice(
    seen: [Range<usize>; 2],
    compared: Compared,
) -> [impl Iterator<Item = usize> + Clone; 2] {
    let pixels: usize = seen.iter().map(Range::len).product();
    let step = match compared {
        Compared::All => 1,
        Compared::Lattice(most) => (pixels as f64 / most as f64).sqrt().ceil().max(1.0) as usize,
    };
    // The first one is at the middle of a step, because the edge of a range hardly shows a cuboid.
    seen.map(|side| side.skip(step / 2).step_by(step))
}

/// The columns and rows of a picture in which cuboids may be seen.
fn bounds(exact: &Reference<Interval>) -> [Range<usize>; 2] {
    let around = |one: [Range<usize>; 2], other: [Range<usize>; 2]| {
        from_fn(|side| {
            let (one, other) = (&one[side], &other[side]);
            one.start.min(other.start)..one.end.max(other.end)
        })
    };
    let is_seen = |sides: &[Range<usize>; 2]| sides.iter().all(|side| !side.is_empty());
    let seen = exact.bounds().into_iter().filter(is_seen);
    seen.reduce(around).unwrap_or_default()
}

/// The pixels of a frame.
fn by_frame(frame: &Frame) -> Shown<'_> {
    Box::new(|[x, y]| shown(frame, y * frame.size()[0] + x))
}

/// The pixels of the reference in floats.
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
