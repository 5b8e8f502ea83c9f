//! A frame that has been drawn once takes no more memory, whatever is drawn next at that size.

use allocation_counter::measure;
use fearless_simd::Level;
use shadetrade::components::Light;
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::systems;

use crate::life::{Move, still_life, views};

#[test]
fn a_warm_frame_on_one_thread_allocates_nothing() {
    for keep in [Keep::Display, Keep::Levels] {
        for cuboids in [1, 3] {
            let mut world = still_life(cuboids, Move::NONE);
            let workers = Workers::new(1, Level::new()).expect("one thread is always there");
            let mut frame = Frame::new(keep, workers);
            let views = views([160, 120], Move::NONE);
            systems::draw(&mut world, &views[0], &mut frame).expect("a small picture fits");
            for view in &views {
                for on in [true, false, true] {
                    world
                        .query_mut::<&mut Light>()
                        .into_iter()
                        .for_each(|light| light.on = on);
                    let taken = measure(|| {
                        systems::draw(&mut world, view, &mut frame).expect("it fitted before");
                    });
                    assert_eq!(
                        taken.count_total, 0,
                        "{keep:?}, {cuboids} cuboids, {view:?}"
                    );
                }
            }
        }
    }
}
