//! The stepper of derivatives: explicit, or implicit where the run was.

use super::ode::SlopeOde;
use crate::integrate::{
    Atol, BoxedStepper, Cause, Dae, Dop853, ExplicitMethod, ImplicitMethod, Radau, StepControl,
};
use crate::solve::Breakdown;

/// Largest number of steps.
const MOST: usize = 1_000_000;

/// Least relative tolerance of the implicit method, below which its estimate has rounding errors, and the factor on the
/// tolerance of the explicit one. Its error of order 5 is far below the estimate of order 3.
const LEAST: f64 = 1e-10;
const LOOSER: f64 = 4.0;

/// Integrates the motion with its derivatives.
pub(super) struct SlopeStepper {
    control: StepControl,
    /// The span and the state from which the steps continue.
    begun: ((f64, f64), Vec<f64>),
    explicit: BoxedStepper<SlopeOde, Breakdown>,
    /// While an implicit method takes the steps.
    implicit: Option<BoxedStepper<dyn Dae<Stop = Breakdown>, Breakdown>>,
}

type Outcome<T> = Result<T, Cause<Breakdown>>;

impl SlopeStepper {
    /// Begins with `y` at the beginning of a span.
    pub fn new(
        ode: &SlopeOde,
        (rtol, atol): (f64, Vec<f64>),
        span: (f64, f64),
        y: &[f64],
    ) -> Outcome<Self> {
        let control = StepControl {
            atol: Atol::Each(atol),
            max_steps: Some(MOST),
            ..StepControl::new(rtol, 0.0)
        };
        let explicit = Dop853 { control: control.clone() }.start(ode, span, y)?;
        Ok(Self { control, begun: (span, y.to_vec()), explicit, implicit: None })
    }

    /// The time reached.
    pub fn t(&self) -> f64 {
        self.implicit.as_ref().map_or(self.explicit.t(), |implicit| implicit.t())
    }

    /// The state reached.
    pub fn y(&self, ode: &SlopeOde) -> Vec<f64> {
        match &self.implicit {
            Some(implicit) => ode.columns.in_states(implicit.y()),
            None => self.explicit.y().to_vec(),
        }
    }

    /// The state at a time within the last step.
    pub fn at(&mut self, ode: &mut SlopeOde, t: f64) -> Outcome<Vec<f64>> {
        let mut y = self.y(ode);
        match &self.implicit {
            Some(implicit) => {
                if let Some(step) = implicit.last_step() {
                    step.interpolate(t, &mut y);
                    y = ode.columns.in_states(&y);
                }
            }
            None => {
                self.explicit.prepare_interpolant(ode)?;
                if let Some(step) = self.explicit.last_step() {
                    step.interpolate(t, &mut y);
                }
            }
        }
        Ok(y)
    }

    /// The size of the next step, if it is known.
    pub fn next_size(&self) -> Option<f64> {
        match &self.implicit {
            Some(implicit) => implicit.next_size(),
            None => self.explicit.next_size(),
        }
    }

    /// Takes a step. Where the implicit method finds none, as by rounding errors of large forces, the explicit one begins
    /// again.
    pub fn step(&mut self, ode: &mut SlopeOde) -> Outcome<()> {
        if let Some(implicit) = &mut self.implicit {
            if implicit.step(ode).is_ok() {
                return Ok(());
            }
            self.implicit = None;
            let (span, y) = &self.begun;
            self.explicit.restart_until(span.0, y, span.1)?;
        }
        self.explicit.step(ode)
    }

    /// Continues with other equations.
    pub fn forget(&mut self) {
        self.implicit = None;
    }

    /// Whether an implicit method takes the steps.
    pub fn is_implicit(&self) -> bool {
        self.implicit.is_some()
    }

    /// Continues from another state with a new end time, with an implicit method whose first step is `first`, or with the
    /// explicit one.
    pub fn go_on(
        &mut self,
        ode: &SlopeOde,
        span: (f64, f64),
        y: &[f64],
        first: Option<f64>,
    ) -> Outcome<()> {
        self.begun = (span, y.to_vec());
        let Some(first) = first else {
            self.implicit = None;
            return self.explicit.restart_until(span.0, y, span.1);
        };
        let y = ode.columns.in_parts(y);
        if let Some(implicit) = &mut self.implicit {
            return implicit.restart_until(span.0, &y, span.1);
        }
        let rtol = (LOOSER * self.control.rtol).max(LEAST);
        let mut control = StepControl { rtol, first_step: Some(first), ..self.control.clone() };
        if let Atol::Each(atol) = &mut control.atol {
            *atol = ode.columns.in_parts(atol);
            atol.iter_mut().for_each(|atol| *atol *= rtol / self.control.rtol);
            atol.truncate(ode.lengths().controlled());
        }
        let system: &dyn Dae<Stop = Breakdown> = ode;
        self.implicit = Some(Radau { control }.start(system, span, &y)?);
        Ok(())
    }
}
