//! Choice of the step from the error estimate: Hairer, Nørsett and Wanner, *Solving Ordinary
//! Differential Equations I*, II.4, with the constants of `scipy.integrate`.

/// Part of a step that is tried after the system refused its end.
const REFUSED: f64 = 0.7;
/// Part of the optimal step that is tried.
const SAFETY: f64 = 0.9;
/// Least factor from one step to the next.
const MIN_FACTOR: f64 = 0.2;
/// Largest factor from one step to the next.
const MAX_FACTOR: f64 = 10.0;
/// Least step, in spacings of numbers at t.
const MIN_SPACINGS: f64 = 10.0;

/// The step to try next, as a magnitude.
pub(super) struct StepSize {
    pub size: f64,
    /// Whether the step under way was rejected before: then it may not grow at once.
    rejected: bool,
    /// -1 / (order of the error estimate + 1).
    exponent: f64,
}

impl StepSize {
    pub fn new(size: f64, error_order: i32) -> Self {
        Self { size, rejected: false, exponent: -1.0 / f64::from(error_order + 1) }
    }

    /// Brings the step between its bounds, at the beginning of a step.
    pub fn begin(&mut self, least: f64, most: f64) {
        self.rejected = false;
        // not f64::clamp: near the end of the numbers `least` may exceed `most`
        if self.size > most {
            self.size = most;
        } else if self.size < least {
            self.size = least;
        }
    }

    /// After a step of magnitude `h` with an error norm below 1.
    pub fn accept(&mut self, h: f64, norm: f64) {
        let wanted = if norm == 0.0 { MAX_FACTOR } else { SAFETY * norm.powf(self.exponent) };
        let most = if self.rejected { 1.0 } else { MAX_FACTOR };
        self.size = h * wanted.min(most);
    }

    /// After a step of magnitude `h` with an error norm of 1 or more, or none at all (NaN).
    pub fn reject(&mut self, h: f64, norm: f64) {
        self.rejected = true;
        self.size = h * (SAFETY * norm.powf(self.exponent)).max(MIN_FACTOR);
    }

    /// After a step of magnitude `h` whose end the system refused: the next may grow at once, past
    /// what was refused.
    pub fn refuse(&mut self, h: f64) {
        self.rejected = false;
        self.size = h * REFUSED;
    }
}

/// Least magnitude of a step from t in a direction (+1 or -1).
pub(super) fn least_step(t: f64, direction: f64) -> f64 {
    let outward = t == 0.0 || (t > 0.0) == (direction > 0.0);
    let bits = t.abs().to_bits();
    let next = f64::from_bits(if outward { bits + 1 } else { bits - 1 });
    MIN_SPACINGS * (next - t.abs()).abs()
}

/// First guess of a step: what a first-order method would allow at the start (algorithm of II.4, its
/// part before the trial step). `d0` and `d1` are the scaled norms of y and f.
pub(super) fn probing_step(d0: f64, d1: f64, interval: f64) -> f64 {
    let guess = if d0 < 1e-5 || d1 < 1e-5 { 1e-6 } else { 0.01 * d0 / d1 };
    guess.min(interval)
}

/// Second guess, with `d2` the scaled norm of the second derivative found by the probing step `h0`.
pub(super) fn initial_step(h0: f64, d1: f64, d2: f64, error_order: i32) -> f64 {
    let h1 = if d1 <= 1e-15 && d2 <= 1e-15 {
        (h0 * 1e-3).max(1e-6)
    } else {
        (0.01 / d1.max(d2)).powf(1.0 / f64::from(error_order + 1))
    };
    (100.0 * h0).min(h1)
}

/// √(Σ (xᵢ / scaleᵢ)² / n); 0 without components.
pub(super) fn scaled_norm(x: impl ExactSizeIterator<Item = (f64, f64)>) -> f64 {
    let n = x.len();
    let sum: f64 = x.map(|(x, scale)| (x / scale) * (x / scale)).sum();
    if n == 0 {
        0.0
    } else {
        (sum / n as f64).sqrt()
    }
}
