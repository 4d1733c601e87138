//! Points and tangents of an equilibrium path over a parameter p.
//!
//! Along a path, K u + k dp = 0 with the reduced stiffness K and the derivative k of the reduced forces with respect
//! to p. The motion is dq = B u + (dq/dp) dp with the basis B of the degrees of freedom. At a fold, dp = 0 and K is
//! singular, but the matrix [K k] has full rank, so that the system with one additional row is regular.

use super::failure::Reason;
use super::parameter::{self, ByParameter};
use super::result::Equilibrium;
use super::search::zero;
use super::statics::{LocalForces, StaticState, Statics};
use crate::math::Listed;
use crate::model::Model;
use crate::solve::{solve_dense, Eigen};

/// A path over a parameter.
pub(super) struct ParameterPath<'m> {
    /// The model with its holders.
    pub model: &'m Model,
    /// Number of holders.
    pub holders: usize,
    pub t: f64,
    /// The parameter.
    pub over: &'m str,
    /// The range of the parameter, which is its unit.
    pub unit: f64,
    /// 1/(s² n) for each coordinate, with its scale s and the number n of coordinates.
    pub weights: Vec<f64>,
}

/// A direction (dq, dp).
#[derive(Clone, Debug)]
pub(super) struct PathDirection {
    pub q: Vec<f64>,
    pub p: f64,
}

/// A closed position at a value of the parameter, not necessarily in equilibrium.
pub(super) struct Spot {
    pub value: f64,
    pub place: StaticState,
    local: LocalForces,
    by: ByParameter,
    /// Derivative of the reduced forces with respect to the parameter.
    reduced: Vec<f64>,
}

/// A point of the path.
pub(super) struct PathStep {
    pub spot: Spot,
    pub tangent: PathDirection,
    /// Number of iterations to find it.
    pub iterations: usize,
}

impl ParameterPath<'_> {
    /// The closed position near `q` at a value of the parameter.
    pub fn spot(&self, value: f64, q: &[f64], z: &[f64]) -> Result<Spot, Reason> {
        let model = parameter::at(self.model, self.over, value)?;
        let mut statics = Statics::new(&model, self.t);
        let place = statics.place(q, z)?;
        let local = statics.local(&place)?;
        let by = ByParameter::new(&statics, &place, self.over)?;
        let reduced = local.basis.reduce(&by.missing);
        match reduced.iter().all(|x| x.is_finite()) {
            true => Ok(Spot { value, place, local, by, reduced }),
            false => Err(Reason::NotFinite),
        }
    }

    /// The result at a spot.
    pub fn equilibrium(&self, spot: &Spot) -> Result<Equilibrium, Reason> {
        let model = parameter::at(self.model, self.over, spot.value)?;
        let statics = Statics::new(&model, self.t);
        Equilibrium::at(&statics, &spot.place, self.holders)
    }

    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.weights).map(|((a, b), w)| a * b * w).sum()
    }

    /// The scalar product of two directions.
    pub fn along(&self, a: &PathDirection, b: &PathDirection) -> f64 {
        self.product(&a.q, &b.q) + a.p * b.p / (self.unit * self.unit)
    }

    /// Solves K u + k dp = `right` with the condition that the scalar product of the direction and `row` equals
    /// `last`.
    fn solved(
        &self,
        spot: &Spot,
        row: &PathDirection,
        right: &[f64],
        last: f64,
    ) -> Option<PathDirection> {
        let LocalForces { basis, stiffness, .. } = &spot.local;
        let f = spot.reduced.len();
        let n = f + 1;
        let mut matrix = vec![0.0; n * n];
        for r in 0..f {
            matrix[r * n..r * n + f].copy_from_slice(&stiffness[r * f..(r + 1) * f]);
            matrix[r * n + f] = spot.reduced[r];
        }
        // the scale makes the last row comparable to the others
        let size = matrix.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        for (column, b) in basis.basis.iter().enumerate() {
            matrix[f * n + column] = size * self.product(b, &row.q);
        }
        let of_value = self.product(&spot.by.motion, &row.q) + row.p / (self.unit * self.unit);
        matrix[f * n + f] = size * of_value;
        let mut x = right.to_vec();
        x.push(size * last);
        if !solve_dense(&mut matrix, &mut x) || x.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mut q = basis.extend(&x[..f]);
        if q.is_empty() {
            q = vec![0.0; spot.place.q.len()];
        }
        q.iter_mut().zip(&spot.by.motion).for_each(|(q, motion)| *q += motion * x[f]);
        Some(PathDirection { q, p: x[f] })
    }

    /// The unit tangent at a point of the path, in the sense of `before`.
    pub fn tangent(&self, spot: &Spot, before: &PathDirection) -> Option<PathDirection> {
        let none = vec![0.0; spot.reduced.len()];
        let mut tangent = self.solved(spot, before, &none, 1.0)?;
        let length = self.along(&tangent, &tangent).sqrt();
        tangent.q.iter_mut().for_each(|x| *x /= length);
        tangent.p /= length;
        Some(tangent)
    }

    /// The Newton correction of a spot. It leads to the plane normal to `tangent` through the prediction; `ahead` is
    /// the distance of the spot from this plane.
    pub fn correction(
        &self,
        spot: &Spot,
        tangent: &PathDirection,
        ahead: f64,
    ) -> Option<PathDirection> {
        let right: Vec<f64> = spot.local.gradient.iter().map(|g| -g).list();
        self.solved(spot, tangent, &right, -ahead)
    }
}

impl Spot {
    /// Number of negative eigenvalues of the stiffness.
    pub fn negative(&self) -> usize {
        let limit = zero(&self.local.stiffness, self.place.scale);
        let values = Eigen::of(&self.local.stiffness, self.reduced.len()).values;
        values.iter().filter(|x| **x < -limit).count()
    }
}
