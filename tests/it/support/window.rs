//! The window's state without a display, and where its rows stand.

use fearless_simd::Level;
use shadetrade::canvas::{Point, Rect};
use shadetrade::components::Projection;
use shadetrade::drawing::Drawing;
use shadetrade::scene::Scene;
use shadetrade::window::bindings::Action;
use shadetrade::window::hud::board::Board;
use shadetrade::window::hud::lines::{Command, Line};
use shadetrade::window::hud::{Hud, Part};
use shadetrade::window::session::Session;

/// The size of the window in these tests, in pixels.
pub const SIZE: [usize; 2] = [960, 720];

/// The sizes of windows that are common, in pixels.
pub const COMMON: [[usize; 2]; 3] = [[640, 480], [960, 720], [1920, 1080]];

/// The window as it opens on `scene`.
pub fn session_of(scene: Scene) -> Session {
    Session::new(drawing(scene))
}

pub fn drawing(scene: Scene) -> Drawing {
    Drawing {
        scene,
        camera: 0,
        projection: Projection::Perspective,
        shading: None,
        tolerance: 0.5,
        size: SIZE,
        threads: 1,
        level: Level::new(),
    }
}

/// The window as it opens on the default scene.
pub fn default_session() -> Session {
    session_of(Scene::load(None).expect("the built-in scene is valid"))
}

pub fn hud(session: &Session, size: [usize; 2]) -> Hud {
    Hud::new(session, size)
}

/// The first board of this kind.
pub fn board(hud: &Hud, part: Part) -> &Board {
    hud.boards(part).next().expect("there is room")
}

pub fn commands(hud: &Hud, part: Part) -> Vec<(&Command, Rect)> {
    hud.boards(part)
        .flat_map(|board| &board.rows)
        .filter_map(|(line, rect)| match line {
            Line::Command(command) => Some((command, *rect)),
            _ => None,
        })
        .collect()
}

/// A place where a click does `action`, among the rows of `part`.
pub fn place_of(hud: &Hud, part: Part, action: Action) -> Option<Point> {
    let rows = commands(hud, part).into_iter();
    let mut points =
        rows.flat_map(|(_, row)| (row.x..row.right()).map(move |x| [x, row.y + row.height / 2]));
    points.find(|point| hud.action_at(*point) == Some(action))
}
