//! An equilibrium position with its stability and its forces.

use super::failure::Reason;
use super::search::{relative, zero};
use super::statics::{StaticState, Statics};
use crate::analyses::curves;
use crate::analyses::linearization::coordinate;
use crate::analyses::rigid::RigidContacts;
use crate::analyses::State;
use crate::math::{Listed, Ordered};
use crate::model::{Model, Problem};
use crate::solve::{eigenvalues as of_matrix, Eigen};

/// Largest asymmetry of a stiffness that has a potential, relative to its largest entry.
const SYMMETRIC: f64 = 1e-9;

/// An equilibrium position.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The state, with v = 0 and ż = 0.
    pub state: State,
    /// Multipliers of joints and drivers: Φ_qᵀ λ = Q with the loads of joints, shape (n_rows).
    pub lam: Vec<f64>,
    /// The effort of each holder, positive if it increases its quantity, N or N·m.
    pub holders: Vec<f64>,
    /// The effort of each driver by its name.
    pub efforts: Vec<(String, f64)>,
    /// Names of the independent coordinates of the reduced stiffness.
    pub coordinates: Vec<String>,
    /// The reduced stiffness on the independent coordinates, shape (f, f).
    pub stiffness: Vec<f64>,
    /// Eigenvalues of the symmetric part of the stiffness, ascending. The stiffness is symmetric if all forces have a
    /// potential.
    pub eigenvalues: Vec<f64>,
    /// Whether all eigenvalues are positive.
    pub stable: bool,
    /// The residual force, relative to the largest single force.
    pub residual: f64,
    /// Number of steps of Newton's method.
    pub steps: usize,
    /// Number of steps of dynamic relaxation.
    pub relaxed: usize,
}

impl Equilibrium {
    /// The eigenvalues that decide about the stability, ascending, and whether all are positive. Forces without a
    /// potential have an asymmetric stiffness: the real parts of its eigenvalues decide about divergence.
    pub fn stability(&self) -> (Vec<f64>, bool) {
        let (f, k) = (self.coordinates.len(), &self.stiffness);
        let largest = k.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let skew = |place: usize| (k[place] - k[place % f * f + place / f]).abs();
        if (0..f * f).all(|place| skew(place) <= SYMMETRIC * largest) {
            return (self.eigenvalues.clone(), self.stable);
        }
        let mut parts: Vec<f64> = of_matrix(k, f).into_iter().map(|s| s.re).list();
        parts.sort_by(f64::total_cmp);
        let stable = parts.iter().all(|x| *x > 0.0);
        (parts, stable)
    }

    /// The result at a closed position of a model whose last `holders` rows belong to holders.
    pub(super) fn at(
        statics: &Statics<'_>,
        place: &StaticState,
        holders: usize,
    ) -> Result<Self, Reason> {
        let model = statics.model;
        is_within(model, statics.t, place)?;
        let local = statics.local(place)?;
        let scaled = Eigen::of(&local.stiffness, local.gradient.len()).values;
        let limit = zero(&local.stiffness, place.scale);
        let freedoms = statics.freedoms(place)?;
        let stiffness = statics.stiffness(place, &freedoms)?;
        let mut eigenvalues = Eigen::of(&stiffness, freedoms.coordinates.len()).values;
        let zeros = scaled.iter().filter(|x| x.abs() <= limit).count();
        let mut order: Vec<usize> = (0..eigenvalues.len()).list();
        order.order_by(|a, b| eigenvalues[*a].abs().total_cmp(&eigenvalues[*b].abs()));
        order.iter().take(zeros).for_each(|k| eigenvalues[*k] = 0.0);
        eigenvalues.sort_by(f64::total_cmp);
        let own = model.layout.n_rows - holders;
        let lam = statics.with_loads(place)?;
        let rest = vec![0.0; place.q.len()];
        Ok(Self {
            state: State { t: statics.t, q: place.q.clone(), v: rest, z: place.z.clone() },
            lam: lam[..own].to_vec(),
            holders: lam[own..].iter().map(|lam| -lam).list(),
            efforts: efforts(model, &lam, own),
            coordinates: freedoms.coordinates.iter().map(|k| coordinate(model, *k)).list(),
            stable: scaled.iter().all(|x| *x > limit),
            stiffness,
            eigenvalues,
            residual: relative(&local, place),
            steps: 0,
            relaxed: 0,
        })
    }
}

/// Rejects a position beyond a stop or contact with restitution, which exerts no force there, or beyond the end of a
/// curve.
fn is_within(model: &Model, t: f64, place: &StaticState) -> Result<(), Reason> {
    let refused = |problem: Problem, hint: &str| Err(Reason::Option(vec![problem.hint(hint)]));
    if let Some((name, _)) = RigidContacts::of(model).beyond(model, t, &place.q) {
        let message =
            "the mechanism would come to rest beyond it, where restitution gives no force";
        let problem = Problem::at(&["forces", &name], message);
        return refused(problem, "give it a stiffness in place of restitution");
    }
    if let Some((name, message)) = curves::beyond(model, &place.q) {
        let problem = Problem::at(&["joints", &name], message);
        return refused(problem, "extend the range of the curve, or add a stop before its end");
    }
    Ok(())
}

/// The efforts of the drivers whose rows come before `own`.
fn efforts(model: &Model, lam: &[f64], own: usize) -> Vec<(String, f64)> {
    let all = model.constraints.iter().zip(&model.layout.constraints);
    let drivers =
        all.filter(|(item, slots)| item.element.drives().is_some() && slots.rows.end <= own);
    drivers.map(|(item, slots)| (item.name.clone(), -lam[slots.rows.start])).list()
}
