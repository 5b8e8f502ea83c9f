//! The keys: one table, from which key handling, the help and the captions of the panel are read.
//!
//! A new command is a variant of [`Command`], a row of [`BINDINGS`] and an arm of `App::run`.

use egui::{Key, Modifiers};

use crate::components::{ShadingMode, Side, Tab, ViewMode};

/// Everything that a key can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Switches the light of this place in the file, counted from 0.
    Light(usize),
    /// Switches the light of this name.
    LightNamed(&'static str),
    /// Shades every cuboid in this mode.
    Shading(ShadingMode),
    /// Goes to the next tolerance of [`TOLERANCES`]: a coarser one if positive.
    Tolerance(i32),
    /// Holds the time of a frame, or the error again.
    HoldTime,
    NextProjection,
    NextCamera,
    View(ViewMode),
    /// Shows the wipe between a method and exact Phong.
    WipeExact,
    /// Shows the wipe with the next choice on its left (0) or right (1) side: an earlier one if negative.
    Side(usize, i32),
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
    /// Undoes orbit, zoom and rotation.
    ResetView,
    /// Starts and stops the rotation of the cuboids.
    Rotate,
    /// Opens and folds the tab of the inspector.
    Tab(Tab),
    Undo,
    Redo,
    Save,
    SaveAs,
    /// Folds and unfolds the panel.
    Panel,
    Help,
    /// Writes the window into a PNG file.
    Screenshot,
    /// Closes the uppermost thing that can be closed.
    Close,
    Quit,
}

/// The tolerances that keys step through, in levels of 255.
pub const TOLERANCES: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
/// One press of an arrow moves the camera so far about its target, in degrees.
const ORBIT_STEP: f64 = 2.0;

/// Keys of one meaning, and their words.
pub struct Binding {
    /// The words on its button and in the help.
    pub name: &'static str,
    /// A sentence about it.
    pub says: &'static str,
    pub keys: &'static [Bound],
}

/// A key with its modifiers, and its command.
pub type Bound = (Modifiers, Key, Command);

const NO: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const BOTH: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn bind(name: &'static str, says: &'static str, keys: &'static [Bound]) -> Binding {
    Binding { name, says, keys }
}

/// Every key, by the sections and in the order of the help.
#[rustfmt::skip]
pub const BINDINGS: &[(&str, &[Binding])] = &[
    ("Lights", &[
        bind("white light", "Switches this light on and off.", &[(NO, Key::W, Command::LightNamed("white"))]),
        bind("red light", "Switches this light on and off.", &[(NO, Key::R, Command::LightNamed("red"))]),
        bind("specular light", "Switches this light on and off.", &[(NO, Key::S, Command::LightNamed("specular"))]),
        bind("ambient light", "Switches this light on and off.", &[(NO, Key::A, Command::LightNamed("ambient"))]),
        bind("first to ninth light", "", &[
            (NO, Key::Num1, Command::Light(0)), (NO, Key::Num2, Command::Light(1)), (NO, Key::Num3, Command::Light(2)),
            (NO, Key::Num4, Command::Light(3)), (NO, Key::Num5, Command::Light(4)), (NO, Key::Num6, Command::Light(5)),
            (NO, Key::Num7, Command::Light(6)), (NO, Key::Num8, Command::Light(7)), (NO, Key::Num9, Command::Light(8)),
        ]),
    ]),
    ("Shading", &[
        bind("Gouraud", "Light is computed at the vertices, and its colours are interpolated.", &[(NO, Key::G, Command::Shading(ShadingMode::Gouraud))]),
        bind("Phong", "Normals are interpolated, and light is computed at every pixel.", &[(NO, Key::P, Command::Shading(ShadingMode::Phong))]),
        bind("finer tolerance", "The next finer tolerance, or more time.", &[(NO, Key::OpenBracket, Command::Tolerance(-1)), (NO, Key::PageDown, Command::Tolerance(-1))]),
        bind("coarser tolerance", "The next coarser tolerance, or less time.", &[(NO, Key::CloseBracket, Command::Tolerance(1)), (NO, Key::PageUp, Command::Tolerance(1))]),
        bind("hold the time", "The most exact method whose frame takes no longer than the budget draws.", &[(NO, Key::M, Command::HoldTime)]),
    ]),
    ("Camera", &[
        bind("next camera", "The camera that is looked through.", &[(NO, Key::C, Command::NextCamera)]),
        bind("projection", "In perspective rays leave the eye; in orthographic projection they are parallel.", &[(NO, Key::O, Command::NextProjection)]),
        bind("orbit, or drag", "", &[
            (NO, Key::ArrowLeft, Command::Orbit(-ORBIT_STEP, 0.0)), (NO, Key::ArrowRight, Command::Orbit(ORBIT_STEP, 0.0)),
            (NO, Key::ArrowUp, Command::Orbit(0.0, ORBIT_STEP)), (NO, Key::ArrowDown, Command::Orbit(0.0, -ORBIT_STEP)),
        ]),
        bind("zoom, or wheel", "", &[(NO, Key::Plus, Command::Zoom(1)), (NO, Key::Equals, Command::Zoom(1)), (NO, Key::Minus, Command::Zoom(-1))]),
        bind("rotate", "The cuboids turn about their own x axes.", &[(NO, Key::Space, Command::Rotate)]),
        bind("reset view", "The camera and the cuboids go back to their places in the file.", &[(NO, Key::Home, Command::ResetView)]),
    ]),
    ("View", &[
        bind("picture", "The picture as it is shaded.", &[(NO, Key::F2, Command::View(ViewMode::Picture))]),
        bind("Gouraud | Phong", "Two methods, left and right of a divider that can be dragged.", &[(NO, Key::F3, Command::View(ViewMode::Wipe))]),
        bind("picture | exact", "The picture, and exact Phong in f64, left and right of a divider.", &[(NO, Key::F4, Command::WipeExact)]),
        bind("error map", "The error of each pixel against exact Phong.", &[(NO, Key::F5, Command::View(ViewMode::Error))]),
        bind("tiles", "The way in which each square was drawn.", &[(NO, Key::F6, Command::View(ViewMode::Tiles))]),
        bind("blink (hold)", "Exact Phong and the picture take turns while this is held; in a wipe, its two sides.", &[(NO, Key::B, Command::Blink)]),
        bind("left side", "The next method left of the divider; with Shift, the one before.", &[(NO, Key::Comma, Command::Side(0, 1)), (SHIFT, Key::Comma, Command::Side(0, -1))]),
        bind("right side", "The next method right of the divider; with Shift, the one before.", &[(NO, Key::Period, Command::Side(1, 1)), (SHIFT, Key::Period, Command::Side(1, -1))]),
        bind("worst pixel", "Shows why the worst pixel errs.", &[(NO, Key::Y, Command::Worst)]),
        bind("move the pixel", "", &[
            (SHIFT, Key::ArrowLeft, Command::Probe(-1, 0)), (SHIFT, Key::ArrowRight, Command::Probe(1, 0)),
            (SHIFT, Key::ArrowUp, Command::Probe(0, -1)), (SHIFT, Key::ArrowDown, Command::Probe(0, 1)),
        ]),
    ]),
    ("Scene", &[
        bind("edit", "Shows every number of the scene, to be changed.", &[(NO, Key::E, Command::Tab(Tab::Scene))]),
        bind("required", "Shows the parts of the model that this picture requires.", &[(NO, Key::N, Command::Tab(Tab::Required))]),
        bind("undo", "Takes back the last change.", &[(CTRL, Key::Z, Command::Undo)]),
        bind("redo", "Makes the change again that was last taken back.", &[(BOTH, Key::Z, Command::Redo), (CTRL, Key::Y, Command::Redo)]),
        bind("save", "Writes the scene and the view to the scene's file.", &[(CTRL, Key::S, Command::Save)]),
        bind("save as new", "Writes the scene and the view to a new file.", &[(BOTH, Key::S, Command::SaveAs)]),
    ]),
    ("Window", &[
        bind("fold the panel", "Folds and opens the panel.", &[(NO, Key::I, Command::Panel)]),
        bind("help", "Shows all keys.", &[(NO, Key::H, Command::Help), (NO, Key::Questionmark, Command::Help), (NO, Key::F1, Command::Help)]),
        bind("save the window", "Writes the window into a PNG file.", &[(NO, Key::F12, Command::Screenshot)]),
        bind("close", "Closes the uppermost thing that can be closed.", &[(NO, Key::Escape, Command::Close)]),
        bind("quit", "Ends the program.", &[(NO, Key::Q, Command::Quit)]),
    ]),
];

/// The sides of the wipe between the picture and exact Phong.
pub const EXACT_SIDES: [Side; 2] = [Side::Picture, Side::Reference];

/// The sides of the wipe between Gouraud and Phong, both within this tolerance.
pub fn gouraud_phong(tolerance: f64) -> [Side; 2] {
    [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| Side::Method { mode, tolerance })
}

fn bindings() -> impl Iterator<Item = &'static Binding> {
    BINDINGS.iter().flat_map(|section| section.1)
}

/// All keys.
pub fn keys() -> impl Iterator<Item = &'static Bound> {
    bindings().flat_map(|binding| binding.keys)
}

/// The command of a press. A key that needs no shift acts with shift too: some layouts have digits there.
pub fn command(key: Key, modifiers: Modifiers) -> Option<Command> {
    let find = |shift: bool| {
        keys().find(|(wanted, bound, _)| {
            *bound == key && wanted.command == modifiers.command && wanted.shift == shift
        })
    };
    let (.., command) = find(modifiers.shift).or_else(|| find(false))?;
    (!modifiers.alt).then_some(*command)
}

/// The row of a command.
pub fn binding(command: Command) -> Option<&'static Binding> {
    let is_bound = |binding: &&Binding| binding.keys.iter().any(|key| key.2 == command);
    bindings().find(is_bound)
}

/// The words for the first key of a command; empty where it has none.
pub fn caption(command: Command) -> String {
    let key = keys().find(|key| key.2 == command);
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
    fn no_key_has_two_commands() {
        let keys = || keys().map(|(modifiers, key, _)| (modifiers, key));
        for one in keys() {
            assert_eq!(keys().filter(|other| *other == one).count(), 1, "{one:?}");
        }
    }

    #[test]
    fn shift_chooses_another_command_only_where_there_is_one() {
        assert_eq!(
            command(Key::Num1, Modifiers::SHIFT),
            Some(Command::Light(0))
        );
        assert_eq!(command(Key::Z, BOTH), Some(Command::Redo));
        assert_eq!(command(Key::Z, Modifiers::NONE), None);
        assert_eq!(command(Key::W, Modifiers::COMMAND), None);
        assert_eq!(caption(Command::SaveAs), "Ctrl Shift S");
    }
}
