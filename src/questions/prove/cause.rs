//! The cause of a wrong picture, where one is proven: with one change of the model, or of the order of its rows, columns or
//! colours, every pixel of the picture is.

use hecs::World;

use super::{Shown, Verdict, judge};
use crate::components::{NormalMode, ShadingMode, View};
use crate::output::progress::bands;
use crate::output::{Monitor, one_line};
use crate::reference::{Interval, Reference, Rule};
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
    // Each of them alone, and several together.
    for chosen in 1..1 << EXCHANGES.len() {
        let (mut names, mut exchanged) = (Vec::new(), picture.to_vec());
        for (bit, (name, exchange)) in EXCHANGES.iter().enumerate() {
            if chosen >> bit & 1 == 1 {
                names.push(*name);
                exchange(&mut exchanged, view.size[0]);
            }
        }
        if is_proven(world, view, None, &exchanged, monitor).await? {
            let names = names.join(" and ");
            causes.push(format!("it is right once {names} are exchanged"));
        }
    }
    let (mut modes, mut rules) = (METHODS.to_vec(), Rule::ALL.to_vec());
    modes.dedup_by_key(|method| method.mode);
    for method in modes {
        if is_proven(world, &view.shaded(method.mode), None, picture, monitor).await? {
            let name = method.id.trim_end_matches("-0");
            causes.push(format!("it is the picture of {name}"));
            if method.mode == ShadingMode::BlinnPhong {
                // Phong without this rule is the same picture.
                rules.retain(|rule| *rule != Rule::Reflection);
            }
        }
    }
    for normals in NormalMode::ALL {
        let mut other = record.clone();
        other.cuboid.iter_mut().for_each(|it| it.normals = normals);
        if is_proven(&other.spawn(), view, None, picture, monitor).await? {
            causes.push(format!("it is the picture with {} normals", normals.name()));
        }
    }
    let lights = record.light.iter().enumerate();
    for (index, light) in lights.filter(|(_, light)| light.on) {
        let mut other = record.clone();
        other.light[index].on = false;
        if is_proven(&other.spawn(), view, None, picture, monitor).await? {
            let name = one_line(&light.name);
            causes.push(format!("it is the picture without light {name}"));
        }
    }
    for rule in rules {
        if is_proven(world, view, Some(rule), picture, monitor).await? {
            let name = rule.name();
            causes.push(format!("it is the picture without {name}"));
        }
    }
    Ok(causes)
}

/// Whether every pixel of `picture` is proven to be that of `view`, without a rule of the model if one is given. The first band
/// of rows with another pixel ends the search.
async fn is_proven(
    world: &World,
    view: &View,
    without: Option<Rule>,
    picture: &[u32],
    monitor: Monitor<'_>,
) -> anyhow::Result<bool> {
    let enclosures = Reference::<Interval>::without(world, view, without);
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
