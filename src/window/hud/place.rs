//! A box and what it should not cover -> where it stands.
//!
//! Rule: it stands at the place wished for, at an edge of the area or beside an obstacle, wherever it covers least: least
//! of the first obstacles, among those places least of the second, and so on.

use crate::canvas::{Point, Rect};

/// How many pixels of each group of obstacles are covered, the most important group first.
pub type Covered = Vec<i64>;

/// Where in `area` a box of `size` stands; `None` where it does not fit. `wish` is its upper left corner where it covers
/// nothing there.
pub fn place(
    size: [i32; 2],
    area: Rect,
    wish: Point,
    obstacles: &[&[Rect]],
) -> Option<(Rect, Covered)> {
    let along = |axis: usize, start: i32, end: i32, edges: &dyn Fn(&Rect) -> [i32; 2]| {
        let last = end - size[axis];
        let beside = obstacles.iter().copied().flatten().flat_map(|obstacle| {
            let [low, high] = edges(obstacle);
            [high, low - size[axis]]
        });
        let all = [wish[axis].clamp(start, last.max(start)), start, last];
        let all = all.into_iter().chain(beside);
        all.filter(|at| (start..=last).contains(at))
            .collect::<Vec<_>>()
    };
    let across = along(0, area.x, area.right(), &|it| [it.x, it.right()]);
    let down = along(1, area.y, area.bottom(), &|it| [it.y, it.bottom()]);
    let places = down.iter().flat_map(|y| across.iter().map(|x| (*x, *y)));
    places
        .map(|(x, y)| {
            let rect = Rect::new(x, y, size[0], size[1]);
            let covered = |group: &&[Rect]| group.iter().map(|it| common_pixels(&rect, it)).sum();
            (rect, obstacles.iter().map(covered).collect::<Covered>())
        })
        .min_by(|(_, one), (_, other)| one.cmp(other))
}

fn common_pixels(one: &Rect, other: &Rect) -> i64 {
    let common = one.intersection(other);
    i64::from(common.width) * i64::from(common.height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_stands_where_it_covers_least_of_what_matters_most() {
        let area = Rect::new(10, 20, 60, 50);
        let first = [Rect::new(10, 20, 25, 20)];
        let second = [Rect::new(30, 30, 40, 40)];
        for width in [5, 20, 40, 60] {
            for height in [5, 15, 30, 50] {
                for wish in [[10, 20], [40, 60], [0, 0], [500, 500]] {
                    let (rect, covered) =
                        place([width, height], area, wish, &[&first, &second]).expect("it fits");
                    assert_eq!(rect.intersection(&area), rect);
                    // No place of a naive search over all pixels is better.
                    for y in area.y..=area.bottom() - height {
                        for x in area.x..=area.right() - width {
                            let other = Rect::new(x, y, width, height);
                            let other = [&first, &second]
                                .map(|it| it.iter().map(|it| common_pixels(&other, it)).sum());
                            assert!(covered[..] <= other[..], "{rect:?} {x} {y}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_free_wish_is_granted_and_what_is_too_large_has_no_place() {
        let area = Rect::new(0, 0, 100, 80);
        let obstacles = [Rect::new(0, 0, 30, 30)];
        let granted = place([10, 10], area, [50, 40], &[&obstacles]);
        assert_eq!(granted, Some((Rect::new(50, 40, 10, 10), vec![0])));
        assert_eq!(place([101, 10], area, [0, 0], &[]), None);
        assert_eq!(place([10, 81], area, [0, 0], &[]), None);
    }
}
