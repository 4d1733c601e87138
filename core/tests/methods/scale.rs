//! Work grows in proportion to the mechanism: counted on the N-four-bar, so that no clock is read.

#[path = "../../benches/mechanisms/mod.rs"]
mod mechanisms;

use kempe::equations::Plan;
use mechanisms::chain;

/// The second half of the windows takes as long as the first half, to one in a hundred.
#[test]
fn the_elimination_is_linear() {
    let sizes = [100, 200, 400, 800, 1600];
    let all = sizes.map(|windows| Plan::of_motion(&chain(windows).0).n_products() as f64);
    for (pair, n) in all.windows(2).zip(sizes) {
        let (before, added) = (pair[0] / n as f64, (pair[1] - pair[0]) / n as f64);
        assert!((added / before - 1.0).abs() < 0.01, "{n}: {before} and then {added}");
    }
}
