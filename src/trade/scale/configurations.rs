//! A quantity in; the configurations in which frames are timed out.
//!
//! Rule: in a series nothing varies but its quantity.

use super::{Quantity, scenes};
use crate::components::View;
use crate::scene::Scene;
use crate::trade::Request;

/// The sides of the pictures drawn, as fractions of those asked for: of 1920x1080 they are 480p to 8K.
const SIDES: [[usize; 2]; 6] = [[4, 9], [2, 3], [1, 1], [4, 3], [2, 1], [4, 1]];

/// How many times longer the sides of the largest picture are than those asked for.
pub const LARGEST: usize = 4;

/// Places from which light comes.
const LIGHTS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Cuboids, as far as there is [`ROOM`] for them.
const CUBOIDS: [usize; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];

/// The side in pixels of the square that a cuboid needs: of smaller ones hardly anything would be drawn.
const ROOM: usize = 8;

/// How one frame is drawn.
pub struct Configuration {
    /// Of what varies.
    pub number: usize,
    pub scene: Scene,
    /// Without a method.
    pub view: View,
    /// How many draw it.
    pub threads: usize,
}

/// The configurations of a series.
pub fn configurations(quantity: Quantity, request: &Request) -> Vec<Configuration> {
    let size = request.view.size;
    let own = |number, size, threads| Configuration {
        number,
        scene: request.scene.snapshot(),
        view: View {
            size,
            ..request.view.clone()
        },
        threads,
    };
    let generated = |number, scene: Scene| Configuration {
        number,
        view: View {
            projection: request.view.projection,
            ..View::of(&scene.world, size)
        },
        scene,
        threads: 1,
    };
    match quantity {
        Quantity::Pixels => {
            let sizes = sizes(size).into_iter();
            sizes.map(|size| own(size[0] * size[1], size, 1)).collect()
        }
        Quantity::Lights => {
            let most = LIGHTS[LIGHTS.len() - 1];
            let of_lights = |number| generated(number, scenes::of_lights(number, most));
            LIGHTS.map(of_lights).into()
        }
        Quantity::Cuboids => {
            let numbers = cuboid_counts(size);
            let most = numbers[numbers.len() - 1];
            let of_cuboids = |number| generated(number, scenes::of_cuboids(number, most, size));
            numbers.into_iter().map(of_cuboids).collect()
        }
        Quantity::Threads => {
            let counts = thread_counts(request.threads).into_iter();
            counts.map(|threads| own(threads, size, threads)).collect()
        }
    }
}

/// The sizes of the pictures round one of `size`, each once.
fn sizes(size: [usize; 2]) -> Vec<[usize; 2]> {
    let mut sizes: Vec<[usize; 2]> = SIDES
        .iter()
        .map(|[times, over]| size.map(|side| (side * times).div_ceil(*over)))
        .collect();
    sizes.dedup();
    sizes
}

/// The numbers of cuboids for which a picture of that size has [`ROOM`]; one there always is.
fn cuboid_counts([width, height]: [usize; 2]) -> Vec<usize> {
    let capacity = (width / ROOM) * (height / ROOM);
    let fits = |number: &usize| *number <= capacity.max(1);
    CUBOIDS.into_iter().filter(fits).collect()
}

/// 1, 2, 3, 4, 6, 8, 12, 16 and so on as far as `most`, and `most`.
fn thread_counts(most: usize) -> Vec<usize> {
    let round = |threads: usize| {
        threads.is_power_of_two() || (threads.is_multiple_of(3) && (threads / 3).is_power_of_two())
    };
    (1..=most)
        .filter(|&threads| threads == most || round(threads))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_hd_is_measured_from_480p_to_8k() {
        assert_eq!(
            sizes([1920, 1080]),
            [
                [854, 480],
                [1280, 720],
                [1920, 1080],
                [2560, 1440],
                [3840, 2160],
                [7680, 4320]
            ]
        );
        assert_eq!(sizes([1, 1]), [[1, 1], [2, 2], [4, 4]]);
        assert!(SIDES.iter().all(|[times, over]| times <= &(LARGEST * over)));
    }

    #[test]
    fn cuboids_are_as_many_as_find_room() {
        assert_eq!(cuboid_counts([1920, 1080]).last(), Some(&10_000));
        // 8 times 6 squares.
        assert_eq!(cuboid_counts([64, 48]), [1, 3, 10, 30]);
        assert_eq!(cuboid_counts([16_384, 1]), [1]);
    }

    #[test]
    fn threads_are_counted_up_to_all_of_them() {
        assert_eq!(thread_counts(1), [1]);
        assert_eq!(thread_counts(4), [1, 2, 3, 4]);
        assert_eq!(thread_counts(7), [1, 2, 3, 4, 6, 7]);
        assert_eq!(thread_counts(24), [1, 2, 3, 4, 6, 8, 12, 16, 24]);
    }
}
