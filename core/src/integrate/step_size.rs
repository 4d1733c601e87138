//! Choice of the step size from the error estimate by the elementary controller of Hairer, Nørsett and Wanner,
//! *Solving Ordinary Differential Equations I*, II.4,
//!
//! ```text
//! h_new = h min(most, factor),   factor = safety norm^(-1/k),   k the order of the estimate + 1,
//! ```
//!
//! The constants depend on the method. A controller may hold its step: a factor above 1 is divided by `hold`, but not
//! below 1. A step therefore grows only if it is too short by more than the factor `hold`. Controllers with a memory
//! of errors (Gustafsson 1991; Söderlind, *Digital filters in adaptive time-stepping*, ACM TOMS 29 (2003) 1)
//! performed worse for mechanisms: `docs/performance.md`.

/// Factor on the step after the system refused the state at its end.
const REFUSED: f64 = 0.7;
/// An implicit method keeps the step and its matrices if the step could grow by less than this factor.
pub(super) const KEEP: f64 = 1.2;
/// Smallest factor from one step to the next.
const MIN_FACTOR: f64 = 0.2;
/// Largest factor from one step to the next.
const MAX_FACTOR: f64 = 10.0;
/// Smallest step, as a multiple of the floating-point spacing at t.
const MIN_SPACINGS: f64 = 10.0;

/// Constants of the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Control {
    /// Fraction of the optimal step that is tried.
    pub safety: f64,
    /// Factor by which a step must be too short before it grows. With 1 it grows at once.
    pub hold: f64,
}

impl Control {
    /// The controller of `scipy.integrate`.
    pub const ELEMENTARY: Self = Self { safety: 0.9, hold: 1.0 };
}

/// The size of the next trial step, as a magnitude.
pub(super) struct StepSize {
    pub size: f64,
    /// Whether a trial of the current step was rejected. If so, the next step must not grow.
    rejected: bool,
    /// -1 / (order of the error estimate + 1).
    exponent: f64,
    pub control: Control,
}

impl StepSize {
    #[inline]
    pub fn new(size: f64, error_order: i32, control: Control) -> Self {
        Self { size, rejected: false, exponent: -1.0 / f64::from(error_order + 1), control }
    }

    /// Clips the size to its bounds, at the beginning of a step.
    pub fn begin(&mut self, least: f64, most: f64) {
        self.rejected = false;
        // not f64::clamp: near the largest numbers `least` may exceed `most`
        if self.size > most {
            self.size = most;
        } else if self.size < least {
            self.size = least;
        }
    }

    /// Updates the size after an accepted step of magnitude `h` with an error norm below 1.
    pub fn accept(&mut self, h: f64, norm: f64) {
        let Control { safety, hold } = self.control;
        let factor = safety * norm.powf(self.exponent); // infinite for zero error
                                                        // a division by 1 would only add latency
        let factor = match factor > 1.0 && hold != 1.0 {
            true => (factor / hold).max(1.0),
            false => factor,
        };
        let most = if self.rejected { 1.0 } else { MAX_FACTOR };
        self.size = h * factor.min(most);
    }

    /// Updates the size after a rejected step of magnitude `h`, with an error norm of at least 1 or NaN.
    #[inline]
    pub fn reject(&mut self, h: f64, norm: f64) {
        self.rejected = true;
        self.size = h * (self.control.safety * norm.powf(self.exponent)).max(MIN_FACTOR);
    }

    /// Updates the size after the system refused the end of a step of magnitude `h`. The next step may grow at once,
    /// past the refused end.
    #[inline]
    pub fn refuse(&mut self, h: f64) {
        self.rejected = false;
        self.size = h * REFUSED;
    }
}

/// The smallest magnitude of a step from t in a direction (+1 or -1).
#[inline]
pub(super) fn least_step(t: f64, direction: f64) -> f64 {
    let outward = t == 0.0 || (t > 0.0) == (direction > 0.0);
    let bits = t.abs().to_bits();
    let next = f64::from_bits(if outward { bits + 1 } else { bits - 1 });
    MIN_SPACINGS * (next - t.abs()).abs()
}

/// First guess of the first step, from a first-order method (the algorithm of II.4 before its trial step). `d0` and
/// `d1` are the scaled norms of y and f.
#[inline]
pub(super) fn probing_step(d0: f64, d1: f64, interval: f64) -> f64 {
    let guess = if d0 < 1e-5 || d1 < 1e-5 { 1e-6 } else { 0.01 * d0 / d1 };
    guess.min(interval)
}

/// Second guess of the first step. `d2` is the scaled norm of the second derivative, from the probing step `h0`.
pub(super) fn initial_step(h0: f64, d1: f64, d2: f64, error_order: i32) -> f64 {
    let h1 = if d1 <= 1e-15 && d2 <= 1e-15 {
        (h0 * 1e-3).max(1e-6)
    } else {
        (0.01 / d1.max(d2)).powf(1.0 / f64::from(error_order + 1))
    };
    (100.0 * h0).min(h1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELD: Control = Control { safety: 0.8, hold: 1.25 };

    /// The factor after a step that was accepted with an error of order 3.
    fn after(control: Control, norm: f64) -> f64 {
        let mut size = StepSize::new(1.0, 3, control);
        size.accept(2.0, norm);
        size.size / 2.0
    }

    #[test]
    fn the_elementary_controller_takes_its_part_of_the_optimal_step() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        close(after(Control::ELEMENTARY, 0.5_f64.powi(4)), 1.8);
        close(after(Control::ELEMENTARY, 0.9_f64.powi(4)), 1.0);
        close(after(Control::ELEMENTARY, 0.95_f64.powi(4)), 0.9 / 0.95);
        close(after(Control::ELEMENTARY, 0.0), 10.0);
        close(after(Control::ELEMENTARY, 1e-30), 10.0);
    }

    #[test]
    fn a_step_is_held_until_it_is_short_by_more() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        close(after(HELD, 0.5_f64.powi(4)), 1.28);
        close(after(HELD, 0.64_f64.powi(4)), 1.0);
        assert_eq!([0.65, 0.7, 0.79].map(|e: f64| after(HELD, e.powi(4))), [1.0; 3]);
        close(after(HELD, 0.9_f64.powi(4)), 0.8 / 0.9);
        close(after(HELD, 0.0), 10.0);
    }

    #[test]
    fn after_a_rejection_it_shrinks_by_its_part_and_does_not_grow() {
        let mut size = StepSize::new(1.0, 3, HELD);
        size.reject(1.0, 16.0);
        assert!((size.size - 0.4).abs() < 1e-15);
        size.reject(1.0, 1e9);
        assert_eq!(size.size, 0.2);
        size.reject(1.0, f64::NAN);
        assert_eq!(size.size, 0.2);
        size.accept(0.2, 1e-9);
        assert_eq!(size.size, 0.2);
        size.begin(0.0, 1.0);
        size.accept(0.2, 1e-9);
        assert_eq!(size.size, 2.0);
    }
}
