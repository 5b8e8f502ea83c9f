//! The canvas: the place of the picture in the window, and the pictures that are drawn for it.

use std::borrow::Cow;
use std::sync::Arc;
use std::time::Duration;

use egui::{Pos2, Rect, vec2};
use hecs::World;

use super::facts::Facts;
use super::pictures::{Pictures, or_dimmed, sides};
use crate::components::{Projection, Side, View, ViewMode, Viewer};
use crate::output::memory::{self, OutOfMemory};
use crate::scene::SceneRecord;
use crate::scene::unseen::shows_all;
use crate::systems::frame::Workers;

/// The time without a change after which the picture is compared and measured.
pub const REST: Duration = Duration::from_millis(100);

/// The factor from one fit of a narrow picture to the next.
const FIT_STEP: f64 = 1.1;
/// A divider that is dragged stays this share of the picture's width away from either edge.
const DIVIDER_MARGIN: f64 = 0.02;

/// The picture on screen.
pub struct Canvas {
    pub pictures: Pictures,
    /// The place of the picture, in points.
    pub place: Rect,
    /// Pixels of the window in a point.
    pub scale: f32,
    /// A picture that is too narrow shows this many times the height of its camera.
    pub fit: f64,
    /// The size, the camera and the projection for which that was found.
    fitted: Option<([usize; 2], Option<String>, Projection)>,
    /// The state and the view that were drawn last.
    pub drawn: Option<(Arc<SceneRecord>, View)>,
    /// When the picture last changed, until it rests.
    moved: Option<Duration>,
}

impl Canvas {
    pub fn new(workers: Workers) -> Self {
        Canvas {
            pictures: Pictures::new(workers),
            place: Rect::ZERO,
            scale: 1.0,
            fit: 1.0,
            fitted: None,
            drawn: None,
            moved: None,
        }
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [usize; 2] {
        let size = self.place.size() * self.scale;
        [size.x, size.y].map(|side| (side.round() as usize).max(1))
    }

    /// The pixel of the picture at a place in the window, or the nearest one.
    pub fn pixel_at(&self, at: Pos2) -> [usize; 2] {
        let place = (at - self.place.min) * self.scale;
        let [width, height] = self.size();
        let pixel = |at: f32, side: usize| (at.max(0.0) as usize).min(side - 1);
        [pixel(place.x, width), pixel(place.y, height)]
    }

    /// The place in the window of the middle of a pixel.
    pub fn place_of(&self, [x, y]: [usize; 2]) -> Pos2 {
        self.place_at([x as f64 + 0.5, y as f64 + 0.5])
    }

    /// The place in the window of a point of the picture, in pixels from its upper left corner.
    pub fn place_at(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.place.min + vec2(x as f32, y as f32) / self.scale
    }

    /// The pixel that is explained, if it lies in the picture.
    pub fn pixel(&self, viewer: &Viewer) -> Option<[usize; 2]> {
        viewer.pixel_in(self.size(), self.rows())
    }

    /// The pixels of the camera's height.
    pub fn rows(&self) -> f64 {
        self.size()[1] as f64 / self.fit
    }

    /// Fits what is shown into a narrow picture that would cut cuboids off which one of 4:3 shows. The camera stays as it is.
    /// While the user moves it in this picture the fit stays, too.
    pub fn fit(&mut self, world: &World, viewer: &Viewer) {
        let [width, height] = self.size();
        let present = ([width, height], viewer.camera.clone(), viewer.projection);
        if self.fitted.as_ref() == Some(&present) {
            return;
        }
        self.fitted = Some(present);
        let shows_all = |width, fit| {
            let view = View::of(world, [width, height]);
            let camera = view.camera.widened(fit);
            shows_all(world, &View { camera, ..view })
        };
        let [wide, _] = self.wide_size();
        let most = wide as f64 / width as f64;
        self.fit = 1.0;
        while self.fit < most && !shows_all(width, self.fit) && shows_all(wide, 1.0) {
            self.fit = most.min(self.fit * FIT_STEP);
        }
    }

    /// The size of the picture, or of one of 4:3 that is as high and wider.
    pub fn wide_size(&self) -> [usize; 2] {
        let [width, height] = self.size();
        [width.max(height * 4 / 3), height]
    }

    /// Fits the picture anew: another scene or place of the camera is shown.
    pub fn fit_again(&mut self) {
        self.fitted = None;
    }

    /// The width of which the divider is a share. A picture narrower than 4:3 shows the middle of one of 4:3, so the divider
    /// is at the same place of the scene in both.
    fn divided_width(&self) -> f64 {
        let [width, _] = self.size();
        (self.rows() * 4.0 / 3.0).max(width as f64)
    }

    /// The first column right of the divider.
    pub fn divider_column(&self, viewer: &Viewer) -> usize {
        let [width, _] = self.size();
        let offset = (viewer.divider - 0.5) * self.divided_width();
        let column = (width as f64 / 2.0 + offset).round();
        (column.max(0.0) as usize).min(width)
    }

    /// The divider at a column, or at the nearest one that is not too near to an edge.
    pub fn divider_at(&self, column: f64) -> f64 {
        let [width, _] = self.size().map(|it| it as f64);
        let column = column.clamp(DIVIDER_MARGIN * width, (1.0 - DIVIDER_MARGIN) * width);
        0.5 + (column - width / 2.0) / self.divided_width()
    }

    /// The picture that is shown in a column.
    pub fn side_at(&self, viewer: &Viewer, column: usize) -> Side {
        sides(viewer)[usize::from(column >= self.divider_column(viewer))]
    }

    /// The milliseconds of the last frame, where a frame of another state is to be drawn now.
    pub fn last_frame(&self, state: &Arc<SceneRecord>) -> Option<f64> {
        let (drawn, _) = self.drawn.as_ref()?;
        self.pictures.time.filter(|_| !Arc::ptr_eq(drawn, state))
    }

    /// Lets the picture rest if nothing has changed for [`REST`]. The layout tells of it, and comes next.
    pub fn rest(&mut self, now: Duration) {
        self.moved.take_if(|moved| now >= *moved + REST);
    }

    /// Whether nothing has changed for [`REST`].
    pub fn rests(&self) -> bool {
        self.moved.is_none()
    }

    /// Draws the pictures of `world`, whose state this is, if the state or the view is another one.
    ///
    /// # Errors
    /// If they do not fit in memory.
    pub fn draw(
        &mut self,
        now: Duration,
        world: &mut World,
        state: &Arc<SceneRecord>,
        view: View,
    ) -> Result<(), OutOfMemory> {
        let drawn = self.drawn.as_ref();
        if drawn.is_none_or(|it| !Arc::ptr_eq(&it.0, state) || it.1 != view) {
            self.pictures.draw(world, &state.view, &view)?;
            self.moved = Some(now);
            self.drawn = Some((Arc::clone(state), view));
        }
        Ok(())
    }

    /// The picture of a side of a wipe, left (0) or right (1), 0x00RRGGBB.
    fn side<'a>(&'a self, viewer: &Viewer, facts: &'a Facts, index: usize) -> Cow<'a, [u32]> {
        let exact = facts.comparison.current().map(|it| &*it.exact);
        match viewer.sides[index] {
            Side::Reference => or_dimmed(exact, self.pictures.frame.pixels()),
            _ => Cow::from(&self.pictures.sides[index]),
        }
    }

    /// The picture as it is shown, 0x00RRGGBB. `turn` is the place of the picture that has its turn while two blink.
    pub fn shown<'a>(
        &'a self,
        viewer: &Viewer,
        facts: &'a Facts,
        turn: Option<usize>,
    ) -> Cow<'a, [u32]> {
        let comparison = facts.comparison.current();
        let exact = comparison.map(|it| it.exact.as_slice());
        let frame = self.pictures.frame.pixels();
        match (viewer.show, turn) {
            (ViewMode::Wipe, Some(turn)) => self.side(viewer, facts, turn),
            (_, Some(0)) => or_dimmed(exact, frame),
            (ViewMode::Picture, _) | (_, Some(_)) => frame.into(),
            (ViewMode::Error, None) => or_dimmed(comparison.map(|it| &*it.error_map), frame),
            (ViewMode::Tiles, None) => self.pictures.tiles().into(),
            (ViewMode::Terms, None) => Cow::from(&self.pictures.terms),
            (ViewMode::Wipe, None) => {
                let width = self.pictures.frame.size()[0];
                let divider = self.divider_column(viewer).min(width);
                let mut pixels = self.side(viewer, facts, 0).into_owned();
                let right = self.side(viewer, facts, 1);
                let lines = pixels.chunks_exact_mut(width);
                for (left, right) in lines.zip(right.chunks_exact(width)) {
                    left[divider..].copy_from_slice(&right[divider..]);
                }
                pixels.into()
            }
        }
    }

    /// Copies a picture into its place in a window of `size` pixels, and fills the rest with `ground`.
    pub fn copy(
        &self,
        shown: &[u32],
        pixels: &mut Vec<u32>,
        [width, height]: [usize; 2],
        ground: u32,
    ) {
        memory::clear(pixels, width * height);
        pixels.resize(width * height, ground);
        let columns = self.pictures.frame.size()[0];
        let corner = self.place.min * self.scale;
        let [left, top] = [corner.x, corner.y].map(|it| it.round() as usize);
        let lines = pixels.chunks_exact_mut(width).skip(top);
        for (line, drawn) in lines.zip(shown.chunks_exact(columns)) {
            let line = line.get_mut(left..).unwrap_or_default();
            let count = line.len().min(columns);
            line[..count].copy_from_slice(&drawn[..count]);
        }
    }
}
