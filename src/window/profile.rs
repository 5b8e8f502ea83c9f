//! The profile of a wipe, column by column over its lower edge: both sides and exact Phong along a row, and the error of the
//! side that is shown as the gap between, in the colours of the error map.

use egui::{Align2, Color32, Pos2, Rect, Ui, UiBuilder, pos2, vec2};

use super::app::App;
use super::keys::{Command, caption};
use super::style::{EXACT, INK, STALE};
use super::widgets::{CHANNELS, tag};
use crate::components::{Probed, Show};
use crate::paint::color;
use crate::trade::error_map::Pixel;

/// The heights of the curves, the least one that is left of the picture, and that of the bar over the curves, in points.
const HEIGHT: f32 = 84.0;
const ROOM: f32 = 260.0;
const BAR: f32 = 20.0;

impl App {
    /// Lays out the profile over the lower edge of a wipe, so that the pictures keep their size.
    pub fn profile(&mut self, ui: &mut Ui) {
        if self.place.height() < HEIGHT + ROOM {
            return;
        }
        let row = self.profile_row();
        let is_open = !self.desk.profile_folded;
        let height = BAR + if is_open { HEIGHT } else { 0.0 };
        let top = pos2(self.place.min.x, self.place.max.y - height);
        let place = Rect::from_min_max(top, self.place.max);
        if is_open {
            let painter = ui.painter_at(place);
            painter.rect_filled(place, 0.0, Color32::from_black_alpha(225));
            let curves = Rect::from_min_max(top + vec2(0.0, BAR), place.max);
            self.draw_profile(&painter, curves, row);
        }
        let mut bar = ui.new_child(UiBuilder::new().max_rect(place).id_salt("profile"));
        bar.set_clip_rect(self.place);
        let arrow = if is_open { "⏷" } else { "⏵" };
        let key = caption(Command::Profile);
        let fold = bar.small_button(format!("{arrow} levels along row {row}  {key}"));
        if fold
            .on_hover_text("Folds the levels along the row.")
            .clicked()
        {
            self.desk.profile_folded = is_open;
        }
    }

    /// The row of the probed pixel, or the one in the middle.
    pub fn profile_row(&self) -> usize {
        let Probed(pixel) = self.look();
        let height = self.pictures.size()[1];
        pixel.map_or(height / 2, |[_, y]| y.min(height.saturating_sub(1)))
    }

    fn draw_profile(&self, painter: &egui::Painter, place: Rect, row: usize) {
        let show: Show = self.look();
        let width = self.pictures.size()[0];
        let comparison = self.facts.comparison.current();
        let of_row = |pixels| <[u32]>::get(pixels, row * width..(row + 1) * width);
        let sides = [0, 1].map(|index| self.side(index));
        let exact = comparison.and_then(|it| of_row(&it.exact));
        let [Some(left), Some(right)] = sides.each_ref().map(|side| of_row(side)) else {
            return;
        };
        let level = |pixel: u32, channel: usize| f32::from(pixel.to_be_bytes()[1 + channel]);
        let gap = |channel: usize| {
            let levels = left.iter().zip(right);
            let gaps = levels.map(|(left, right)| level(*left, channel) - level(*right, channel));
            gaps.map(f32::abs).fold(0.0, f32::max)
        };
        let larger = |most, next| if gap(next) > gap(most) { next } else { most };
        let channel = (0..3).fold(0, larger);
        let at = |column: usize, pixel: u32| -> Pos2 {
            let x = self.place_of([column, 0]).x;
            let height = level(pixel, channel) / 255.0 * (place.height() - 8.0);
            pos2(x, place.max.y - 4.0 - height)
        };
        let divider = self.divider_column();
        if let (Some(exact), Some(comparison)) = (exact, comparison) {
            for (column, truth) in exact.iter().enumerate() {
                let drawn = if column < divider { left } else { right }[column];
                let error = (level(drawn, channel) - level(*truth, channel)).abs();
                let ink = color(comparison.scale.color(Pixel::Error(error)));
                painter.line_segment([at(column, *truth), at(column, drawn)], (1.5, ink));
            }
        }
        let [left_ink, right_ink] = show.sides.map(|side| self.side_ink(&side));
        let curves = [
            (exact, EXACT),
            (Some(left), left_ink),
            (Some(right), right_ink),
        ];
        for (pixels, ink) in curves {
            let points = pixels.into_iter().flatten().enumerate();
            let points = points.map(|(column, pixel)| at(column, *pixel)).collect();
            painter.line(points, (1.5, ink));
        }
        let x = at(divider, 0).x;
        painter.vline(x, place.y_range(), (1.0, STALE));
        let corner = place.left_top() + vec2(8.0, 2.0);
        tag(painter, Align2::LEFT_TOP, corner, CHANNELS[channel], INK);
    }
}
