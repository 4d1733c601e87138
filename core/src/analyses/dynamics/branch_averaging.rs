//! Reported states beside a singular position, where branches of the motion are closer to each other than
//! a loose tolerance is tight: the nearest state that meets the constraints may be one of another branch.
//!
//! Further off the branches are apart. So the state is moved ahead and behind along its rates, projected
//! there, and taken as the mean, extrapolated once: the error of the extension is the same in all of them
//! and goes, and what curvature leaves is of the fourth order.

use crate::equations::Workspace;
use crate::math::Real;
use crate::stabilize::{Fault, Projector};

/// Part of the fastest rate by which projection changes the rates of a state of the right branch at most.
pub(super) const TURNED: f64 = 0.1;
/// How far ahead, in parts of the mechanism or rad: first where branches are well apart, then closer by,
/// where curvature leaves less, since rates have what is left over σ.
const AHEAD: [f64; 3] = [0.2, 0.05, 0.0125];
/// How far, in parts of that, and what it counts: even orders up to the second cancel.
const AROUND: [(f64, f64); 4] =
    [(1.0, 2.0 / 3.0), (-1.0, 2.0 / 3.0), (2.0, -1.0 / 6.0), (-2.0, -1.0 / 6.0)];

/// Part of the fastest rate by which projection changed v.
pub(super) fn turn<S: Real>(projector: &Projector<'_, S>, given: &[S], v: &[S]) -> f64 {
    projector.largest_difference(v, given) / projector.fastest().max(f64::MIN_POSITIVE)
}

/// Takes (q, v) from states around; they are to be projected then.
///
/// # Errors
/// [`Fault`] of a state around; q and v are then of no use.
pub(super) fn take(
    projector: &mut Projector<'_>,
    workspace: &mut Workspace,
    t: f64,
    (q, v): (&mut [f64], &mut [f64]),
) -> Result<(), Fault> {
    let fastest = projector.largest(v).max(f64::MIN_POSITIVE);
    for far in AHEAD {
        let [places, rates] = mean(projector, workspace, (t, far / fastest), (&*q, &*v))?;
        q.copy_from_slice(&places);
        v.copy_from_slice(&rates);
    }
    Ok(())
}

/// The mean of states around, `dt` apart.
fn mean(
    projector: &mut Projector<'_>,
    workspace: &mut Workspace,
    (t, dt): (f64, f64),
    (q, v): (&[f64], &[f64]),
) -> Result<[Vec<f64>; 2], Fault> {
    let mut means = [vec![0.0; q.len()], vec![0.0; v.len()]];
    for (ahead, weight) in AROUND {
        let mut places: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + ahead * dt * v).collect();
        let mut rates = v.to_vec();
        projector.project(workspace, t + ahead * dt, (&mut places, &mut rates), false)?;
        for (mean, x) in means.iter_mut().zip([places, rates]) {
            mean.iter_mut().zip(x).for_each(|(mean, x)| *mean += weight * x);
        }
    }
    Ok(means)
}
