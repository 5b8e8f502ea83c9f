//! The changes that keys, buttons and the mouse make in the World.
//!
//! A function returns the message for the status line, if there is one: mostly the limit that was reached.

use std::time::Duration;

use hecs::World;

use super::facts::Facts;
use super::keys::TOLERANCES;
use super::pictures::{side_method, sides};
use crate::components::numbers::range_of;
use crate::components::{
    Camera, Light, NormalMode, Orbit, Projection, Segments, ShadingMode, Side, View, ViewMode,
    Viewer, active_camera, common, get, names, ordered, overwrite, viewer, viewer_mut,
};
use crate::output::words::{counted, rounded};
use crate::questions::job::camera_name;
use crate::scene::unseen::shows_all;
use crate::shading::Method;

/// The factor of a budget from one press of a key to the next.
const BUDGET_STEP: f64 = 1.25;
/// The budget where no time is known, in milliseconds.
const FIRST_BUDGET: f64 = 1.0;
/// The time in which a rotating cuboid turns by one degree, as in the assignment's program.
const DEGREE: Duration = Duration::from_millis(30);

/// Switches the light of this place in the file, counted from 0.
pub fn switch_light(world: &World, index: usize) -> Option<String> {
    let lights = ordered::<Light>(world);
    let light = lights.get(index).map(|it| world.get::<&mut Light>(*it));
    match light {
        Some(Ok(mut light)) => {
            light.on ^= true;
            None
        }
        _ => Some(format!("there is no light {}", index + 1)),
    }
}

/// Switches the light of this name.
pub fn switch_light_named(world: &World, name: &str) -> Option<String> {
    let names = names::<Light>(world);
    match names.iter().position(|own| own == name) {
        Some(index) => switch_light(world, index),
        None => Some(format!("no light is named {name}")),
    }
}

/// Whether the picture is on screen, and no wipe of two others.
pub fn shows_picture(viewer: &Viewer) -> bool {
    viewer.show != ViewMode::Wipe || viewer.sides.contains(&Side::Picture)
}

/// Shades every cuboid in this mode, whatever time that takes, and shows the picture in place of a wipe of others.
pub fn shade(world: &mut World, mode: ShadingMode) {
    let mut viewer = viewer_mut(world);
    viewer.budget = None;
    if !shows_picture(&viewer) {
        viewer.show = ViewMode::Picture;
    }
    drop(viewer);
    overwrite(world, &mode);
}

/// Whether every cuboid has face normals.
pub fn has_face_normals(world: &World) -> bool {
    common(world) == Some(NormalMode::Face)
}

/// Gives every cuboid face normals, or corner normals if all have face normals.
pub fn switch_normals(world: &mut World) {
    let normals = if has_face_normals(world) {
        NormalMode::Corner
    } else {
        NormalMode::Face
    };
    overwrite(world, &normals);
}

/// Doubles the number of segments of every cuboid, or halves it if `steps` is negative.
pub fn step_segments(world: &mut World, steps: i32) -> Option<String> {
    let present = common::<Segments>(world).unwrap_or_default().count() as f64;
    let most = f64::from(*Segments::RANGE.end());
    let count = (present * f64::from(steps).exp2()).clamp(1.0, most);
    let next = Segments::new(count as u32).unwrap_or_default();
    if common(world) == Some(next) {
        return Some(format!("{} is the limit", counted(next.count(), "segment")));
    }
    overwrite(world, &next);
    None
}

/// Shades every cuboid by a method. One that the reference draws is no shading mode of scenes: a wipe compares it.
pub fn choose_method(world: &mut World, method: Method) {
    if !method.mode.is_drawn() {
        return wipe(world, [Side::from(method), Side::Picture]);
    }
    shade(world, method.mode);
    if method.mode != ShadingMode::Flat {
        set_tolerance(world, method.tolerance);
    }
    if let Some(segments) = method.segments {
        overwrite(world, &segments);
    }
}

/// From this tolerance on, in levels, squares are plain to see.
const PLAIN: f64 = 64.0;

/// Goes to the next of [`TOLERANCES`], coarser if `steps` is positive; with a budget, to a shorter time.
pub fn step_tolerance(world: &mut World, steps: i32) -> Option<String> {
    let Viewer {
        tolerance: present,
        budget,
        ..
    } = *viewer(world);
    if let Some(budget) = budget {
        set_budget(world, Some(budget * BUDGET_STEP.powi(-steps)));
        return None;
    }
    let mut tolerances = TOLERANCES.into_iter();
    let next = if steps > 0 {
        tolerances.find(|next| *next > present)
    } else {
        tolerances.rfind(|next| *next < present)
    };
    let limit = if steps > 0 {
        "255 levels are the coarsest tolerance"
    } else {
        "the tolerance is 0 already"
    };
    let Some(next) = next else {
        return Some(limit.to_owned());
    };
    set_tolerance(world, next);
    (next >= PLAIN).then(|| "look around the highlight: squares show".to_owned())
}

/// Draws within this many levels. The sides of a wipe that had the tolerance before follow.
pub fn set_tolerance(world: &mut World, levels: f64) {
    let mut viewer = viewer_mut(world);
    let before = viewer.tolerance;
    for side in viewer.sides.iter_mut() {
        if let Side::Method {
            mode, tolerance, ..
        } = side
            && *tolerance == before
            && matches!(mode, ShadingMode::Gouraud | ShadingMode::Phong)
        {
            *tolerance = levels;
        }
    }
    (viewer.tolerance, viewer.budget) = (levels, None);
}

/// The method on screen; `None` where the cuboids have different modes.
pub fn shown_method(world: &World, facts: &Facts) -> Option<Method> {
    let own = || Some(Method::of(common(world)?, viewer(world).tolerance));
    facts.held.or_else(own)
}

/// Holds this time, in milliseconds, or the usual tolerance.
pub fn set_budget(world: &mut World, budget: Option<f64>) {
    set_tolerance(world, Viewer::TOLERANCE);
    let (least, most) = range_of("budget").into_inner();
    let legal = |budget: f64| rounded(budget.clamp(least, most), 1);
    let mut viewer = viewer_mut(world);
    viewer.budget = budget.map(legal);
    // A wipe between two other methods would not show the one that keeps the budget.
    if budget.is_some() && viewer.show == ViewMode::Wipe && !viewer.sides.contains(&Side::Picture) {
        viewer.show = ViewMode::Picture;
    }
}

/// Holds the time that the method on screen takes, with a little room, or the error again.
pub fn switch_budget(world: &mut World, facts: &Facts) {
    let time = facts.measured_time(shown_method(world, facts));
    let next = time.map_or(FIRST_BUDGET, |time| 1.1 * time);
    let has_budget = viewer(world).budget.is_some();
    set_budget(world, (!has_budget).then_some(next));
}

/// Shows the picture in another way; a wipe is one between Gouraud and Phong. The error map of a wipe is that of its left side,
/// which is the picture then.
pub fn show(world: &mut World, mode: ViewMode) {
    let mut viewer = viewer_mut(world);
    let [left, _] = sides(&viewer);
    viewer.show = mode;
    if mode == ViewMode::Wipe {
        // Neither side is drawn within a budget.
        (viewer.sides, viewer.budget) = (Side::gouraud_phong(viewer.tolerance), None);
    }
    drop(viewer);
    if mode == ViewMode::Error
        && let Some(method) = side_method(&left, None).filter(|it| it.mode.is_drawn())
    {
        choose_method(world, method);
    }
}

/// Shows a wipe between these sides.
pub fn wipe(world: &mut World, sides: [Side; 2]) {
    let mut viewer = viewer_mut(world);
    (viewer.show, viewer.sides) = (ViewMode::Wipe, sides);
}

pub fn next_projection(world: &mut World) {
    let mut viewer = viewer_mut(world);
    viewer.projection = match viewer.projection {
        Projection::Perspective => Projection::Orthographic,
        Projection::Orthographic => Projection::Perspective,
    };
}

pub fn next_camera(world: &mut World) -> Option<String> {
    let cameras = names::<Camera>(world);
    if cameras.len() == 1 {
        return Some("there is one camera".to_owned());
    }
    let active = camera_name(world);
    let place = cameras.iter().position(|camera| *camera == active);
    let next = (place.unwrap_or_default() + 1) % cameras.len();
    viewer_mut(world).camera = Some(cameras[next].clone());
    None
}

/// Moves the camera about its target, by degrees to the right and up.
pub fn orbit(world: &mut World, azimuth: f64, elevation: f64) {
    let own = Camera::own(world, active_camera(world));
    change_orbit(world, |orbit| orbit.moved(&own, azimuth, elevation));
}

/// Moves the camera by steps towards its target; away from it if negative. Returns whether it moved.
pub fn zoom(world: &mut World, steps: i32) -> bool {
    let limits = Orbit::limits(world);
    change_orbit(world, |orbit| orbit.zoomed(steps, &limits))
}

/// Undoes orbit, zoom and rotation. Steps back until a picture of `size` pixels shows all cuboids.
pub fn show_all(world: &mut World, size: [usize; 2]) {
    viewer_mut(world).turned = 0;
    change_orbit(world, |_| Orbit::default());
    step_back(world, size);
}

/// Moves the camera away until a picture of `size` pixels shows all cuboids.
pub fn step_back(world: &mut World, size: [usize; 2]) {
    while !shows_all(world, &View::of(world, size)) && zoom(world, -1) {}
}

/// Changes the orbit of the active camera. Returns whether it is another one.
fn change_orbit(world: &mut World, change: impl FnOnce(Orbit) -> Orbit) -> bool {
    let camera = active_camera(world);
    let orbit: Orbit = get(world, camera).unwrap_or_default();
    let changed = change(orbit);
    // The camera is in the World.
    let _ = world.insert_one(camera, changed);
    changed != orbit
}

/// The rotation of the cuboids.
#[derive(Default)]
pub struct Rotation {
    next_degree: Duration,
}

impl Rotation {
    /// Starts and stops it.
    pub fn switch(&mut self, world: &mut World, now: Duration) {
        self.next_degree = now + DEGREE;
        viewer_mut(world).turns ^= true;
    }

    /// Turns the cuboids by the degrees that are due.
    pub fn go_on(&mut self, world: &mut World, now: Duration) {
        let mut viewer = viewer_mut(world);
        if viewer.turns && now >= self.next_degree {
            let late = now.saturating_sub(self.next_degree);
            let degrees = 1 + (late.as_millis() / DEGREE.as_millis()) as u32;
            self.next_degree += DEGREE * degrees;
            viewer.turned = (viewer.turned + degrees) % 360;
        }
    }

    /// The time until the next degree is due; `None` while nothing turns.
    pub fn wait(&self, world: &World, now: Duration) -> Option<Duration> {
        let turns = viewer(world).turns;
        turns.then(|| self.next_degree.saturating_sub(now))
    }
}
