//! Consistent velocities: the solution of Φ_q q̇ = ν that is nearest to the given velocities. The distance is the
//! kinetic energy of the difference.

use crate::equations::augmented::Augmented;
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, refine, Compiled};
use crate::math::Listed;
use crate::model::{column_scales, row_scales, size, Model};

/// Largest velocity residual that is not corrected, relative to its summands.
const TOLERANCE: f64 = 1e-12;
/// If a larger residual remains after corrections in the metric of the mass matrix, it is corrected in the metric of
/// the unit matrix. With mass ratios of 1e10 and more, the mass matrix leaves too few digits.
const ALIKE: f64 = 1e-10;
/// Damping of redundant rows, relative to the compliance of a point, and to that of an angle where it moves a point at
/// the distance of the size of the mechanism.
const REDUNDANT: f64 = 1e-10;
/// Number of corrections that are always made. The second removes the rounding errors of the first.
const LEAST: usize = 2;
/// Largest number of corrections. Damped rows converge by the ratio of their damping to the compliance at the
/// joint. This ratio is near 1 if heavy bodies are joined to light ones.
const MOST: usize = 30;

/// A metric of velocities.
struct Metric<'a> {
    matrix: &'a mut Augmented,
    /// Its largest 1/m.
    compliance: f64,
}

/// Makes `v` consistent at `q`; a consistent `v` is not changed. Returns the largest remaining component of Φ_q q̇ -
/// ν, relative to its summands. It is not near zero if the requested rates contradict each other.
pub fn project(model: &Model, t: f64, q: &[f64], v: &mut [f64]) -> f64 {
    let motions = Motions::at(&model.layout, q, v);
    let scales = row_scales(model);
    let open = largest(&velocity_residual(model, t, &motions), &scales);
    let fastest = open.max(largest(v, &column_scales(model))).max(f64::MIN_POSITIVE);
    if open / fastest <= TOLERANCE {
        return 0.0;
    }
    let mut matrix = Augmented::new(model);
    let compiled = Compiled::new(model);
    matrix.set_mass(&compiled, &motions);
    constraints::jacobian(model, &motions, t, matrix.jacobian_mut());
    let metric = Metric { matrix: &mut matrix, compliance: compiled.compliance() };
    let left = correct(model, t, q, v, (metric, &scales, fastest));
    if left <= ALIKE {
        return left;
    }
    let turning = size(model).powi(2);
    let lengths = model.layout.lengths().into_iter();
    let alike: Vec<f64> = lengths.map(|length| if length { 1.0 } else { turning }).list();
    matrix.set_weights(&alike);
    let metric = Metric { matrix: &mut matrix, compliance: 1.0 };
    correct(model, t, q, v, (metric, &scales, fastest))
}

/// Corrects `v` with the weights of the matrix until the residual no longer decreases; returns the residual.
fn correct(
    model: &Model,
    t: f64,
    q: &[f64],
    v: &mut [f64],
    (Metric { matrix, compliance }, scales, fastest): (Metric<'_>, &[f64], f64),
) -> f64 {
    matrix.set_damping(scales.iter().map(|_| 0.0));
    if matrix.factor().is_err() {
        let of_length = REDUNDANT * compliance / size(model).powi(2);
        matrix.set_damping(scales.iter().map(|scale| of_length * scale * scale));
        if matrix.factor().is_err() {
            return f64::INFINITY;
        }
    }
    let mut last = f64::INFINITY;
    for correction in 0..=MOST {
        let motions = Motions::at(&model.layout, q, v);
        let rate = velocity_residual(model, t, &motions);
        let left = largest(&rate, scales) / fastest;
        let settled = left <= TOLERANCE || left > 0.5 * last;
        if (correction >= LEAST && settled) || left.is_nan() {
            return left;
        }
        last = left;
        let mut x = vec![0.0; v.len()];
        rate.iter().map(|r| -r).append_to(&mut x);
        nearest(model, &motions, matrix, &mut x);
        v.iter_mut().zip(&x).for_each(|(v, dv)| *v += dv);
    }
    last
}

/// Solves for a correction in the metric. If the motion of a massless body is undetermined, all of its rates have the
/// same energy; the factorisation with added mass selects one of them.
fn nearest(model: &Model, motions: &Motions, matrix: &Augmented, x: &mut Vec<f64>) {
    if matrix.is_light() {
        let mut exact = x.clone();
        let memory = &mut refine::Memory::default();
        if refine::solve(model, motions, matrix, &mut exact, memory).is_ok() {
            *x = exact;
            return;
        }
    }
    matrix.solve(x);
}

/// The largest rate, with lengths relative to the size of the mechanism.
fn largest(rate: &[f64], scales: &[f64]) -> f64 {
    rate.iter().zip(scales).fold(0.0, |most: f64, (rate, scale)| most.max(rate.abs() / scale))
}

/// Φ_q q̇ + Φ_t.
fn velocity_residual(model: &Model, t: f64, motions: &Motions) -> Vec<f64> {
    let [_, rate, _] = constraints::terms_at(model, motions, t);
    rate
}
