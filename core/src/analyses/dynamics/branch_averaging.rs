//! Reported states near a singular position. There, two branches of the motion may be closer than the tolerance, so
//! the nearest state that meets the constraints may belong to the wrong branch.
//!
//! The branches separate farther away. The state is therefore moved forward and backward along its rates and
//! projected there, and the mean of these states is extrapolated once. The error of the linear motion cancels, and
//! the remaining error from the curvature is of fourth order.

use crate::equations::Workspace;
use crate::math::{Listed, Real};
use crate::solve::Breakdown;
use crate::stabilize::Projector;

/// Largest change of the rates by projection on the correct branch, as a fraction of the fastest rate.
pub(super) const TURNED: f64 = 0.1;
/// Fraction of its magnitude that the worst pivot keeps near a singular position. The fraction is of the order of the
/// squared distance. Branches that differ by less than a tolerance are far closer to the position.
pub(super) const NEAR: f64 = 1e-4;
/// Largest distance between two states on different branches near a singular position, relative to the mechanism's
/// size or in rad.
pub(super) const BESIDE: f64 = 1e-3;
/// Distances of the neighbouring states, as fractions of the mechanism's size or in rad: first far away, where the
/// branches are well apart, then nearer, where the error from the curvature is smaller.
const AHEAD: [f64; 3] = [0.2, 0.05, 0.0125];
/// Position of each neighbouring state in units of the distance, and its weight. Even orders up to the second cancel.
const AROUND: [(f64, f64); 4] =
    [(1.0, 2.0 / 3.0), (-1.0, 2.0 / 3.0), (2.0, -1.0 / 6.0), (-2.0, -1.0 / 6.0)];

/// Change of v by projection, as a fraction of the fastest rate.
pub(super) fn turn<S: Real>(projector: &Projector<'_, S>, given: &[S], v: &[S]) -> f64 {
    projector.largest_difference(v, given) / projector.fastest().max(f64::MIN_POSITIVE)
}

/// Computes (q, v) from neighbouring states. The caller must project the result.
///
/// # Errors
/// [`Breakdown`] of a neighbouring state; q and v are then invalid.
pub(super) fn take(
    projector: &mut Projector<'_>,
    workspace: &mut Workspace,
    t: f64,
    (q, v): (&mut [f64], &mut [f64]),
) -> Result<(), Breakdown> {
    let fastest = projector.largest(v).max(f64::MIN_POSITIVE);
    for far in AHEAD {
        let [places, rates] = mean(projector, workspace, (t, far / fastest), (&*q, &*v))?;
        q.copy_from_slice(&places);
        v.copy_from_slice(&rates);
    }
    Ok(())
}

/// The mean of neighbouring states, `dt` apart.
fn mean(
    projector: &mut Projector<'_>,
    workspace: &mut Workspace,
    (t, dt): (f64, f64),
    (q, v): (&[f64], &[f64]),
) -> Result<[Vec<f64>; 2], Breakdown> {
    let mut means = [vec![0.0; q.len()], vec![0.0; v.len()]];
    for (ahead, weight) in AROUND {
        let mut places: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + ahead * dt * v).list();
        let mut rates = v.to_vec();
        projector.project(workspace, t + ahead * dt, (&mut places, &mut rates), false)?;
        for (mean, x) in means.iter_mut().zip([places, rates]) {
            mean.iter_mut().zip(x).for_each(|(mean, x)| *mean += weight * x);
        }
    }
    Ok(means)
}
