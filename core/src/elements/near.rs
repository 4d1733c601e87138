//! The point of a curve that is nearest to a given point.

use crate::math::{Local, Real};

/// The nearest point of a curve, in the frame of the curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near<S> {
    /// The distance, > 0 on the side of the contact.
    pub distance: S,
    /// The gradient of the distance, a unit vector away from the body of the curve.
    pub away: Local<S>,
    /// The nearest point.
    pub place: Local<S>,
}

/// The first point where the condition is positive, otherwise the second.
pub(super) fn choose<S: Real>(condition: S, positive: Near<S>, otherwise: Near<S>) -> Near<S> {
    let pick = |a: S, b: S| S::select(condition, a, b);
    let both = |a: Local<S>, b: Local<S>| Local::new(pick(a.x, b.x), pick(a.y, b.y));
    Near {
        distance: pick(positive.distance, otherwise.distance),
        away: both(positive.away, otherwise.away),
        place: both(positive.place, otherwise.place),
    }
}
