//! Time of the sparse LDLᵀ on a four-bar linkage (17 unknowns) and on a hanging chain of 2000 bodies.

use kempe::solve::{bodies_first, Factor, Symbolic};
use std::hint::black_box;
use std::time::Instant;

/// The pattern and the numbers of [M Φᵀ; Φ 0].
struct Matrix {
    n: usize,
    blocks: Vec<usize>,
    entries: Vec<(usize, usize)>,
    values: Vec<f64>,
}

/// A chain of bodies between two ground pins.
fn chain(bodies: usize) -> Matrix {
    let coordinates = 3 * bodies;
    let mut blocks: Vec<usize> = (0..bodies).map(|b| 3 * b).collect();
    let mut entries: Vec<_> = (0..coordinates).map(|i| (i, i)).collect();
    for pin in 0..=bodies {
        let row = coordinates + 2 * pin;
        blocks.push(row);
        for body in [pin.checked_sub(1), (pin < bodies).then_some(pin)].into_iter().flatten() {
            for column in [0, 2] {
                entries.push((row, 3 * body + column));
            }
            for column in [1, 2] {
                entries.push((row + 1, 3 * body + column));
            }
        }
    }
    let values = (0..entries.len()).map(|e| 2.0 + (e as f64).sin()).collect();
    Matrix { n: coordinates + 2 * (bodies + 1), blocks, entries, values }
}

fn main() {
    for (bodies, repeats) in [(3, 2_000_000_usize), (2000, 2000)] {
        let Matrix { n, blocks, entries, values } = chain(bodies);
        let start = Instant::now();
        let order = bodies_first(3 * bodies, n, &entries, Some(&blocks));
        let symbolic = Symbolic::new(n, &entries, &order);
        let symbolic_time = start.elapsed();
        let mut factor = Factor::new(&symbolic);
        let mut x = vec![1.0; n];
        let start = Instant::now();
        for _ in 0..repeats {
            factor.factor(black_box(&symbolic), black_box(&values)).expect("full rank");
        }
        let factor_time = start.elapsed();
        let start = Instant::now();
        for _ in 0..repeats {
            x.fill(1.0);
            factor.solve(black_box(&symbolic), black_box(&mut x));
        }
        let solve_time = start.elapsed();
        println!(
            "{bodies} bodies: n = {n}, {} entries, fill {}; symbolic {symbolic_time:.1?}, factor {:.0} ns, solve {:.0} ns",
            entries.len(),
            symbolic.fill(),
            factor_time.as_secs_f64() * 1e9 / repeats as f64,
            solve_time.as_secs_f64() * 1e9 / repeats as f64,
        );
    }
}
