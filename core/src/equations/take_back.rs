//! Removes the effect of the inertia E = Σ κ u uᵀ that is added where no body can lend (`equations/lending.rs`). The
//! vectors u are unit vectors of coordinates.
//!
//! Let P = K + E be the factorised matrix and K the matrix of the equations. The additions are subtracted from P one
//! after the other (J. Sherman, W. J. Morrison, Ann. Math. Stat. 21 (1950) 124):
//!
//! ```text
//! (P - κ u uᵀ)⁻¹ b = x + y (uᵀ x) / (1 - g),   x = P⁻¹ b,   y = P⁻¹ κ u,   g = uᵀ y
//! ```
//!
//! If the mechanism itself has little inertia along y, g is near 1, and 1 - g has lost its digits. But 1 - g is also
//! yᵀ (P - κ u uᵀ) y / (κ g), which is a sum of squares: twice the kinetic energy of the motion y. A degree of
//! freedom whose only inertia is that of a light body therefore keeps its digits. A motion without energy moves no
//! mass; in this case the addition is not removed.

use super::augmented::Augmented;
use super::kinematics::Motions;
use super::loans::Addition;
use super::{constraints, mass};
use crate::math::Real;
use crate::model::Model;

/// Value of g above which 1 - g is computed from the energy.
const LITTLE_INERTIA: f64 = 0.5;
/// Largest 1 - g of a motion without mass. Rounding errors leave about 1e-28.
const MASSLESS: f64 = 1e-22;

/// The motion with which one addition is removed.
#[derive(Clone, Debug)]
struct AddedMotion<S> {
    /// Column of the addition.
    column: usize,
    /// y: coordinates, padding and multipliers.
    y: Vec<S>,
    /// 1 / (1 - g).
    factor: S,
}

/// The directions y of all additions at one state.
#[derive(Clone, Debug)]
pub(super) struct Directions<S> {
    all: Vec<AddedMotion<S>>,
    /// Φ_q y.
    rows: Vec<S>,
}

impl<S> Default for Directions<S> {
    fn default() -> Self {
        Self { all: Vec::new(), rows: Vec::new() }
    }
}

impl<S: Real> Directions<S> {
    /// Computes the directions with the factors of the matrix. Returns the coordinate of a motion without mass, if there
    /// is any.
    pub fn find(
        &mut self,
        model: &Model<S>,
        motions: &Motions<S>,
        matrix: &Augmented<S>,
    ) -> Option<usize> {
        let additions = matrix.additions();
        let none = || AddedMotion { column: 0, y: Vec::new(), factor: S::zero() };
        self.all.resize_with(additions.len(), none);
        let mut massless = None;
        for (k, Addition { column, weight }) in additions.iter().enumerate() {
            let (before, after) = self.all.split_at_mut(k);
            let own = &mut after[0];
            own.column = *column;
            matrix.put_response(*column, S::constant(*weight), &mut own.y);
            let (a, lam) = own.y.split_at_mut(matrix.plan().n_unknowns());
            before.iter().for_each(|direction| direction.apply(a, lam));
            let g = a[*column];
            own.factor = S::one() / (S::one() - g);
            let little = g - S::constant(LITTLE_INERTIA);
            if any(S::select(little, S::one(), S::zero())) {
                let mut energy = mass::twice_energy(model, motions, a);
                if matrix.regularised() || matrix.damps() {
                    energy += stretched(model, matrix, (a, lam), &mut self.rows);
                }
                for later in &additions[k + 1..] {
                    let moved = a[later.column];
                    energy += S::constant(later.weight) * moved * moved;
                }
                let all = S::constant(*weight) * g;
                let moves = energy - S::constant(MASSLESS) * all;
                let factor = S::select(moves, all / energy, S::zero());
                own.factor = S::select(little, factor, own.factor);
                if any(S::select(little, S::select(moves, S::zero(), S::one()), S::zero())) {
                    massless = Some(*column);
                }
            }
        }
        massless
    }

    /// Changes x = P⁻¹ b to K⁻¹ b, for coordinates and multipliers.
    pub fn take_back(&self, a: &mut [S], lam: &mut [S]) {
        self.all.iter().for_each(|direction| direction.apply(a, lam));
    }
}

impl<S: Real> AddedMotion<S> {
    fn apply(&self, a: &mut [S], lam: &mut [S]) {
        let part = a[self.column] * self.factor;
        let (moved, multipliers) = self.y.split_at(self.y.len() - lam.len());
        for (x, y) in a.iter_mut().zip(moved).chain(lam.iter_mut().zip(multipliers)) {
            *x = x.plus_product(part, *y);
        }
    }
}

/// The contribution of damped rows to yᵀ K y: λᵀ Φ_q y.
fn stretched<S: Real>(
    model: &Model<S>,
    matrix: &Augmented<S>,
    (a, lam): (&[S], &[S]),
    rows: &mut Vec<S>,
) -> S {
    rows.clear();
    rows.resize(model.layout.n_rows, S::zero());
    constraints::times_all(model, matrix.jacobian(), a, rows);
    rows.iter().zip(lam).fold(S::zero(), |sum, (row, lam)| sum.plus_product(*row, *lam))
}

/// Whether a number is positive in any lane.
fn any<S: Real>(x: S) -> bool {
    S::select(x, S::one(), S::zero()).largest_magnitude() > 0.0
}
