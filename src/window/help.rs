//! The help: every key, and the words of the window, each with its sentence. The sentences are tooltips, too.

use egui::{Grid, Id, Modal, ScrollArea, Ui, Vec2, vec2};

use super::keys::{BINDINGS, Binding, caption_of};

/// The width of the words, in points.
const WORDS_WIDTH: f32 = 260.0;

/// The words that a beginner needs, in the order of the help.
const WORDS: [(&str, &str); 19] = [
    (
        "vertex",
        "A corner: of a cuboid, or of the grid of segments on its faces.",
    ),
    (
        "segment",
        "One of the equal parts of an edge. More segments give Gouraud more vertices.",
    ),
    (
        "normal",
        "The direction that a surface faces. The faces at a corner share its normal (smooth edges), or each has its own (sharp edges).",
    ),
    (
        "Gouraud",
        "Light is computed at the vertices, and its colours are interpolated between them.",
    ),
    (
        "Phong",
        "Normals are interpolated between the vertices, and light is computed at every pixel.",
    ),
    ("ambient", "Light from everywhere: the same on all faces."),
    (
        "diffuse",
        "Light that a surface scatters: the more, the straighter it faces the lamp.",
    ),
    (
        "specular",
        "Light that a surface mirrors towards the eye: it makes the highlight.",
    ),
    (
        "highlight",
        "The bright spot where the mirrored lamp is seen. It is the smaller, the larger the shininess.",
    ),
    (
        "level",
        "The brightness of a colour channel: 0 is dark, 255 is full. Scenes may have levels beyond; they are clamped.",
    ),
    (
        "exact Phong",
        "The best picture of the scene: the model evaluated at every pixel, in f64.",
    ),
    (
        "error",
        "The difference between the drawn and the exact level, in levels of 255. Below half a level no displayed value changes by more than one of 255.",
    ),
    (
        "tolerance",
        "The largest error of a pixel against the exact evaluation of its mode, in levels of 255. A coarser tolerance is faster, and 0 is exact.",
    ),
    (
        "proven",
        "Interval arithmetic encloses the exact level of each pixel. A pixel is proven if its drawn level is within the tolerance of all of its interval, or within 0.05 if the tolerance is 0.",
    ),
    (
        "reference",
        "A second renderer in f64 that shares no code with the first: the exact picture that errors are measured against.",
    ),
    (
        "highlight kept",
        "The share of the highlight's light that is where exact Phong has it.",
    ),
    (
        "best trade",
        "A method that no other one beats: none is both faster and more exact. The grey line of the chart joins them.",
    ),
    (
        "square",
        "The renderer draws in squares of 2 to 32 pixels. Where a bound proves it, a polynomial stands for the model in the whole square.",
    ),
    (
        "budget",
        "The longest time that a frame may take. The most exact method that keeps it is chosen.",
    ),
];

/// The sentence about a word.
pub fn about(word: &str) -> &'static str {
    let found = WORDS.iter().find(|(own, _)| *own == word);
    found.map_or("", |(_, says)| says)
}

/// Lays out the list of keys. Returns whether it stays open.
pub fn help(ui: &Ui) -> bool {
    let room = (ui.ctx().content_rect().size() - vec2(60.0, 120.0)).max(Vec2::ZERO);
    let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
        ui.set_width(room.x.min(560.0 + WORDS_WIDTH));
        ui.heading("Keys and words");
        ui.weak("H or Esc closes this. Tab goes to the next control; most have a tooltip.");
        ui.weak("A click explains a pixel. Ctrl with +, - or 0 sizes the letters.");
        ui.weak("The line between two pictures can be dragged (F3, F4). So can the disc of a lamp, beside");
        ui.weak("that line or while the scene is edited (E). An arrow points to a lamp outside: zoom out.");
        let scroll = ScrollArea::both().max_height(room.y);
        scroll.min_scrolled_height(room.y).show(ui, |ui| {
            let (left, right) = BINDINGS.split_at(BINDINGS.len() / 2);
            ui.horizontal_top(|ui| {
                key_table(ui, left);
                ui.add_space(16.0);
                key_table(ui, right);
                ui.add_space(16.0);
                ui.vertical(|ui| {
                    ui.set_width(WORDS_WIDTH);
                    ui.strong("Words");
                    for (word, says) in WORDS {
                        ui.label(word);
                        ui.weak(says);
                    }
                });
            });
        });
    });
    !modal.should_close()
}

/// A table of keys; the name of its first section tells it from others.
fn key_table(ui: &mut Ui, sections: &[(&str, &[Binding])]) {
    Grid::new(sections[0].0).show(ui, |ui| {
        for (section, rows) in sections {
            ui.strong(*section);
            ui.end_row();
            for (name, _, keys) in *rows {
                let keys: Vec<String> = keys.iter().map(caption_of).collect();
                ui.label(*name);
                ui.weak(keys.join("  "));
                ui.end_row();
            }
        }
    });
}
