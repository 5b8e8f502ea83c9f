//! Where the eye is, what it looks at and how wide: the near plane, the cuboid's own surface, lenses and rotations.

use glam::DVec3;

use super::judge::{Fact, difference, known, proven, same_bits, same_picture};
use super::renderer::Renderer;
use super::scene_spec::{
    RenderConfig, SceneSpec, around, cuboid, default_cuboid, lights_at, scene,
};
use super::{Case, case};
use crate::components::{Mesh, Projection, Transform};
use crate::scene::{Scene, SceneRecord};

/// The cases.
pub fn cases() -> Vec<Case> {
    let groups = [near_plane(), eye(), lens()];
    groups.into_iter().flatten().collect()
}

fn near_plane() -> Vec<Case> {
    // Beyond the sixth corner no more than a tip is left.
    let depths = &corner_depths()[..6];
    let between = depths
        .windows(2)
        .map(|ends| f64::midpoint(ends[0], ends[1]));
    vec![
        proven(
            "near plane through one, two or three corners of triangles",
            between.map(cut_at),
        ),
        proven(
            "near plane through each corner, and an ulp to either side",
            depths.iter().copied().flat_map(around).map(cut_at),
        ),
        same_bits(
            "near plane in a face's own plane",
            [1.0, 9.0_f64.next_down(), 9.0].map(|near| frontal().near(near)),
        ),
        known(
            "near plane an ulp beyond the only face in sight",
            "nothing is seen",
            Fact::Background(&Projection::ALL),
            [frontal().near(9.0_f64.next_up())],
        ),
        proven(
            "near plane a billionth of the distance",
            [1e-8, 1e-100].map(cut_at),
        ),
        proven(
            "near plane 1e-6 and 1e-10 away, a face's middle 1e5",
            [1e-3, 1e-7].map(far_from_the_middle),
        ),
    ]
}

fn eye() -> Vec<Case> {
    vec![
        known(
            "the assignment's own placement",
            "ambient light alone: 30 levels, from both cameras",
            Fact::Everywhere(30.0),
            [0, 1].map(assignment),
        ),
        nothing_around(
            "eye inside the cuboid",
            [[0.0, 0.0, 0.0], [0.1, 0.2, 0.3], [1.99, 1.49, -0.99]],
        ),
        nothing_around(
            "eye on a face, an edge, a corner",
            [[0.1, 0.2, 1.0], [2.0, 0.2, 1.0], [2.0, 1.5, 1.0]],
        ),
        proven(
            "orthographic eye on an edge or a corner",
            [[2.0, 1.5, 1.0], [2.0, 0.2, 1.0]].map(|eye| scene().eye(eye).near(1e-9)),
        ),
        proven(
            "eye 1e-3, 1e-6 and 1e-9 in front of a face",
            [1e-3, 1e-6, 1e-9].map(|gap| {
                let scene = scene().eye([0.1, 0.2, 1.0 + gap]).target([0.4, 0.3, 0.0]);
                scene.near(gap / 10.0).height(2.0)
            }),
        ),
        proven(
            "eye in the plane of a face, and an ulp to either side",
            around(2.0).map(|x| scene().eye([x, 3.0, 9.0])),
        ),
        proven(
            "eye 1e-4, 1e-7 and 1e-12 above a face, looking along it",
            [1e-4, 4e-8, 1e-12].map(|gap| {
                let eye = DVec3::new(-0.164, 1.5 + gap, 0.633);
                let scene = scene().fov(100.0).eye(eye).near(gap / 4.0);
                let scene = scene.target(eye + DVec3::new(-1.006, 0.0, 0.641));
                scene.up([0.01, 1.0, 0.02]).height(2.0).size([97, 81])
            }),
        ),
        proven(
            "the horizon of floors 1e5 to 1e12 long",
            [1e5, 1e6, 1e9, 1e12].into_iter().flat_map(level_above),
        ),
        proven(
            "lines of sight exactly through edges and in the planes of faces",
            [[2.0, 0.976, 9.0], [2.0, 1.5, 9.0], [9.0, 1.5, 1.0]].map(|eye| {
                let scene = scene().eye(eye).up([0.01, 1.0, 0.02]).size([97, 81]);
                scene.target(DVec3::from(eye).min(DVec3::new(2.0, 1.5, 1.0)))
            }),
        ),
        proven(
            "eye at the lights",
            [76.8, 1e6].map(|shininess| {
                let cuboid = default_cuboid().shininess(shininess);
                scene()
                    .cuboid(cuboid)
                    .lights(lights_at(scene().camera.position))
            }),
        ),
        proven(
            "a face whose depths are as 1 to a million",
            [0.0, 7.0].map(|rotation| {
                let floor = cuboid([20.0, 2.0, 2e6], [0.0; 3]).rotation(DVec3::Z * rotation);
                let scene = scene()
                    .cuboid(floor)
                    .lights(lights_at([3.0, 8.0, 999_990.0]));
                let scene = scene.eye([0.0, 2.0, 1e6 + 1.0]).near(1.0);
                scene.target([0.0, 1.0, 1e6 - 4.0])
            }),
        ),
    ]
}

fn lens() -> Vec<Case> {
    vec![
        proven(
            "field of view of 1e-3 and of 1e-9 degrees",
            [1e-3, 1e-9].map(|fov| scene().fov(fov)),
        ),
        proven(
            "a cuboid as large as the picture from 1e4 to 1e9 units away",
            [1e3, 1e5, 1e8].map(from_afar),
        ),
        case(
            "perspective from 1e4 times as far against orthographic",
            "within 1 level, the same faces off their edges",
            far_perspective,
        ),
        proven(
            "field of view of 179 degrees",
            [[1.0, 1.0, 2.0], [0.1, 0.1, 1.01]].map(|eye| scene().fov(179.0).eye(eye).near(1e-3)),
        ),
        proven("orthographic height of 1e-6", [scene().height(1e-6)]),
        proven(
            "orthographic height of 1e6",
            [
                scene().height(1e6),
                scene()
                    .height(1e6)
                    .cuboid(cuboid([4e5, 3e5, 2e5], [0.0; 3]))
                    .eye(scene().camera.position * 1e6),
            ],
        ),
        same_picture(
            "up almost parallel to the view",
            1.0,
            [None, Some(1.0), Some(1e-3), Some(1e-7)].map(|share| {
                let up = share.map(|share| scene().camera.position * -0.1 + DVec3::Y * share);
                scene().up(up.unwrap_or(DVec3::Y))
            }),
        ),
        same_picture(
            "up of any length from 1e-100 to 1e100",
            0.01,
            [1.0, 1e-100, 1e100].map(|length| scene().up(DVec3::Y * length)),
        ),
        // 1e9 = 2777777 turns and 280 degrees.
        same_bits(
            "rotation by 1e9 degrees",
            [
                [280.0, -280.0, 10.0],
                [1e9, -1e9, 1e9 + 90.0],
                [280.0 + 360.0 * 7.0, -280.0 - 360.0 * 9.0, 370.0],
            ]
            .map(rotated),
        ),
        // The double nearest to 1e100 is a whole number and leaves 64 when divided by 360, in integers of any length.
        same_bits(
            "rotation by 1e100 degrees",
            [64.0, 1e100].map(|x| rotated([x, 3.0, 4.0])),
        ),
    ]
}

/// The default cuboid, rotated.
fn rotated(degrees: [f64; 3]) -> SceneSpec {
    scene().cuboid(default_cuboid().rotation(degrees))
}

/// In degrees.
const ROTATION: [f64; 3] = [10.0, 20.0, 30.0];

/// The default cuboid, rotated so that its corners have eight depths, and cut at this one.
fn cut_at(depth: f64) -> SceneSpec {
    rotated(ROTATION).near(depth).size([192, 144])
}

/// The depths of that cuboid's corners, in order.
fn corner_depths() -> [f64; 8] {
    let camera = scene().camera;
    let eye = camera.position;
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: ROTATION.into(),
    };
    let forward = (camera.target - eye).normalize();
    let corners = Mesh::cuboid(default_cuboid().size).corners;
    let mut depths = corners.map(|corner| forward.dot(transform.axes() * corner - eye));
    depths.sort_by(f64::total_cmp);
    depths
}

/// The default cuboid from straight before its face z = 1, which is 9 away.
fn frontal() -> SceneSpec {
    scene().eye(DVec3::Z * 10.0)
}

/// A plate of a million units from so near, far from its middle and at a place in numbers that round; lit from as near.
fn far_from_the_middle(gap: f64) -> SceneSpec {
    let position = DVec3::new(-28_186.154, -42_731.562, 121_284.477);
    let eye = position + DVec3::new(1.1e5, 0.5 + gap, -1.3e5);
    let plate = cuboid([1e6, 1.0, 1e6], position);
    let scene = scene().cuboid(plate).fov(100.0).height(3.0 * gap).eye(eye);
    let scene = scene.target(eye + DVec3::new(0.8, -0.6, 0.5) * gap);
    scene
        .near(gap / 1e3)
        .lights(lights_at(eye + DVec3::new(0.3, 1.0, -0.2) * gap))
}

/// Floors of this length, 1 below an eye that looks along an axis and askew, level and almost; lit from above the middle.
fn level_above(length: f64) -> [SceneSpec; 3] {
    [[1.0, 0.0, 0.0], [0.2, 0.0, -1.0], [0.54, 1e-5, -0.84]].map(|ahead| {
        let floor = cuboid([length, 2.0, length], [0.0; 3]);
        let (eye, target) = (DVec3::Y * 2.0, DVec3::Y * 2.0 + DVec3::from(ahead));
        let scene = scene().cuboid(floor).lights(lights_at(DVec3::Y * length));
        scene.eye(eye).target(target).fov(60.0).size([65, 65])
    })
}

/// Nothing is seen in perspective from these places, along the axes and in two directions askew.
fn nothing_around(name: &'static str, places: [[f64; 3]; 3]) -> Case {
    let askew = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-3.0, 1.0, -2.0)];
    let straight = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let directions: Vec<DVec3> = straight.chain(askew).collect();
    let scenes = places.iter().flat_map(|place| {
        directions.iter().map(|direction| {
            let target = DVec3::from(*place) + *direction;
            // Parallel to none of the directions.
            let scene = scene().eye(*place).target(target).up([0.3, 1.0, 0.2]);
            scene.near(1e-6).fov(90.0)
        })
    });
    let fact = Fact::Background(&[Projection::Perspective]);
    known(name, "nothing is seen", fact, scenes)
}

/// The default scene from so many times as far, the field of view as much narrower.
fn from_afar(times: f64) -> SceneSpec {
    let scene = scene();
    let eye = scene.camera.position * times;
    let fov = 2.0
        * (scene.camera.height / 2.0 / eye.length())
            .atan()
            .to_degrees();
    scene.eye(eye).fov(fov)
}

/// Orthographic pictures from where the perspective ones are taken.
fn far_perspective(renderer: &mut Renderer) -> anyhow::Result<String> {
    let scene = from_afar(1e4);
    let mut worst = 0.0_f64;
    let is_plain = |config: &RenderConfig| config.projection == Projection::Orthographic;
    for config in RenderConfig::all().filter(is_plain) {
        let perspective = RenderConfig {
            projection: Projection::Perspective,
            ..config
        };
        let both = [(&scene, config), (&scene, perspective)];
        worst = worst.max(difference(renderer, both, 1.0)?);
    }
    Ok(format!("{worst:.2e} levels"))
}

/// The built-in scene from one of its cameras; its lights lie on the cuboid: n.l is negative wherever either camera looks.
fn assignment(camera: usize) -> SceneSpec {
    let scene = Scene::load(Some("assignment")).expect("it is built in");
    let record = SceneRecord::of(&scene.world);
    SceneSpec {
        camera: record.camera[camera].clone(),
        cuboids: record.cuboid,
        lights: record.light,
        size: [160, 120],
    }
}
