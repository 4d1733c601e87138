//! Samples that are the same on every machine: from whole numbers by operations that IEEE 754 rounds exactly.

use super::plane::abs;
use kempe::math::{Complex, Field, Random};

/// The golden angle, which spreads directions evenly: its cosine and sine.
const GOLDEN: Complex = Complex::new(-0.737_368_878_078_319_7, 0.675_490_294_261_523_6);

/// Places around the task: directions are even, and few are far away. The logarithm of the distance has a logistic
/// distribution with the standard deviation 0.9.
pub fn scattered(random: &mut Random, n: usize) -> Vec<Complex> {
    let mut way = loop {
        let at = Complex::new(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0);
        let square = at.re * at.re + at.im * at.im;
        if (0.01..1.0).contains(&square) {
            let size = square.sqrt();
            break Complex::new(at.re / size, at.im / size);
        }
    };
    let mut places = Vec::with_capacity(n);
    for _ in 0..n {
        let share = random.uniform();
        let far = (share / (1.0 - share)).sqrt();
        places.push(Complex::new(far * way.re, far * way.im));
        way = way * GOLDEN;
    }
    places
}

/// Which of `n` things are among `most` of them, each choice with the same probability.
pub fn chosen(random: &mut Random, n: usize, most: usize) -> Vec<bool> {
    let mut left = most.min(n);
    (0..n)
        .map(|k| {
            let taken = random.uniform() * ((n - k) as f64) < left as f64;
            left -= usize::from(taken);
            taken
        })
        .collect()
}

/// A place divided by its distance from zero, and this distance.
pub fn direction(at: Complex) -> (Complex, f64) {
    let far = abs(at);
    (at * Complex::from_real(1.0 / far), far)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_spread_and_do_not_change() {
        let places = scattered(&mut Random::new(7), 4000);
        let logs: Vec<f64> = places.iter().map(|at| abs(*at).ln()).collect();
        let mean = logs.iter().sum::<f64>() / 4000.0;
        let spread = (logs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 4000.0).sqrt();
        assert!(mean.abs() < 0.05 && (spread - 0.907).abs() < 0.05, "{mean} {spread}");
        let side = places.iter().filter(|at| at.re > 0.0).count();
        assert!((1950..2050).contains(&side));
        let chosen = chosen(&mut Random::new(1), 1000, 300);
        assert_eq!(chosen.iter().filter(|taken| **taken).count(), 300);
        assert!(chosen[..500].iter().filter(|taken| **taken).count() > 100);
    }
}
