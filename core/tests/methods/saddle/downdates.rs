//! Rows with negative pivots, which remove inertia that was added to W.

use super::matrix::{chain, hub, Matrix, Random};
use super::{dense_solve, norm, right_side};
use kempe::solve::{Breakdown, Pattern, RowBlock, Saddle};

/// The matrix with κ added at some coordinates, with a row for each addition that removes it.
fn with_additions(m: &Matrix, additions: &[(usize, usize, f64)]) -> (Pattern, Saddle<f64>) {
    let mut more = m.clone();
    for &(group, place, weight) in additions {
        let mass = &mut more.masses[group];
        mass[place] += weight;
        let touches = vec![(group, 3 * more.entries.len())];
        more.blocks.push(RowBlock { size: 1, touches, signs: vec![] });
        more.entries.push(std::array::from_fn(|c| f64::from(u8::from(c == place))));
    }
    let all: Vec<usize> = (0..m.blocks.len()).collect();
    let before = vec![all; additions.len()];
    let pattern = more.pattern_with_downdates(&before);
    let mut saddle = more.saddle(&pattern);
    saddle.downdates = additions.iter().map(|(.., weight)| -1.0 / weight).collect();
    (pattern, saddle)
}

/// At angles and at points, at several bodies and twice at one body.
#[test]
fn additions_are_removed_to_rounding() {
    let mut random = Random(41);
    for m in [chain(2, &mut random), chain(9, &mut random), hub(6, &mut random)] {
        for additions in [
            vec![(0, 2, 0.7)],
            vec![(1, 2, 3.0), (0, 2, 1.0)],
            vec![(0, 0, 2.0), (0, 1, 2.0), (1, 2, 0.5)],
        ] {
            let (pattern, mut saddle) = with_additions(&m, &additions);
            let b = right_side(&m, &mut random);
            let mut x = b.clone();
            x.extend(vec![0.0; additions.len()]);
            let mut beside = x.clone();
            saddle.factor_and_solve(&pattern, &mut beside).unwrap();
            saddle.factor(&pattern).unwrap();
            saddle.solve(&pattern, &mut x);
            let reference = dense_solve(m.dense(), b);
            for x in [&x, &beside] {
                let apart: Vec<f64> = x.iter().zip(&reference).map(|(x, y)| x - y).collect();
                assert!(norm(&apart) < 1e-11 * norm(&reference), "{additions:?}");
            }
            // the multiplier of the row is the force of the addition
            for ((group, place, weight), mu) in additions.iter().zip(&x[m.n()..]) {
                let force = -weight * reference[3 * group + place];
                assert!((mu - force).abs() < 1e-10 * norm(&reference), "{additions:?}");
            }
            assert!(saddle.cancellation(&pattern).is_some_and(|(row, _)| row < m.rows()));
        }
    }
}

/// A group with hardly any inertia of its own, which no row holds: the digits of its pivot are lost. Solutions need
/// corrections, and without digits the pivot is refused.
#[test]
fn an_addition_that_is_almost_all_the_inertia() {
    let mut random = Random(43);
    let mut m = chain(3, &mut random);
    for d in &mut m.masses {
        (d[3], d[4]) = (0.0, 0.0);
    }
    m.blocks.clear();
    m.entries.clear();
    for (own, outcome) in [(1e-14, Err(Breakdown::Row(0))), (1e-9, Ok(true)), (1.0, Ok(false))] {
        m.masses[1] = [own, own, own, 0.0, 0.0];
        let (pattern, mut saddle) = with_additions(&m, &[(1, 2, 1.0)]);
        let found = saddle.factor(&pattern).map(|()| saddle.is_inexact(&pattern));
        assert_eq!(found, outcome, "{own}");
    }
}
