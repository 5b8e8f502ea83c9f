//! Gaps: what a pixel would show only where faces that touch left room is neither proven nor refuted.

use shadetrade::questions::metrics::pixel_error;
use shadetrade::questions::prove::Verdict::{Gap, Refuted};
use shadetrade::questions::prove::{Proof, Shown, judge, shown};
use shadetrade::reference::{Interval, Real, Reference, Seen};
use shadetrade::systems::frame::display_step;

use super::{enclosures, judged, proof};
use crate::support::prelude::*;

/// No face and no mixture of faces looks like it.
const BACKGROUND: DVec3 = DVec3::new(255.0, 0.0, 255.0);

/// A cuboid that reflects ambient light in this colour and no other light.
fn spawn(world: &mut World, size: impl Into<DVec3>, transform: Transform, color: DVec3) {
    let mut material = white(1.0);
    (material.ambient, material.diffuse, material.specular) = (color, DVec3::ZERO, DVec3::ZERO);
    spawn_cuboid(world, size.into(), transform, material);
}

/// An empty world under ambient light.
fn lit() -> World {
    let mut world = empty();
    shine(&mut world, LightKind::Ambient, 100.0, DVec3::ZERO);
    world
}

/// Looks straight down at the plane z = 1/2 of a wall, rolled by this angle; a unit is `height` / `size[1]` pixels.
fn rolled(size: [usize; 2], centre: DVec3, degrees: f64, height: f64) -> View {
    let eye = centre + 10.0 * DVec3::Z;
    let mut view = view(size, eye, centre, Projection::Orthographic);
    let (sin, cos) = degrees.to_radians().sin_cos();
    view.camera.up = DVec3::new(sin, cos, 0.0);
    view.camera.height = height;
    view.background = BACKGROUND;
    view
}

/// The picture that the renderer draws, with the background at these pixels, and its proof.
fn holed(world: &mut World, view: &View, pixels: &[usize]) -> Proof {
    let mut picture = draw(world, view, Keep::Display).pixels().to_vec();
    for pixel in pixels {
        picture[*pixel] = color(view.background.to_array());
    }
    judged(world, view, &picture)
}

/// Levels as a pixel of a picture.
fn color(levels: [f64; 3]) -> u32 {
    let [red, green, blue] = levels.map(display_step);
    u32::from_be_bytes([0, red, green, blue])
}

#[track_caller]
fn assert_counts(proof: &Proof, gaps: u64, what: &str) {
    let found = [proof.gaps, proof.refuted, proof.undecided];
    assert_eq!(found, [gaps, 0, 0], "{what}: {:?}", proof.examples);
}

/// The scene of docs/limits.md.
#[test]
fn a_hole_where_a_corner_meets_an_edge_is_a_gap() {
    let mut blocks = include_str!("../../../docs/limits.md").split("```");
    let text = blocks.find_map(|block| block.strip_prefix("toml"));
    let mut scene = Scene::parse("limits", text.expect("a scene")).expect("it is right");
    let view = View::of(&scene.world, [320, 240]);
    let proof = proof(&mut scene.world, &view);
    assert_counts(&proof, 1, "the corner");
    let example = &proof.examples[0];
    assert_eq!((example.pixel, example.verdict), ([168, 117], Gap));
    // It is compared with a face that it may show.
    assert_eq!((example.face.is_some(), example.drawn_face), (true, None));
    assert!(example.error[0] > 100.0, "{example:?}");
}

/// One box exactly on another: the joint y = 0 is closed, in exact pictures and in the renderer's.
#[test]
fn holes_in_a_closed_joint_of_two_cuboids_are_gaps() {
    let mut world = lit();
    spawn(&mut world, [40.0, 10.0, 1.0], at(DVec3::Y * -5.0), DVec3::X);
    spawn(&mut world, [40.0, 10.0, 1.0], at(DVec3::Y * 5.0), DVec3::Y);
    let mut view = rolled([320, 240], DVec3::new(0.0131, 0.0073, 0.0), 0.0, 7.0);
    view.camera.up = DVec3::new(0.3090, 0.9511, 0.0);
    assert_counts(&proof(&mut world, &view), 0, "the renderer's");
    let holes = [[208, 104], [168, 117], [128, 130], [88, 143], [11, 168]];
    let proof = holed(&mut world, &view, &holes.map(|[x, y]| 320 * y + x));
    assert_counts(&proof, 5, "with holes");
    let mut found: Vec<_> = proof.examples.iter().map(|it| it.pixel).collect();
    found.sort_unstable_by_key(|[x, _]| 320 - x);
    assert_eq!(found, holes);
    // A pixel of a wrong colour there is no gap, and no face is so dark.
    let dark = View {
        background: DVec3::ZERO,
        ..view
    };
    let mut picture = draw(&mut world, &view, Keep::Display).pixels().to_vec();
    picture[320 * 117 + 168] = 0x40_4040;
    let proof = judged(&mut world, &dark, &picture);
    assert_eq!((proof.gaps, proof.examples[0].verdict), (0, Refuted));
}

/// Whether a pixel and its neighbours show cuboids.
fn is_inner(triangles: &[TriangleId], width: usize, pixel: usize) -> bool {
    let (x, y) = (pixel % width, pixel / width);
    let is_inside = x > 0 && y > 0 && x + 1 < width && (y + 1) * width < triangles.len();
    is_inside
        && (y - 1..=y + 1)
            .all(|y| (x - 1..=x + 1).all(|x| triangles[y * width + x] != TriangleId::NONE))
}

/// The pixels near edges that show cuboids all around.
fn inner_edges(world: &mut World, view: &View, proof: &Proof) -> Vec<usize> {
    let triangles = truth(world, view).triangles;
    let mut pixels = outline(proof);
    pixels.retain(|pixel| is_inner(&triangles, view.size[0], *pixel));
    pixels
}

/// The pixels near edges.
fn outline(proof: &Proof) -> Vec<usize> {
    let pixels = 0..proof.marks.len();
    pixels.filter(|it| proof.marks[*it].is_outline).collect()
}

#[test]
fn holes_along_the_inner_edges_of_one_cuboid_are_gaps() {
    let mut found = 0;
    let mut scene = built_in();
    for projection in Projection::ALL {
        let view = View {
            projection,
            background: BACKGROUND,
            ..View::of(&scene.world, [401, 301]).shaded(ShadingMode::Phong)
        };
        let own = proof(&mut scene.world, &view);
        let holes = inner_edges(&mut scene.world, &view, &own);
        let proof = holed(&mut scene.world, &view, &holes);
        assert_counts(&proof, holes.len() as u64, "inner edges");
        found += holes.len();
    }
    assert!(found > 3, "{found} holes");
}

/// A box that is cut into boxes by planes across its axes.
fn cut_box(random: &mut Random) -> World {
    let rotation = random.around(180.0);
    let axes = placed(DVec3::ZERO, rotation).axes();
    let cuts = [(); 3].map(|()| {
        let mut places = vec![-1.0, 1.0];
        places.extend((0..random.below(3)).map(|_| random.within(-0.9, 0.9)));
        places.sort_unstable_by(f64::total_cmp);
        places
    });
    let mut world = lit();
    for x in cuts[0].windows(2) {
        for y in cuts[1].windows(2) {
            for z in cuts[2].windows(2) {
                let [low, high] = [0, 1].map(|end| DVec3::new(x[end], y[end], z[end]));
                let transform = placed(axes * ((low + high) / 2.0), rotation);
                let color = DVec3::ZERO.map(|_| random.within(0.2, 2.0));
                spawn(&mut world, high - low, transform, color);
            }
        }
    }
    world
}

/// The boxes touch corner to corner. What they hide in their joints is drawn at every pixel that it might reach.
#[test]
fn joints_of_random_boxes_are_closed() {
    let random = &mut Random(21);
    let (mut painted, mut outline, mut gaps) = (0, 0, 0);
    for case in 0..cases(25) {
        let mut world = cut_box(random);
        let projection = random.one_of(&Projection::ALL);
        let eye = random.direction() * random.between(2.0, 30.0);
        let mut view = view([97, 73], eye, random.around(0.3), projection);
        view.camera.up = random.direction();
        view.camera.fov = (1.5 / eye.length()).atan().to_degrees() * random.between(0.5, 2.0);
        view.camera.height = random.between(1.0, 4.0);
        // In some cases the near plane opens the boxes.
        view.camera.near = Some(random.one_of(&[1e-3, 1e-3, 0.9]) * eye.length());
        view.background = BACKGROUND;
        let own = proof(&mut world, &view);
        assert_counts(&own, own.gaps, &format!("case {case}"));
        gaps += own.gaps;
        outline += own.outline;
        let mut picture = draw(&mut world, &view, Keep::Display).pixels().to_vec();
        let mut holes = 0;
        for (pixel, seen) in picture.iter_mut().zip(enclosures(&world, &view)) {
            let levels = |seen: &Seen<Interval>| seen.levels.map(|level| level.endpoints()[0]);
            let visible: Vec<_> = seen.iter().filter(|it| !it.is_hidden).map(levels).collect();
            // Faces of one cuboid have one colour.
            let is_new = |it: &[f64; 3]| visible.iter().all(|other| pixel_error(*it, *other) > 2.0);
            let mut hidden = seen.iter().filter(|it| it.is_hidden).map(levels);
            if let Some(levels) = hidden.find(is_new) {
                *pixel = color(levels);
                holes += 1;
            }
        }
        let judged = judged(&mut world, &view, &picture);
        assert_counts(&judged, holes, &format!("case {case} with holes"));
        painted += holes;
    }
    assert!(painted > 50 && outline > 100, "{painted}, {outline}");
    // `docs/limits.md` has their number in a hundred pictures, and the cause: snapped edges.
    assert!(gaps <= cases(25) as u64 / 10, "{gaps} gaps");
}

/// Two boxes side by side, seen rolled, one farther away. All pixels near their common edge show the background.
fn beside(room: f64, farther: f64) -> (Proof, u64) {
    let [width, height] = [641, 41];
    let mut world = lit();
    let upwards = room * 0.8 / height as f64;
    spawn(&mut world, [40.0, 10.0, 1.0], at(DVec3::Y * -5.0), DVec3::X);
    let place = DVec3::new(0.0, 5.0 + upwards, -farther);
    spawn(&mut world, [40.0, 10.0, 1.0], at(place), DVec3::Y);
    let view = rolled([width, height], DVec3::new(0.0131, 0.0073, 0.0), 2.9, 0.8);
    let own = proof(&mut world, &view);
    let holes = outline(&own);
    (holed(&mut world, &view, &holes), holes.len() as u64)
}

#[test]
fn a_slit_that_a_picture_can_show_is_no_joint() {
    for (room, farther, is_closed) in [
        (0.0, 0.0, true),
        (1e-6, 0.0, true),
        (1e-3, 0.0, false),
        (4e-3, 0.0, false),
        (0.1, 0.0, false),
        (0.0, 3.0, true),
        (4e-3, 3.0, false),
    ] {
        let (proof, holes) = beside(room, farther);
        assert!(holes >= 4, "{holes} pixels are near the edges");
        let gaps = if is_closed { holes } else { 0 };
        let what = format!("{room} pixels apart, {farther} units behind");
        assert_counts(&proof, gaps, &what);
    }
}

/// A box before the middle of a larger one: near its outline a pixel may show either, but not the background.
#[test]
fn along_an_outline_the_box_behind_may_be_seen() {
    let mut world = lit();
    spawn(&mut world, [4.0, 3.0, 1.0], at(DVec3::Z * 3.0), DVec3::X);
    spawn(&mut world, [20.0, 20.0, 1.0], at(DVec3::ZERO), DVec3::Y);
    let view = rolled([321, 241], DVec3::new(0.0131, 0.0073, 0.0), 18.0, 5.0);
    let outline = outline(&proof(&mut world, &view));
    assert!(outline.len() > 5, "{}", outline.len());
    let mut picture = draw(&mut world, &view, Keep::Display).pixels().to_vec();
    for color in [0x64_0000, 0x00_6400] {
        for pixel in &outline {
            picture[*pixel] = color;
        }
        assert_counts(&judged(&mut world, &view, &picture), 0, "either box");
    }
    let proof = holed(&mut world, &view, &outline);
    let inside = (321 * 241 - outline.len()) as u64;
    assert_eq!(proof.proven, inside, "the background");
}

/// 14 courses of ten bricks in running bond. Each corner of a brick lies on the middle of another's edge.
fn brick_wall() -> World {
    let mut world = lit();
    for (course, brick) in (0..14).flat_map(|course| (0..10).map(move |brick| (course, brick))) {
        let x = f64::from(2 * brick + course % 2 - 10);
        let color = DVec3::new(0.5, 0.2, 0.1) * f64::from(1 + (course + brick) % 5);
        let place = at(DVec3::new(x, f64::from(course - 7), 0.0));
        spawn(&mut world, [2.0, 1.0, 1.0], place, color);
    }
    world
}

/// docs/limits.md gives their number.
#[test]
fn the_dots_in_a_wall_of_bricks_are_gaps() {
    let mut world = brick_wall();
    let view = rolled([960, 720], DVec3::new(0.0131, 0.0073, 0.0), 11.0, 12.0);
    let drawn = draw(&mut world, &view, Keep::Levels);
    let exact = truth(&world, &view);
    let enclosures = Reference::<Interval>::new(&world, &view);
    let is_dot = |it: &usize| {
        drawn.triangles()[*it] == TriangleId::NONE && exact.triangles[*it] != TriangleId::NONE
    };
    let dots: Vec<usize> = (0..960 * 720).filter(is_dot).collect();
    assert_eq!(dots.len(), 4, "{dots:?}");
    for dot in dots {
        let (face, levels) = shown(&drawn, dot);
        let shown = Shown {
            face,
            levels,
            ..Shown::default()
        };
        let (mark, _) = judge(shown, &enclosures.at([dot % 960, dot / 960]), 0.05);
        assert_eq!(mark.verdict, Gap);
    }
}
