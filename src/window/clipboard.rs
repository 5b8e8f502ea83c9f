//! The clipboard of the system. It belongs to another program, which may hang, so it is read by a thread.

use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::thread;
use std::time::Duration;

use anyhow::anyhow;

/// How long a read may take. A later text is not pasted, because the user has gone on.
pub const PATIENCE: Duration = Duration::from_secs(1);

type Text = anyhow::Result<String>;

#[derive(Default)]
pub struct Clipboard {
    /// It is opened when it is used first, because closing it takes a second.
    system: Option<arboard::Clipboard>,
    reading: Option<Reading>,
}

impl Clipboard {
    /// Puts a text on it.
    ///
    /// # Errors
    /// If there is none.
    pub fn copy(&mut self, text: String) -> anyhow::Result<()> {
        let system = match &mut self.system {
            Some(system) => system,
            None => self.system.insert(arboard::Clipboard::new()?),
        };
        Ok(system.set_text(text)?)
    }

    /// Begins to read it, in place of an earlier read.
    pub fn read(&mut self, now: Duration) {
        self.reading = Some(Reading::begin(now, || {
            Ok(arboard::Clipboard::new()?.get_text()?)
        }));
    }

    /// The text, once it is read, or the reason why there is none.
    pub fn receive(&mut self, now: Duration) -> Option<Text> {
        let text = self.reading.as_ref()?.receive(now)?;
        self.reading = None;
        Some(text)
    }
}

/// A read by a thread, which ends by itself if nobody waits for it any more.
pub struct Reading {
    answer: Receiver<Text>,
    until: Duration,
}

impl Reading {
    pub fn begin(now: Duration, read: impl FnOnce() -> Text + Send + 'static) -> Self {
        let (tell, answer) = mpsc::channel();
        thread::spawn(move || {
            // Nobody listens if it took too long.
            let _ = tell.send(read());
        });
        let until = now + PATIENCE;
        Reading { answer, until }
    }

    pub fn receive(&self, now: Duration) -> Option<Text> {
        match self.answer.try_recv() {
            Ok(text) => Some(text),
            Err(TryRecvError::Empty) if now < self.until => None,
            Err(_) => Some(Err(anyhow!(
                "the program that has the text does not answer"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use anyhow::Context;

    use super::*;

    #[test]
    fn a_text_is_waited_for_in_vain_for_a_second() {
        let (answer, asked) = mpsc::channel::<Text>();
        let read = move || asked.recv().context("nobody answers")?;
        let start = Duration::from_secs(7);
        let reading = Reading::begin(start, read);
        assert!(reading.receive(start).is_none());
        assert!(reading.receive(start + PATIENCE / 2).is_none());
        let late = reading.receive(start + PATIENCE).expect("an end");
        assert!(late.is_err());
        // A text in time.
        answer.send(Ok("77".to_owned())).expect("it is read");
        let text = loop {
            if let Some(text) = reading.receive(start) {
                break text;
            }
            thread::yield_now();
        };
        assert_eq!(text.expect("a text"), "77");
    }
}
