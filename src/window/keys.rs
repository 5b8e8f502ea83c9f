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
    /// Shades every cuboid as its file does.
    FileShading,
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
    /// Folds the profile below a wipe.
    Profile,
    /// Moves the probed pixel: columns to the right, rows down.
    Probe(i32, i32),
    /// Magnifies by powers of two.
    Magnify(i32),
    /// Shows exact Phong while its key is held.
    ShowExact,
    /// Moves the camera about its target: degrees to the right and up.
    Orbit(f64, f64),
    /// Steps towards the target.
    Zoom(i32),
    /// Undoes orbit, zoom, rotation and magnification.
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
    /// Writes the window, or the picture alone, into a PNG file.
    Screenshot {
        window: bool,
    },
    /// Closes the uppermost thing that can be closed.
    Close,
    Quit,
}

/// The tolerances that keys step through, in levels of 255.
pub const TOLERANCES: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
/// One press of an arrow moves the camera so far about its target, in degrees.
const ORBIT_STEP: f64 = 2.0;

/// A command, its keys and its words.
pub struct Binding {
    pub section: &'static str,
    pub keys: &'static [(Modifiers, Key)],
    pub command: Command,
    /// The words on its button and in the help.
    pub name: &'static str,
    /// A sentence about it.
    pub says: &'static str,
}

const NO: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const BOTH: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn bind(
    section: &'static str,
    keys: &'static [(Modifiers, Key)],
    command: Command,
    name: &'static str,
    says: &'static str,
) -> Binding {
    Binding {
        section,
        keys,
        command,
        name,
        says,
    }
}

/// The sections of the help.
pub const SECTIONS: [&str; 6] = ["Lights", "Shading", "Camera", "View", "Scene", "Window"];

/// Every key, in the order of the help.
#[rustfmt::skip]
pub const BINDINGS: &[Binding] = &[
    bind("Lights", &[(NO, Key::W)], Command::LightNamed("white"), "white light", "Switches this light on and off."),
    bind("Lights", &[(NO, Key::R)], Command::LightNamed("red"), "red light", "Switches this light on and off."),
    bind("Lights", &[(NO, Key::S)], Command::LightNamed("specular"), "specular light", "Switches this light on and off."),
    bind("Lights", &[(NO, Key::A)], Command::LightNamed("ambient"), "ambient light", "Switches this light on and off."),
    bind("Lights", &[(NO, Key::Num1)], Command::Light(0), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num2)], Command::Light(1), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num3)], Command::Light(2), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num4)], Command::Light(3), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num5)], Command::Light(4), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num6)], Command::Light(5), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num7)], Command::Light(6), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num8)], Command::Light(7), "first to ninth light", ""),
    bind("Lights", &[(NO, Key::Num9)], Command::Light(8), "first to ninth light", ""),
    bind("Shading", &[(NO, Key::G)], Command::Shading(ShadingMode::Gouraud), "Gouraud", "Light is computed at the vertices, and its colours are interpolated."),
    bind("Shading", &[(NO, Key::P)], Command::Shading(ShadingMode::Phong), "Phong", "Normals are interpolated, and light is computed at every pixel."),
    bind("Shading", &[(NO, Key::F)], Command::FileShading, "as the file", "Each cuboid is shaded as the scene's file says."),
    bind("Shading", &[(NO, Key::OpenBracket), (NO, Key::PageDown)], Command::Tolerance(-1), "finer tolerance", "The next finer tolerance."),
    bind("Shading", &[(NO, Key::CloseBracket), (NO, Key::PageUp)], Command::Tolerance(1), "coarser tolerance", "The next coarser tolerance."),
    bind("Shading", &[(NO, Key::M)], Command::HoldTime, "hold the time", "The most exact method that holds a time of milliseconds a frame draws."),
    bind("Camera", &[(NO, Key::C)], Command::NextCamera, "next camera", "The camera that is looked through."),
    bind("Camera", &[(NO, Key::O)], Command::NextProjection, "projection", "In perspective rays leave the eye; in orthographic projection they are parallel."),
    bind("Camera", &[(NO, Key::ArrowLeft)], Command::Orbit(-ORBIT_STEP, 0.0), "orbit, or drag", ""),
    bind("Camera", &[(NO, Key::ArrowRight)], Command::Orbit(ORBIT_STEP, 0.0), "orbit, or drag", ""),
    bind("Camera", &[(NO, Key::ArrowUp)], Command::Orbit(0.0, ORBIT_STEP), "orbit, or drag", ""),
    bind("Camera", &[(NO, Key::ArrowDown)], Command::Orbit(0.0, -ORBIT_STEP), "orbit, or drag", ""),
    bind("Camera", &[(NO, Key::Plus), (NO, Key::Equals)], Command::Zoom(1), "zoom, or wheel", ""),
    bind("Camera", &[(NO, Key::Minus)], Command::Zoom(-1), "zoom, or wheel", ""),
    bind("Camera", &[(NO, Key::Space)], Command::Rotate, "rotate", "The cuboids turn about their own x axes."),
    bind("Camera", &[(NO, Key::Home)], Command::ResetView, "reset view", "The camera and the cuboids go back to their places in the file."),
    bind("View", &[(NO, Key::F2)], Command::View(ViewMode::Picture), "picture", "The picture as it is shaded."),
    bind("View", &[(NO, Key::F3)], Command::View(ViewMode::Wipe), "Gouraud | Phong", "Two methods, left and right of a divider that can be dragged."),
    bind("View", &[(NO, Key::F4)], Command::WipeExact, "picture | exact", "The picture, and exact Phong in f64, left and right of a divider."),
    bind("View", &[(NO, Key::F5)], Command::View(ViewMode::Error), "error map", "The error of each pixel against exact Phong; once more: the difference, amplified until it is seen."),
    bind("View", &[(NO, Key::F6)], Command::View(ViewMode::Tiles), "tiles", "The way in which each square was drawn."),
    bind("View", &[(NO, Key::B)], Command::ShowExact, "show exact (hold)", "Shows exact Phong while the key or the button is held."),
    bind("View", &[(NO, Key::Comma)], Command::Side(0, 1), "left side", "The next method left of the divider."),
    bind("View", &[(SHIFT, Key::Comma)], Command::Side(0, -1), "left side", "The method before, left of the divider."),
    bind("View", &[(NO, Key::Period)], Command::Side(1, 1), "right side", "The next method right of the divider."),
    bind("View", &[(SHIFT, Key::Period)], Command::Side(1, -1), "right side", "The method before, right of the divider."),
    bind("View", &[(NO, Key::Y)], Command::Worst, "why, at the worst pixel", "Shows why the worst pixel errs."),
    bind("View", &[(NO, Key::L)], Command::Profile, "levels below a wipe", "Folds and opens the levels along a row."),
    bind("View", &[(SHIFT, Key::ArrowLeft)], Command::Probe(-1, 0), "move the probed pixel", ""),
    bind("View", &[(SHIFT, Key::ArrowRight)], Command::Probe(1, 0), "move the probed pixel", ""),
    bind("View", &[(SHIFT, Key::ArrowUp)], Command::Probe(0, -1), "move the probed pixel", ""),
    bind("View", &[(SHIFT, Key::ArrowDown)], Command::Probe(0, 1), "move the probed pixel", ""),
    bind("View", &[(NO, Key::Z)], Command::Magnify(1), "magnify, or Ctrl wheel", "Pixels are shown twice as large."),
    bind("View", &[(NO, Key::X)], Command::Magnify(-1), "magnify less", "Pixels are shown half as large."),
    bind("Scene", &[(NO, Key::E)], Command::Tab(Tab::Scene), "edit", "Shows every number of the scene, to be changed."),
    bind("Scene", &[(NO, Key::N)], Command::Tab(Tab::Required), "required", "Shows the parts of the model that this picture requires."),
    bind("Scene", &[(CTRL, Key::Z)], Command::Undo, "undo", "Takes back the last change."),
    bind("Scene", &[(BOTH, Key::Z), (CTRL, Key::Y)], Command::Redo, "redo", "Makes the change again that was last taken back."),
    bind("Scene", &[(CTRL, Key::S)], Command::Save, "save", "Writes the scene and the view to the scene's file."),
    bind("Scene", &[(BOTH, Key::S)], Command::SaveAs, "save as new", "Writes the scene and the view to a new file."),
    bind("Window", &[(NO, Key::I)], Command::Panel, "fold the panel", "Folds and opens the panel."),
    bind("Window", &[(NO, Key::H), (NO, Key::Questionmark), (NO, Key::F1)], Command::Help, "help", "Shows all keys."),
    bind("Window", &[(NO, Key::F12)], Command::Screenshot { window: true }, "save the window", "Writes the window into a PNG file."),
    bind("Window", &[(SHIFT, Key::F12)], Command::Screenshot { window: false }, "save the picture", "Writes the picture into a PNG file."),
    bind("Window", &[(NO, Key::Escape)], Command::Close, "close", "Closes the uppermost thing that can be closed."),
    bind("Window", &[(NO, Key::Q)], Command::Quit, "quit", "Ends the program."),
];

/// The sides of the wipe between Gouraud and Phong, both within this tolerance.
pub fn gouraud_phong(tolerance: f64) -> [Side; 2] {
    [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| Side::Method { mode, tolerance })
}

/// The command of a press. A key that needs no shift acts with shift too: some layouts have digits there.
pub fn command(key: Key, modifiers: Modifiers) -> Option<Command> {
    let find = |shift: bool| {
        BINDINGS.iter().find(|binding| {
            let mut keys = binding.keys.iter();
            keys.any(|(wanted, bound)| {
                *bound == key && wanted.command == modifiers.command && wanted.shift == shift
            })
        })
    };
    let found = find(modifiers.shift).or_else(|| find(false))?;
    (!modifiers.alt).then_some(found.command)
}

/// The row of a command.
pub fn binding(command: Command) -> Option<&'static Binding> {
    BINDINGS.iter().find(|binding| binding.command == command)
}

/// The first key of a command; empty where it has none.
pub fn caption(command: Command) -> String {
    binding(command).map_or_else(String::new, |it| it.captions().remove(0))
}

impl Binding {
    /// The words for its keys.
    pub fn captions(&self) -> Vec<String> {
        let caption = |(modifiers, key): &(Modifiers, Key)| {
            let control = if modifiers.command { "Ctrl " } else { "" };
            let shift = if modifiers.shift { "Shift " } else { "" };
            format!("{control}{shift}{}", key.symbol_or_name())
        };
        self.keys.iter().map(caption).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_commands() {
        let keys = || BINDINGS.iter().flat_map(|binding| binding.keys);
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
        assert_eq!(command(Key::Z, Modifiers::NONE), Some(Command::Magnify(1)));
        assert_eq!(command(Key::W, Modifiers::COMMAND), None);
        assert_eq!(caption(Command::SaveAs), "Ctrl Shift S");
    }
}
