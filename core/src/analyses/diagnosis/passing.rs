//! Kinds of singular positions.
//!
//! If rows of Φ_q depend on each other, Σ y_k Φ_q,k = 0, a motion q + ε w + … with Φ_q w = 0 must also satisfy B(w,
//! w) = Σ y_k wᵀ Φ_qq,k w = 0. If B has both signs on the null space, two motions cross: a change point. If B has one
//! sign, no motion exists in these directions, and the mechanism has only first-order play. If a driver takes part,
//! it cannot move the mechanism: a dead point.

use crate::analyses::freedoms;
use crate::analyses::mobility::Mobility;
use crate::analyses::second_forms::{forms, independent, ZERO};
use crate::analyses::Dependent;
use crate::math::Listed;
use crate::model::Model;
use std::fmt;

/// The kind of a singular position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularKind {
    /// A driver cannot move the mechanism.
    DeadPoint,
    /// Motions cross or touch: the position does not determine the branch.
    ChangePoint,
    /// Velocities exist without a motion: first-order play.
    Uncertainty,
    /// Equations hold only to second order in every position, and keep a coordinate constant.
    SecondOrder,
}

impl fmt::Display for SingularKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DeadPoint => "dead point",
            Self::ChangePoint => "change point",
            Self::Uncertainty => "uncertainty",
            Self::SecondOrder => "second order",
        })
    }
}

/// The kind of each equation that is dependent only at this position.
pub(super) fn kinds(model: &Model, t: f64, q: &[f64], mobility: &Mobility) -> Vec<SingularKind> {
    let driven = |one: &Dependent| one.group.iter().any(|k| model.constraints[*k].driven);
    let equations = &mobility.singular_equations;
    if equations.is_empty() {
        return Vec::new();
    }
    let of_joints: Vec<&Dependent> = equations.iter().filter(|one| !driven(one)).list();
    let kind = of_joints.first().map(|_| crossing(model, t, q, &of_joints));
    equations
        .iter()
        .map(|one| {
            if driven(one) {
                SingularKind::DeadPoint
            } else {
                kind.unwrap_or(SingularKind::ChangePoint)
            }
        })
        .list()
}

/// The directions in which a mechanism can move without its drivers. None if the model is too large.
pub(super) fn freedoms(model: &Model, t: f64, q: &[f64]) -> Option<Vec<Vec<f64>>> {
    freedoms::freedoms(model, t, q, |item| !item.driven)
}

/// The kind of a position at which equations of joints depend on each other.
fn crossing(model: &Model, t: f64, q: &[f64], equations: &[&Dependent]) -> SingularKind {
    let Some(freedoms) = freedoms(model, t, q) else { return SingularKind::ChangePoint };
    let forms = independent(forms(model, t, q, equations, &freedoms));
    let definite = |form: &Vec<f64>| {
        let [least, most] = signs(form, freedoms.len());
        least > ZERO || most < -ZERO
    };
    // a form with one sign excludes every motion
    match forms.iter().any(definite) {
        true => SingularKind::Uncertainty,
        false => SingularKind::ChangePoint,
    }
}

/// The smallest and the largest eigenvalue of a symmetric matrix, by Jacobi rotations.
fn signs(form: &[f64], n: usize) -> [f64; 2] {
    let mut a = form.to_vec();
    for _ in 0..30 {
        let mut rest = 0.0;
        for p in 0..n {
            for q in p + 1..n {
                let off = a[p * n + q];
                rest += off * off;
                if off.abs() < f64::MIN_POSITIVE {
                    continue;
                }
                let theta = 0.5 * (a[q * n + q] - a[p * n + p]) / off;
                let tan = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let cos = 1.0 / tan.hypot(1.0);
                let sin = tan * cos;
                for k in 0..n {
                    let (x, y) = (a[k * n + p], a[k * n + q]);
                    (a[k * n + p], a[k * n + q]) = (cos * x - sin * y, sin * x + cos * y);
                }
                for k in 0..n {
                    let (x, y) = (a[p * n + k], a[q * n + k]);
                    (a[p * n + k], a[q * n + k]) = (cos * x - sin * y, sin * x + cos * y);
                }
            }
        }
        if rest < 1e-30 {
            break;
        }
    }
    let values = (0..n).map(|k| a[k * n + k]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}
