//! Locates a sign change of a function of the state within a step.
//!
//! The ends of the step bracket the root. The method of Chandrupatla locates it (*A new hybrid quadratic/bisection
//! algorithm for finding the zero of a nonlinear function without using derivatives*, Adv. Eng. Softw. 28 (1997)
//! 145): inverse quadratic interpolation where it is safe, otherwise bisection.

use super::step::Step;

/// The sign changes that count, along the direction of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From below zero to zero or above.
    Rising,
    /// From above zero to zero or below.
    Falling,
    /// In both directions.
    Any,
}

impl Direction {
    /// Whether the sign change from one value to a later value is rising. `None` if there is no sign change that
    /// counts.
    pub fn counts(self, before: f64, after: f64) -> Option<bool> {
        let rising = before < 0.0 && after >= 0.0;
        let falling = before > 0.0 && after <= 0.0;
        let counts = match self {
            Self::Rising => rising,
            Self::Falling => falling,
            Self::Any => rising || falling,
        };
        counts.then_some(rising)
    }
}

/// Time within `step` at which g(t, y) changes sign. At this time, just past the change, g has its new sign or is
/// zero; the change lies at most `tolerance` before. Returns `None` if g has the same sign at both ends or begins at
/// zero, because that root belongs to the step before. Of several changes one is found; an even number of changes is
/// missed.
///
/// `y` is scratch memory of the length of the state; on return it contains the state at the time found. `tolerance`
/// is absolute, in units of t, and is raised to four floating-point spacings.
pub fn locate(
    step: &Step<'_>,
    y: &mut [f64],
    mut g: impl FnMut(f64, &[f64]) -> f64,
    direction: Direction,
    tolerance: f64,
) -> Option<f64> {
    let (before, after) = signs(step, &mut g, direction)?;
    if after == 0.0 {
        y.copy_from_slice(step.y);
        return Some(step.t);
    }
    let sign = after.signum();
    let spacing = step.t.abs().max(step.t_old.abs()) * f64::EPSILON;
    let bracket = Bracket { old: (step.t_old, sign * before), new: (step.t, sign * after) };
    let t = bracket.close(tolerance.max(4.0 * spacing), |t| {
        step.interpolate(t, y);
        sign * g(t, y)
    });
    if t == step.t {
        y.copy_from_slice(step.y);
    } else {
        step.interpolate(t, y);
    }
    Some(t)
}

/// Whether g changes sign over a step in the given direction.
pub(super) fn changes_sign(
    step: &Step<'_>,
    g: &mut dyn FnMut(f64, &[f64]) -> f64,
    direction: Direction,
) -> bool {
    signs(step, g, direction).is_some()
}

/// The values of g at the ends of a step if g changes sign in the given direction.
fn signs(
    step: &Step<'_>,
    g: &mut dyn FnMut(f64, &[f64]) -> f64,
    direction: Direction,
) -> Option<(f64, f64)> {
    let (before, after) = (g(step.t_old, step.y_old), g(step.t, step.y));
    direction.counts(before, after).map(|_| (before, after))
}

/// A time and a value, which is positive on the side of the new sign.
type Point = (f64, f64);

/// Two times around a root. The value is negative at the old time and not negative at the new time. When integrating
/// backward, the new time is the earlier one.
pub(super) struct Bracket {
    pub old: Point,
    pub new: Point,
}

impl Bracket {
    /// Shortens the bracket to `tolerance`. Returns the time of its new side.
    pub fn close(mut self, tolerance: f64, mut g: impl FnMut(f64) -> f64) -> f64 {
        let mut part = 0.5;
        let (mut a, mut b) = (self.new, self.old);
        while (b.0 - a.0).abs() > tolerance {
            let t = a.0 + part * (b.0 - a.0);
            let latest = (t, g(t));
            if latest.1 == 0.0 {
                return t;
            }
            // NaN counts as the new sign
            let old_side = latest.1 < 0.0;
            let replaced = if old_side { self.old } else { self.new };
            let kept = if old_side { self.new } else { self.old };
            *(if old_side { &mut self.old } else { &mut self.new }) = latest;
            (a, b) = (latest, kept);
            // half the tolerance beyond the estimate, so that both sides approach the root
            let least = 0.5 * tolerance / (b.0 - a.0).abs();
            part = inverse_quadratic(a, b, replaced).unwrap_or(0.5).max(least).min(1.0 - least);
        }
        self.new.0
    }
}

/// The zero of the inverse quadratic interpolant through a, b and c, as a fraction of the way from a (0) to b (1).
/// `None` unless the interpolant is monotonic between a and b.
fn inverse_quadratic(a: Point, b: Point, c: Point) -> Option<f64> {
    let xi = (a.0 - b.0) / (c.0 - b.0);
    let phi = (a.1 - b.1) / (c.1 - b.1);
    let safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    let part = a.1 / (b.1 - a.1) * c.1 / (b.1 - c.1)
        + (c.0 - a.0) / (b.0 - a.0) * a.1 / (c.1 - a.1) * b.1 / (c.1 - b.1);
    (safe && part.is_finite()).then_some(part)
}
