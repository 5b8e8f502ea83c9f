//! Paints egui's shapes into a buffer of pixels: the widgets of the window, and the text and lines of figures.
//!
//! A pixel is `0x00RRGGBB`. Where egui has painted, its top byte is egui's alpha.

use egui::{Color32, Context, FullOutput, RawInput, Rect, Ui, pos2};
use egui_software_backend::{BufferMutRef, ColorFieldOrder, EguiSoftwareRender};

/// The state of egui, and a software rasterizer for its triangles.
pub struct Painter {
    pub context: Context,
    rasterizer: EguiSoftwareRender,
}

impl Default for Painter {
    fn default() -> Self {
        Painter {
            context: Context::default(),
            // Painting only the changed parts is slower here than painting everything.
            rasterizer: EguiSoftwareRender::new(ColorFieldOrder::Bgra).with_caching(false),
        }
    }
}

impl Painter {
    /// Paints the output of one pass of egui over `pixels`, row by row from the top.
    pub fn paint(&mut self, output: FullOutput, pixels: &mut [u32], [width, height]: [usize; 2]) {
        let scale = output.pixels_per_point;
        let triangles = self.context.tessellate(output.shapes, scale);
        // The bytes of a little-endian 0xAARRGGBB are blue, green, red and alpha.
        let mut buffer = BufferMutRef::new(bytemuck::cast_slice_mut(pixels), width, height);
        self.rasterizer
            .render(&mut buffer, &triangles, &output.textures_delta, scale);
    }
}

/// The whole area of `size` pixels.
pub fn area(size: [usize; 2]) -> Rect {
    Rect::from_min_max(egui::Pos2::ZERO, pos2(size[0] as f32, size[1] as f32))
}

/// The colour of egui for `0x00RRGGBB`.
pub fn color(pixel: u32) -> Color32 {
    let [_, red, green, blue] = pixel.to_be_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Draws text and shapes over a finished picture; one point is one pixel.
pub fn annotate(pixels: &mut [u32], size: [usize; 2], draw: impl FnMut(&mut Ui)) {
    let mut painter = Painter::default();
    let input = RawInput {
        screen_rect: Some(area(size)),
        ..RawInput::default()
    };
    let output = painter.context.run_ui(input, draw);
    painter.paint(output, pixels, size);
    for pixel in pixels {
        *pixel &= 0x00ff_ffff;
    }
}

#[cfg(test)]
mod tests {
    use egui::{Align2, FontId};

    use super::*;

    #[test]
    fn text_and_shapes_are_painted_in_their_colors_at_their_positions() {
        let size = [40, 30];
        let mut pixels = vec![0x0012_3456; size[0] * size[1]];
        annotate(&mut pixels, size, |ui| {
            let painter = ui.painter();
            let bar = Rect::from_min_max(pos2(2.0, 3.0), pos2(6.0, 9.0));
            painter.rect_filled(bar, 0.0, color(0x00ff_8000));
            painter.text(
                pos2(20.0, 15.0),
                Align2::LEFT_TOP,
                "I",
                FontId::monospace(12.0),
                Color32::WHITE,
            );
        });
        let at = |x: usize, y: usize| pixels[y * size[0] + x];
        assert_eq!(
            [at(1, 3), at(2, 3), at(5, 8), at(6, 8), at(5, 9)],
            [
                0x0012_3456,
                0x00ff_8000,
                0x00ff_8000,
                0x0012_3456,
                0x0012_3456
            ]
        );
        let lit = |x: std::ops::Range<usize>| {
            x.flat_map(|x| (0..30).map(move |y| (x, y)))
                .filter(|&(x, y)| at(x, y) & 0xff > 0x90)
                .count()
        };
        assert!(lit(20..30) > 5);
        assert_eq!(lit(0..20) + lit(30..40), 0);
    }
}
