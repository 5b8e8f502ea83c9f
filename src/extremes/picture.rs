//! Pictures of the least and the largest size, faces whose corners lie on pixels, and who draws them.

use std::hint::black_box;

use anyhow::{Result, bail, ensure};
use fearless_simd::Level;
use glam::DVec3;

use super::judge::{KnownPixel, expect_covered, known_pixels, proven};
use super::renderer::{Renderer, wrong_pixel};
use super::scene_spec::{RenderConfig, SceneSpec, cuboid, default_cuboid, lights_at, scene};
use super::{Case, case};
use crate::components::{Projection, ShadingMode};
use crate::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use crate::prove::nearest;
use crate::reference::{Interval, Reference};
use crate::scene::{CuboidRecord, EMERALD};
use crate::simd;
use crate::systems;

/// The cases.
pub fn cases() -> Vec<Case> {
    let one_pixel = || {
        let lights = lights_at([0.0, 0.0, 5.0]);
        scene().size([1, 1]).eye(DVec3::Z * 10.0).lights(lights)
    };
    let phong = RenderConfig::all().filter(|config| config.mode == ShadingMode::Phong);
    vec![
        // The ray through the middle meets the face z = 1 at its middle: n = l = r = o = (0, 0, 1).
        known_pixels(
            "a picture of 1x1",
            phong.map(|config| {
                let levels = 30.0 + 170.0 * EMERALD.diffuse + 255.0 * EMERALD.specular;
                KnownPixel {
                    scene: one_pixel(),
                    config,
                    pixel: [0, 0],
                    levels: levels.to_array(),
                }
            }),
        ),
        proven("a picture of 1x16384", [scene().size([1, 16_384])]),
        // The cuboid fills a good part of the row.
        proven(
            "a picture of 16384x1",
            [scene().size([16_384, 1]).fov(1e-2).height(2e-3)],
        ),
        case(
            "a picture of 16384x16384",
            "sampled bytes proven within half a level and their rounding",
            largest,
        ),
        case(
            "corners on pixel centres: the top and the left are covered",
            "12 pixels of a face 4 wide and 3 high",
            |renderer| count_halves(renderer, [4.0, 3.0], 0.0, [3, 9]),
        ),
        case(
            "corners on pixel corners",
            "25 pixels of a face of 5 x 5, 15 of them right of the diagonal",
            |renderer| count_halves(renderer, [5.0, 5.0], 0.5, [15, 10]),
        ),
        case(
            "every SIMD level of this machine",
            "the same bits",
            |renderer| {
                let levels: Vec<Level> = simd::NAMES.into_iter().filter_map(simd::named).collect();
                for &level in &levels {
                    expect_same(renderer, level, 1)?;
                }
                let names: Vec<_> = levels.into_iter().map(simd::name).collect();
                Ok(format!("the same: {}", names.join(", ")))
            },
        ),
        case("2, 3 and 7 threads", "the same bits", |renderer| {
            let level = renderer.workers().level();
            for threads in [2, 3, 7] {
                expect_same(renderer, level, threads)?;
            }
            Ok("the same".to_owned())
        }),
        case(
            "the state of the processor's floating point after all that",
            "rounds to nearest and keeps subnormal numbers",
            |_| {
                let least = black_box(f32::from_bits(1));
                let halves = [
                    black_box(1.0_f32) + f32::EPSILON / 2.0,
                    black_box(-1.0_f32) - f32::EPSILON / 2.0,
                ];
                let keeps_subnormal = least * black_box(2.0) == f32::from_bits(2);
                ensure!(keeps_subnormal && halves == [1.0, -1.0], "does not");
                Ok("does".to_owned())
            },
        ),
    ]
}

/// Draws the largest picture and proves the bytes of one pixel in a hundred thousand.
fn largest(renderer: &mut Renderer) -> Result<String> {
    let side = if renderer.full { 16_384 } else { 1024 };
    let spec = scene().size([side, side]);
    let mut scene = spec.parse()?;
    let view = spec.view(&scene, RenderConfig::phong(Projection::Perspective, 0.5));
    // A frame of its own, whose memory is given back at the end.
    let workers = renderer.workers();
    let workers = Workers::new(workers.threads(), workers.level())?;
    let mut large = Frame::new(Keep::Display, workers);
    if let Err(full) = systems::draw(&mut scene.world, &view, &mut large) {
        return Ok(format!("said of itself: {full}"));
    }
    let reference = Reference::<Interval>::new(&scene.world, &view);
    let (mut worst, mut covered) = (0.0_f64, 0);
    for step in 0..2_000 {
        // Multiples of the golden ratio and its square spread evenly (Roberts 2018).
        let place @ [x, y] = [0.754_877_666, 0.569_840_291]
            .map(|share: f64| (share * f64::from(step)).fract() * side as f64)
            .map(|coordinate| coordinate as usize);
        let pixel = y * side + x;
        let [_, bytes @ ..] = large.pixels()[pixel].to_be_bytes();
        // Only the bytes are known, not the face: it is one that may be seen.
        let all = reference.at(place);
        let mut errors = all.iter().filter_map(|seen| {
            let [_, most] = nearest(seen.face(), bytes.map(f64::from), &all)?;
            Some((seen.face(), most))
        });
        let Some((face, error)) = errors.find(|(_, error)| *error <= view.tolerance + 0.5) else {
            let what = format!("is {bytes:?}, not {all:?}");
            return Err(wrong_pixel(&view, pixel, &what));
        };
        worst = worst.max(error);
        covered += u64::from(face.is_some());
    }
    expect_covered(covered)?;
    Ok(format!(
        "{side}x{side}: {worst:.2} levels at most at {covered} pixels"
    ))
}

/// Counts the pixels of both halves of a face so many pixels wide and high whose corners lie `shift` pixels off pixel
/// centres.
fn count_halves(
    renderer: &mut Renderer,
    [width, height]: [f64; 2],
    shift: f64,
    expected: [usize; 2],
) -> Result<String> {
    // A unit is a pixel; corners at halves of a side lie on centres in a picture of odd size, and the other way round.
    let place = [0.5 * width + shift, 0.5 * height + shift, 0.0];
    let scene = scene()
        .cuboid(cuboid([width, height, 2.0], place))
        .eye(DVec3::Z * 10.0)
        .size([21, 21])
        .height(21.0);
    let is_flat = |config: &RenderConfig| config.projection == Projection::Orthographic;
    for config in RenderConfig::all().filter(is_flat) {
        let picture = renderer.picture(&scene, config)?;
        let count = |id: u32| {
            let triangles = picture.triangles.iter();
            triangles.filter(|other| **other == id).count()
        };
        let counts = [8, 9].map(count);
        if counts != expected || counts[0] + counts[1] + count(NO_TRIANGLE) != 21 * 21 {
            bail!("{counts:?} pixels of its halves");
        }
    }
    Ok(format!("{} and {} pixels", expected[0], expected[1]))
}

/// Compares with what another renderer draws of one and of three cuboids, near enough that the picture is worth sharing
/// among threads.
fn expect_same(renderer: &mut Renderer, level: Level, threads: usize) -> Result<()> {
    let mut other = Renderer::new(level, threads, false)?;
    let cuboids = [10.0, 50.0, 100.0].map(|x| default_cuboid().rotation([x, 20.0, 30.0]));
    let close_up = |cuboids: &[CuboidRecord]| -> SceneSpec {
        let scene = scene().cuboids(cuboids.to_vec()).size([400, 320]);
        scene.fov(12.0).height(2.0)
    };
    for config in RenderConfig::all() {
        for scene in [close_up(&cuboids), close_up(&cuboids[..1])] {
            let expected = renderer.picture(&scene, config)?;
            expect_covered(expected.covered())?;
            other.picture(&scene, config)?.expect_bits_of(&expected)?;
        }
    }
    Ok(())
}
