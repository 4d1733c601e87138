//! Four-bars that fit places of the coupler point, angles of the coupler or angles of the crank, by the method of
//! Levenberg and Marquardt (Marquardt 1963).
//!
//! Crank and coupler of a position are complex numbers of length 1, which a step δ turns by (1 + iδ/2)/(1 - iδ/2). With
//! sums, products, quotients and roots alone, the results are the same on every machine. The two angles of a position
//! occur in its own residuals only, so that their 2 × 2 block of the normal equations is eliminated first.

use super::plane::{abs, closed, conjugate, cross, scaled, unit};
use kempe::math::Complex;

/// Unknowns of a linkage: O (2), a, b, p (2; the point in the frame of the coupler, x from A to B), D (2), c, and what is
/// added to the angles of the coupler and of the crank to get the given ones.
const ALL: usize = 11;
/// Residuals of a position: x, y, closure, angle of the moving frame, angle of the crank.
const RESIDUALS: usize = 5;

/// A four-bar with its positions.
#[derive(Clone, Debug)]
pub(crate) struct Posed {
    /// The first nine unknowns.
    pub(crate) lengths: [f64; 9],
    /// The last two, that of the crank first, as numbers of length 1.
    pub(crate) turned: [Complex; 2],
    /// Directions of crank and coupler at each position.
    pub(crate) at: Vec<[Complex; 2]>,
}

/// What a four-bar must fit. A list without entries is free.
#[derive(Clone, Debug)]
pub(crate) struct Targets {
    pub(crate) places: Vec<Complex>,
    pub(crate) frames: Vec<Complex>,
    pub(crate) cranks: Vec<Complex>,
    /// Which unknowns of the linkage may change.
    pub(crate) free: [bool; ALL],
    /// Factor of the lengths themselves, which keeps a linkage small.
    pub(crate) ridge: f64,
    /// The sign of the side of the line from A to D on which the coupler closes exactly; zero for either.
    pub(crate) side: f64,
}

/// A residual with its slopes by the linkage and by the angles of the position.
#[derive(Clone, Copy)]
struct Row(f64, [f64; ALL], [f64; 2]);

/// Of a position: its coupling with the linkage, its right side, and what solves its own block.
type Block<T> = ([[f64; 2]; ALL], [f64; 2], T);

impl Posed {
    fn pair(&self, k: usize) -> Complex {
        Complex::new(self.lengths[k], self.lengths[k + 1])
    }
    /// The ground pivots of crank and rocker.
    pub(crate) fn pivots(&self) -> [Complex; 2] {
        [self.pair(0), self.pair(6)]
    }
    /// The point in the frame of the coupler.
    pub(crate) fn point(&self) -> Complex {
        self.pair(4)
    }
    /// The pin of the crank at a position.
    pub(crate) fn pin(&self, k: usize) -> Complex {
        self.pair(0) + scaled(self.at[k][0], self.lengths[2])
    }
}

impl Targets {
    /// A least sum of squares near a start, and this sum. The closure counts `closing` times.
    pub(crate) fn fitted(&self, start: Posed, closing: f64, steps: usize) -> (Posed, f64) {
        let mut best = start;
        let (mut rows, mut sum) = self.rows(&best, closing);
        let mut damping = 1e-3;
        for _ in 0..steps {
            let mut improved = false;
            while damping < 1e12 {
                if let Some(trial) = self.stepped(&best, &rows, damping) {
                    let (reached, least) = self.rows(&trial, closing);
                    if least < sum {
                        improved = least < sum * (1.0 - 1e-9);
                        (best, rows, sum) = (trial, reached, least);
                        damping = (damping * 0.1).max(1e-14);
                        break;
                    }
                }
                damping *= 8.0;
            }
            if !improved {
                break;
            }
        }
        (best, sum)
    }

    fn rows(&self, at: &Posed, closing: f64) -> (Vec<[Row; RESIDUALS]>, f64) {
        let rows: Vec<_> = (0..self.places.len()).map(|k| self.residuals(at, k, closing)).collect();
        let sum: f64 = rows.iter().flatten().map(|row| row.0 * row.0).sum();
        let long: f64 = at.lengths.iter().map(|x| x * x).sum();
        (rows, sum + self.ridge * self.ridge * long)
    }

    fn residuals(&self, of: &Posed, k: usize, closing: f64) -> [Row; RESIDUALS] {
        let mut rows = [Row(0.0, [0.0; ALL], [0.0; 2]); RESIDUALS];
        let [u, v] = of.at[k];
        let [_, _, a, b, .., c] = of.lengths;
        let arm = scaled(u, a);
        let pin = of.pair(0) + arm;
        let out = of.point() * v;
        let off = pin + out - self.places[k];
        for (row, (value, unit)) in rows
            .iter_mut()
            .zip([(off.re, Complex::new(1.0, 0.0)), (off.im, Complex::new(0.0, 1.0))])
        {
            let along = |z: Complex| z.re * unit.re + z.im * unit.im;
            row.0 = value;
            row.1[..3].copy_from_slice(&[unit.re, unit.im, along(u)]);
            row.1[4..6].copy_from_slice(&[along(v), along(turned(v))]);
            row.2 = [along(turned(arm)), along(turned(out))];
        }
        let bar = scaled(v, b);
        let to = pin + bar - of.pair(6);
        let length = abs(to).max(f64::MIN_POSITIVE);
        let unit = scaled(to, 1.0 / length);
        let along = |z: Complex| z.re * unit.re + z.im * unit.im;
        // O = D and b = 0 close at all positions, so that a short coupler must close better
        let narrow = closing * (1.0 + 1.0 / (b * b)).sqrt();
        let (open, short) = (length - c, closing * closing / (narrow * b * b * b));
        let slopes = [unit.re, unit.im, along(u), along(v), 0.0, 0.0, -unit.re, -unit.im, -1.0];
        let row = &mut rows[2];
        row.0 = narrow * open;
        (0..9).for_each(|j| row.1[j] = narrow * slopes[j]);
        row.1[3] -= short * open;
        row.2 = [narrow * along(turned(arm)), narrow * along(turned(bar))];
        let angles = [(&self.frames, 1, 1.0), (&self.cranks, 0, closing)];
        for (j, (given, which, factor)) in angles.into_iter().enumerate() {
            let Some(wanted) = given.get(k) else { continue };
            // the angle of the coupler or of the crank, less that of the linkage: 2 sin(δ/2)
            let own = [u, v][which] * of.turned[which];
            let half = (0.5 * (1.0 + dot(*wanted, own))).max(1e-18).sqrt();
            let row = &mut rows[3 + j];
            row.0 = factor * cross(*wanted, own) / half;
            (row.1[9 + j], row.2[which]) = (factor * half, factor * half);
        }
        rows
    }

    /// The next point; None if the equations have no usable solution.
    fn stepped(&self, at: &Posed, rows: &[[Row; RESIDUALS]], damping: f64) -> Option<Posed> {
        let (mut matrix, mut step) = ([[0.0; ALL]; ALL], [0.0; ALL]);
        let mut size = [0.0; ALL];
        let blocks: Vec<_> = rows
            .iter()
            .map(|rows| {
                let (mut own, mut side) = ([0.0; 3], [0.0; 2]);
                let mut coupling = [[0.0; 2]; ALL];
                for Row(residual, slope, local) in rows {
                    own[0] += local[0] * local[0];
                    own[1] += local[0] * local[1];
                    own[2] += local[1] * local[1];
                    (0..2).for_each(|i| side[i] -= local[i] * residual);
                    for i in 0..ALL {
                        (0..2).for_each(|j| coupling[i][j] += slope[i] * local[j]);
                        (0..=i).for_each(|j| matrix[i][j] += slope[i] * slope[j]);
                        step[i] -= slope[i] * residual;
                    }
                }
                own[0] += damping * own[0] + 1e-30;
                own[2] += damping * own[2] + 1e-30;
                let determinant = own[0] * own[2] - own[1] * own[1];
                let inverse = own.map(|x| x / determinant);
                let times = move |x: [f64; 2]| {
                    [inverse[2] * x[0] - inverse[1] * x[1], inverse[0] * x[1] - inverse[1] * x[0]]
                };
                (coupling, side, times)
            })
            .collect();
        for (k, x) in at.lengths.iter().enumerate() {
            matrix[k][k] += self.ridge * self.ridge;
            step[k] -= self.ridge * self.ridge * x;
        }
        (0..ALL).for_each(|k| size[k] = matrix[k][k].max(1e-12));
        for (coupling, side, times) in &blocks {
            let solved = times(*side);
            for i in 0..ALL {
                let [x, y] = times(coupling[i]);
                (0..=i).for_each(|j| matrix[i][j] -= x * coupling[j][0] + y * coupling[j][1]);
                step[i] -= coupling[i][0] * solved[0] + coupling[i][1] * solved[1];
            }
        }
        for k in 0..ALL {
            matrix[k][k] += damping * size[k];
            if !self.free[k] {
                (0..k).for_each(|j| matrix[k][j] = 0.0);
                (k + 1..ALL).for_each(|i| matrix[i][k] = 0.0);
                (matrix[k][k], step[k]) = (1.0, 0.0);
            }
        }
        solve(&mut matrix, &mut step)?;
        Some(self.moved(at, &step, &blocks))
    }

    /// The point after a step of the linkage, which determines those of the positions.
    fn moved<T>(&self, at: &Posed, step: &[f64; ALL], blocks: &[Block<T>]) -> Posed
    where
        T: Fn([f64; 2]) -> [f64; 2],
    {
        let mut next = at.clone();
        (0..9).for_each(|k| next.lengths[k] += step[k]);
        next.turned = [turned_by(at.turned[0], step[10]), turned_by(at.turned[1], step[9])];
        for (k, (coupling, side, times)) in blocks.iter().enumerate() {
            let left = std::array::from_fn(|i| {
                side[i] - (0..ALL).map(|k| coupling[k][i] * step[k]).sum::<f64>()
            });
            let turns = times(left);
            (0..2).for_each(|i| next.at[k][i] = turned_by(next.at[k][i], turns[i]));
            if self.side != 0.0 {
                let far = next.pair(6) - next.pin(k);
                next.at[k][1] = closed(far, [next.lengths[3], next.lengths[8]], self.side);
            }
        }
        next
    }
}

/// A number turned by a right angle.
fn turned(z: Complex) -> Complex {
    Complex::new(-z.im, z.re)
}

/// A direction turned by a step.
fn turned_by(z: Complex, step: f64) -> Complex {
    let by = Complex::new(1.0 - 0.25 * step * step, step);
    unit(z * by)
}

fn dot(x: Complex, y: Complex) -> f64 {
    (conjugate(x) * y).re
}

/// Solves equations with the lower half of a positive definite matrix, by Cholesky's method; None if it is not.
fn solve(matrix: &mut [[f64; ALL]; ALL], x: &mut [f64; ALL]) -> Option<()> {
    for i in 0..ALL {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let left = matrix[i][j] - sum;
            matrix[i][j] = if i > j { left / matrix[j][j] } else { left.sqrt() };
        }
        let known: f64 = (0..i).map(|k| matrix[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / matrix[i][i];
    }
    for i in (0..ALL).rev() {
        let known: f64 = (i + 1..ALL).map(|k| matrix[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / matrix[i][i];
    }
    x.iter().all(|x| x.is_finite()).then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_the_residuals() {
        let z = Complex::new;
        let at = (0..3).map(|k| [unit(z(1.0, f64::from(k))), unit(z(0.4, 1.0 - f64::from(k)))]);
        let posed = Posed {
            lengths: [0.1, -0.2, 0.7, 1.3, 0.5, 0.4, 1.6, 0.3, 0.9],
            turned: [unit(z(1.0, 0.2)), unit(z(0.9, -0.5))],
            at: at.collect(),
        };
        let units = vec![unit(z(0.3, 0.8)); 3];
        let places = vec![z(0.9, 0.7), z(0.2, 1.0), z(-0.4, 0.3)];
        let (frames, cranks) = (units.clone(), units);
        let targets = Targets { places, frames, cranks, free: [true; ALL], ridge: 0.0, side: 0.0 };
        let step = 1e-6;
        for k in 0..3 {
            let rows = targets.residuals(&posed, k, 5.0);
            for column in 0..ALL + 2 {
                let moved = |by: f64| {
                    let mut next = posed.clone();
                    match column {
                        9 => next.turned[1] = turned_by(next.turned[1], by),
                        10 => next.turned[0] = turned_by(next.turned[0], by),
                        c if c < 9 => next.lengths[c] += by,
                        c => next.at[k][c - ALL] = turned_by(next.at[k][c - ALL], by),
                    }
                    targets.residuals(&next, k, 5.0)
                };
                let (ahead, back) = (moved(step), moved(-step));
                for (j, row) in rows.iter().enumerate() {
                    let slope = row.1.get(column).copied().unwrap_or_else(|| row.2[column - ALL]);
                    let numeric = (ahead[j].0 - back[j].0) / (2.0 * step);
                    assert!((slope - numeric).abs() < 1e-7 * (1.0 + numeric.abs()), "{j} {column}");
                }
            }
        }
    }
}
