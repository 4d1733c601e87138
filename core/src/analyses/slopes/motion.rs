//! The derivatives of a motion along the steps of its run.
//!
//! A step is repeated from its recorded start, so that the motion itself is that of the run. Where the run took
//! implicit steps, which are too long for an explicit method, the equations and their derivatives are integrated
//! together with an error control of their own.

use super::ode::SlopeOde;
use crate::analyses::assemble::StartSlopes;
use crate::analyses::dynamics::{PiecewiseInterpolant, Scheme};
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::Workspace;
use crate::integrate::{Atol, BoxedStepper, Dop853, ExplicitMethod, Rk4, Rk45, StepControl};
use crate::math::Listed;
use crate::model::{column_scales, usual_energy, Model, WORKS};
use crate::solve::Breakdown;

/// Tolerances of states and derivatives along implicit steps, relative to their scales.
const CONTROLLED: f64 = 1e-10;
/// Largest number of steps within an implicit step.
const MOST: usize = 100_000;

/// A run whose derivatives are computed at ascending times.
pub(super) struct MotionSlopes<'a> {
    ode: SlopeOde<'a>,
    /// The ends of the steps, and the states at their starts.
    steps: &'a PiecewiseInterpolant,
    /// The state at the end of the run.
    last: Vec<f64>,
    /// The index of the step that begins at the present state.
    step: usize,
    /// The state at the start of this step, with its derivatives.
    y: Vec<f64>,
    stepper: BoxedStepper<SlopeOde<'a>, Breakdown>,
}

impl<'a> MotionSlopes<'a> {
    /// Begins at the start of a run without phases; `start` contains the derivatives of its start, one block after the
    /// other. The steps are those of a `scheme`; `implicit` states whether some were implicit.
    /// `sizes` are the magnitudes of the variables of all blocks.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn new(
        model: &'a Model,
        blocks: Vec<Sensitivity>,
        (steps, last): (&'a PiecewiseInterpolant, Vec<f64>),
        start: &[Vec<Slope>],
        (scheme, implicit, sizes): (&Scheme, bool, &[f64]),
    ) -> Result<Self, String> {
        let workspace = Workspace::new(model);
        let ode = SlopeOde::new(model, workspace, blocks);
        let n_y = model.layout.n_y();
        let mut y = steps.y[..n_y].to_vec();
        y.resize(n_y * (1 + ABREAST * ode.blocks.len()), 0.0);
        for (b, slopes) in start.iter().enumerate() {
            let mut state = ode.state(b, &y);
            state.iter_mut().zip(slopes).for_each(|(to, of)| to.slope = of.slope);
            ode.put(b, &state, &mut y);
        }
        let span = (steps.t[0], steps.t[steps.t.len() - 1]);
        let control = match implicit {
            true => {
                let atol = Atol::Each(scales(model, sizes).iter().map(|x| CONTROLLED * x).list());
                StepControl { atol, max_steps: Some(MOST), ..StepControl::new(CONTROLLED, 0.0) }
            }
            false => StepControl::constant((span.1 - span.0).abs()),
        };
        let stepper = match scheme {
            Scheme::Rk45(_) => Rk45 { control }.start(&ode, span, &y),
            Scheme::Rk4(_) => Rk4 { control }.start(&ode, span, &y),
            _ => Dop853 { control }.start(&ode, span, &y),
        };
        let stepper = stepper.map_err(|_| "the run has no steps".to_string())?;
        Ok(Self { ode, steps, last, step: 0, y, stepper })
    }

    /// The state with its derivatives at a time that is not before the last one.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn at(&mut self, t: f64) -> Result<Vec<f64>, String> {
        let ends = self.steps.t.len() - 1;
        while self.step + 1 < ends && t >= self.steps.t[self.step + 1]
            || self.step + 1 == ends && t == self.steps.t[ends]
        {
            let end = self.steps.t[self.step + 1];
            let mut y = self.advance(end)?;
            let n_y = self.ode.model.layout.n_y();
            self.step += 1;
            let known = match self.step < ends {
                true => &self.steps.y[self.step * n_y..][..n_y],
                false => &self.last[..],
            };
            y[..n_y].copy_from_slice(known);
            self.project(end, &mut y)?;
            self.y = y;
        }
        if self.step == ends || t == self.steps.t[self.step] {
            return Ok(self.y.clone());
        }
        let mut y = self.advance(t)?;
        self.project(t, &mut y)?;
        Ok(y)
    }

    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String> {
        self.ode.project(t, y).map_err(|_| singular(t))
    }

    /// The state at a time within the present step.
    fn advance(&mut self, t: f64) -> Result<Vec<f64>, String> {
        let Self { ode, stepper, .. } = self;
        let begin = self.steps.t[self.step];
        let failed = |_| singular(begin);
        stepper.restart_until(begin, &self.y, t).map_err(failed)?;
        while stepper.t() != t {
            stepper.step(ode).map_err(failed)?;
        }
        Ok(stepper.y().to_vec())
    }

    /// The equations with derivatives.
    pub fn ode(&mut self) -> &mut SlopeOde<'a> {
        &mut self.ode
    }
}

fn singular(t: f64) -> String {
    format!("it has no bound: the position at t = {t:.6} s is singular, or the forces there have no derivative")
}

/// The scale of each component of (state, derivatives of the state by the first variable, and so on).
fn scales(model: &Model, sizes: &[f64]) -> Vec<f64> {
    let of_q = column_scales(model);
    let (states, works) = (vec![1.0; model.layout.n_z], vec![usual_energy(model); WORKS]);
    let own = [&of_q[..], &of_q, &states, &works].concat();
    let slopes = sizes.iter().flat_map(|size| own.iter().map(move |scale| scale / size));
    own.iter().copied().chain(slopes).list()
}

/// A start as one row: q, v and z.
pub(super) fn joined(start: StartSlopes) -> Vec<Slope> {
    let [q, v, z] = start;
    q.into_iter().chain(v).chain(z).list()
}
