//! Least squares with unknowns of the linkage and two unknowns of each position, by the method of Levenberg and
//! Marquardt (Marquardt 1963). The unknowns of a position occur in its own residuals only, so that its 2 × 2 block of
//! the normal equations is eliminated first.

use kempe::math::{Dual, Real};
use kempe::solve::solve_dense;

/// Most unknowns of a linkage, and with those of a position.
const MOST: usize = 11;
const ALL: usize = MOST + 2;
/// Residuals of a position.
const RESIDUALS: usize = 5;

/// Residuals of a position of a linkage.
pub trait Problem {
    /// Number of unknowns of the linkage, at most 11.
    fn unknowns(&self) -> usize;
    /// Number of positions.
    fn positions(&self) -> usize;
    /// The residuals of position k, for the unknowns of the linkage and of the position.
    fn residuals<S: Real>(&self, k: usize, linkage: &[S], position: [S; 2]) -> [S; RESIDUALS];
}

/// A least sum of squares.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Unknowns of the linkage.
    pub linkage: Vec<f64>,
    /// Unknowns of each position.
    pub positions: Vec<[f64; 2]>,
    /// The sum of squares.
    pub sum: f64,
}

/// Normal equations after the elimination of the positions.
struct Normal {
    /// (n, n) and (n), of the linkage.
    matrix: Vec<f64>,
    right: Vec<f64>,
    blocks: Vec<Block>,
}

/// Of a position: its inverse block, its coupling (2, n) and its right side.
type Block = ([[f64; 2]; 2], Vec<[f64; 2]>, [f64; 2]);

/// A least sum of squares near a start. Unknowns of the linkage that are not `free` keep their values.
pub fn least_squares<P: Problem>(of: &P, start: Fitted, free: &[bool], steps: usize) -> Fitted {
    let mut best = start;
    best.sum = sum(of, &best);
    let mut damping = 1e-3;
    for _ in 0..steps {
        let (rows, size) = slopes(of, &best);
        let mut improved = false;
        while damping < 1e12 {
            let trial = moved(&best, &normal(of.unknowns(), &rows, &size, free, damping));
            let reached = trial.map(|mut trial| {
                trial.sum = sum(of, &trial);
                trial
            });
            match reached {
                Some(trial) if trial.sum < best.sum => {
                    improved = trial.sum < best.sum * (1.0 - 1e-9);
                    best = trial;
                    damping = (damping * 0.1).max(1e-14);
                    break;
                }
                _ => damping *= 8.0,
            }
        }
        if !improved {
            break;
        }
    }
    best
}

fn sum<P: Problem>(of: &P, at: &Fitted) -> f64 {
    let squares = |k: usize| {
        let found = of.residuals(k, &at.linkage, at.positions[k]);
        found.iter().map(|r| r * r).sum::<f64>()
    };
    (0..of.positions()).map(squares).sum()
}

/// One residual, and its slopes by the linkage and by the position.
type Row = (f64, [f64; ALL]);

/// All residuals with their slopes, and the largest diagonal of the normal equations of the linkage.
fn slopes<P: Problem>(of: &P, at: &Fitted) -> (Vec<[Row; RESIDUALS]>, Vec<f64>) {
    let n = of.unknowns();
    let unknown = |k: usize, position: &[f64; 2]| match k {
        k if k < MOST => at.linkage.get(k).copied().unwrap_or(0.0),
        k => position[k - MOST],
    };
    let rows: Vec<[Row; RESIDUALS]> = (0..of.positions())
        .map(|position| {
            let mut rows = [(0.0, [0.0; ALL]); RESIDUALS];
            for first in (0..ALL).step_by(3) {
                let seeded = |k: usize| match unknown(k, &at.positions[position]) {
                    x if (first..first + 3).contains(&k) => Dual::<3>::variable(x, k - first),
                    x => Dual::constant(x),
                };
                let linkage: Vec<_> = (0..n).map(seeded).collect();
                let found = of.residuals(position, &linkage, [seeded(MOST), seeded(MOST + 1)]);
                for (row, residual) in rows.iter_mut().zip(found) {
                    row.0 = residual.value;
                    (first..ALL.min(first + 3)).for_each(|k| row.1[k] = residual.slope[k - first]);
                }
            }
            rows
        })
        .collect();
    let square = |k: usize| rows.iter().flatten().map(|(_, s)| s[k] * s[k]).sum::<f64>();
    let size = (0..n).map(|k| square(k).max(1e-12)).collect();
    (rows, size)
}

fn normal(
    n: usize,
    rows: &[[Row; RESIDUALS]],
    size: &[f64],
    free: &[bool],
    damping: f64,
) -> Normal {
    let (mut matrix, mut right) = (vec![0.0; n * n], vec![0.0; n]);
    let mut blocks = Vec::with_capacity(rows.len());
    for position in rows {
        let (mut own, mut coupling, mut side) = ([[0.0; 2]; 2], vec![[0.0; 2]; n], [0.0; 2]);
        for (residual, slope) in position {
            let local = [slope[MOST], slope[MOST + 1]];
            for i in 0..2 {
                (0..2).for_each(|j| own[i][j] += local[i] * local[j]);
                (0..n).for_each(|k| coupling[k][i] += slope[k] * local[i]);
                side[i] -= local[i] * residual;
            }
            for i in 0..n {
                (0..n).for_each(|j| matrix[i * n + j] += slope[i] * slope[j]);
                right[i] -= slope[i] * residual;
            }
        }
        (0..2).for_each(|i| own[i][i] += damping * own[i][i] + 1e-30);
        let determinant = own[0][0] * own[1][1] - own[0][1] * own[1][0];
        let inverse = [
            [own[1][1] / determinant, -own[0][1] / determinant],
            [-own[1][0] / determinant, own[0][0] / determinant],
        ];
        let times = |x: [f64; 2]| inverse.map(|row| row[0] * x[0] + row[1] * x[1]);
        let solved = times(side);
        for i in 0..n {
            let scaled = times(coupling[i]);
            for j in 0..n {
                matrix[i * n + j] -= scaled[0] * coupling[j][0] + scaled[1] * coupling[j][1];
            }
            right[i] -= coupling[i][0] * solved[0] + coupling[i][1] * solved[1];
        }
        blocks.push((inverse, coupling, side));
    }
    for k in 0..n {
        matrix[k * n + k] += damping * size[k];
        if !free[k] {
            (0..n).for_each(|j| (matrix[k * n + j], matrix[j * n + k]) = (0.0, 0.0));
            (matrix[k * n + k], right[k]) = (1.0, 0.0);
        }
    }
    Normal { matrix, right, blocks }
}

/// The next point; None if the equations have no usable solution.
fn moved(at: &Fitted, by: &Normal) -> Option<Fitted> {
    let (mut matrix, mut step) = (by.matrix.clone(), by.right.clone());
    if !solve_dense(&mut matrix, &mut step) || !step.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut next = at.clone();
    next.linkage.iter_mut().zip(&step).for_each(|(x, dx)| *x += dx);
    for (position, (inverse, coupling, side)) in next.positions.iter_mut().zip(&by.blocks) {
        let left: [f64; 2] = std::array::from_fn(|i| {
            side[i] - coupling.iter().zip(&step).map(|(c, dx)| c[i] * dx).sum::<f64>()
        });
        for i in 0..2 {
            position[i] += inverse[i][0] * left[0] + inverse[i][1] * left[1];
        }
    }
    Some(next)
}
