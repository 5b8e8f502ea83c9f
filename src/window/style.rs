//! The look of the panels: one text size, calm colours, no animations.

use egui::{Color32, Context, TextStyle, Theme};

use crate::components::ShadingMode;

/// The colour of numbers about an earlier picture.
pub const STALE: Color32 = Color32::from_gray(95);
/// The colour of numbers about the picture on screen.
pub const INK: Color32 = Color32::from_gray(220);
pub const GOOD: Color32 = Color32::from_rgb(0x3c, 0xb8, 0x7c);
pub const BAD: Color32 = Color32::from_rgb(0xff, 0x6b, 0x5a);
/// The curves and dots of Gouraud and Phong.
pub const GOURAUD: Color32 = Color32::from_rgb(0xff, 0xb4, 0x54);
pub const PHONG: Color32 = Color32::from_rgb(0x34, 0xd3, 0x99);
/// The dots of the interpolated unit vectors.
const SHORTCUT: Color32 = Color32::from_rgb(0xcc, 0x79, 0xa7);

/// The colour of a method's dot.
pub fn mode_ink(mode: ShadingMode) -> Color32 {
    match mode {
        ShadingMode::Gouraud => GOURAUD,
        ShadingMode::Phong => PHONG,
        ShadingMode::UnitVectors => SHORTCUT,
    }
}

/// Sets the look of all widgets.
pub fn apply(context: &Context) {
    context.set_theme(Theme::Dark);
    context.all_styles_mut(|style| {
        // An animation would draw frames while nothing changes.
        style.animation_time = 0.0;
        for (name, font) in &mut style.text_styles {
            font.size = match name {
                TextStyle::Small => 11.0,
                TextStyle::Monospace => 12.0,
                TextStyle::Heading => 15.0,
                _ => 13.0,
            };
        }
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        // Bars in sight say that there is more.
        style.spacing.scroll = egui::style::ScrollStyle::thin();
        style.spacing.slider_width = 110.0;
        style.spacing.combo_width = 110.0;
        style.visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(200);
    });
}
