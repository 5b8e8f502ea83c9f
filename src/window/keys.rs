//! The keys: one table, from which key handling, the help and the captions of the panel are read.
//!
//! A new action is a variant of [`Action`], a row of [`BINDINGS`] and an arm of `App::run`.

use egui::{Key, Modifiers};

use super::inspector::Tab;
use crate::components::{ShadingMode, Side, ViewMode};

/// Everything that a key or a button can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Switches the light of this place in the file, counted from 0.
    Light(usize),
    /// Switches the light of this name.
    LightNamed(&'static str),
    /// Shades every cuboid in this mode.
    Shading(ShadingMode),
    /// Gives every cuboid face normals, or corner normals again.
    FaceNormals,
    /// Doubles the segments of every cuboid so often, or halves them if negative.
    Segments(i32),
    /// Goes to the next tolerance of [`TOLERANCES`]: a coarser one if positive.
    Tolerance(i32),
    /// Holds the time of a frame, or the error again.
    HoldTime,
    NextProjection,
    NextCamera,
    View(ViewMode),
    /// Shows the wipe between a method and exact Phong.
    WipeExact,
    /// Probes the worst pixel.
    Worst,
    /// Moves the probed pixel: columns to the right, rows down.
    Probe(i32, i32),
    /// Two pictures take turns while its key is held.
    Blink,
    /// Moves the camera about its target: degrees to the right and up.
    Orbit(f64, f64),
    /// Steps towards the target.
    Zoom(i32),
    /// Undoes orbit, zoom and rotation, and steps back until all cuboids are in sight.
    ShowAll,
    /// Starts and stops the rotation of the cuboids.
    Rotate,
    /// Opens and closes a heading of the panel.
    Tab(Tab),
    /// Opens the built-in scene of this name.
    Open(&'static str),
    /// Goes to a later step of the lesson.
    Step(isize),
    Undo,
    Redo,
    Save,
    SaveAs,
    /// Folds and unfolds the panel.
    Panel,
    Help,
    /// Writes the window into a PNG file.
    Screenshot,
    /// Writes the picture without the panels into a PNG file.
    SavePicture,
    /// Closes the uppermost thing that can be closed.
    Close,
    Quit,
}

/// The tolerances that keys step through, in levels of 255.
pub const TOLERANCES: [f64; 12] = [
    0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 255.0,
];
/// One press of an arrow moves the camera so far about its target, in degrees.
const ORBIT_STEP: f64 = 2.0;

/// The words on a button and in the help, a sentence, and the keys of this meaning.
pub type Binding = (&'static str, &'static str, &'static [Bound]);

/// A key with its modifiers, and its action.
pub type Bound = (Modifiers, Key, Action);

const NO: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const BOTH: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Every key, by the sections and in the order of the help.
#[rustfmt::skip]
pub const BINDINGS: &[(&str, &[Binding])] = &[
    ("Lights", &[
        ("white light", "Switches this light on and off.", &[(NO, Key::W, Action::LightNamed("white"))]),
        ("red light", "Switches this light on and off.", &[(NO, Key::R, Action::LightNamed("red"))]),
        ("specular light", "Switches this light on and off.", &[(NO, Key::S, Action::LightNamed("specular"))]),
        ("ambient light", "Switches this light on and off.", &[(NO, Key::A, Action::LightNamed("ambient"))]),
        ("first to ninth light", "", &[
            (NO, Key::Num1, Action::Light(0)), (NO, Key::Num2, Action::Light(1)), (NO, Key::Num3, Action::Light(2)),
            (NO, Key::Num4, Action::Light(3)), (NO, Key::Num5, Action::Light(4)), (NO, Key::Num6, Action::Light(5)),
            (NO, Key::Num7, Action::Light(6)), (NO, Key::Num8, Action::Light(7)), (NO, Key::Num9, Action::Light(8)),
        ]),
    ]),
    ("Shading", &[
        ("flat", "Light is computed once a face, at its middle: one colour for the whole face.", &[(NO, Key::F, Action::Shading(ShadingMode::Flat))]),
        ("Gouraud", "Light is computed at the vertices, and its colours are interpolated.", &[(NO, Key::G, Action::Shading(ShadingMode::Gouraud))]),
        ("Phong", "Normals are interpolated, and light is computed at every pixel.", &[(NO, Key::P, Action::Shading(ShadingMode::Phong))]),
        ("sharp edges", "Each face has its own normal: edges are sharp. Else the faces at a corner share one, and edges look smooth.", &[(NO, Key::X, Action::FaceNormals)]),
        ("more segments", "Twice as many segments along each edge of a face: Gouraud computes light at their corners, too.", &[(NO, Key::Period, Action::Segments(1))]),
        ("fewer segments", "Half as many segments along each edge of a face.", &[(NO, Key::Comma, Action::Segments(-1))]),
        ("finer tolerance", "The next finer tolerance, or more time.", &[(NO, Key::OpenBracket, Action::Tolerance(-1)), (NO, Key::PageDown, Action::Tolerance(-1))]),
        ("coarser tolerance", "The next coarser tolerance, or less time.", &[(NO, Key::CloseBracket, Action::Tolerance(1)), (NO, Key::PageUp, Action::Tolerance(1))]),
        ("hold the time", "Draws by the most exact method whose frames keep a budget of time, or holds the tolerance again.", &[(NO, Key::M, Action::HoldTime)]),
    ]),
    ("Camera", &[
        ("next camera", "The camera that is looked through.", &[(NO, Key::C, Action::NextCamera)]),
        ("projection", "In perspective rays leave the eye; in orthographic projection they are parallel.", &[(NO, Key::O, Action::NextProjection)]),
        ("orbit, or drag", "", &[
            (NO, Key::ArrowLeft, Action::Orbit(-ORBIT_STEP, 0.0)), (NO, Key::ArrowRight, Action::Orbit(ORBIT_STEP, 0.0)),
            (NO, Key::ArrowUp, Action::Orbit(0.0, ORBIT_STEP)), (NO, Key::ArrowDown, Action::Orbit(0.0, -ORBIT_STEP)),
        ]),
        ("zoom, or wheel", "", &[(NO, Key::Plus, Action::Zoom(1)), (NO, Key::Equals, Action::Zoom(1)), (NO, Key::Minus, Action::Zoom(-1))]),
        ("turn the cuboids", "The cuboids turn about their own x axes.", &[(NO, Key::Space, Action::Rotate)]),
        ("show all", "The camera and the cuboids go back to their places in the file, and the camera further away until every cuboid is in sight.", &[(NO, Key::Home, Action::ShowAll)]),
    ]),
    ("View", &[
        ("picture", "The picture as it is shaded.", &[(NO, Key::F2, Action::View(ViewMode::Picture))]),
        ("both", "Gouraud and Phong, left and right of a line that can be dragged.", &[(NO, Key::F3, Action::View(ViewMode::Wipe))]),
        ("picture | exact", "The picture, and exact Phong in f64, left and right of a divider.", &[(NO, Key::F4, Action::WipeExact)]),
        ("error map", "The error of each pixel against exact Phong; of a wipe that of its left side.", &[(NO, Key::F5, Action::View(ViewMode::Error))]),
        ("tiles", "The way in which each square was drawn.", &[(NO, Key::F6, Action::View(ViewMode::Tiles))]),
        ("terms", "The ambient, the diffuse and the specular term of the model, and their sum.", &[(NO, Key::F7, Action::View(ViewMode::Terms))]),
        ("blink (hold)", "While this is held, exact Phong and the picture take turns. In a wipe its two sides take turns.", &[(NO, Key::B, Action::Blink)]),
        ("why?", "Explains the worst pixel: the cause of its error, and every number.", &[(NO, Key::Y, Action::Worst)]),
        ("move the pixel", "", &[
            (SHIFT, Key::ArrowLeft, Action::Probe(-1, 0)), (SHIFT, Key::ArrowRight, Action::Probe(1, 0)),
            (SHIFT, Key::ArrowUp, Action::Probe(0, -1)), (SHIFT, Key::ArrowDown, Action::Probe(0, 1)),
        ]),
    ]),
    ("Scene", &[
        ("edit", "Shows every number of the scene, to be changed, and its file.", &[(NO, Key::E, Action::Tab(Tab::Scene))]),
        ("needed parts", "Shows the parts of the model that this picture requires.", &[(NO, Key::N, Action::Tab(Tab::Required))]),
        ("proof", "Shows the proof that the picture keeps its tolerance.", &[(NO, Key::K, Action::Tab(Tab::Proof))]),
        ("try a range", "Shows a number of the scene against the error.", &[(NO, Key::V, Action::Tab(Tab::Vary))]),
        ("lessons", "A few steps each, with a question.", &[(NO, Key::L, Action::Tab(Tab::Lessons))]),
        ("next step", "The next step of the lesson.", &[(NO, Key::Enter, Action::Step(1))]),
        ("back", "The step of the lesson before.", &[(NO, Key::Backspace, Action::Step(-1))]),
        ("undo", "Takes back the last change.", &[(CTRL, Key::Z, Action::Undo)]),
        ("redo", "Makes the change again that was last taken back.", &[(BOTH, Key::Z, Action::Redo), (CTRL, Key::Y, Action::Redo)]),
        ("save", "Writes the scene and the view to the scene's file.", &[(CTRL, Key::S, Action::Save)]),
        ("save as new", "Writes the scene and the view to a new file.", &[(BOTH, Key::S, Action::SaveAs)]),
    ]),
    ("Window", &[
        ("panel", "Folds and opens the panel; in a lesson, everything but the lesson.", &[(NO, Key::I, Action::Panel)]),
        ("help", "Shows all keys.", &[(NO, Key::H, Action::Help), (NO, Key::Questionmark, Action::Help), (NO, Key::F1, Action::Help)]),
        ("screenshot", "Writes the window into a PNG file.", &[(NO, Key::F12, Action::Screenshot)]),
        ("save picture", "Writes the picture, the error map with its scale, or the wipe with its names into a PNG file.", &[(SHIFT, Key::F12, Action::SavePicture)]),
        ("close", "Closes the uppermost thing that can be closed.", &[(NO, Key::Escape, Action::Close)]),
        ("quit", "Ends the program.", &[(NO, Key::Q, Action::Quit)]),
    ]),
];

/// The sides of the wipe between the picture and exact Phong.
pub const EXACT_SIDES: [Side; 2] = [Side::Picture, Side::Reference];

fn bindings() -> impl Iterator<Item = &'static Binding> {
    BINDINGS.iter().flat_map(|section| section.1)
}

/// All keys.
pub fn keys() -> impl Iterator<Item = &'static Bound> {
    bindings().flat_map(|binding| binding.2)
}

/// The action of a press. A key that needs no shift acts with shift too: some layouts have digits there.
pub fn action(key: Key, modifiers: Modifiers) -> Option<Action> {
    let find = |shift: bool| {
        keys().find(|(wanted, bound, _)| {
            *bound == key && wanted.command == modifiers.command && wanted.shift == shift
        })
    };
    let (.., action) = find(modifiers.shift).or_else(|| find(false))?;
    (!modifiers.alt).then_some(*action)
}

/// The row of an action.
pub fn binding(action: Action) -> Option<&'static Binding> {
    let is_bound = |(.., keys): &&Binding| keys.iter().any(|key| key.2 == action);
    bindings().find(is_bound)
}

/// The words for the first key of an action; empty where it has none.
pub fn caption(action: Action) -> String {
    let key = keys().find(|key| key.2 == action);
    key.map_or_else(String::new, caption_of)
}

/// The words for a key.
pub fn caption_of((modifiers, key, _): &Bound) -> String {
    let control = if modifiers.command { "Ctrl " } else { "" };
    let shift = if modifiers.shift { "Shift " } else { "" };
    format!("{control}{shift}{}", key.symbol_or_name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_actions() {
        let keys = || keys().map(|(modifiers, key, _)| (modifiers, key));
        for one in keys() {
            assert_eq!(keys().filter(|other| *other == one).count(), 1, "{one:?}");
        }
    }

    #[test]
    fn shift_chooses_another_action_only_where_there_is_one() {
        assert_eq!(action(Key::Num1, Modifiers::SHIFT), Some(Action::Light(0)));
        assert_eq!(action(Key::Z, BOTH), Some(Action::Redo));
        assert_eq!(action(Key::Z, Modifiers::NONE), None);
        assert_eq!(action(Key::W, Modifiers::COMMAND), None);
        assert_eq!(caption(Action::SaveAs), "Ctrl Shift S");
    }
}
