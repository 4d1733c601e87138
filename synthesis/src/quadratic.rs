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

/// A matrix (n, n), row by row, times a vector.
pub(crate) fn times(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    matrix.chunks(x.len()).map(|row| dot(row, x)).collect()
}

/// The step d that makes g·d + ½ d·B d least, with row·d + room >= 0 for each limit, and the multipliers of the limits.
/// Where no step satisfies all limits, it satisfies them as far as possible.
pub(crate) fn step(
    inverse: &[f64],
    slope: &[f64],
    limits: &[(Vec<f64>, f64)],
) -> (Vec<f64>, Vec<f64>) {
    let m = limits.len();
    let moved: Vec<Vec<f64>> = limits.iter().map(|(row, _)| times(inverse, row)).collect();
    let mut curvature: Vec<Vec<f64>> =
        limits.iter().map(|(row, _)| moved.iter().map(|by| dot(row, by)).collect()).collect();
    let most = (0..m).fold(0.0_f64, |most, k| most.max(curvature[k][k]));
    (0..m).for_each(|k| curvature[k][k] += YIELDING * most);
    let free = times(inverse, slope);
    let right: Vec<f64> = limits.iter().map(|(row, room)| dot(row, &free) - room).collect();
    let found = not_negative(&curvature, &right);
    let mut d: Vec<f64> = free.iter().map(|x| -x).collect();
    for (factor, by) in found.iter().zip(&moved) {
        d.iter_mut().zip(by).for_each(|(x, y)| *x += factor * y);
    }
    (d, found)
}

/// The x >= 0 that makes ½ x·M x - right·x least, for a positive definite M.
fn not_negative(matrix: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let m = right.len();
    let (mut x, mut passive) = (vec![0.0; m], vec![false; m]);
    let size = right.iter().fold(0.0_f64, |most, r| most.max(r.abs()));
    for _ in 0..3 * m {
        let gain = |k: usize| right[k] - dot(&matrix[k], &x);
        let best = (0..m).filter(|k| !passive[*k]).max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
        let Some(next) = best.filter(|k| gain(*k) > ZERO * size) else { break };
        passive[next] = true;
        loop {
            let held: Vec<usize> = (0..m).filter(|k| passive[*k]).collect();
            let own = |i: &usize| held.iter().map(|j| matrix[*i][*j]).collect::<Vec<f64>>();
            let mut block: Vec<f64> = held.iter().flat_map(own).collect();
            let mut wanted: Vec<f64> = held.iter().map(|k| right[*k]).collect();
            if !solve_dense(&mut block, &mut wanted) {
                passive[next] = false;
                return x;
            }
            // the way to the least, up to the first multiplier that would be negative
            let share = held.iter().zip(&wanted).filter(|(_, to)| **to <= 0.0);
            let share = share.map(|(k, to)| x[*k] / (x[*k] - to)).fold(1.0_f64, f64::min);
            for (k, to) in held.iter().zip(&wanted) {
                x[*k] += share * (to - x[*k]);
                if *to <= 0.0 && x[*k] <= ZERO * to.abs() {
                    (x[*k], passive[*k]) = (0.0, false);
                }
            }
            if share == 1.0 {
                break;
            }
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
        let limits = [(vec![-1.0, -1.0], 1.0), (vec![0.0, 1.0], -0.5)];
        let (d, factors) = step(&inverse, &[-4.0, -2.0], &limits);
        assert!((d[0] - 0.5).abs() < 1e-10 && (d[1] - 0.5).abs() < 1e-10, "{d:?}");
        // slope (-3, -1) = 3 (-1, -1) + 2 (0, 1)
        assert!((factors[0] - 3.0).abs() < 1e-8 && (factors[1] - 2.0).abs() < 1e-8);
    }

    #[test]
    fn repeated_limits_count_once() {
        let limit = (vec![-1.0, 0.0], 1.0);
        let (d, _) = step(&[1.0, 0.0, 0.0, 1.0], &[-5.0, -3.0], &[limit.clone(), limit]);
        assert!((d[0] - 1.0).abs() < 1e-9 && (d[1] - 3.0).abs() < 1e-9, "{d:?}");
    }

    #[test]
    fn contradictions_are_shared() {
        let limits = [(vec![1.0], -1.0), (vec![-1.0], -1.0)];
        let (d, _) = step(&[1.0], &[0.0], &limits);
        assert!(d[0].abs() < 1e-3, "{d:?}");
    }
}
