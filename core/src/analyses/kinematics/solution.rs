//! Positions, velocities and accelerations at a time.

use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::model::{column_scales, row_scales, Model};
use crate::solve::sign_of_determinant;

/// Largest scaled residual of a closed position.
const CLOSED: f64 = 1e-13;
/// A residual of this size is accepted if Newton's step does not reduce it any more.
const ROUNDING: f64 = 1e-10;
/// Largest number of Newton's iterations; a good prediction takes two or three.
const MOST: usize = 8;
/// Least factor by which an iteration must reduce the correction.
const CONTRACTS: f64 = 0.25;
/// Damping of redundant rows, relative to their scale.
const REDUNDANT: f64 = 1e-12;
/// Part of a pivot that remains where Φ_q counts as regular; less if the mechanism begins with less.
const REGULAR: f64 = 1e-9;
/// The same, as a part of that at the first position.
const OF_FIRST: f64 = 1e-4;
/// Part of a pivot that remains where no singular position is near, so that no other branch is.
const CLEAR: f64 = 0.01;
/// Largest number of coordinates for which the orientation is examined.
const MOST_DENSE: usize = 120;

/// The motion at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Time, s, or the driven value in its place.
    pub t: f64,
    /// Coordinates, shape (n_q).
    pub q: Vec<f64>,
    /// Their rates.
    pub v: Vec<f64>,
    /// Their accelerations.
    pub a: Vec<f64>,
}

impl Point {
    /// q + h v + h²/2 a + h³/6 j, with the change of the acceleration since an earlier point for j.
    pub(super) fn predicted(&self, h: f64, earlier: Option<&Point>) -> Vec<f64> {
        let all = self.q.iter().zip(&self.v).zip(&self.a);
        let mut q: Vec<f64> = all.map(|((q, v), a)| q + h * (v + 0.5 * h * a)).collect();
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
    /// Velocities of a mechanism at rest.
    rest: Vec<f64>,
    motions: Motions,
    /// Part of the worst pivot that the last factorisation left.
    kept: f64,
    /// Least part of a pivot at a regular position; none before the first factorisation.
    regular: Option<f64>,
    /// Φ, its rate and γ.
    terms: [Vec<f64>; 3],
    solution: Vec<f64>,
}

impl<'a> Solver<'a> {
    pub fn new(model: &'a Model) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let (columns, rows) = (column_scales(model), row_scales(model));
        let weights: Vec<f64> = columns.iter().map(|scale| 1.0 / (scale * scale)).collect();
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
            kept: 1.0,
            regular: None,
            terms: std::array::from_fn(|_| vec![0.0; m]),
            solution: vec![0.0; n + m],
            model,
        }
    }

    /// The root mean square of x, scaled.
    pub fn norm(&self, x: &[f64]) -> f64 {
        self.apart(x, &self.rest)
    }

    /// The same of a - b.
    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let squares = a.iter().zip(b).zip(&self.weights).map(|((a, b), w)| (a - b) * (a - b) * w);
        (squares.sum::<f64>() / a.len().max(1) as f64).sqrt()
    }

    /// Closes a position that is nearly closed, and solves for its rates. None if Newton's method does not contract at
    /// once, or Φ_q is singular.
    pub fn point(&mut self, t: f64, q: Vec<f64>) -> Option<Point> {
        let q = self.closed(t, q)?;
        self.factored(t)?;
        let v = self.solved(1, -1.0);
        self.evaluate(t, &q, Some(&v));
        let a = self.solved(2, 1.0);
        v.iter().chain(&a).all(|x| x.is_finite()).then_some(Point { t, q, v, a })
    }

    /// Newton's method; Φ and its rate without velocities belong to the position that it returns.
    fn closed(&mut self, t: f64, mut q: Vec<f64>) -> Option<Vec<f64>> {
        let mut last = f64::INFINITY;
        for _ in 0..MOST {
            self.evaluate(t, &q, None);
            let gap = self.gap();
            if gap <= CLOSED {
                return Some(q);
            }
            self.factored(t)?;
            let step = self.solved(0, -1.0);
            let size = self.norm(&step);
            if size.is_nan() || size > CONTRACTS * last {
                // rounding: the position as it was evaluated
                return (gap <= ROUNDING).then_some(q);
            }
            q.iter_mut().zip(&step).for_each(|(q, dq)| *q += dq);
            last = size;
        }
        None
    }

    /// Φ, its rate and γ at a motion, or at rest.
    fn evaluate(&mut self, t: f64, q: &[f64], v: Option<&[f64]>) {
        let Self { model, motions, terms, rest, .. } = self;
        motions.place(&model.layout, q, v.unwrap_or(rest));
        let [phi, rate, gamma] = terms;
        constraints::velocity_terms(model, motions, t, phi, rate, gamma);
    }

    /// The largest |Φ|, scaled.
    fn gap(&self) -> f64 {
        let scaled = self.terms[0].iter().zip(&self.rows).map(|(phi, scale)| phi.abs() / scale);
        scaled.fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
    }

    /// Factorises at the last motion. None where a pivot is lost.
    fn factored(&mut self, t: f64) -> Option<()> {
        let Self { model, matrix, motions, .. } = self;
        constraints::jacobian(model, motions, t, matrix.jacobian_mut());
        matrix.factor().ok()?;
        let kept = matrix.cancellation().map_or(1.0, |(_, kept)| kept);
        self.kept = kept;
        let least = *self.regular.get_or_insert(REGULAR.min(OF_FIRST * kept));
        (model.allow_redundancy || kept > least).then_some(())
    }

    /// x of Φ_q x = `sign` times one of the terms.
    fn solved(&mut self, term: usize, sign: f64) -> Vec<f64> {
        let n = self.model.layout.n_q;
        let (upper, lower) = self.solution.split_at_mut(n);
        upper.fill(0.0);
        lower.iter_mut().zip(&self.terms[term]).for_each(|(x, term)| *x = sign * term);
        self.matrix.solve(&mut self.solution);
        let mut x = self.solution[..n].to_vec();
        if self.model.allow_redundancy {
            self.correct(&mut x, (term, sign));
        }
        x
    }

    /// One correction of `x` for the damping of redundant rows, of which an error in its proportion is left.
    fn correct(&mut self, x: &mut [f64], (term, sign): (usize, f64)) {
        let (upper, lower) = self.solution.split_at_mut(x.len());
        upper.fill(0.0);
        constraints::times_all(self.model, self.matrix.jacobian(), x, lower);
        let wanted = lower.iter_mut().zip(&self.terms[term]);
        wanted.for_each(|(left, term)| *left = sign * term - *left);
        self.matrix.solve(&mut self.solution);
        x.iter_mut().zip(&self.solution).for_each(|(x, dx)| *x += dx);
    }

    /// Φ at a position, scaled, for the path by its length.
    pub fn phi(&mut self, t: f64, q: &[f64]) -> Vec<f64> {
        self.evaluate(t, q, None);
        self.terms[0].iter().zip(&self.rows).map(|(phi, scale)| phi / scale).collect()
    }

    /// Whether the last point is far from singular positions.
    pub fn is_clear(&self) -> bool {
        self.kept > CLEAR
    }

    /// The sign of det Φ_q, which a regular motion keeps; 0 where it is not examined.
    pub fn orientation(&mut self, point: &Point) -> f64 {
        let n = self.model.layout.n_q;
        if self.model.layout.n_rows != n || n > MOST_DENSE {
            return 0.0;
        }
        let full = self.extended(point.t, &point.q, 1.0);
        let mut square: Vec<f64> =
            full.chunks(n + 1).flat_map(|row| row[..n].iter().copied()).collect();
        sign_of_determinant(&mut square, n)
    }

    /// Φ_q, scaled, with the column Φ_t, row by row, shape (n_rows, n_q + 1). `unit` is the scale of t.
    pub fn extended(&mut self, t: f64, q: &[f64], unit: f64) -> Vec<f64> {
        self.evaluate(t, q, None);
        let Self { model, motions, terms, .. } = self;
        let n = model.layout.n_q;
        let mut entries = vec![0.0; model.layout.n_entries];
        constraints::jacobian(model, motions, t, &mut entries);
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
