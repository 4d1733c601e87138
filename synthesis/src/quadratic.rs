//! The least of a quadratic function within linear limits, from its dual: multipliers that are not negative, found by
//! the method of active sets (Lawson and Hanson 1974, chapter 23; Bro and de Jong 1997).

use kempe::solve::solve_dense;

/// Part of the largest curvature of the dual by which a limit yields, so that limits that contradict or repeat each
/// other have multipliers too.
const YIELDING: f64 = 1e-12;
/// Part of the largest slope of the dual that counts as zero.
const ZERO: f64 = 1e-13;

/// A sum of products.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Adds a multiple of a vector to another one.
pub(crate) fn add(to: &mut [f64], factor: f64, x: &[f64]) {
    to.iter_mut().zip(x).for_each(|(to, x)| *to += factor * x);
}

/// A matrix (n, n), row by row, times a vector.
pub(crate) fn times(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    let (n, mut found) = (x.len(), x.to_vec());
    for (k, one) in found.iter_mut().enumerate() {
        *one = dot(&matrix[k * n..(k + 1) * n], x);
    }
    found
}

/// The step d that makes g·d + ½ d·B d least, with row·d + room >= 0 for each limit, and the multipliers of the limits.
/// Where no step satisfies all limits, it satisfies them as far as possible. `inverse` is that of B.
pub(crate) fn step(
    inverse: &[f64],
    slope: &[f64],
    rows: &[Vec<f64>],
    room: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let m = rows.len();
    let mut d = times(inverse, slope);
    d.iter_mut().for_each(|x| *x = -*x);
    let mut moved = Vec::new();
    rows.iter().for_each(|row| moved.push(times(inverse, row)));
    let (mut curvature, mut right, mut most) = (vec![0.0; m * m], vec![0.0; m], 0.0_f64);
    for i in 0..m {
        right[i] = -dot(&rows[i], &d) - room[i];
        for j in 0..m {
            curvature[i * m + j] = dot(&rows[i], &moved[j]);
        }
        most = most.max(curvature[i * m + i]);
    }
    for i in 0..m {
        curvature[i * m + i] += YIELDING * most;
    }
    let found = not_negative(&curvature, &right);
    for k in 0..m {
        add(&mut d, found[k], &moved[k]);
    }
    (d, found)
}

/// The x >= 0 that makes ½ x·M x - right·x least, for a positive definite M.
fn not_negative(matrix: &[f64], right: &[f64]) -> Vec<f64> {
    let m = right.len();
    let (mut x, mut held) = (vec![0.0; m], Vec::new());
    let size = right.iter().fold(0.0_f64, |most, r| most.max(r.abs()));
    for _ in 0..3 * m {
        let (mut most, mut next) = (ZERO * size, None);
        for k in 0..m {
            let gain = right[k] - dot(&matrix[k * m..(k + 1) * m], &x);
            if gain > most && !held.contains(&k) {
                (most, next) = (gain, Some(k));
            }
        }
        let Some(next) = next else { break };
        held.push(next);
        loop {
            let (mut block, mut wanted) = (Vec::new(), Vec::new());
            for i in &held {
                wanted.push(right[*i]);
                held.iter().for_each(|j| block.push(matrix[i * m + j]));
            }
            if !solve_dense(&mut block, &mut wanted) {
                return x;
            }
            // the way to the least, up to the first multiplier that would be negative
            let mut share = 1.0_f64;
            for (k, to) in held.iter().zip(&wanted) {
                if *to <= 0.0 {
                    share = share.min(x[*k] / (x[*k] - to));
                }
            }
            for (k, to) in held.iter().zip(&wanted) {
                x[*k] += share * (to - x[*k]);
                if *to <= 0.0 && x[*k] <= ZERO * to.abs() {
                    x[*k] = 0.0;
                }
            }
            if share == 1.0 {
                break;
            }
            held.retain(|k| x[*k] > 0.0);
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_lies_at_a_limit() {
        // (x - 2)² + (y - 1)² with x + y <= 1 and y >= 0.5: at (0.5, 0.5)
        let inverse = [0.5, 0.0, 0.0, 0.5];
        let rows = [vec![-1.0, -1.0], vec![0.0, 1.0]];
        let (d, factors) = step(&inverse, &[-4.0, -2.0], &rows, &[1.0, -0.5]);
        assert!((d[0] - 0.5).abs() < 1e-10 && (d[1] - 0.5).abs() < 1e-10, "{d:?}");
        // slope (-3, -1) = 3 (-1, -1) + 2 (0, 1)
        assert!((factors[0] - 3.0).abs() < 1e-8 && (factors[1] - 2.0).abs() < 1e-8);
    }

    #[test]
    fn repeated_limits_count_once() {
        let rows = [vec![-1.0, 0.0], vec![-1.0, 0.0]];
        let (d, _) = step(&[1.0, 0.0, 0.0, 1.0], &[-5.0, -3.0], &rows, &[1.0, 1.0]);
        assert!((d[0] - 1.0).abs() < 1e-9 && (d[1] - 3.0).abs() < 1e-9, "{d:?}");
    }

    #[test]
    fn contradictions_are_shared() {
        let (d, _) = step(&[1.0], &[0.0], &[vec![1.0], vec![-1.0]], &[-1.0, -1.0]);
        assert!(d[0].abs() < 1e-3, "{d:?}");
    }
}
