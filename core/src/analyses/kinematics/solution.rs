//! Positions, velocities and accelerations at a time.

use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, ShortArray};
use crate::model::{column_scales, row_scales, Model};
use crate::solve::sign_of_determinant;

/// Largest scaled residual of a closed position.
pub(super) const CLOSED: f64 = 1e-13;
/// Largest residual that is accepted if Newton's method no longer reduces it.
const ROUNDING: f64 = 1e-10;
/// Largest number of Newton iterations; a good prediction needs two or three.
const MOST: usize = 8;
/// Largest ratio of successive corrections at which the iteration continues.
const CONTRACTS: f64 = 0.25;
/// Damping of redundant rows, relative to their scale.
const REDUNDANT: f64 = 1e-12;
/// Smallest fraction of a pivot that remains after elimination if Φ_q counts as regular.
const REGULAR: f64 = 1e-9;
/// Ratio of the smallest to the largest pivot above which the sign of a determinant counts.
const DECIDED: f64 = 3e-7;
/// These bounds relative to the values at the first position. The smaller bound applies.
const OF_FIRST: f64 = 1e-4;
/// Largest number of coordinates for which the orientation is examined.
const MOST_DENSE: usize = 120;

/// The motion at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Time, s, or the driven value that replaces it.
    pub t: f64,
    /// Coordinates, shape (n_q).
    pub q: Vec<f64>,
    /// Their rates.
    pub v: Vec<f64>,
    /// Their accelerations.
    pub a: Vec<f64>,
}

impl Point {
    /// q + h v + h²/2 a + h³/6 j. The jerk j is the difference quotient of the acceleration since an earlier point.
    pub(super) fn predicted(&self, h: f64, earlier: Option<&Point>) -> Vec<f64> {
        let all = self.q.iter().zip(&self.v).zip(&self.a);
        let mut q: Vec<f64> = all.map(|((q, v), a)| q + h * (v + 0.5 * h * a)).list();
        if let Some(earlier) = earlier {
            let c = h * h * h / (6.0 * (self.t - earlier.t));
            let change = self.a.iter().zip(&earlier.a);
            q.iter_mut().zip(change).for_each(|(q, (a, b))| *q += c * (a - b));
        }
        q
    }
}

/// Solves the kinematic equations of a model.
pub(super) struct Solver<'a> {
    pub model: &'a Model,
    matrix: Augmented,
    weights: Vec<f64>,
    /// Scale of each coordinate, and of each row of Φ.
    pub columns: Vec<f64>,
    pub rows: Vec<f64>,
    /// Zero velocities.
    rest: Vec<f64>,
    motions: Motions,
    /// The sum of the norms of the Newton corrections for the last position.
    pub corrected: f64,
    /// Fraction of the worst pivot that remained in the last factorisation.
    kept: f64,
    /// The bound of `kept` for a regular position; None before the first factorisation.
    regular: Option<f64>,
    /// The ratio of pivots above which the sign of a determinant counts; None before the first one.
    decided: Option<f64>,
    /// Φ, its rate and γ.
    terms: [Vec<f64>; 3],
    solution: Vec<f64>,
}

impl<'a> Solver<'a> {
    pub fn new(model: &'a Model) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let (columns, rows) = (column_scales(model), row_scales(model));
        let weights: Vec<f64> = columns.iter().map(|scale| 1.0 / (scale * scale)).list();
        let mut matrix = Augmented::new(model);
        matrix.set_weights(&weights);
        if model.allow_redundancy {
            matrix.set_damping(rows.iter().map(|scale| REDUNDANT * scale * scale));
        }
        Self {
            matrix,
            weights,
            columns,
            rows,
            rest: vec![0.0; n],
            motions: Motions::new(&model.layout),
            corrected: 0.0,
            kept: 1.0,
            regular: None,
            decided: None,
            terms: std::array::from_fn(|_| vec![0.0; m]),
            solution: vec![0.0; n + m],
            model,
        }
    }

    /// The root mean square of x, scaled.
    pub fn norm(&self, x: &[f64]) -> f64 {
        self.mean(x.iter().copied())
    }

    /// The root mean square of a - b, scaled.
    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        self.mean(a.iter().zip(b).map(|(a, b)| a - b))
    }

    /// The scaled root mean square of v - (v₀ + h a₀), the deviation from a motion of constant acceleration.
    pub fn turned(&self, from: &Point, to: &Point) -> f64 {
        let h = to.t - from.t;
        let all = from.v.iter().zip(&from.a).zip(&to.v);
        self.mean(all.map(|((v, a), next)| next - (v + h * a)))
    }

    fn mean(&self, x: impl Iterator<Item = f64>) -> f64 {
        let squares = x.zip(&self.weights).map(|(x, w)| x * x * w);
        (squares.sum::<f64>() / self.weights.len().max(1) as f64).sqrt()
    }

    /// Closes a nearly closed position and solves for its velocities and accelerations. None if Newton's method does
    /// not converge fast, or Φ_q is singular.
    pub fn point(&mut self, t: f64, mut q: Vec<f64>) -> Option<Point> {
        self.close(t, &mut q)?;
        self.factor()?;
        let v = self.solve(1, -1.0).to_vec();
        self.set_gamma(t, &v);
        let a = self.solve(2, 1.0).to_vec();
        v.iter().chain(&a).all(|x| x.is_finite()).then_some(Point { t, q, v, a })
    }

    /// Newton's method. On return, Φ_q and the terms are those of the final position at zero velocity.
    fn close(&mut self, t: f64, q: &mut [f64]) -> Option<()> {
        let mut last = f64::INFINITY;
        self.corrected = 0.0;
        for _ in 0..MOST {
            self.evaluate(t, q);
            let gap = self.gap();
            if gap <= CLOSED {
                return Some(());
            }
            self.factor()?;
            self.solve(0, -1.0);
            let step = &self.solution[..q.len()];
            let size = self.norm(step);
            if size.is_nan() || size > CONTRACTS * last {
                // rounding errors dominate: the position of the last evaluation is kept
                return (gap <= ROUNDING).then_some(());
            }
            q.iter_mut().zip(step).for_each(|(q, dq)| *q += dq);
            self.corrected += size;
            last = size;
        }
        None
    }

    /// Evaluates Φ, its rate, γ and Φ_q at zero velocity.
    fn evaluate(&mut self, t: f64, q: &[f64]) {
        let Self { model, matrix, motions, terms, rest, .. } = self;
        motions.place(&model.layout, q, rest);
        let terms = terms.each_mut().each(|term| &mut term[..]);
        constraints::terms_and_jacobian(model, motions, t, terms, matrix.jacobian_mut());
    }

    /// Evaluates γ at the last position with the velocities v.
    fn set_gamma(&mut self, t: f64, v: &[f64]) {
        let Self { model, motions, terms: [phi, rate, gamma], .. } = self;
        motions.set_rates(&model.layout, v);
        constraints::velocity_terms(model, motions, t, phi, rate, gamma);
    }

    /// The largest |Φ|, scaled.
    fn gap(&self) -> f64 {
        let scaled = self.terms[0].iter().zip(&self.rows).map(|(phi, scale)| phi.abs() / scale);
        scaled.fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
    }

    /// Factorises Φ_q at the last position. None if it is singular.
    fn factor(&mut self) -> Option<()> {
        self.matrix.factor().ok()?;
        self.kept = self.matrix.cancellation().map_or(1.0, |(_, kept)| kept);
        let least = *self.regular.get_or_insert(REGULAR.min(OF_FIRST * self.kept));
        (self.model.allow_redundancy || self.kept > least).then_some(())
    }

    /// Solves Φ_q x = `sign` · `terms[term]`. The solution is also kept in `solution`.
    fn solve(&mut self, term: usize, sign: f64) -> &[f64] {
        let n = self.model.layout.n_q;
        let (upper, lower) = self.solution.split_at_mut(n);
        upper.fill(0.0);
        lower.iter_mut().zip(&self.terms[term]).for_each(|(x, term)| *x = sign * term);
        self.matrix.solve(&mut self.solution);
        if self.model.allow_redundancy {
            self.correct(term, sign);
        }
        &self.solution[..n]
    }

    /// One step of iterative refinement, which reduces the error caused by the damping of redundant rows.
    fn correct(&mut self, term: usize, sign: f64) {
        let (x, lower) = self.solution.split_at_mut(self.model.layout.n_q);
        let mut change = vec![0.0; x.len() + lower.len()];
        let left = &mut change[x.len()..];
        constraints::times_all(self.model, self.matrix.jacobian(), x, left);
        let wanted = left.iter_mut().zip(&self.terms[term]);
        wanted.for_each(|(left, term)| *left = sign * term - *left);
        self.matrix.solve(&mut change);
        x.iter_mut().zip(&change).for_each(|(x, dx)| *x += dx);
    }

    /// Φ at a position, scaled.
    pub fn phi(&mut self, t: f64, q: &[f64]) -> Vec<f64> {
        self.evaluate(t, q);
        self.terms[0].iter().zip(&self.rows).map(|(phi, scale)| phi / scale).list()
    }

    /// The sign of det Φ_q, which is constant along a regular motion; see [`Solver::sign`]. None if Φ_q is not square or
    /// too large.
    pub fn orientation(&mut self, point: &Point) -> Option<f64> {
        let n = self.model.layout.n_q;
        if self.model.layout.n_rows != n || n > MOST_DENSE {
            return None;
        }
        let full = self.extended(point.t, &point.q, 1.0);
        let mut square: Vec<f64> =
            full.chunks(n + 1).flat_map(|row| row[..n].iter().copied()).list();
        Some(self.sign(&mut square, n))
    }

    /// The sign of the determinant of a scaled matrix of shape (n, n), which is overwritten; 0 if rounding errors
    /// could determine it.
    pub fn sign(&mut self, matrix: &mut [f64], n: usize) -> f64 {
        let (sign, ratio) = sign_of_determinant(matrix, n);
        let least = *self.decided.get_or_insert(DECIDED.min(OF_FIRST * ratio));
        if ratio > least {
            sign
        } else {
            0.0
        }
    }

    /// A unit of t in which the drivers move as far as the mechanism is large, or by 1 rad. None if they rest.
    pub fn unit(&mut self, point: &Point) -> Option<f64> {
        self.evaluate(point.t, &point.q);
        let rates = self.terms[1].iter().zip(&self.rows).map(|(rate, scale)| rate.abs() / scale);
        Some(1.0 / rates.fold(0.0, f64::max)).filter(|unit| unit.is_finite())
    }

    /// The scaled matrix [Φ_q Φ_t], row by row, shape (n_rows, n_q + 1). `unit` is the scale of t.
    pub fn extended(&mut self, t: f64, q: &[f64], unit: f64) -> Vec<f64> {
        self.evaluate(t, q);
        let Self { model, matrix, terms, .. } = self;
        let (n, entries) = (model.layout.n_q, matrix.jacobian());
        let mut full = vec![0.0; model.layout.n_rows * (n + 1)];
        for (row, column, at) in model.layout.positions() {
            full[row * (n + 1) + column] = entries[at] * self.columns[column] / self.rows[row];
        }
        for (row, rate) in terms[1].iter().enumerate() {
            full[row * (n + 1) + n] = rate * unit / self.rows[row];
        }
        full
    }
}
