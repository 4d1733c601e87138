//! Tolerances and step options of all methods, with their defaults.

use super::arguments::{check_problem, not_negative, positive, require};
use super::failure::Cause;
use super::fixed_step::{affordable, Grid};

/// Absolute tolerance.
#[derive(Clone, Debug, PartialEq)]
pub enum Atol {
    /// One tolerance for all components.
    Scalar(f64),
    /// One tolerance for each controlled component.
    Each(Vec<f64>),
    /// Relative to the scale of each component. A caller that has scales converts it to [`Each`](Self::Each); here
    /// each scale is 1.
    Scaled(f64),
}

/// Tolerances and step options of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct StepControl {
    /// Relative tolerance of a step. With a constant step, tolerance of Newton's iteration only. Most methods raise
    /// it to 100 ε ≈ 2.2e-14.
    pub rtol: f64,
    /// Absolute tolerance of a step, in the units of y. A component that stays zero requires a positive one. With a
    /// constant step, tolerance of Newton's iteration only.
    pub atol: Atol,
    /// Constant step size, whatever the error. It is positive also when integrating backward, and excludes
    /// `first_step` and `max_step`. Steps end at t0 + k `step`, computed by multiplication. The last step is
    /// shortened to end at t_end.
    pub step: Option<f64>,
    /// First step. Chosen automatically if `None`.
    pub first_step: Option<f64>,
    /// Largest step.
    pub max_step: f64,
    /// Largest number of accepted steps. If steps of length `max_step` need more, the integration fails before the
    /// first step.
    pub max_steps: Option<usize>,
}

/// Default tolerances (rtol, atol). atol is relative to the scale of each component.
impl StepControl {
    /// Tolerances of RK45, DOP853 and Radau.
    pub const USUAL: (f64, f64) = (1e-6, 1e-9);
    /// Tolerances of generalized-α, whose order is 2.
    pub const LOW_ORDER: (f64, f64) = (1e-4, 1e-7);
    /// Tolerances of the automatic choice of the method.
    pub const AUTO: (f64, f64) = (1e-8, 1e-11);
    /// Tolerances of Newton's iteration with a constant step.
    pub const NEWTON: (f64, f64) = (1e-10, 1e-12);
}

impl Default for StepControl {
    /// The tolerances [`USUAL`](Self::USUAL), without bounds.
    fn default() -> Self {
        Self::with(Self::USUAL)
    }
}

impl StepControl {
    /// Step control with these tolerances and no bounds.
    pub fn new(rtol: f64, atol: f64) -> Self {
        Self {
            rtol,
            atol: Atol::Scalar(atol),
            step: None,
            first_step: None,
            max_step: f64::INFINITY,
            max_steps: None,
        }
    }

    /// Step control with a pair (rtol, atol) of default tolerances.
    pub fn with((rtol, atol): (f64, f64)) -> Self {
        Self { atol: Atol::Scaled(atol), ..Self::new(rtol, atol) }
    }

    /// Step control with a constant step.
    pub fn constant(step: f64) -> Self {
        Self { step: Some(step), ..Self::with(Self::NEWTON) }
    }

    /// A copy with a relative tolerance of at least 100 ε, below which an estimated error is a rounding error. An
    /// invalid tolerance is kept, so that the checks report it.
    pub fn usable(&self) -> Self {
        let rtol = if (0.0..MIN_RTOL).contains(&self.rtol) { MIN_RTOL } else { self.rtol };
        Self { rtol, ..self.clone() }
    }

    /// Checks the options, the times, and that `y` has the length `len`. Returns the ends of the steps if the step is
    /// constant.
    pub(super) fn begin<E>(
        &self,
        (t0, t_end): (f64, f64),
        (y, len): (&[f64], usize),
        controlled: usize,
    ) -> Result<Option<Grid>, Cause<E>> {
        check_problem(t0, t_end, y, len)?;
        let interval = (t_end - t0).abs();
        self.check(controlled, interval)?;
        match self.step {
            Some(step) => Grid::new(t0, t_end, step, self.max_steps).map(Some),
            None => affordable(interval, self.max_step, self.max_steps).map(|()| None),
        }
    }

    /// Checks the options of a stepper that continues from another state. The first step is not checked again.
    pub(super) fn restart<E>(
        &self,
        span: (f64, f64),
        state: (&[f64], usize),
        controlled: usize,
    ) -> Result<Option<Grid>, Cause<E>> {
        Self { first_step: None, ..self.clone() }.begin(span, state, controlled)
    }

    /// Checks the options without a system.
    ///
    /// # Errors
    /// An impossible option or time; more steps than allowed.
    pub fn check_times<E>(&self, t0: f64, t_end: f64) -> Result<(), Cause<E>> {
        let controlled = match &self.atol {
            Atol::Scalar(_) | Atol::Scaled(_) => 0,
            Atol::Each(atol) => atol.len(),
        };
        self.begin((t0, t_end), (&[], 0), controlled).map(|_| ())
    }

    fn check<E>(&self, controlled: usize, interval: f64) -> Result<(), Cause<E>> {
        not_negative("rtol", self.rtol)?;
        match &self.atol {
            Atol::Scalar(atol) | Atol::Scaled(atol) => not_negative("atol", *atol)?,
            Atol::Each(atol) => {
                let len = atol.len();
                require(
                    len == controlled,
                    "atol",
                    len as f64,
                    "one for each controlled component",
                )?;
                atol.iter().try_for_each(|&a| not_negative("atol", a))?;
            }
        }
        positive("max_step", self.max_step)?;
        if self.step.is_some() {
            return self.check_constant();
        }
        if let Some(h) = self.first_step {
            positive("first_step", h)?;
            let fits = h <= interval || interval == 0.0;
            require(fits, "first_step", h, "at most |t_end - t0|")?;
        }
        Ok(())
    }

    /// Checks that no other step option is set together with a constant step.
    fn check_constant<E>(&self) -> Result<(), Cause<E>> {
        const ABSENT: &str = "absent beside a constant step";
        require(self.first_step.is_none(), "first_step", self.first_step.unwrap_or(0.0), ABSENT)?;
        require(self.max_step == f64::INFINITY, "max_step", self.max_step, ABSENT)
    }
}

/// Smallest relative tolerance in use. Below it, the error estimate contains only rounding errors.
const MIN_RTOL: f64 = 100.0 * f64::EPSILON;
