//! The questions that the program answers about a scene. Each command of that name prints its answer, and most are tabs of the
//! window.
//!
//! | question | where |
//! |---|---|
//! | the time and the error of each method | [`trade`] |
//! | the error against one number of the scene | [`mod@vary`] |
//! | whether each pixel keeps the tolerance | [`mod@prove`] |
//! | the parts of the model that a picture needs | [`mod@requires`] |
//! | the evaluation at one pixel | [`probe`] |
//! | whether extreme numbers are drawn right | [`extremes`] |
//! | pictures: `render` and the assignment's figures | [`figures`] |
//! | the scene for other renderers | [`export`] |
//! | the scene, size and threads of a question | [`job`] |
//! | the errors of a picture | [`metrics`] |
//! | the text and the JSON that a command prints | the file of the question, or `command.rs` or `export.rs` below it |
//!
//! # Who may import whom
//!
//! ```text
//! vary         extremes     figures
//! trade        prove        requires     probe      export
//! job          metrics
//! ```

pub mod export;
pub mod extremes;
pub mod figures;
pub mod job;
pub mod metrics;
pub mod probe;
pub mod prove;
pub mod requires;
pub mod trade;
pub mod vary;
