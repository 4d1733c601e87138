//! The law of compliant stops and contacts: N = max(0, k δⁿ (1 + c δ̇)) with the depth δ (Hunt and Crossley 1975).
//!
//! The elastic part k δⁿ has the potential k δⁿ⁺¹/(n + 1). The rest of N is the damping part. It dissipates energy in
//! both directions, and cancels the elastic part where 1 + c δ̇ < 0. With c in s/m and k in N/mⁿ, N is in N.

use super::force_trait::Situation;
use crate::math::Real;

/// The number of switches of one contact.
pub(super) const SWITCHES: usize = 2;

/// The default of `rest_speed`.
const REST_SPEED: f64 = 1e-9;

/// The coefficients of the law.
#[derive(Clone, Copy)]
pub(super) struct Hertz<S> {
    /// k, N/mⁿ.
    pub stiffness: S,
    /// n.
    pub exponent: S,
    /// c, s/m.
    pub damping: S,
}

/// A depth and its rate.
#[derive(Clone, Copy)]
pub(super) struct Depth<S> {
    /// δ, > 0 in contact.
    pub value: S,
    /// δ̇.
    pub rate: S,
}

/// The parts of N.
#[derive(Clone, Copy)]
pub(super) struct Normal<S> {
    /// k δⁿ.
    pub elastic: S,
    /// N - k δⁿ.
    pub damping: S,
}

impl<S: Real> Normal<S> {
    /// N.
    pub fn sum(self) -> S {
        self.elastic + self.damping
    }
}

impl<S: Real> Hertz<S> {
    /// The parts of N. `first` is the index of the first switch of the contact. None if there is no contact in any
    /// lane.
    pub fn normal(
        &self,
        at: &Situation<'_, S>,
        first: usize,
        depth: Depth<S>,
    ) -> Option<Normal<S>> {
        if !touches(at, first, depth.value) {
            return None;
        }
        let elastic = at.choose(first, depth.value, self.elastic(depth.value), S::zero());
        let factor = self.damping * depth.rate;
        let damping = at.choose(first + 1, S::one() + factor, elastic * factor, -elastic);
        Some(Normal { elastic, damping })
    }

    /// The potential of the elastic part, J.
    pub fn potential(&self, at: &Situation<'_, S>, first: usize, depth: S) -> S {
        if !touches(at, first, depth) {
            return S::zero();
        }
        let energy = self.elastic(depth) * depth / (self.exponent + S::one());
        at.choose(first, depth, energy, S::zero())
    }

    /// The functions of the switches: onset and release, and the sign of 1 + c δ̇ while in contact.
    pub fn switches(&self, depth: Depth<S>, out: &mut [S]) {
        let factor = S::one() + self.damping * depth.rate;
        out[0] = depth.value;
        out[1] = S::select(depth.value, factor, S::one());
    }

    /// k δⁿ, continued to negative depths as an odd function, so that a step may extend beyond the release.
    fn elastic(&self, depth: S) -> S {
        let squared = depth * depth;
        let bend = (self.exponent - S::one()) * depth.abs().ln();
        self.stiffness * S::select(squared, depth * bend.exp(), depth)
    }
}

/// Whether any lane is in contact; during a step, whether it was at the beginning of the step.
fn touches<S: Real>(at: &Situation<'_, S>, first: usize, depth: S) -> bool {
    match at.held.pieces.get(at.held.first + first) {
        Some(piece) if *piece != 0.0 => *piece > 0.0,
        _ => depth.in_lanes().iter().any(|depth| *depth > 0.0 || depth.is_nan()),
    }
}

/// The fault of the fields that select compliance or restitution.
pub(super) fn fault(
    stiffness: Option<f64>,
    [exponent, usual]: [f64; 2],
    damping: f64,
    [restitution, rest_speed]: [Option<f64>; 2],
) -> Option<(&'static str, String)> {
    let refuse = |field, message: &str| Some((field, message.to_string()));
    let alone = "not together with restitution; remove one of them";
    match (stiffness, restitution) {
        (None, None) => refuse("stiffness", "missing; give stiffness or restitution"),
        (Some(_), Some(_)) => {
            refuse("restitution", "not together with stiffness; remove one of them")
        }
        (Some(k), None) if k <= 0.0 => refuse("stiffness", "must be positive"),
        (Some(_), None) if exponent < 1.0 => refuse("exponent", "must be at least 1"),
        (Some(_), None) if damping < 0.0 => refuse("damping", "must not be negative"),
        (Some(_), None) if rest_speed.is_some_and(|speed| speed != REST_SPEED) => {
            refuse("rest_speed", "not together with stiffness; remove it")
        }
        (None, Some(_)) if rest_speed.is_some_and(|speed| speed < 0.0) => {
            refuse("rest_speed", "must not be negative")
        }
        (None, Some(_)) if damping != 0.0 => refuse("damping", alone),
        (None, Some(_)) if exponent != usual => refuse("exponent", alone),
        (None, Some(e)) if !(0.0..=1.0).contains(&e) => {
            refuse("restitution", "must be from 0 to 1")
        }
        _ => None,
    }
}
