//! A recording -> its frames, drawn again without a display.
//!
//! Rule: a frame is the picture as it was seen, with the boards that lay over it. The panel is left out, for its times
//! are the machine's; so is the proof in the error map, for it takes seconds a frame.

use std::io::{self, Write};
use std::time::Duration;

use fearless_simd::Level;

use super::composition::Composition;
use super::examination::examine;
use super::hud::Hud;
use super::jobs::Progress;
use super::recording::{Event, Log, LogFrame};
use super::session::{Redraw, Session};
use crate::drawing::Drawing;
use crate::output::{Animation, Output, say};
use crate::trade::progress::with_bar;

/// How long the last frame of an animation is shown.
const LAST: Duration = Duration::from_secs(2);

/// A window without a display.
pub struct Player {
    session: Session,
    composition: Composition,
    level: Level,
    /// Of the picture, in pixels.
    pub size: [usize; 2],
    /// The picture alone.
    pub picture: Vec<u32>,
    /// What is seen, 0x00RRGGBB, row by row from the top.
    pub shown: Vec<u32>,
}

impl Player {
    /// Opens it.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(start: Drawing) -> anyhow::Result<Self> {
        let (size, level) = (start.size, start.level);
        let composition = Composition::new(start.workers()?);
        let mut session = Session::new(start);
        session.state.panel = false;
        Ok(Player {
            session,
            composition,
            level,
            size,
            picture: Vec::new(),
            shown: Vec::new(),
        })
    }

    /// Lets happen what happened at one time, and draws what is seen then.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn play(&mut self, frame: LogFrame) -> anyhow::Result<()> {
        self.session.tick(frame.time);
        for event in frame.events {
            if let Event::Size(size) = event {
                self.size = size;
            }
            self.session.happens(event);
        }
        // Nobody is there to time frames or to save them.
        self.session.take_requests();
        let redraw = self.session.take_redraw();
        if redraw == Redraw::Nothing {
            return Ok(());
        }
        if redraw == Redraw::Picture {
            self.composition.draw(&mut self.session, self.size)?;
        }
        let state = &self.session.state;
        if (state.mode.compares() || state.shows_reference) && self.session.reference.is_none() {
            let mut snapshot = self.session.snapshot(self.size);
            if let Some(result) = examine(&mut snapshot, self.level, &|| false)? {
                let progress = Progress::Examined(result);
                self.session.on_progress(snapshot.revision, progress);
            }
        }
        self.composition.compose(&self.session, &mut self.picture);
        let hud = Hud::new(&self.session, self.size);
        hud.draw(&self.picture, false, &mut self.shown);
        Ok(())
    }
}

/// Replays `log`: writes its last frame, or all of them where `animated`, and prints a hash of each where that is asked for:
/// CRC-32 of its pixels, four bytes each.
///
/// # Errors
/// When a frame does not fit in memory, or something cannot be written.
pub fn run(
    log: Log,
    output: Option<&Output>,
    animated: bool,
    with_hashes: bool,
) -> anyhow::Result<()> {
    let count = log.frames.len();
    let canvas = log.canvas();
    let times: Vec<Duration> = log.frames.iter().map(|frame| frame.time).collect();
    let last = times[count - 1];
    let ends = times.iter().skip(1).copied().chain([last + LAST]);
    let frames = log.frames.into_iter().zip(ends);
    let mut player = Player::new(log.start)?;
    let mut hashes = Vec::new();
    with_bar(|on_progress| {
        let mut done = 0_usize;
        let mut play = |player: &mut Player, frame: LogFrame| {
            let time = frame.time.as_secs_f64();
            player.play(frame)?;
            let bytes: Vec<u8> = player
                .shown
                .iter()
                .flat_map(|it| it.to_be_bytes())
                .collect();
            writeln!(hashes, "{time:.3} {:08x}", crc32fast::hash(&bytes))?;
            done += 1;
            on_progress("replaying", done as f64 / count as f64);
            anyhow::Ok(())
        };
        match output {
            Some(output) if animated => output.write(|writer| {
                let mut animation = Animation::new(writer, canvas, count)?;
                for (frame, end) in frames {
                    let time = end.saturating_sub(frame.time);
                    play(&mut player, frame).map_err(io::Error::other)?;
                    animation.add(&player.shown, player.size, time)?;
                }
                animation.finish()
            }),
            _ => {
                for (frame, _) in frames {
                    play(&mut player, frame)?;
                }
                output.map_or(Ok(()), |it| it.write_png(&player.shown, player.size))
            }
        }
    })?;
    if with_hashes {
        Output::Stdout.write(|writer| writer.write_all(&hashes))?;
    }
    let written = output.map_or_else(String::new, |it| format!("; wrote {}", it.name()));
    let seconds = last.as_secs_f64();
    say(&format!(
        "replayed {count} frames of {seconds:.3} s{written}"
    ));
    Ok(())
}
