//! What the user can do, and the one table that says by which key: [`BINDINGS`].
//!
//! Key handling, the help and the rows of the panel are generated from the table, so no key can do what the help does not
//! tell. The mouse and typed digits are not in it. A new command is one variant of [`Action`], one row of the table and one arm where it is applied.

use minifb::Key;
use serde::{Deserialize, Serialize};

use super::magnifier::Magnifier;
use super::views::ViewMode;
use crate::components::{Projection, ShadingMode};

/// What the user can have done; a recording names it so, but for what is skipped there, which says nothing of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Action {
    /// Switches the light of this place in the file, counted from 0.
    Light(usize),
    /// Switches the light of this name.
    #[serde(skip)]
    LightNamed(#[serde(skip)] &'static str),
    /// Shades every cuboid so.
    Shading(ShadingMode),
    /// Shades every cuboid as the scene does.
    SceneShading,
    /// Shades more coarsely by so many steps of [`super::session::TOLERANCES`], or finer where negative.
    Tolerance(i32),
    /// Projects so.
    Projection(Projection),
    /// The other projection.
    NextProjection,
    /// Looks from the next camera of the file, after the last from the first.
    NextCamera,
    /// The view so many steps on, or back where negative; the first follows the last.
    View(i32),
    /// Shows the reference, and hides it again.
    Blink,
    /// Hides the reference.
    EndBlink,
    /// Measures what every method costs and errs in this view, and ends or closes that.
    #[serde(skip)]
    Measure,
    /// Moves the camera about its target.
    Orbit {
        /// To the right as seen from the camera, in degrees.
        azimuth: f64,
        /// Towards the camera's up, in degrees.
        elevation: f64,
    },
    /// Goes closer by so many steps, or away where negative.
    Zoom(i32),
    /// Undoes orbit, zoom and turning.
    ResetView,
    /// Starts and stops turning the cuboids about their own x axes.
    Turning,
    /// Shows what the scene requires of the model, and hides it again.
    #[serde(skip)]
    Requires,
    /// Shows the picture without this part of that list, or the whole again.
    #[serde(skip)]
    LeaveOut(usize),
    /// Shows and hides the panel.
    #[serde(skip)]
    Panel,
    /// Shows and hides the help.
    Help,
    /// Saves what the window shows.
    #[serde(skip)]
    Screenshot,
    /// Saves the picture alone.
    #[serde(skip)]
    SavePicture,
    /// Sets words in letters of this size of [`crate::canvas::FACES`], counted from 0.
    Letters(usize),
    /// The same in letters so many sizes larger than those that are seen.
    #[serde(skip)]
    LettersBy(i32),
    /// Covers the whole screen, and ends that.
    #[serde(skip)]
    FullScreen,
    /// Closes what lies over the picture; see [`super::session::Session::resolved`].
    #[serde(skip)]
    Close,
    /// Ends the program.
    #[serde(skip)]
    Quit,
    /// Shows the numbers of the scene to be changed, and hides them again.
    Editor,
    /// Chooses the row of the editor so many rows on, or back where negative.
    Row(i32),
    /// Chooses a row of the editor, counted from 0, to type a number into.
    ChooseRow(usize),
    /// Changes the number of a row of the editor, or of the one that is chosen.
    Step {
        row: Option<usize>,
        /// How often, down where negative.
        steps: i32,
        size: StepSize,
    },
    /// Takes the typed number.
    Enter,
    /// Takes back the last letter that was typed.
    Erase,
    /// Takes back the last change of the scene.
    Undo,
    /// Makes the change again that was last taken back.
    Redo,
    /// Writes the scene as it is into a new file.
    #[serde(skip)]
    Save,
    /// Takes a letter of a number.
    Type(char),
    /// Forgets what was typed.
    Forget,
    /// Probes this pixel of the picture from now on, or none.
    Probe(Option<[usize; 2]>),
    /// Moves the light of this place in the file, and those that stand where it stands.
    DragLight {
        light: usize,
        /// Right and down, in heights of the picture.
        by: [f64; 2],
        /// Down is towards the viewer then.
        in_depth: bool,
    },
    /// Moves the divider to the right by this share of the picture's width.
    DragDivider(f64),
    /// Leaves what was dragged where it is seen.
    EndDrag,
    /// Shows pixels so many powers of two larger, the probed one or the middle one staying where it is.
    #[serde(skip)]
    MagnifyBy(i32),
    /// Shows pixels so large.
    Magnify(Magnifier),
    /// Shows this view.
    Show(ViewMode),
}

/// How much a step changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StepSize {
    Fine,
    #[default]
    Usual,
    Coarse,
}

impl StepSize {
    /// What a usual step is multiplied by.
    pub fn factor(self) -> f64 {
        match self {
            StepSize::Fine => 0.1,
            StepSize::Usual => 1.0,
            StepSize::Coarse => 10.0,
        }
    }
}

/// The keys that are held with another one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    pub shift: bool,
    pub control: bool,
}

impl Modifiers {
    const NONE: Modifiers = Modifiers {
        shift: false,
        control: false,
    };

    /// How much a step with these keys held changes.
    pub fn step_size(self) -> StepSize {
        match self {
            Modifiers { shift: true, .. } => StepSize::Fine,
            Modifiers { control: true, .. } => StepSize::Coarse,
            Modifiers::NONE => StepSize::Usual,
        }
    }
}

/// A group of commands, by what stands above them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Section(pub &'static str);

impl Section {
    /// Which lights are on.
    pub const LIGHTS: Section = Section("lights");
    /// How surfaces are shaded.
    pub const SHADING: Section = Section("shading");
    /// From where and how it is projected.
    pub const CAMERA: Section = Section("camera");
    /// What is shown of the scene.
    pub const VIEW: Section = Section("view");
    /// Moving about.
    pub const MOTION: Section = Section("move");
    /// The scene as a whole.
    pub const SCENE: Section = Section("scene");
    /// The numbers of the scene; its keys count while these are shown.
    pub const EDITOR: Section = Section("numbers of the scene");
    /// The window itself.
    pub const WINDOW: Section = Section("window");
}

/// One command and how it is called up.
#[derive(Debug)]
pub struct Binding {
    /// The group it belongs to.
    pub section: Section,
    /// The keys as they are written; the panel has room for the first one.
    pub captions: &'static [&'static str],
    /// The keys that call it up.
    pub keys: &'static [Key],
    /// The characters that do, on layouts that deliver these only as such; letters in either case.
    pub characters: &'static [char],
    /// What it does.
    pub action: Action,
    /// What it does, in words; lights and modes are called by their names instead.
    pub says: &'static str,
    /// Whether the panel has it too; the help has all.
    pub on_panel: bool,
    /// Whether it goes on while its key is held.
    pub repeats: bool,
    /// What happens when its key goes up, if anything.
    pub on_release: Option<Action>,
    /// What is held with it.
    pub modifiers: Modifiers,
}

impl Binding {
    /// A row that the help shows and a press calls up once.
    const fn new(
        section: Section,
        captions: &'static [&'static str],
        keys: &'static [Key],
        characters: &'static [char],
        action: Action,
        says: &'static str,
    ) -> Self {
        Binding {
            section,
            captions,
            keys,
            characters,
            action,
            says,
            on_panel: false,
            repeats: false,
            on_release: None,
            modifiers: Modifiers::NONE,
        }
    }

    /// The same row, on the panel too.
    const fn on_panel(mut self) -> Self {
        self.on_panel = true;
        self
    }

    /// The same row, going on while its key is held.
    const fn repeats(mut self) -> Self {
        self.repeats = true;
        self
    }

    /// The same row, with the shift key.
    const fn with_shift(mut self) -> Self {
        self.modifiers.shift = true;
        self
    }

    /// The same row, with the control key.
    const fn with_control(mut self) -> Self {
        self.modifiers.control = true;
        self
    }

    /// The same row, whose key does this when it goes up.
    const fn on_release(mut self, action: Action) -> Self {
        self.on_release = Some(action);
        self
    }
}

/// How far one press of an arrow goes about the target, in degrees.
const ORBIT_STEP: f64 = 2.0;
const fn orbit(azimuth: f64, elevation: f64) -> Action {
    Action::Orbit { azimuth, elevation }
}
const fn step(steps: i32, size: StepSize) -> Action {
    Action::Step {
        row: None,
        steps,
        size,
    }
}
const GOURAUD: Action = Action::Shading(ShadingMode::Gouraud);
const PHONG: Action = Action::Shading(ShadingMode::Phong);

/// Every command, in the order in which they are shown.
#[rustfmt::skip]
pub const BINDINGS: &[Binding] = &[
    Binding::new(Section::LIGHTS, &["1"], &[Key::Key1, Key::NumPad1], &['1'], Action::Light(0), "").on_panel(),
    Binding::new(Section::LIGHTS, &["2"], &[Key::Key2, Key::NumPad2], &['2'], Action::Light(1), "").on_panel(),
    Binding::new(Section::LIGHTS, &["3"], &[Key::Key3, Key::NumPad3], &['3'], Action::Light(2), "").on_panel(),
    Binding::new(Section::LIGHTS, &["4"], &[Key::Key4, Key::NumPad4], &['4'], Action::Light(3), "").on_panel(),
    Binding::new(Section::LIGHTS, &["5"], &[Key::Key5, Key::NumPad5], &['5'], Action::Light(4), "").on_panel(),
    Binding::new(Section::LIGHTS, &["6"], &[Key::Key6, Key::NumPad6], &['6'], Action::Light(5), "").on_panel(),
    Binding::new(Section::LIGHTS, &["7"], &[Key::Key7, Key::NumPad7], &['7'], Action::Light(6), "").on_panel(),
    Binding::new(Section::LIGHTS, &["8"], &[Key::Key8, Key::NumPad8], &['8'], Action::Light(7), "").on_panel(),
    Binding::new(Section::LIGHTS, &["9"], &[Key::Key9, Key::NumPad9], &['9'], Action::Light(8), "").on_panel(),
    Binding::new(Section::LIGHTS, &["W"], &[Key::W], &['w'], Action::LightNamed("white"), "").on_panel(),
    Binding::new(Section::LIGHTS, &["R"], &[Key::R], &['r'], Action::LightNamed("red"), "").on_panel(),
    Binding::new(Section::LIGHTS, &["S"], &[Key::S], &['s'], Action::LightNamed("specular"), "").on_panel(),
    Binding::new(Section::LIGHTS, &["A"], &[Key::A], &['a'], Action::LightNamed("ambient"), "").on_panel(),
    Binding::new(Section::SHADING, &["G"], &[Key::G], &['g'], GOURAUD, "").on_panel(),
    Binding::new(Section::SHADING, &["P"], &[Key::P], &['p'], PHONG, "").on_panel(),
    Binding::new(Section::SHADING, &["F"], &[Key::F], &['f'], Action::SceneShading, "as the file says"),
    Binding::new(Section::SHADING, &["[", "PgDn"], &[Key::LeftBracket, Key::PageDown], &['['], Action::Tolerance(-1), "tolerance").on_panel(),
    Binding::new(Section::SHADING, &["]", "PgUp"], &[Key::RightBracket, Key::PageUp], &[']'], Action::Tolerance(1), "tolerance").on_panel(),
    Binding::new(Section::CAMERA, &["O"], &[Key::O], &['o'], Action::NextProjection, "projection").on_panel(),
    Binding::new(Section::CAMERA, &["C"], &[Key::C], &['c'], Action::NextCamera, "camera").on_panel(),
    Binding::new(Section::VIEW, &["Tab"], &[Key::Tab], &[], Action::View(1), "view").on_panel(),
    Binding::new(Section::VIEW, &["Shift Tab"], &[Key::Tab], &[], Action::View(-1), "view").with_shift(),
    Binding::new(Section::VIEW, &["F2"], &[Key::F2], &[], Action::Show(ViewMode::Picture), "each view"),
    Binding::new(Section::VIEW, &["F3"], &[Key::F3], &[], Action::Show(ViewMode::GouraudPhong), "each view"),
    Binding::new(Section::VIEW, &["F4"], &[Key::F4], &[], Action::Show(ViewMode::MethodReference), "each view"),
    Binding::new(Section::VIEW, &["F5"], &[Key::F5], &[], Action::Show(ViewMode::ErrorMap), "each view"),
    Binding::new(Section::VIEW, &["F6"], &[Key::F6], &[], Action::Show(ViewMode::Tiles), "each view"),
    Binding::new(Section::VIEW, &["Z"], &[Key::Z], &['z'], Action::MagnifyBy(1), "magnify, or Ctrl wheel"),
    Binding::new(Section::VIEW, &["X"], &[Key::X], &['x'], Action::MagnifyBy(-1), "magnify, or Ctrl wheel"),
    Binding::new(Section::VIEW, &["Ctrl +"], &[Key::Equal, Key::NumPadPlus], &[], Action::LettersBy(1), "size of letters").with_control(),
    Binding::new(Section::VIEW, &["-"], &[Key::Minus, Key::NumPadMinus], &[], Action::LettersBy(-1), "size of letters").with_control(),
    Binding::new(Section::VIEW, &["B"], &[Key::B], &['b'], Action::Blink, "hold: reference").on_panel().on_release(Action::EndBlink),
    Binding::new(Section::VIEW, &["M"], &[Key::M], &['m'], Action::Measure, "measure methods").on_panel(),
    Binding::new(Section::VIEW, &["N"], &[Key::N], &['n'], Action::Requires, "what is required"),
    Binding::new(Section::MOTION, &["Left"], &[Key::Left], &[], orbit(-ORBIT_STEP, 0.0), "orbit across, or drag").repeats(),
    Binding::new(Section::MOTION, &["Right"], &[Key::Right], &[], orbit(ORBIT_STEP, 0.0), "orbit across, or drag").repeats(),
    Binding::new(Section::MOTION, &["Up"], &[Key::Up], &[], orbit(0.0, ORBIT_STEP), "orbit up and down").repeats(),
    Binding::new(Section::MOTION, &["Down"], &[Key::Down], &[], orbit(0.0, -ORBIT_STEP), "orbit up and down").repeats(),
    Binding::new(Section::MOTION, &["+"], &[Key::Equal, Key::NumPadPlus], &['+'], Action::Zoom(1), "zoom, or wheel").repeats(),
    Binding::new(Section::MOTION, &["-"], &[Key::Minus, Key::NumPadMinus], &['-'], Action::Zoom(-1), "zoom, or wheel").repeats(),
    Binding::new(Section::MOTION, &["Home"], &[Key::Home], &[], Action::ResetView, "reset view").on_panel(),
    Binding::new(Section::MOTION, &["Space"], &[Key::Space], &[' '], Action::Turning, "turn cuboids").on_panel(),
    Binding::new(Section::SCENE, &["E"], &[Key::E], &['e'], Action::Editor, "edit numbers").on_panel(),
    Binding::new(Section::SCENE, &["Ctrl Z"], &[Key::Z], &[], Action::Undo, "undo").with_control().repeats(),
    Binding::new(Section::SCENE, &["Ctrl Shift Z"], &[Key::Z], &[], Action::Redo, "redo").with_control().with_shift().repeats(),
    Binding::new(Section::SCENE, &["Ctrl S"], &[Key::S], &[], Action::Save, "save the scene").with_control(),
    Binding::new(Section::EDITOR, &["Up"], &[Key::Up], &[], Action::Row(-1), "choose").repeats(),
    Binding::new(Section::EDITOR, &["Down"], &[Key::Down], &[], Action::Row(1), "choose").repeats(),
    Binding::new(Section::EDITOR, &["Left"], &[Key::Left], &[], step(-1, StepSize::Usual), "change, or wheel").repeats(),
    Binding::new(Section::EDITOR, &["Right"], &[Key::Right], &[], step(1, StepSize::Usual), "change, or wheel").repeats(),
    Binding::new(Section::EDITOR, &["Shift Left"], &[Key::Left], &[], step(-1, StepSize::Fine), "a tenth of that").with_shift().repeats(),
    Binding::new(Section::EDITOR, &["Right"], &[Key::Right], &[], step(1, StepSize::Fine), "a tenth of that").with_shift().repeats(),
    Binding::new(Section::EDITOR, &["Ctrl Left"], &[Key::Left], &[], step(-1, StepSize::Coarse), "ten times that").with_control().repeats(),
    Binding::new(Section::EDITOR, &["Right"], &[Key::Right], &[], step(1, StepSize::Coarse), "ten times that").with_control().repeats(),
    Binding::new(Section::EDITOR, &["0-9", "Enter"], &[Key::Enter, Key::NumPadEnter], &[], Action::Enter, "type a number"),
    Binding::new(Section::EDITOR, &["Backspace"], &[Key::Backspace, Key::Delete], &[], Action::Erase, "erase a digit").repeats(),
    Binding::new(Section::WINDOW, &["I"], &[Key::I], &['i'], Action::Panel, "panel").on_panel(),
    Binding::new(Section::WINDOW, &["H", "?", "F1"], &[Key::H, Key::F1], &['h', '?'], Action::Help, "help").on_panel(),
    Binding::new(Section::WINDOW, &["F11"], &[Key::F11], &[], Action::FullScreen, "full screen"),
    Binding::new(Section::WINDOW, &["F12"], &[Key::F12], &[], Action::Screenshot, "save the window"),
    Binding::new(Section::WINDOW, &["Shift F12"], &[Key::F12], &[], Action::SavePicture, "save the picture").with_shift(),
    Binding::new(Section::WINDOW, &["Esc"], &[Key::Escape], &[], Action::Close, "close a board"),
    Binding::new(Section::WINDOW, &["Q"], &[Key::Q], &['q'], Action::Quit, "quit"),
];

/// What a press of `key` calls up while these keys are held; the editor's keys come first while it is shown.
pub fn bound_to_key(key: Key, modifiers: Modifiers, editing: bool) -> Option<&'static Binding> {
    let find = |editor: bool, modifiers: Modifiers| {
        BINDINGS.iter().find(|binding| {
            binding.keys.contains(&key)
                && binding.modifiers == modifiers
                && (binding.section == Section::EDITOR) == editor
        })
    };
    let of_editor = || find(true, modifiers).filter(|_| editing);
    // What needs no shift key does not mind it.
    let unshifted = Modifiers {
        shift: false,
        ..modifiers
    };
    of_editor()
        .or_else(|| find(false, modifiers))
        .or_else(|| find(false, unshifted))
}

/// What `character` calls up where its press gave no bound key.
pub fn bound_to_character(character: char) -> Option<&'static Binding> {
    let character = character.to_ascii_lowercase();
    BINDINGS
        .iter()
        .find(|binding| binding.characters.contains(&character))
}
