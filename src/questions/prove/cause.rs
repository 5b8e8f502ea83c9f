//! The cause of a wrong picture, where one is proven: with one change of the scene, or of the order of its rows, columns or
//! colours, every pixel of the picture is.

use hecs::World;

use super::{Shown, Verdict, judge};
use crate::components::{NormalMode, View};
use crate::output::progress::bands;
use crate::output::{Monitor, one_line};
use crate::reference::{Interval, Reference};
use crate::scene::{Scene, SceneRecord};
use crate::shading::{METHODS, limit};

/// The name of what is exchanged, and the function that does so in pixels of so many columns.
type Exchange = (&'static str, fn(&mut [u32], usize));

/// Pictures are often stored from the bottom up, or as blue, green and red.
const EXCHANGES: [Exchange; 3] = [
    ("its rows", |pixels, width| {
        pixels.reverse();
        pixels.chunks_exact_mut(width).for_each(<[u32]>::reverse);
    }),
    ("its columns", |pixels, width| {
        pixels.chunks_exact_mut(width).for_each(<[u32]>::reverse);
    }),
    ("red and blue", |pixels, _| {
        for pixel in pixels {
            *pixel = pixel.swap_bytes() >> 8;
        }
    }),
];

/// Sentences about `picture`, 0x00RRGGBB row by row from the top, each proven: what it is instead of that of `view`.
///
/// # Errors
/// If the work is cancelled.
pub async fn causes(
    scene: &Scene,
    view: &View,
    picture: &[u32],
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<String>> {
    let (world, record) = (&scene.world, SceneRecord::of(&scene.world));
    let mut causes = Vec::new();
    for (name, exchange) in EXCHANGES {
        let mut exchanged = picture.to_vec();
        exchange(&mut exchanged, view.size[0]);
        if is_proven(world, view, &exchanged, monitor).await? {
            causes.push(format!("it is right once {name} are exchanged"));
        }
    }
    let mut modes = METHODS.to_vec();
    modes.dedup_by_key(|method| method.mode);
    for method in modes {
        if is_proven(world, &view.shaded(method.mode), picture, monitor).await? {
            let name = method.id.trim_end_matches("-0");
            causes.push(format!("it is the picture of {name}"));
        }
    }
    for normals in NormalMode::ALL {
        let mut other = record.clone();
        other.cuboid.iter_mut().for_each(|it| it.normals = normals);
        if is_proven(&other.spawn(), view, picture, monitor).await? {
            causes.push(format!("it is the picture with {} normals", normals.name()));
        }
    }
    let lights = record.light.iter().enumerate();
    for (index, light) in lights.filter(|(_, light)| light.on) {
        let mut other = record.clone();
        other.light[index].on = false;
        if is_proven(&other.spawn(), view, picture, monitor).await? {
            let name = one_line(&light.name);
            causes.push(format!("it is the picture without light {name}"));
        }
    }
    Ok(causes)
}

/// Whether every pixel of `picture` is proven to be that of `view`. The first band of rows with another pixel ends the search.
async fn is_proven(
    world: &World,
    view: &View,
    picture: &[u32],
    monitor: Monitor<'_>,
) -> anyhow::Result<bool> {
    let enclosures = Reference::<Interval>::new(world, view);
    let ([width, height], limit) = (view.size, limit(view.tolerance));
    let row = |y: usize| {
        let mut is_proven = true;
        enclosures.row(y, |x, seen| {
            let shown = Shown::of_bytes(picture[y * width + x], seen, limit);
            is_proven &= judge(shown, seen, limit).0.verdict == Verdict::Proven;
        });
        Ok(is_proven)
    };
    for rows in bands(height) {
        let done = [rows.start, height];
        let rows = monitor
            .in_parallel("looking for the cause", rows, done, row)
            .await?;
        if rows.contains(&false) {
            return Ok(false);
        }
    }
    Ok(true)
}
