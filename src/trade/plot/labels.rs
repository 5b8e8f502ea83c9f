//! Points and the widths of their labels in, places for the labels out.
//!
//! Rule: no label overlaps another one, a point or an obstacle as long as there is room; earlier points choose first,
//! and each takes the place nearest to it.

/// Pixels from a point's centre within which no label lies.
const CLEARANCE: i32 = 8;
/// The height of a label in pixels.
pub const HEIGHT: i32 = 16;
/// How far up and down a label goes to find room, in steps of half its height.
const FARTHEST: i32 = 40;

/// A rectangle: left, top, right, bottom in pixels, the latter two outside.
pub type Rectangle = [i32; 4];

/// Where the labels of `points` go, given their `widths`: within `bounds` and off the `obstacles` if there is room.
pub fn places(
    points: &[[i32; 2]],
    widths: &[i32],
    obstacles: &[Rectangle],
    bounds: Rectangle,
) -> Vec<Rectangle> {
    let mut taken: Vec<Rectangle> = points
        .iter()
        .map(|[x, y]| [x - CLEARANCE, y - CLEARANCE, x + CLEARANCE, y + CLEARANCE])
        .chain(obstacles.iter().copied())
        .collect();
    let mut found = Vec::new();
    for (&point, &width) in points.iter().zip(widths) {
        let free = |place: &Rectangle| {
            within(*place, bounds) && !taken.iter().any(|other| overlap(*place, *other))
        };
        let place = candidates(point, width)
            .find(free)
            .unwrap_or(beside(point, width, 0, 1));
        taken.push(place);
        found.push(place);
    }
    found
}

/// What a horizontal or vertical line between these two points takes.
pub fn around([from, to]: [[i32; 2]; 2]) -> Rectangle {
    [
        from[0].min(to[0]) - 1,
        from[1].min(to[1]) - 1,
        from[0].max(to[0]) + 2,
        from[1].max(to[1]) + 2,
    ]
}

/// All places for a label, the nearest first, on the right before the left.
fn candidates(point: [i32; 2], width: i32) -> impl Iterator<Item = Rectangle> {
    (0..=FARTHEST).flat_map(move |step| {
        [(-1, 1), (1, 1), (-1, -1), (1, -1)]
            .map(|(up, side)| beside(point, width, up * step * HEIGHT / 2, side))
    })
}

/// The place `down` pixels below the height of the point, on its right (1) or left (-1).
fn beside([x, y]: [i32; 2], width: i32, down: i32, side: i32) -> Rectangle {
    let left = if side > 0 {
        x + CLEARANCE + 2
    } else {
        x - CLEARANCE - 2 - width
    };
    let top = y + down - HEIGHT / 2;
    [left, top, left + width, top + HEIGHT]
}

fn overlap(a: Rectangle, b: Rectangle) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

fn within(a: Rectangle, b: Rectangle) -> bool {
    a[0] >= b[0] && a[1] >= b[1] && a[2] <= b[2] && a[3] <= b[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rectangle = [0, 0, 900, 500];

    fn assert_apart(points: &[[i32; 2]]) {
        let places = places(points, &vec![130; points.len()], &[], BOUNDS);
        for (index, place) in places.iter().enumerate() {
            assert!(within(*place, BOUNDS), "{place:?}");
            assert!(!places[..index].iter().any(|other| overlap(*place, *other)));
            let covers = |[x, y]: &[i32; 2]| overlap(*place, [*x, *y, x + 1, y + 1]);
            assert!(!points.iter().any(covers), "{place:?} hides a point");
        }
    }

    #[test]
    fn a_lone_label_stands_to_the_right_of_its_point() {
        assert_eq!(
            places(&[[100, 100]], &[50], &[], BOUNDS),
            [[110, 92, 160, 108]]
        );
    }

    #[test]
    fn a_label_at_the_right_edge_stands_to_the_left() {
        assert_eq!(
            places(&[[890, 100]], &[50], &[], BOUNDS),
            [[830, 92, 880, 108]]
        );
    }

    #[test]
    fn a_label_leaves_a_line_legible() {
        let line = [0, 100, 900, 101];
        let [place] = places(&[[100, 100]], &[50], &[line], BOUNDS)[..] else {
            panic!("one point has one label")
        };
        assert_eq!(place, [110, 84, 160, 100]);
    }

    #[test]
    fn labels_of_points_in_one_place_are_all_legible() {
        assert_apart(&[[450, 250]; 9]);
        assert_apart(&[[880, 490]; 9]);
        assert_apart(&[[5, 5]; 9]);
    }

    #[test]
    fn labels_of_points_in_a_row_are_all_legible() {
        let row: Vec<[i32; 2]> = (0..9).map(|i| [500 + 4 * i, 490]).collect();
        assert_apart(&row);
    }
}
