//! One step along a path: prediction along the tangent, and correction normal to it by Newton's method.

use super::failure::Reason;
use super::spot::{ParameterPath, PathDirection, PathStep, Spot};
use crate::math::Listed;

/// Least cosine between neighbouring tangents.
const ALONG: f64 = 0.97;
/// Largest number of iterations.
const ITERATIONS: usize = 12;
/// Correction at which the iteration has converged, in units of the step.
const FOUND: f64 = 1e-13;
/// Correction below which an iteration that no longer contracts counts as converged.
const ROUNDING: f64 = 1e-9;

/// The point of the path at the distance `ds` along the tangent.
pub(super) fn advance(
    course: &ParameterPath<'_>,
    from: &PathStep,
    ds: f64,
) -> Result<PathStep, Reason> {
    towards(course, &from.spot, &from.tangent, ds)
}

/// The point of the path beyond a kink that is nearer than `ds`, as where a linear stop begins to push: the path turns
/// there to the tangent that the stiffness beyond the kink gives. None if the path does not continue.
pub(super) fn around(course: &ParameterPath<'_>, from: &PathStep, ds: f64) -> Option<PathStep> {
    let (ahead, goal) = predicted(&from.spot, &from.tangent, ds);
    let beyond = course.spot(goal, &ahead, &from.spot.place.z).ok()?;
    let after = course.tangent(&beyond, &from.tangent)?;
    [1.0, -1.0].into_iter().find_map(|sense| {
        let q = after.q.iter().map(|x| sense * x).list();
        let turned = PathDirection { q, p: sense * after.p };
        let back = course.along(&turned, &from.tangent) < -ALONG;
        towards(course, &from.spot, &turned, ds).ok().filter(|_| !back)
    })
}

/// The position and the value at the distance `ds` along a direction.
fn predicted(
    Spot { place, value, .. }: &Spot,
    tangent: &PathDirection,
    ds: f64,
) -> (Vec<f64>, f64) {
    let q = place.q.iter().zip(&tangent.q).map(|(q, dq)| q + ds * dq).list();
    (q, value + ds * tangent.p)
}

fn towards(
    course: &ParameterPath<'_>,
    from: &Spot,
    tangent: &PathDirection,
    ds: f64,
) -> Result<PathStep, Reason> {
    let (ahead, goal) = predicted(from, tangent, ds);
    let mut spot = course.spot(goal, &ahead, &from.place.z)?;
    let lost = || Reason::Lost { relative: f64::NAN, coordinate: course.over.to_string() };
    let mut last = f64::INFINITY;
    for iterations in 1..=ITERATIONS {
        let q: Vec<f64> = spot.place.q.iter().zip(&ahead).map(|(q, goal)| q - goal).list();
        let beside = course.along(&PathDirection { q, p: spot.value - goal }, tangent);
        let step = course.correction(&spot, tangent, beside).ok_or_else(lost)?;
        let size = course.along(&step, &step).sqrt();
        let done = size <= FOUND || (size <= ROUNDING && size >= 0.3 * last);
        if done {
            let after = course.tangent(&spot, tangent).ok_or_else(lost)?;
            return match course.along(&after, tangent) >= ALONG {
                true => Ok(PathStep { spot, tangent: after, iterations }),
                false => Err(lost()),
            };
        }
        if size > 0.5 * last || size > ds {
            return Err(lost());
        }
        let q: Vec<f64> = spot.place.q.iter().zip(&step.q).map(|(q, dq)| q + dq).list();
        spot = course.spot(spot.value + step.p, &q, &spot.place.z)?;
        last = size;
    }
    Err(lost())
}
