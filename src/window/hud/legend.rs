//! The session's view -> what explains it: the names beside the divider of a wipe, a word for what is shown instead of
//! the picture, the scale of the error map, the tints of tiles.
//!
//! Rule: what is not computed yet is called so.

use super::lines::{Line, shaded_by};
use crate::prove::{REFUTED, UNDECIDED};
use crate::shading::TileKind;
use crate::trade::error_map::{EDGE, NOTHING, Scale};
use crate::window::session::Session;
use crate::window::views::{TINTS, ViewMode};

/// What the user waits for.
const WAITING: &str = "computing ...";

/// The names of what is left and right of the divider; `None` where there is no divider.
pub fn sides(session: &Session) -> Option<[String; 2]> {
    let state = &session.state;
    if state.shows_reference {
        return None;
    }
    match state.mode {
        ViewMode::GouraudPhong => Some(["Gouraud".to_owned(), "Phong".to_owned()]),
        ViewMode::MethodReference => {
            let known = session.reference.is_some();
            let right = if known { "exact Phong" } else { WAITING };
            Some([shaded_by(session), right.to_owned()])
        }
        ViewMode::Picture | ViewMode::ErrorMap | ViewMode::Tiles => None,
    }
}

/// What else is to be said of the picture.
pub fn lines(session: &Session) -> Vec<Line> {
    let state = &session.state;
    let known = session.reference.is_some();
    let text = |text: &str| Line::Text(text.to_owned());
    let or_waiting = |words| if known { words } else { WAITING };
    if let Some(requires) = &session.requires
        && let Some(part) = requires.left_out.and_then(|it| requires.parts.get(it))
    {
        let known = requires.picture.is_some();
        let waiting = if known { "" } else { ": computing ..." };
        return vec![Line::Text(format!("without {}{waiting}", part.name))];
    }
    if state.shows_reference {
        return vec![text(or_waiting("reference: exact Phong"))];
    }
    match state.mode {
        ViewMode::ErrorMap => {
            let title = or_waiting("in levels, against exact Phong");
            let reference = session.reference.as_ref();
            let scale = reference.map_or(Scale::WIDEST, |it| it.scale);
            let head = [Line::Title("error", title.to_owned()), Line::Scale(scale)];
            with_swatches(&head, &error_swatches(session))
        }
        ViewMode::Tiles => {
            let title = Line::Title("tiles", "squares drawn of each kind".to_owned());
            with_swatches(&[title], &tile_swatches(session))
        }
        ViewMode::Picture if session.is_flat => vec![
            text("One colour: only ambient light reaches"),
            text("the faces seen. Any other light that is"),
            text("on lies in their planes or behind them."),
        ],
        ViewMode::Picture | ViewMode::GouraudPhong | ViewMode::MethodReference => Vec::new(),
    }
}

/// `head`, and below it swatches, two in a row.
fn with_swatches(head: &[Line], swatches: &[(u32, String)]) -> Vec<Line> {
    let rows = swatches.chunks(2).map(|it| Line::Swatches(it.to_vec()));
    head.iter().cloned().chain(rows).collect()
}

/// What is no error: edges, the background, and pixels that are not proven where there are any.
fn error_swatches(session: &Session) -> Vec<(u32, String)> {
    let proof = session.reference.as_ref().and_then(|it| it.proof.as_ref());
    let [undecided, refuted] = proof.map_or([0; 2], |proof| [proof.undecided, proof.refuted]);
    let mut all = vec![(EDGE, "other face"), (NOTHING, "nothing drawn")];
    all.extend((undecided > 0).then_some((UNDECIDED, "undecided")));
    all.extend((refuted > 0).then_some((REFUTED, "refuted")));
    let all = all.into_iter();
    all.map(|(color, text)| (color, text.to_owned())).collect()
}

/// Every kind of tile, and how many of them were drawn.
fn tile_swatches(session: &Session) -> Vec<(u32, String)> {
    let counts = session.times.counts.tiles;
    let kinds = TileKind::ALL.iter().zip(TINTS).zip(counts);
    kinds
        .map(|((kind, tint), count)| (tint, format!("{:<12}{count:>6}", kind.name())))
        .collect()
}
