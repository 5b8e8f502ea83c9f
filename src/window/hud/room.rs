//! An area and what must stay uncovered in it -> the parts of it where something may stand.
//!
//! ```text
//!   +--------------+      off one obstacle there are four parts, each as large as can be, which overlap in the corners:
//!   |    above     |      right of it, above it, left of it, below it
//!   | left # right |
//!   |    below     |
//!   +--------------+
//! ```
//! Rule: no part has a pixel of an obstacle, and every pixel of the area that no obstacle has is in a part.

use crate::canvas::Rect;

/// The parts of `area` off all `obstacles`, those to the right of the first one first; none is empty.
pub fn parts(area: Rect, obstacles: &[Rect]) -> Vec<Rect> {
    let whole = [area].into_iter().filter(|area| !area.is_empty()).collect();
    obstacles.iter().fold(whole, |parts: Vec<Rect>, obstacle| {
        parts
            .iter()
            .flat_map(|part| around(part, obstacle))
            .collect()
    })
}

/// The parts of `area` off one obstacle.
fn around(area: &Rect, obstacle: &Rect) -> Vec<Rect> {
    let hole = area.intersection(obstacle);
    if hole.is_empty() {
        return vec![*area];
    }
    let between = |left: i32, top: i32, right: i32, bottom: i32| {
        Rect::new(left, top, right - left, bottom - top)
    };
    let (right, bottom) = (area.right(), area.bottom());
    [
        between(hole.right(), area.y, right, bottom),
        between(area.x, area.y, right, hole.y),
        between(area.x, area.y, hole.x, bottom),
        between(area.x, hole.bottom(), right, bottom),
    ]
    .into_iter()
    .filter(|part| !part.is_empty())
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn off_one_obstacle_there_are_four_parts() {
        let area = Rect::new(0, 0, 100, 80);
        let obstacle = Rect::new(40, 30, 10, 20);
        let expected = [
            Rect::new(50, 0, 50, 80),
            Rect::new(0, 0, 100, 30),
            Rect::new(0, 0, 40, 80),
            Rect::new(0, 50, 100, 30),
        ];
        assert_eq!(parts(area, &[obstacle]), expected);
    }

    #[test]
    fn an_obstacle_at_the_edge_or_outside_takes_what_it_has_of_the_area() {
        let area = Rect::new(10, 10, 100, 80);
        let corner = Rect::new(0, 0, 30, 30);
        let expected = [Rect::new(30, 10, 80, 80), Rect::new(10, 30, 100, 60)];
        assert_eq!(parts(area, &[corner]), expected);
        assert_eq!(parts(area, &[Rect::new(200, 0, 5, 500)]), [area]);
        assert_eq!(parts(area, &[Rect::new(0, 0, 500, 500)]), []);
        assert_eq!(parts(Rect::new(5, 5, 0, 9), &[]), []);
    }

    #[test]
    fn a_pixel_is_in_a_part_exactly_where_no_obstacle_has_it() {
        let area = Rect::new(0, 0, 12, 10);
        let obstacles = [Rect::new(2, 3, 4, 4), Rect::new(5, -1, 3, 6)];
        let parts = parts(area, &obstacles);
        for (x, y) in (0..10).flat_map(|y| (0..12).map(move |x| (x, y))) {
            let has = |rects: &[Rect]| rects.iter().any(|rect| rect.contains([x, y]));
            assert_eq!(has(&parts), !has(&obstacles), "({x}, {y})");
        }
    }
}
