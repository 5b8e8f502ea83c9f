//! The surfaces that other surfaces hide all around a pixel's centre. Only a gap between those would show them.
//!
//! ```text
//!            .-  -  -.
//!    A     /           \     B       the edges of A, B and C within EDGE pixels of a centre
//!         |      .------+-------
//!    -----+------+      |            a line of sight may miss A, B or C, but none of them misses all three:
//!          \     | C   /             they hide the background
//!            `- -+- -'
//! ```
//! A pixel may show a surface that some line of sight near its centre shows. A few lines suffice, because visibility changes
//! only at edges and where faces penetrate each other. A surface that is visible near the centre is therefore visible beside an edge
//! there, or beside the centre. The lines keep a distance of ROOM pixels from the edge and the centre. Intervals decide on which
//! side of an edge such a line passes. On a common edge itself they cannot decide which face is hit.
//!
//! A face so narrow that no line meets it counts as visible.

use super::picture::{Met, Reference, Seen, shows};
use super::real::Real;
use super::sight::Place;

impl<R: Real> Reference<R> {
    /// Marks the surfaces that lines of sight near `centre` meet but never show. `met` are the cuboids there.
    pub(super) fn mark_hidden(&self, centre: Place, met: &[Met<R>], seen: &mut [Seen<R>]) {
        // The faces that no line has shown so far, and whether a line has met them.
        let mut unseen: Vec<_> = seen.iter().map(|seen| (seen.face(), false)).collect();
        unseen.dedup();
        let edges = met.iter().flat_map(|met| met.cuboid.solid.edges());
        let cuboids = || met.iter().map(|met| met.cuboid);
        let (mut together, mut alone) = (Vec::new(), Vec::new());
        for place in edges.flat_map(|edge| edge.places(centre)) {
            self.meet_at(place, cuboids(), &mut together);
            unseen.retain_mut(|(face, is_met)| {
                let number = face.map(|face| face / 6);
                let own = cuboids().filter(|cuboid| Some(cuboid.number) == number);
                self.meet_at(place, own, &mut alone);
                *is_met |= shows(&alone, *face);
                !shows(&together, *face)
            });
            if unseen.is_empty() {
                return;
            }
        }
        for seen in seen {
            seen.is_hidden = unseen.contains(&(seen.face(), true));
        }
    }
}

#[cfg(test)]
mod tests;
