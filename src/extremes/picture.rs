//! Pictures of the least and the largest size, faces whose corners lie on pixels, and who draws them.

use std::hint::black_box;

use fearless_simd::Level;
use glam::DVec3;

use super::bench::{Bench, Trouble, ways, wrong};
use super::setting::{Body, Setting, Way};
use super::{Case, Known, Rule};
use crate::components::{Projection, ShadingMode};
use crate::frame::NO_TRIANGLE;
use crate::prove::{self, Shown, Verdict};
use crate::reference::{Interval, Reference};
use crate::simd;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "a picture of 1x1",
        // The ray through the middle meets the face z = 1 at its middle: n = (0, 0, 1), l = (0, 0, 1): 30 + kD 170 + kE 255.
        rule: Rule::Known(|| {
            let one = Setting::with(|setting| {
                setting.size = [1, 1];
                setting.eye = DVec3::Z * 10.0;
                for light in &mut setting.lights {
                    light.position = DVec3::Z * 5.0;
                }
            });
            let levels = [0.07568, 0.61424, 0.07568];
            let highlight = [0.633, 0.72811, 0.66];
            let all = ways()
                .filter(|way| way.mode == ShadingMode::Phong)
                .map(|way| Known {
                    setting: one.clone(),
                    way,
                    pixel: [0, 0],
                    levels: [0, 1, 2]
                        .map(|channel| 30.0 + 170.0 * levels[channel] + 255.0 * highlight[channel]),
                });
            all.collect()
        }),
    },
    Case {
        name: "a picture of 1x16384",
        rule: Rule::Proven(|| vec![Setting::with(|setting| setting.size = [1, 16_384])]),
    },
    Case {
        name: "a picture of 16384x1",
        rule: Rule::Proven(|| {
            vec![Setting::with(|setting| {
                setting.size = [16_384, 1];
                // So that the cuboid fills a good part of the row.
                setting.fov = 1e-2;
                setting.height = 2e-3;
            })]
        }),
    },
    Case {
        name: "a picture of 16384x16384",
        rule: Rule::Own(
            "sampled bytes proven within half a level and their rounding",
            largest,
        ),
    },
    Case {
        name: "corners on pixel centres: the top and the left are covered",
        rule: Rule::Own("12 pixels of a face 4 wide and 3 high", |bench| {
            covered(bench, [4.0, 3.0], 0.0, 12)
        }),
    },
    Case {
        name: "corners on pixel corners",
        rule: Rule::Own(
            "25 pixels of a face of 5 x 5, 15 of them right of the diagonal",
            |bench| covered(bench, [5.0, 5.0], 0.5, 25),
        ),
    },
    Case {
        name: "every SIMD level of this machine",
        rule: Rule::Own("the same bits", same_on_every_level),
    },
    Case {
        name: "2, 3 and 7 threads",
        rule: Rule::Own("the same bits", same_on_any_threads),
    },
    Case {
        name: "the state of the processor's floating point after all that",
        rule: Rule::Own("rounds to nearest and keeps subnormal numbers", |_| {
            let least = black_box(f32::from_bits(1));
            let halves = [
                black_box(1.0_f32) + f32::EPSILON / 2.0,
                black_box(-1.0_f32) - f32::EPSILON / 2.0,
            ];
            if least * black_box(2.0) == f32::from_bits(2) && halves == [1.0, -1.0] {
                Ok("does".to_owned())
            } else {
                Err(Trouble::Wrong("does not".to_owned()))
            }
        }),
    },
];

/// Draws the largest picture and proves the bytes of one pixel in a hundred thousand.
fn largest(bench: &mut Bench) -> Result<String, Trouble> {
    let side = if bench.full { 16_384 } else { 1024 };
    let setting = Setting::with(|setting| setting.size = [side, side]);
    let mut scene = setting.scene()?;
    let view = setting.view(
        &scene,
        Way {
            projection: Projection::Perspective,
            mode: ShadingMode::Phong,
            tolerance: 0.5,
        },
    );
    // Its memory is given back at the end.
    let mut large = bench.another(bench.threads())?;
    let frame = match large.display(&mut scene, &view) {
        Ok(frame) => frame,
        Err(full) => return Ok(format!("said of itself: {full}")),
    };
    let reference = Reference::<Interval>::new(&scene.world, &view);
    let (mut worst, mut samples) = (0.0_f64, 0);
    for step in 0..2_000 {
        // Multiples of the golden ratio and its square spread evenly (Roberts 2018).
        let place @ [x, y] = [0.754_877_666, 0.569_840_291]
            .map(|share: f64| (share * f64::from(step)).fract() * side as f64)
            .map(|coordinate| coordinate as usize);
        let [_, bytes @ ..] = frame.pixels()[y * side + x].to_be_bytes();
        // Only the bytes are known, not the face: it is one that may be seen.
        let all = reference.at(place);
        let judged = all.iter().map(|seen| {
            let shown = Shown {
                face: seen.face,
                levels: bytes.map(f64::from),
                bytes: None,
            };
            prove::judge(shown, &all, view.tolerance + 0.5)
        });
        let mut proven = judged.filter(|(mark, _)| mark.verdict == Verdict::Proven);
        let Some((mark, error)) = proven.next() else {
            return Err(wrong(&view, place, &format!("is {bytes:?}, not {all:?}")));
        };
        worst = worst.max(error);
        samples += u64::from(mark.is_covered);
    }
    super::bench::enough(samples)?;
    Ok(format!(
        "{side}x{side}: {worst:.2} levels at most at {samples} pixels"
    ))
}

/// Counts the pixels of a face so many pixels wide and high whose corners lie `shift` pixels off pixel centres.
fn covered(
    bench: &mut Bench,
    [width, height]: [f64; 2],
    shift: f64,
    expected: u64,
) -> Result<String, Trouble> {
    let setting = Setting::with(|setting| {
        // A unit is a pixel; corners at halves of a side lie on centres in a picture of odd size, and the other way round.
        setting.cuboids = vec![Body {
            size: DVec3::new(width, height, 2.0),
            position: DVec3::new(0.5 * width + shift, 0.5 * height + shift, 0.0),
            ..Body::default()
        }];
        setting.eye = DVec3::Z * 10.0;
        setting.size = [21, 21];
        setting.height = 21.0;
    });
    let mut counts = [0_u64; 2];
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let way = Way {
            projection: Projection::Orthographic,
            mode,
            tolerance: 0.0,
        };
        let drawn = bench.picture(&setting, way)?;
        counts =
            [8, 9].map(|id| drawn.triangles.iter().filter(|other| **other == id).count() as u64);
        let others = drawn
            .triangles
            .iter()
            .filter(|id| ![8, 9, NO_TRIANGLE].contains(id));
        if counts[0] + counts[1] != expected || others.count() > 0 || shift > 0.0 && counts[0] != 15
        {
            return Err(Trouble::Wrong(format!("{counts:?} pixels of its halves")));
        }
    }
    Ok(format!("{} and {} pixels", counts[0], counts[1]))
}

/// Three cuboids, near enough that the picture is worth sharing among threads.
fn close_up() -> Setting {
    let turned = |x: f64| Body {
        rotation: DVec3::new(x, 20.0, 30.0),
        ..Body::default()
    };
    Setting::with(|setting| {
        setting.cuboids = vec![turned(10.0), turned(50.0), turned(100.0)];
        setting.fov = 12.0;
        setting.height = 2.0;
        setting.size = [400, 320];
    })
}

fn same_on_every_level(bench: &mut Bench) -> Result<String, Trouble> {
    let levels: Vec<Level> = simd::NAMES.into_iter().filter_map(simd::named).collect();
    let mut names = Vec::new();
    for level in levels {
        let mut other = Bench::alone(level);
        expect_same(bench, &mut other)?;
        names.push(simd::name(level));
    }
    Ok(format!("the same: {}", names.join(", ")))
}

fn same_on_any_threads(bench: &mut Bench) -> Result<String, Trouble> {
    for threads in [2, 3, 7] {
        expect_same(bench, &mut bench.another(threads)?)?;
    }
    Ok("the same".to_owned())
}

fn expect_same(bench: &mut Bench, other: &mut Bench) -> Result<(), Trouble> {
    let setting = close_up();
    let lone = setting.clone().and(|setting| setting.cuboids.truncate(1));
    for way in ways() {
        for setting in [&setting, &lone] {
            let (expected, drawn) = (bench.picture(setting, way)?, other.picture(setting, way)?);
            super::bench::enough(expected.seen())?;
            if let Some(pixel) = drawn.first_other(&expected) {
                return Err(Trouble::Wrong(format!("pixel {pixel} differs, {way:?}")));
            }
        }
    }
    Ok(())
}
