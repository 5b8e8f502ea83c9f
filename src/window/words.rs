//! The words of the window, each with its sentence: in the help, and as tooltips where they stand.

/// The words that a beginner needs, in the order of the help.
pub const WORDS: [(&str, &str); 19] = [
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
        "A second renderer in f64 that shares no formula with the first: the exact picture that errors are measured against.",
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
