//! What the system reports, an [`Event`] at a time -> what the user meant by it, a [`Gesture`].
//!
//! Rule: one press of a key is one gesture, whatever the system repeats and however often it reports the same press; a
//! press of the mouse that moves less than [`DRAG_DISTANCE`] pixels is a click, any other a drag.

use std::time::Duration;

use minifb::Key;

use super::bindings::{Action, Binding, Modifiers, bound_to_character, bound_to_key};
use crate::canvas::Point;

/// From how many pixels on a press that moves is a drag.
pub const DRAG_DISTANCE: i32 = 4;
/// How long a key is held before what it does goes on.
const REPEAT_DELAY: Duration = Duration::from_millis(300);
/// The time from one repetition to the next.
const REPEAT_INTERVAL: Duration = Duration::from_millis(16);
/// The same character sooner than this is the system's repetition, for no finger is as fast.
const CHARACTER_INTERVAL: Duration = Duration::from_millis(120);

/// The letters that numbers are typed with; what they call up otherwise waits until the editor is closed.
const NUMBERS: &str = "0123456789.+-eE";

/// What the system reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A key went down, or is held and reported again.
    KeyDown(Key),
    /// A key went up.
    KeyUp(Key),
    /// The character of a press; follows its [`Event::KeyDown`] where the system knows the key.
    Character(char),
    /// Keys are no longer reported, nor that they go up.
    FocusLost,
    /// The mouse is here now.
    MouseAt(Point),
    /// The left button went down.
    MouseDown,
    /// The left button went up.
    MouseUp,
    /// The wheel turned by so many notches; away from the user is positive.
    Wheel(i32),
}

/// What the user meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gesture {
    /// A key called this up, by going down, going up or being held; or a drag ended.
    Command(Action),
    /// The mouse moved to here, no button held.
    Hover(Point),
    /// A press and its release, here.
    Click(Point),
    /// The mouse went down at `from` and has moved on by `by` since it was last told.
    Drag {
        /// Where the button went down.
        from: Point,
        /// Right and down.
        by: Point,
        modifiers: Modifiers,
    },
    /// The wheel turned while the mouse was at `at`.
    Wheel {
        /// Where the mouse is.
        at: Point,
        /// Away from the user is positive.
        notches: i32,
        modifiers: Modifiers,
    },
}

/// A key that is down, what it called up, and when that goes on if it does.
struct Held {
    key: Key,
    binding: Option<&'static Binding>,
    due: Duration,
}

impl Held {
    fn repeating(&self) -> Option<&'static Binding> {
        self.binding.filter(|it| it.repeats)
    }
}

/// A button that is down.
#[derive(Clone, Copy)]
struct Press {
    from: Point,
    /// Up to where drags have been told; `None` while the press may still be a click.
    told: Option<Point>,
}

/// What is known of the press that the next character belongs to.
#[derive(Clone, Copy, Default, PartialEq)]
enum LastPress {
    /// Nothing: the layout has a key there that the system cannot name.
    #[default]
    Unknown,
    /// A key that is bound to nothing went down just now.
    Unbound,
    /// A bound key, or one that is reported again: its character says nothing new.
    Answered,
}

/// What is down at the moment.
#[derive(Default)]
pub struct Input {
    held: Vec<Held>,
    last_press: LastPress,
    last_character: Option<(char, Duration)>,
    mouse: Point,
    press: Option<Press>,
    /// Whether numbers are typed into the editor.
    pub is_editing: bool,
}

impl Input {
    /// What `event` at the time `now` means, if anything.
    pub fn handle(&mut self, event: Event, now: Duration) -> Option<Gesture> {
        match event {
            Event::KeyDown(key) => self.key_down(key, now),
            Event::KeyUp(key) => {
                self.last_press = LastPress::Unknown;
                self.release(|held| held.key == key)
            }
            Event::Character(character) => self.character(character, now),
            Event::FocusLost => self.release(|_| true),
            Event::MouseAt(point) => self.mouse_at(point),
            Event::MouseDown => {
                self.press = Some(Press {
                    from: self.mouse,
                    told: None,
                });
                None
            }
            Event::MouseUp => {
                let press = self.press.take()?;
                Some(match press.told {
                    None => Gesture::Click(press.from),
                    Some(_) => Gesture::Command(Action::EndDrag),
                })
            }
            Event::Wheel(notches) => Some(Gesture::Wheel {
                at: self.mouse,
                notches,
                modifiers: self.modifiers(),
            }),
        }
    }

    /// What goes on at the time `now` because its key is held; ask until there is nothing more.
    pub fn repeated(&mut self, now: Duration) -> Option<Gesture> {
        self.held.iter_mut().find_map(|held| {
            let binding = held.repeating().filter(|_| now >= held.due)?;
            // After a pause it goes on from now: what was missed is not made up for.
            let next = held.due + REPEAT_INTERVAL;
            held.due = if next > now {
                next
            } else {
                now + REPEAT_INTERVAL
            };
            Some(Gesture::Command(binding.action))
        })
    }

    /// Whether a key or the button is down.
    pub fn is_busy(&self) -> bool {
        self.press.is_some() || self.held.iter().any(|held| held.repeating().is_some())
    }

    /// Forgets those keys; returns what ends with them. Only B has such an action, so at most one is returned.
    fn release(&mut self, of: impl Fn(&Held) -> bool) -> Option<Gesture> {
        let released = self.held.extract_if(.., |held| of(held));
        let ends = released.filter_map(|held| held.binding?.on_release).last();
        ends.map(Gesture::Command)
    }

    fn key_down(&mut self, key: Key, now: Duration) -> Option<Gesture> {
        let modifiers = self.modifiers();
        let types = |binding: &Binding| {
            let mut characters = binding.characters.iter();
            self.is_editing && !modifiers.control && characters.any(|it| NUMBERS.contains(*it))
        };
        let binding = bound_to_key(key, modifiers, self.is_editing).filter(|it| !types(it));
        let again = self.held.iter().any(|held| held.key == key);
        self.last_press = if again || binding.is_some() {
            LastPress::Answered
        } else {
            LastPress::Unbound
        };
        if again {
            return None;
        }
        let due = now + REPEAT_DELAY;
        self.held.push(Held { key, binding, due });
        binding.map(|binding| Gesture::Command(binding.action))
    }

    fn character(&mut self, character: char, now: Duration) -> Option<Gesture> {
        let repeated = self
            .last_character
            .replace((character, now))
            .is_some_and(|(last, time)| last == character && now < time + CHARACTER_INTERVAL);
        match std::mem::take(&mut self.last_press) {
            LastPress::Answered => return None,
            LastPress::Unknown if repeated => return None,
            LastPress::Unknown | LastPress::Unbound => {}
        }
        if self.is_editing && NUMBERS.contains(character) {
            return Some(Gesture::Command(Action::Type(character)));
        }
        bound_to_character(character).map(|binding| Gesture::Command(binding.action))
    }

    /// The keys that are held with others.
    fn modifiers(&self) -> Modifiers {
        let is_held = |keys: [Key; 2]| self.held.iter().any(|held| keys.contains(&held.key));
        Modifiers {
            shift: is_held([Key::LeftShift, Key::RightShift]),
            control: is_held([Key::LeftCtrl, Key::RightCtrl]),
        }
    }

    fn mouse_at(&mut self, point: Point) -> Option<Gesture> {
        if self.mouse == point {
            return None;
        }
        self.mouse = point;
        let Some(press) = &mut self.press else {
            return Some(Gesture::Hover(point));
        };
        let told = press.told.unwrap_or(press.from);
        let by = [point[0] - told[0], point[1] - told[1]];
        if press.told.is_none() && by[0].pow(2) + by[1].pow(2) < DRAG_DISTANCE.pow(2) {
            return None;
        }
        press.told = Some(point);
        let from = press.from;
        Some(Gesture::Drag {
            from,
            by,
            modifiers: self.modifiers(),
        })
    }
}
