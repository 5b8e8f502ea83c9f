//! The keys and the wheel that minifb reports, as events of egui.
//!
//! minifb names keys as they lie on a US keyboard, and sends the characters beside them. A character that its key does not
//! name (`?`, `+`, a digit on a French keyboard) is an egui key of its own; so is the letter of a control character, which a
//! layout without Latin letters in its first group reports alone.

use egui::{Event, Key, Modifiers, MouseWheelUnit, TouchPhase, vec2};
use minifb::Key as Reported;

/// A report of minifb's callback.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KeyReport {
    /// A key went down, or is held and reported again.
    Down(Reported),
    Up(Reported),
    /// The character of a press, after its key.
    Character(char),
}

/// The keys that are down, and the events that were not taken yet.
#[derive(Default)]
pub struct Input {
    pub events: Vec<Event>,
    pub modifiers: Modifiers,
    held: Vec<Reported>,
    /// The key of the last press; `None` once its character was reported.
    pressed: Option<Key>,
    /// The last character that no key named, until a key goes up.
    unnamed: Option<char>,
}

impl Input {
    /// Turns a report into events.
    pub fn report(&mut self, report: KeyReport) {
        match report {
            KeyReport::Down(key) => {
                let repeat = self.held.contains(&key);
                if !repeat {
                    self.held.push(key);
                }
                self.modifiers = self.held_modifiers();
                self.pressed = named(key);
                let press = self.pressed.map(|key| self.press(key, repeat));
                self.events.extend(press);
            }
            KeyReport::Up(key) => {
                self.held.retain(|held| *held != key);
                self.modifiers = self.held_modifiers();
                self.unnamed = None;
                let release = named(key).map(|key| self.key(key, false, false));
                self.events.extend(release);
            }
            KeyReport::Character(character) => self.character(character),
        }
    }

    fn character(&mut self, character: char) {
        let pressed = self.pressed.take();
        let is_letter = pressed.is_none_or(|key| (Key::A..=Key::Z).contains(&key));
        let own = match character {
            // Ctrl A to Ctrl Z. Tab and Enter are such characters, too.
            '\u{1}'..='\u{1a}' if self.modifiers.command && is_letter => {
                Key::from_name(&char::from(b'@' + character as u8).to_string())
            }
            _ if character.is_control() || self.modifiers.command => return,
            _ => Key::from_name(&character.to_uppercase().to_string()),
        };
        if let Some(own) = own.filter(|own| Some(*own) != pressed) {
            // The press has one name: the character's.
            let named = pressed.map(|key| self.press(key, false));
            self.events.pop_if(|event| Some(&*event) == named.as_ref());
            let repeat = self.unnamed.replace(character) == Some(character);
            let press = self.press(own, repeat);
            let release = self.key(own, false, false);
            self.events.extend([press, release]);
        }
        if !self.modifiers.command {
            self.events.push(Event::Text(character.to_string()));
        }
    }

    /// Whether `Ctrl V` was pressed: the clipboard is to be read.
    pub fn pastes(&self) -> bool {
        let is_paste = |event: &Event| matches!(event, Event::Key { key: Key::V, pressed: true, modifiers, .. } if modifiers.command);
        self.events.iter().any(is_paste)
    }

    /// The event of a press. Those that copy and cut have their own.
    fn press(&self, key: Key, repeat: bool) -> Event {
        match key {
            Key::C if self.modifiers.command => Event::Copy,
            Key::X if self.modifiers.command => Event::Cut,
            _ => self.key(key, true, repeat),
        }
    }

    /// The wheel turned by so many notches; away from the user is positive.
    pub fn wheel(&mut self, notches: i32) {
        self.events.push(Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, notches as f32),
            phase: TouchPhase::Move,
            modifiers: self.modifiers,
        });
    }

    /// The window lost or got the keyboard. Releases are not reported to a window without it.
    pub fn focus(&mut self, has_focus: bool) {
        for key in std::mem::take(&mut self.held) {
            self.report(KeyReport::Up(key));
        }
        self.events.push(Event::WindowFocused(has_focus));
    }

    /// Whether a key is down that may go on acting.
    pub fn is_busy(&self) -> bool {
        !self.held.is_empty()
    }

    fn key(&self, key: Key, pressed: bool, repeat: bool) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat,
            modifiers: self.modifiers,
        }
    }

    fn held_modifiers(&self) -> Modifiers {
        let is_held = |keys: [Reported; 2]| keys.iter().any(|key| self.held.contains(key));
        let control = is_held([Reported::LeftCtrl, Reported::RightCtrl]);
        // Windows reports AltGr, which is part of a character, as Ctrl and the right Alt.
        let is_alt_gr = control && self.held.contains(&Reported::RightAlt);
        let control = control && !is_alt_gr;
        Modifiers {
            alt: is_held([Reported::LeftAlt, Reported::RightAlt]) && !is_alt_gr,
            ctrl: control,
            shift: is_held([Reported::LeftShift, Reported::RightShift]),
            mac_cmd: false,
            command: control,
        }
    }
}

/// egui's name of a key; `None` for modifiers and keys that it does not have.
fn named(key: Reported) -> Option<Key> {
    let name = match key {
        Reported::Apostrophe => "Quote",
        Reported::LeftBracket => "OpenBracket",
        Reported::RightBracket => "CloseBracket",
        Reported::NumPadDot => "Period",
        Reported::NumPadSlash => "Slash",
        Reported::NumPadMinus => "Minus",
        Reported::NumPadPlus => "Plus",
        Reported::NumPadEnter => "Enter",
        other => {
            let name = format!("{other:?}");
            let digit = name.strip_prefix("NumPad").or(name.strip_prefix("Key"));
            return Key::from_name(digit.unwrap_or(&name));
        }
    };
    Key::from_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(reports: &[KeyReport]) -> Vec<(Key, bool)> {
        let mut input = Input::default();
        for report in reports {
            input.report(*report);
        }
        let pressed = input.events.into_iter().filter_map(|event| match event {
            Event::Key {
                key,
                pressed: true,
                repeat,
                ..
            } => Some((key, repeat)),
            _ => None,
        });
        pressed.collect()
    }

    #[test]
    fn alt_gr_is_no_modifier() {
        use KeyReport::{Character, Down};
        let mut input = Input::default();
        for report in [
            Down(Reported::LeftCtrl),
            Down(Reported::RightAlt),
            Down(Reported::Key8),
            Character('['),
        ] {
            input.report(report);
        }
        assert_eq!(input.modifiers, Modifiers::NONE);
        assert!(input.events.contains(&Event::Text("[".to_owned())));
    }

    #[test]
    fn each_press_is_one_key_however_often_it_is_reported() {
        use KeyReport::{Character, Down, Up};
        let w = [
            Down(Reported::W),
            Character('w'),
            Down(Reported::W),
            Character('w'),
            Up(Reported::W),
            Down(Reported::W),
        ];
        assert_eq!(keys(&w), [(Key::W, false), (Key::W, true), (Key::W, false)]);
        let question = [
            Down(Reported::LeftShift),
            Down(Reported::Slash),
            Character('?'),
        ];
        assert_eq!(keys(&question), [(Key::Questionmark, false)]);
        // A layout that reports a digit as a character alone, held.
        let digit = [
            Character('1'),
            Character('1'),
            Up(Reported::Unknown),
            Character('1'),
        ];
        assert_eq!(
            keys(&digit),
            [(Key::Num1, false), (Key::Num1, true), (Key::Num1, false)]
        );
    }

    #[test]
    fn a_control_character_is_ctrl_with_its_letter() {
        use KeyReport::{Character, Down};
        let control = Down(Reported::LeftCtrl);
        // A layout whose first group has no Latin letters reports no key.
        assert_eq!(keys(&[control, Character('\u{13}')]), [(Key::S, false)]);
        // One whose first group has others reports another key.
        let other = [control, Down(Reported::Z), Character('\u{19}')];
        assert_eq!(keys(&other), [(Key::Y, false)]);
        // Tab, Enter and Backspace are such characters.
        for (key, character) in [
            (Reported::Tab, '\t'),
            (Reported::Enter, '\r'),
            (Reported::Backspace, '\u{8}'),
        ] {
            let found = keys(&[control, Down(key), Character(character)]);
            assert_eq!(found, [(named(key).expect("egui has it"), false)]);
        }
        let after = |reports: &[KeyReport]| {
            let mut input = Input::default();
            for report in reports {
                input.report(*report);
            }
            input
        };
        let copied = after(&[control, Character('\u{3}')]);
        assert!(copied.events.contains(&Event::Copy));
        let not_copied = after(&[control, Down(Reported::C), Character('\u{9}')]);
        assert!(!not_copied.events.contains(&Event::Copy));
        assert!(after(&[control, Character('\u{16}')]).pastes());
        assert!(!after(&[control, Down(Reported::V), Character('\u{b}')]).pastes());
        assert!(!after(&[Character('\u{13}')]).events.iter().any(|_| true));
    }

    #[test]
    fn keys_have_the_names_of_egui() {
        for (reported, key) in [
            (Reported::Key7, Key::Num7),
            (Reported::NumPad7, Key::Num7),
            (Reported::NumPadPlus, Key::Plus),
            (Reported::Equal, Key::Equals),
            (Reported::LeftBracket, Key::OpenBracket),
            (Reported::PageUp, Key::PageUp),
            (Reported::F12, Key::F12),
            (Reported::Escape, Key::Escape),
        ] {
            assert_eq!(named(reported), Some(key));
        }
        assert_eq!(named(Reported::LeftShift), None);
    }
}
