//! The stored start, cognates, and ways there and back.

use super::exact::Exact;
use super::*;

fn search() -> NinePoints {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../python/kempe/synthesis/nine_points.bin");
    let stored = std::fs::read(path).expect("the stored start");
    assert!(stored.len() <= 100_000);
    let place = |k: u32| {
        let way = f64::from(k) * 0.7;
        Complex::new(way.sin(), 0.5 * (2.0 * way).sin())
    };
    let places: Vec<Complex> = (0..9).map(place).collect();
    assert!(NinePoints::new(&places, &stored[16..]).is_none());
    assert!(NinePoints::new(&places[1..], &stored).is_none());
    NinePoints::new(&places, &stored).expect("solutions of the base")
}

fn apart(one: &Posture, other: &Posture) -> f64 {
    let (one, other) = (one.pivots(), other.pivots());
    let of = |k: usize| (one[k] - other[k]).magnitude() / (1.0 + one[k].magnitude());
    of(0).max(of(1))
}

#[test]
fn the_stored_four_bars_differ() {
    let mut search = search();
    search.ends = search.starts.iter().copied().map(Some).collect();
    assert!((0..PATHS).all(|k| search.is_alone(k, PATHS)));
    // one that ends as another one is followed again, and counts once
    search.ends[7] = search.ends[1000];
    let doubtful: Vec<usize> = (0..PATHS).filter(|k| !search.is_alone(*k, PATHS)).collect();
    assert_eq!(doubtful, [7, 1000]);
    assert_eq!(search.found().1.found, PATHS - 1);
}

#[test]
fn the_same_side_twice_is_no_four_bar() {
    let search = search();
    assert!(search.starts.iter().all(Posture::has_two_sides));
    let mut twice = search.starts[0];
    (0..4).for_each(|k| twice.bars[4 + k] = twice.bars[k]);
    assert!(!twice.has_two_sides());
    twice.bars[4] += Complex::new(1e-12, 0.0);
    assert!(!twice.has_two_sides());
}

#[test]
fn cognates_solve_the_same_equations() {
    let search = search();
    for start in search.starts.iter().step_by(50) {
        let all = start.cognates(&search.base);
        for (k, one) in all.iter().enumerate() {
            let end = settled(*one, &search.base).expect("a solution");
            assert!(apart(&end, start) < 1e-8 && apart(one, &end) < 1e-8);
            let is_other = (end.bars[0] - start.bars[0]).magnitude() > 1e-6;
            assert_eq!(is_other, k > 0);
        }
    }
}

#[test]
fn four_bars_follow_their_points_there_and_back() {
    let search = search();
    for start in search.starts.iter().step_by(120) {
        let there = followed(start, &search.base, &search.target, QUICK).expect("an end");
        let back = followed(&there, &search.target, &search.base, CAREFUL).expect("the start");
        assert!(apart(&back, start) < 1e-9 && apart(&there, start) > 1e-3);
    }
}

#[test]
fn exact_numbers_have_twice_as_many_digits() {
    let z = |re: f64, im: f64| Exact::from(Complex::new(re, im));
    // (1 + ε + i)(1 - ε - i) - (1 - 2 ε i)= 1 - ε², of which numbers with 16 digits lose the last part
    let small = 2.0_f64.powi(-40);
    let product = z(1.0 + small, 1.0) * z(1.0 - small, -1.0);
    let left = (product + z(-2.0, 2.0 * small)).rounded();
    assert_eq!(left, Complex::new(-small * small, 0.0));
}
