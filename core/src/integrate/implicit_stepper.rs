//! The stepper of the implicit methods. It stores the last step, the counts and the step control.

use super::dae::{Dae, DaeLengths};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::Cause;
use super::fixed_step::Grid;
use super::implicit_steps::ImplicitSteps;
use super::statistics::StepCounts;
use super::step::Step;
use super::step_control::StepControl;
use super::stepper::{BoxedStepper, Stepper};

/// A stepper of the method `M`.
pub(super) struct ImplicitStepper<M> {
    pub control: StepControl,
    /// The ends of constant steps.
    pub grid: Option<Grid>,
    pub lengths: DaeLengths,
    counts: StepCounts,
    pub steps: ImplicitSteps,
    pub scale: ErrorWeights,
    pub method: M,
}

/// An implicit method, with its state between steps.
pub(super) trait ImplicitScheme: Sized + 'static {
    /// Number of rows of the interpolant.
    const ROWS: usize;
    /// Degree of the interpolant.
    const DEGREE: usize;

    /// The table of the interpolant.
    fn table() -> &'static [f64];

    /// Takes the next step, from `stepper.steps.y`.
    fn next<Y: Dae + ?Sized>(
        stepper: &mut ImplicitStepper<Self>,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<(), Cause<Y::Stop>>;

    /// The size of the next trial step, if it is known.
    fn size(&self) -> Option<f64>;

    /// Discards data of earlier steps. Returns the size of the next trial step, if it is known.
    fn forget(&mut self) -> Option<f64>;
}

impl<M: ImplicitScheme> ImplicitStepper<M> {
    /// Creates a stepper at the beginning of the span with the state `y`. Evaluates nothing.
    pub fn start<Y: Dae + ?Sized>(
        control: StepControl,
        lengths: DaeLengths,
        span: (f64, f64),
        y: &[f64],
        method: M,
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>> {
        Ok(Box::new(Self {
            grid: control.begin(span, (y, lengths.total()), lengths.controlled())?,
            lengths,
            counts: StepCounts::default(),
            steps: ImplicitSteps::new(span, y, M::ROWS),
            scale: ErrorWeights::new(&control, lengths.controlled()),
            control,
            method,
        }))
    }
}

impl<M: ImplicitScheme, Y: Dae + ?Sized> Stepper<Y, Y::Stop> for ImplicitStepper<M> {
    fn step(&mut self, system: &mut Y) -> Result<(), Cause<Y::Stop>> {
        self.steps.move_on();
        let mut dae = CountedDae { system, counts: self.counts };
        let outcome = M::next(self, &mut dae);
        self.counts = dae.counts;
        outcome
    }

    fn prepare_interpolant(&mut self, _: &mut Y) -> Result<(), Cause<Y::Stop>> {
        Ok(())
    }

    fn last_step(&self) -> Option<Step<'_>> {
        self.steps.view(M::table(), M::DEGREE)
    }

    fn t(&self) -> f64 {
        self.steps.t()
    }

    fn t_end(&self) -> f64 {
        self.steps.t_end
    }

    fn y(&self) -> &[f64] {
        self.steps.y()
    }

    fn next_size(&self) -> Option<f64> {
        self.method.size()
    }

    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<Y::Stop>> {
        let (len, controlled) = (self.lengths.total(), self.lengths.controlled());
        self.grid = self.control.restart((t, t_end), (y, len), controlled)?;
        self.steps.t_end = t_end;
        if let Some(size) = self.method.forget() {
            self.control.first_step = Some(size);
        }
        self.steps.restart(t, y);
        Ok(())
    }

    fn statistics(&self) -> StepCounts {
        self.counts
    }
}
