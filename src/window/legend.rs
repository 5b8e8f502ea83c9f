//! The meaning of the colours of the error map and of tiles, in a corner of the picture.

use egui::color_picker::show_color;
use egui::{Color32, Response, Sense, Ui, vec2};

use super::app::App;
use super::pictures::TINTS;
use crate::components::ViewMode;
use crate::paint::color;
use crate::shading::TileKind;
use crate::trade::error_map::{EDGE, NOTHING, Scale};

impl App {
    /// The meaning of the colours of the error map or of tiles.
    pub fn legend(&self, ui: &mut Ui) {
        match self.viewer().show {
            ViewMode::Error => self.error_legend(ui),
            ViewMode::Tiles => {
                let counts = self.pictures.frame.counts().tiles;
                let kinds = TileKind::ALL.iter().zip(TINTS).zip(counts);
                ui.label("squares, by the colour in them");
                for ((kind, tint), count) in kinds {
                    let row = swatch(ui, tint, &format!("{count} {}", kind.name()));
                    row.on_hover_text(match kind {
                        TileKind::Linear => "Squares with a colour linear in x and y.",
                        TileKind::Quadratic => "Squares with a colour quadratic in x and in y.",
                        TileKind::Terminator => {
                            "As quadratic, where n.l of one light changes sign."
                        }
                        _ => "Squares in which the model is evaluated at each pixel.",
                    });
                }
            }
            ViewMode::Picture | ViewMode::Wipe => {}
        }
    }

    /// The scale of the error map, with marks at the tolerance and at the largest error.
    fn error_legend(&self, ui: &mut Ui) {
        ui.label("error against exact Phong, levels");
        let comparison = self.facts.comparison.current();
        let scale = comparison.map_or(Scale::WIDEST, |it| it.scale);
        let size = vec2(ui.available_width().min(260.0), 26.0);
        let (place, response) = ui.allocate_exact_size(size, Sense::hover());
        response.on_hover_text("Levels of 255. White marks: the tolerance and the largest error.");
        let painter = ui.painter_at(place);
        scale.draw(&painter, place, Color32::GRAY);
        let largest = comparison.and_then(|it| it.error);
        let marks = [Some(self.viewer().tolerance), largest];
        for mark in marks.into_iter().flatten() {
            // The scale leaves room for its last label.
            let share = scale.position(mark) as f32;
            let x = place.min.x + share * (place.width() - place.height());
            painter.vline(x, place.min.y..=place.center().y, (1.5, Color32::WHITE));
        }
        self.wait(ui, &self.facts.comparison);
        swatch(ui, EDGE, "another face is seen");
        swatch(ui, NOTHING, "nothing is drawn");
    }
}

fn swatch(ui: &mut Ui, pixel: u32, text: &str) -> Response {
    let row = ui.horizontal(|ui| {
        show_color(ui, color(pixel), vec2(14.0, 14.0));
        ui.label(text)
    });
    row.inner
}
