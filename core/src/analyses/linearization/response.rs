//! Changes of the accelerations and multipliers due to a change f of the forces and g of the right sides of the
//! constraints:
//!
//! ```text
//! M δa + Φ_qᵀ δλ - R δλ = f        R = ∂(Q + loads)/∂λ
//! Φ_q δa                = g
//! ```
//!
//! With δa = p + N α, where p satisfies the constraints and its independent components are zero, α follows from the
//! reduced mass Nᵀ M N. If forces depend on the multipliers of a few rows, one additional solution is needed for each
//! of these rows.

use super::freedoms::Freedoms;
use super::least_norm::LeastNorm;
use super::variation::{StatePoint, Variation};
use crate::equations::kinematics::Motions;
use crate::equations::mass;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::solve_dense;

/// Fraction of its diagonal entry below which a pivot of the reduced mass counts as zero.
const MASSLESS: f64 = 1e-13;

/// Changes of accelerations and multipliers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LinearResponse {
    /// Changes of the accelerations of all coordinates, shape (n_q).
    pub a: Vec<f64>,
    /// Changes of the multipliers, shape (n_rows).
    pub lam: Vec<f64>,
    /// The reduced force Nᵀ (f + R δλ - M p), shape (f).
    pub force: Vec<f64>,
}

/// The linear equations at a state.
pub(super) struct Linear<'a> {
    model: &'a Model,
    motions: Motions,
    factors: LeastNorm<'a>,
    pub freedoms: Freedoms,
    /// Nᵀ M N, row by row.
    pub mass: Vec<f64>,
    /// The reduced mass after elimination.
    eliminated: Vec<f64>,
    /// Rows of the multipliers on which forces depend, with the columns of R.
    reactive: Vec<(usize, Vec<f64>)>,
    /// The response to each column of R.
    by_reaction: Vec<LinearResponse>,
}

impl<'a> Linear<'a> {
    /// The equations at a state with coordinates `q` and velocities `v`. `variation` belongs to the same state, and
    /// `rows` contains the rows of the multipliers on which forces depend. The error is the index of an independent
    /// coordinate without inertia.
    pub fn new(
        model: &'a Model,
        [q, v]: [&[f64]; 2],
        (freedoms, factors): (Freedoms, LeastNorm<'a>),
        (variation, rows): (&Variation<'_>, &[usize]),
    ) -> Result<Self, usize> {
        let motions = Motions::at(&model.layout, q, v);
        let mass = reduced_mass(model, &motions, &freedoms);
        let eliminated = eliminated(&mass, freedoms.basis.len())
            .map_err(|freedom| freedoms.coordinates[freedom])?;
        let column = |row: &usize| {
            let mut unit = vec![0.0; model.layout.n_rows];
            unit[*row] = 1.0;
            let own = factors.transposed(&unit);
            let all = variation.along(StatePoint { lam: &unit, ..StatePoint::default() }).forces;
            (*row, own.iter().zip(all).map(|(own, all)| own - all).list())
        };
        let reactive: Vec<(usize, Vec<f64>)> = rows.iter().map(column).list();
        let by_reaction = Vec::new();
        let mut linear =
            Self { model, motions, factors, freedoms, mass, eliminated, reactive, by_reaction };
        let none = vec![0.0; model.layout.n_rows];
        linear.by_reaction =
            linear.reactive.iter().map(|(_, column)| linear.plain(column, &none)).list();
        Ok(linear)
    }

    /// The change of velocities δv with Φ_q δv = `rates` whose independent components are zero, shape (n_q).
    pub fn velocities(&self, rates: &[f64]) -> Vec<f64> {
        let mut x = self.factors.least(rates);
        self.freedoms.without_motion(&mut x);
        x
    }

    /// The response to `f`, shape (n_q), and `g`, shape (n_rows).
    pub fn response(&self, f: &[f64], g: &[f64]) -> LinearResponse {
        let mut found = self.plain(f, g);
        let count = self.reactive.len();
        let mut matrix = vec![0.0; count * count];
        let mut change: Vec<f64> = self.reactive.iter().map(|(row, _)| found.lam[*row]).list();
        for (i, (row, _)) in self.reactive.iter().enumerate() {
            for (j, response) in self.by_reaction.iter().enumerate() {
                matrix[i * count + j] = f64::from(u8::from(i == j)) - response.lam[*row];
            }
        }
        if !solve_dense(&mut matrix, &mut change) {
            change.fill(f64::NAN);
        }
        for (response, change) in self.by_reaction.iter().zip(change) {
            let parts = [
                (&mut found.a, &response.a),
                (&mut found.lam, &response.lam),
                (&mut found.force, &response.force),
            ];
            for (to, from) in parts {
                to.iter_mut().zip(from).for_each(|(to, x)| *to += change * x);
            }
        }
        found
    }

    /// The response with R = 0.
    fn plain(&self, f: &[f64], g: &[f64]) -> LinearResponse {
        let mut a = self.velocities(g);
        let mut left = f.to_vec();
        self.subtract_mass_times(&a, &mut left);
        let force = self.freedoms.reduce(&left);
        let mut alpha = force.clone();
        substitute(&self.eliminated, &mut alpha);
        let motion = self.freedoms.extend(&alpha);
        self.subtract_mass_times(&motion, &mut left);
        a.iter_mut().zip(motion).for_each(|(a, x)| *a += x);
        LinearResponse { a, lam: self.factors.multipliers(&left), force }
    }

    fn subtract_mass_times(&self, x: &[f64], from: &mut [f64]) {
        let mut product = vec![0.0; x.len()];
        mass::add_times(self.model, &self.motions, x, &mut product);
        from.iter_mut().zip(product).for_each(|(from, y)| *from -= y);
    }
}

/// Nᵀ M N, row by row.
fn reduced_mass(model: &Model, motions: &Motions, freedoms: &Freedoms) -> Vec<f64> {
    let f = freedoms.basis.len();
    let mut reduced = vec![0.0; f * f];
    for (k, column) in freedoms.basis.iter().enumerate() {
        let mut product = vec![0.0; column.len()];
        mass::add_times(model, motions, column, &mut product);
        for (row, entry) in freedoms.reduce(&product).into_iter().enumerate() {
            reduced[row * f + k] = entry;
        }
    }
    reduced
}

/// A symmetric matrix, shape (n, n), after elimination without pivoting. The entries below the diagonal keep their
/// values from before they were eliminated. The error is the index of a row without a positive pivot.
fn eliminated(matrix: &[f64], n: usize) -> Result<Vec<f64>, usize> {
    let mut left = matrix.to_vec();
    for k in 0..n {
        let (above, below) = left.split_at_mut((k + 1) * n);
        let own = &above[k * n..];
        let pivot = own[k];
        if pivot.is_nan() || pivot <= MASSLESS * matrix[k * n + k] {
            return Err(k);
        }
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / pivot;
            row[k + 1..].iter_mut().zip(&own[k + 1..]).for_each(|(x, own)| *x -= factor * own);
        }
    }
    Ok(left)
}

/// Solves A x = b in place with the [eliminated] matrix A.
fn substitute(eliminated: &[f64], b: &mut [f64]) {
    let n = b.len();
    for k in 0..n {
        let row = &eliminated[k * n..][..n];
        let sum: f64 = (0..k).map(|j| row[j] / eliminated[j * n + j] * b[j]).sum();
        b[k] -= sum;
    }
    for k in (0..n).rev() {
        let row = &eliminated[k * n..][..n];
        let sum: f64 = row[k + 1..].iter().zip(&b[k + 1..]).map(|(a, x)| a * x).sum();
        b[k] = (b[k] - sum) / row[k];
    }
}
