//! The least scene: the parts left out together, and the tolerance that the remaining scene keeps.

use shadetrade::questions::requires::{Part, changes, least, without};
use shadetrade::scene::LightRecord;

use super::{cubes, from_z};
use crate::support::prelude::*;

#[test]
fn as_many_parts_are_left_out_as_the_tolerance_allows_together() {
    use Part::{Cuboid, Light};
    let lights: Vec<Part> = (1..8).map(Light).collect();
    let faint = [100.0, 0.12, 0.12, 0.12, 0.12, 0.12, 0.12, 0.12];
    for (levels, candidates, expected) in [
        // Of two lights that matter only together one stays.
        (&[100.0, 0.3, 0.4][..], &lights[..2], &lights[..1]),
        (&[100.0, 0.2, 0.2], &lights[..2], &lights[..2]),
        (&[100.0, 0.6, 0.7], &lights[..2], &[]),
        (&faint, &lights, &lights[..4]),
        // The second cuboid is hidden by the first.
        (&[100.0], &[Cuboid(1)], &[Cuboid(1)]),
        // Nearly the colour of the background: one cuboid stays even if it is invisible.
        (&[20.3], &[Cuboid(0), Cuboid(1)], &[Cuboid(0)]),
    ] {
        let mut view = from_z(8.0, Projection::Perspective);
        view.background = DVec3::splat(20.0);
        let light = |levels: &f64| (LightKind::Ambient, *levels, DVec3::ZERO);
        let shining: Vec<_> = levels.iter().map(light).collect();
        let places = [DVec3::ZERO, DVec3::Z * -4.0].map(at);
        let scene = cubes(&places, &shining, &view);
        let (left_out, change) = done(least(&scene, &view, candidates, Monitor::NONE));
        assert_eq!(left_out, expected, "{levels:?}");
        assert!(change.keeps(0.5), "{change:?}");
        // The remaining parts are those of the full scene minus those left out.
        let remains = without(&scene, &left_out);
        let lights = SceneRecord::of(&remains.world).light;
        let is_left =
            |(index, it): (usize, &LightRecord)| it.on != left_out.contains(&Light(index));
        assert!(lights.iter().enumerate().all(is_left), "{lights:?}");
        for (scene, left_out, tolerance) in [(&scene, left_out, 0.5), (&remains, vec![], 0.0)] {
            let found = done(changes(scene, &view, &[left_out], Monitor::NONE));
            assert!(found[0].keeps(tolerance));
        }
    }
}
