//! Where a function of the state changes sign within a step.
//!
//! The root is bracketed by the ends of the step and closed in by the ITP method (Oliveira and
//! Takahashi, *An enhancement of the bisection method average performance preserving minmax
//! optimality*, ACM Trans. Math. Softw. 47 (2020) 5): superlinear for smooth functions, never slower
//! than bisection by more than one iteration.

use super::contract::Step;

/// Which changes of sign count, along the direction of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From below zero to zero or above.
    Rising,
    /// From above zero to zero or below.
    Falling,
    /// Both.
    Any,
}

/// Time within `step` at which g(t, y) changes sign, just past the change: g has its new sign (or is
/// zero) there, and the change is at most `tolerance` before. `None` if g has the same sign at both ends
/// or begins at zero (that root belongs to the step before); of several changes one is found, and an
/// even number of them goes unseen.
///
/// `y` is scratch, as long as the state, and afterwards holds the state at the time found. `tolerance`
/// is absolute, in units of t, and never below four spacings of numbers.
pub fn locate(
    step: &Step<'_>,
    y: &mut [f64],
    mut g: impl FnMut(f64, &[f64]) -> f64,
    direction: Direction,
    tolerance: f64,
) -> Option<f64> {
    let before = g(step.t_old, step.y_old);
    let after = g(step.t, step.y);
    let rising = before < 0.0 && after >= 0.0;
    let falling = before > 0.0 && after <= 0.0;
    let counts = match direction {
        Direction::Rising => rising,
        Direction::Falling => falling,
        Direction::Any => rising || falling,
    };
    if !counts {
        return None;
    }
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

/// Times and values around a root: below zero at the old side, above at the new one, which may be the
/// earlier when integrating backward.
struct Bracket {
    old: (f64, f64),
    new: (f64, f64),
}

impl Bracket {
    /// Closes in until the sides are `tolerance` apart; returns the new side.
    fn close(mut self, tolerance: f64, mut g: impl FnMut(f64) -> f64) -> f64 {
        let width = (self.new.0 - self.old.0).abs();
        let bisections = (width / tolerance).log2().ceil().max(0.0);
        let k1 = 0.2 / width;
        let mut j = 0.0;
        while (self.new.0 - self.old.0).abs() > tolerance {
            // how far the point may stay from the middle for bisection to keep its promise
            let reach = 0.5 * tolerance * (bisections + 1.0 - j).exp2();
            let t = self.point(k1, reach, tolerance);
            if t == self.old.0 || t == self.new.0 {
                break;
            }
            let value = g(t);
            if value < 0.0 {
                self.old = (t, value);
            } else {
                self.new = (t, value); // zero and NaN end on the far side
            }
            j += 1.0;
        }
        self.new.0
    }

    /// Interpolate by the secant, truncate towards the middle, project into reach of it.
    fn point(&self, k1: f64, reach: f64, tolerance: f64) -> f64 {
        let (a, b) = (self.old, self.new);
        let width = b.0 - a.0;
        let middle = a.0 + 0.5 * width;
        let secant = a.0 + width * (a.1 / (a.1 - b.1));
        if !secant.is_finite() {
            return middle;
        }
        // half the tolerance past the secant, so that both sides close in on a root
        let push = (k1 * width * width).max(0.5 * tolerance);
        let away = middle - secant;
        let truncated = if push <= away.abs() { secant + push.copysign(away) } else { middle };
        let room = (reach - 0.5 * width.abs()).max(0.0);
        if (truncated - middle).abs() <= room {
            truncated
        } else {
            middle - room.copysign(away)
        }
    }
}
