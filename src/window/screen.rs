//! The picture on screen: drawn when its state or size is another one, and copied into its place in the window.

use std::borrow::Cow;
use std::sync::Arc;

use super::app::{App, REST, TURN};
use super::edits::is_another_scene;
use super::facts::Question;
use super::pictures::{divider_column, or_dimmed};
use crate::components::{Side, View, ViewMode, Viewer};
use crate::memory::{self, OutOfMemory};
use crate::output::{encode_png, write_numbered};
use crate::scene::SceneRecord;

impl App {
    /// Width and height of the picture in pixels.
    pub fn picture_size(&self) -> [usize; 2] {
        let size = self.place.size() * self.scale();
        [size.x, size.y].map(|side| (side.round() as usize).max(1))
    }

    /// The pixel that is explained, if it lies in the picture.
    pub fn pixel(&self) -> Option<[usize; 2]> {
        self.viewer().pixel_in(self.picture_size())
    }

    /// The view that is drawn.
    pub fn view(&self) -> View {
        let view = View::of(&self.scene.world, self.picture_size());
        let held = self.held.map(|method| method.view(&view));
        held.unwrap_or(view)
    }

    /// Outdates the facts about the picture on screen if another one is to be drawn, and stops the work on them.
    pub(super) fn outdate(&mut self) {
        let Some((before, view_before)) = self.drawn.clone() else {
            return;
        };
        let (after, view) = (Arc::clone(&self.state), self.view());
        if Arc::ptr_eq(&before, &after) && view == view_before {
            return;
        }
        let shown = |it: &SceneRecord| (it.view.show, it.view.sides, it.view.divider);
        let by_any_method = |view: View| view.unshaded().with_tolerance(0.0);
        let is_same_view =
            by_any_method(view) == by_any_method(view_before) && !is_another_scene(&before, &after);
        if !is_same_view || view != view_before || before.cuboid != after.cuboid {
            self.work = None;
            self.facts.outdate(is_same_view);
        } else if shown(&before) != shown(&after)
            || before.view.pixel != after.view.pixel
                && (self.probed().is_none() || after.view.show == ViewMode::Wipe)
        {
            self.work.take_if(|work| work.question == Question::Probe);
            self.facts.section.is_current = false;
        }
    }

    /// Draws the pictures if the state or the view is another one.
    pub(super) fn draw(&mut self) -> Result<(), OutOfMemory> {
        let view = self.view();
        let present = (Arc::clone(&self.state), view);
        if self.drawn.as_ref() == Some(&present) {
            self.moved.take_if(|moved| self.now >= *moved + REST);
        } else {
            let viewer = Viewer::clone(&self.viewer());
            self.pictures.draw(&mut self.scene.world, &viewer, &view)?;
            self.moved = Some(self.now);
            self.drawn = Some(present);
        }
        Ok(())
    }

    /// The place of the picture that has its turn while two of them blink: the sides of a wipe, else exact Phong and the
    /// picture.
    pub fn turn(&self) -> Option<usize> {
        let passed = self.now.saturating_sub(self.desk.blinks?);
        Some((passed.as_millis() / TURN.as_millis()) as usize % 2)
    }

    /// The picture of a side of a wipe, left (0) or right (1), 0x00RRGGBB.
    pub fn side(&self, index: usize) -> Cow<'_, [u32]> {
        let sides = self.viewer().sides;
        let exact = self.facts.comparison.current().map(|it| &*it.exact);
        match sides[index] {
            Side::Reference => or_dimmed(exact, self.pictures.frame.pixels()),
            _ => Cow::from(&self.pictures.sides[index]),
        }
    }

    /// The picture as it is shown, 0x00RRGGBB.
    pub fn shown(&self) -> Cow<'_, [u32]> {
        let viewer = self.viewer();
        let comparison = self.facts.comparison.current();
        let exact = comparison.map(|it| it.exact.as_slice());
        let frame = self.pictures.frame.pixels();
        match (viewer.show, self.turn()) {
            (ViewMode::Wipe, Some(turn)) => self.side(turn),
            (_, Some(0)) => or_dimmed(exact, frame),
            (ViewMode::Picture, _) | (_, Some(_)) => frame.into(),
            (ViewMode::Error, None) => or_dimmed(comparison.map(|it| &*it.error_map), frame),
            (ViewMode::Tiles, None) => self.pictures.tiles().into(),
            (ViewMode::Wipe, None) => {
                let width = self.pictures.frame.size()[0];
                let divider = divider_column(viewer.divider, width);
                let (mut pixels, right) = (self.side(0).into_owned(), self.side(1));
                let lines = pixels.chunks_exact_mut(width);
                for (left, right) in lines.zip(right.chunks_exact(width)) {
                    left[divider..].copy_from_slice(&right[divider..]);
                }
                pixels.into()
            }
        }
    }

    /// Copies the picture into its place in the window.
    pub(super) fn copy_picture(&mut self, [width, height]: [usize; 2]) {
        let mut pixels = std::mem::take(&mut self.pixels);
        self.size = [width, height];
        // A panel may paint less than it takes: contents that are too wide are cut off.
        let ground = self.painter.context.global_style().visuals.panel_fill;
        let [red, green, blue, _] = ground.to_array();
        let ground = u32::from_be_bytes([0, red, green, blue]);
        memory::clear(&mut pixels, width * height);
        pixels.resize(width * height, ground);
        let columns = self.pictures.frame.size()[0];
        let corner = self.place.min * self.scale();
        let [left, top] = [corner.x, corner.y].map(|it| it.round() as usize);
        let lines = pixels.chunks_exact_mut(width).skip(top);
        for (line, drawn) in lines.zip(self.shown().chunks_exact(columns)) {
            let line = line.get_mut(left..).unwrap_or_default();
            let count = line.len().min(columns);
            line[..count].copy_from_slice(&drawn[..count]);
        }
        self.pixels = pixels;
    }

    /// Writes the window as it is seen into a new PNG file.
    pub(super) fn screenshot(&mut self) {
        let name = |number| format!("shadetrade-{number:03}.png");
        let encoded = encode_png(&self.pixels, self.size).map_err(anyhow::Error::from);
        match encoded.and_then(|file| write_numbered(&self.folder, name, &file)) {
            Ok(path) => self.say(format!("saved {}", path.display())),
            Err(error) => self.say(format!("no picture saved: {error:#}")),
        }
    }
}
