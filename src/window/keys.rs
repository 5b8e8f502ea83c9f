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
    NextProjection,
    NextCamera,
    View(ViewMode),
    /// Shows the wipe between a method and exact Phong.
    WipeExact,
    /// Magnifies by powers of two.
    Magnify(i32),
    /// Shows exact Phong while its key is held.
    ShowExact,
    /// Measures every method in this view.
    Measure,
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
    pub says: &'static str,
}

const fn plain(key: Key) -> (Modifiers, Key) {
    (Modifiers::NONE, key)
}

const fn control(key: Key) -> (Modifiers, Key) {
    (Modifiers::COMMAND, key)
}

const fn shift(key: Key) -> (Modifiers, Key) {
    (Modifiers::SHIFT, key)
}

const CONTROL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn bind(
    section: &'static str,
    keys: &'static [(Modifiers, Key)],
    command: Command,
    says: &'static str,
) -> Binding {
    Binding {
        section,
        keys,
        command,
        says,
    }
}

/// Every key, in the order of the help.
#[rustfmt::skip]
pub const BINDINGS: &[Binding] = &[
    bind("Lights", &[plain(Key::W)], Command::LightNamed("white"), "white light on, off"),
    bind("Lights", &[plain(Key::R)], Command::LightNamed("red"), "red light on, off"),
    bind("Lights", &[plain(Key::S)], Command::LightNamed("specular"), "specular light on, off"),
    bind("Lights", &[plain(Key::A)], Command::LightNamed("ambient"), "ambient light on, off"),
    bind("Lights", &[plain(Key::Num1)], Command::Light(0), "first to ninth light"),
    bind("Lights", &[plain(Key::Num2)], Command::Light(1), "first to ninth light"),
    bind("Lights", &[plain(Key::Num3)], Command::Light(2), "first to ninth light"),
    bind("Lights", &[plain(Key::Num4)], Command::Light(3), "first to ninth light"),
    bind("Lights", &[plain(Key::Num5)], Command::Light(4), "first to ninth light"),
    bind("Lights", &[plain(Key::Num6)], Command::Light(5), "first to ninth light"),
    bind("Lights", &[plain(Key::Num7)], Command::Light(6), "first to ninth light"),
    bind("Lights", &[plain(Key::Num8)], Command::Light(7), "first to ninth light"),
    bind("Lights", &[plain(Key::Num9)], Command::Light(8), "first to ninth light"),
    bind("Shading", &[plain(Key::G)], Command::Shading(ShadingMode::Gouraud), "Gouraud"),
    bind("Shading", &[plain(Key::P)], Command::Shading(ShadingMode::Phong), "Phong"),
    bind("Shading", &[plain(Key::F)], Command::FileShading, "as the file says"),
    bind("Shading", &[plain(Key::OpenBracket), plain(Key::PageDown)], Command::Tolerance(-1), "finer tolerance"),
    bind("Shading", &[plain(Key::CloseBracket), plain(Key::PageUp)], Command::Tolerance(1), "coarser tolerance"),
    bind("Shading", &[plain(Key::M)], Command::Measure, "measure all methods"),
    bind("Camera", &[plain(Key::C)], Command::NextCamera, "next camera"),
    bind("Camera", &[plain(Key::O)], Command::NextProjection, "perspective, orthographic"),
    bind("Camera", &[plain(Key::ArrowLeft)], Command::Orbit(-ORBIT_STEP, 0.0), "orbit, or drag"),
    bind("Camera", &[plain(Key::ArrowRight)], Command::Orbit(ORBIT_STEP, 0.0), "orbit, or drag"),
    bind("Camera", &[plain(Key::ArrowUp)], Command::Orbit(0.0, ORBIT_STEP), "orbit, or drag"),
    bind("Camera", &[plain(Key::ArrowDown)], Command::Orbit(0.0, -ORBIT_STEP), "orbit, or drag"),
    bind("Camera", &[plain(Key::Plus), plain(Key::Equals)], Command::Zoom(1), "zoom, or wheel"),
    bind("Camera", &[plain(Key::Minus)], Command::Zoom(-1), "zoom, or wheel"),
    bind("Camera", &[plain(Key::Space)], Command::Rotate, "rotate the cuboids"),
    bind("Camera", &[plain(Key::Home)], Command::ResetView, "reset the view"),
    bind("View", &[plain(Key::F2)], Command::View(ViewMode::Picture), "picture"),
    bind("View", &[plain(Key::F3)], Command::View(ViewMode::Wipe), "Gouraud | Phong"),
    bind("View", &[plain(Key::F4)], Command::WipeExact, "picture | exact Phong"),
    bind("View", &[plain(Key::F5)], Command::View(ViewMode::Error), "error map"),
    bind("View", &[plain(Key::F6)], Command::View(ViewMode::Tiles), "tiles"),
    bind("View", &[plain(Key::B)], Command::ShowExact, "hold: exact Phong"),
    bind("View", &[plain(Key::Z)], Command::Magnify(1), "magnify, or Ctrl wheel"),
    bind("View", &[plain(Key::X)], Command::Magnify(-1), "magnify, or Ctrl wheel"),
    bind("Scene", &[plain(Key::E)], Command::Tab(Tab::Scene), "edit the scene"),
    bind("Scene", &[plain(Key::N)], Command::Tab(Tab::Required), "parts that are required"),
    bind("Scene", &[control(Key::Z)], Command::Undo, "undo"),
    bind("Scene", &[(CONTROL_SHIFT, Key::Z), control(Key::Y)], Command::Redo, "redo"),
    bind("Scene", &[control(Key::S)], Command::Save, "save to its file"),
    bind("Scene", &[(CONTROL_SHIFT, Key::S)], Command::SaveAs, "save to a new file"),
    bind("Window", &[plain(Key::I)], Command::Panel, "fold the panel"),
    bind("Window", &[plain(Key::H), plain(Key::Questionmark), plain(Key::F1)], Command::Help, "help"),
    bind("Window", &[plain(Key::F12)], Command::Screenshot { window: true }, "save the window"),
    bind("Window", &[shift(Key::F12)], Command::Screenshot { window: false }, "save the picture"),
    bind("Window", &[plain(Key::Escape)], Command::Close, "close"),
    bind("Window", &[plain(Key::Q)], Command::Quit, "quit"),
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

/// The first key of a command, as the panel shows it; empty where it has none.
pub fn caption(command: Command) -> String {
    let binding = BINDINGS.iter().find(|binding| binding.command == command);
    binding.map_or_else(String::new, |binding| binding.captions().remove(0))
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
        assert_eq!(command(Key::Z, CONTROL_SHIFT), Some(Command::Redo));
        assert_eq!(command(Key::Z, Modifiers::NONE), Some(Command::Magnify(1)));
        assert_eq!(command(Key::W, Modifiers::COMMAND), None);
        assert_eq!(caption(Command::SaveAs), "Ctrl Shift S");
    }
}
