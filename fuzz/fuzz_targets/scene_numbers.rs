//! Fuzzes the numbers of a scene over the ranges of the scene format. The first eight bytes are the seed of a random scene, and
//! each further eight are that of a change of one number.
#![no_main]

#[path = "../promises.rs"]
mod promises;

/// The builder of random scenes that the tests use.
#[expect(dead_code, reason = "the tests use more of it")]
mod support {
    #[path = "../../../tests/it/support/extreme.rs"]
    pub mod extreme;
    #[path = "../../../tests/it/support/random.rs"]
    pub mod random;
    #[path = "../../../tests/it/support/random_scene.rs"]
    pub mod random_scene;
    #[path = "../../../tests/it/support/records.rs"]
    pub mod records;
    #[path = "../../../tests/it/support/scene.rs"]
    pub mod scene;
}

use libfuzzer_sys::fuzz_target;
use shadetrade::components::{ShadingMode, View};
use support::extreme::{exaggerated, flatten, graze};
use support::random::Random;
use support::random_scene::Case;

fuzz_target!(|bytes: &[u8]| {
    let seed = |bytes: &[u8]| bytes.iter().fold(0, |seed, byte| seed << 8 | u64::from(*byte));
    let mut seeds = bytes.chunks(8).map(seed);
    let case = Case {
        seed: seeds.next().unwrap_or_default(),
        mode: ShadingMode::Phong,
    };
    let tolerances = [0.5, 0.05, 1e-4, 4.0, 255.0];
    let mut record = case.record(tolerances[case.seed as usize % tolerances.len()]);
    for seed in seeds {
        let random = &mut Random(seed);
        match random.below(8) {
            0 => graze(&mut record, random),
            1 => flatten(&mut record, random),
            _ => record = exaggerated(&record, random),
        }
        if record.check().is_err() {
            return;
        }
    }
    let mut world = record.spawn();
    let view = View::of(&world, [37, 29]);
    promises::check(&mut world, &view);
});
