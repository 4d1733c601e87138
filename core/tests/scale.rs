//! Work and memory grow in proportion to the mechanism: counted on the N-four-bar, so that no clock is asked.

#[path = "../benches/mechanisms/mod.rs"]
mod mechanisms;

use kempe::equations::augmented::Augmented;
use kempe::equations::Workspace;
use kempe::solve::Bytes;
use mechanisms::chain;

fn bytes(windows: usize) -> Bytes {
    let (model, _) = chain(windows);
    Workspace::new(&model).bytes(&model)
}

/// What the second half of the windows adds is what the first half took, to one in a hundred.
#[test]
fn memory_is_linear() {
    let sizes = [100, 200, 400, 800, 1600];
    let all = sizes.map(bytes);
    for (pair, n) in all.windows(2).zip(sizes) {
        let per_window = |of: fn(&Bytes) -> usize| {
            let added = (of(&pair[1]) - of(&pair[0])) as f64;
            (added / n as f64, of(&pair[0]) as f64 / n as f64)
        };
        for (added, before) in [per_window(|b| b.held), per_window(|b| b.touched)] {
            assert!((added / before - 1.0).abs() < 0.01, "{n}: {before} and then {added}");
        }
    }
}

/// A window is two bodies and three joints; with more, a thousand of them leave the nearer caches.
#[test]
fn an_evaluation_touches_little_memory() {
    let Bytes { held, touched } = bytes(400);
    assert!(touched < 1700 * 400, "{} bytes a window", touched / 400);
    assert!(held < 2600 * 400, "{} bytes a window", held / 400);
}

/// From 1503 coordinates to 6003: four times the work.
#[test]
fn the_plan_is_found_in_linear_time() {
    let effort = |windows: usize| Augmented::<f64>::new(&chain(windows).0).effort() as f64;
    let growth = effort(1000) / effort(250);
    assert!((3.9..4.1).contains(&growth), "{growth}");
}
