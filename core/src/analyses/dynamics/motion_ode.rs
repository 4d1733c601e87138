//! The equations of motion as a first-order system y = (q, v, z, works).

use super::constraint_violation::is_astray;
use super::options::Options;
use super::redundant_rows;
use super::sampling::Sample;
use super::singularity_passage::{would_pass, SingularityPassage};
use super::stabilizations::Stabilization;
use crate::analyses::mobility;
use crate::equations::augmented::NearSingular;
use crate::equations::{constraints, energy, Gains, Workspace};
use crate::integrate::{all_finite, Manifold, Ode, Structure, TimesToAvoid, TrialChanges};
use crate::math::Real;
use crate::model::{usual_energy, Model};
use crate::solve::Breakdown;
use crate::stabilize::{Projection, Projector, StepwiseBaumgarte};

/// Relative error of a step that does not lead to another branch.
const BRANCH: f64 = 1e-8;
/// Part of the energy of a usual motion below which errors of works do not shorten steps.
const LEAST: f64 = 1e-3;

/// The right side of forward dynamics.
pub(super) struct MotionOde<'a> {
    pub model: &'a Model,
    pub workspace: Workspace,
    pub gains: Gains,
    /// Baumgarte's term, if its gains depend on the step.
    stepwise: Option<StepwiseBaumgarte>,
    pub projector: Option<Projector<'a>>,
    /// Whether singular positions are passed.
    pub passing: bool,
    pub passage: SingularityPassage,
    /// The time of the last factors.
    factored: f64,
    /// Part of the errors of positions and rates that counts near a singular position if the constraints determine
    /// them.
    part: f64,
    /// An energy whose errors matter, J, if [works are tested](tests_works).
    least_energy: Option<f64>,
    /// Time and reason of the last evaluation without a solution. A shorter step may avoid it.
    pub paradox: Option<(f64, Breakdown)>,
}

/// Whether works can be less smooth than the motion, so that their errors are tested: bodies touch or rub, or drivers
/// follow laws that are smooth in pieces only.
pub(super) fn tests_works(model: &Model) -> bool {
    let pieces = !model.switches.is_empty() || !model.blueprint.tables.is_empty();
    model.driven && pieces || model.forces.iter().any(|item| item.element.touches_or_rubs())
}

/// An energy whose errors matter, J, if [works are tested](tests_works).
pub(super) fn least_energy(model: &Model) -> Option<f64> {
    tests_works(model).then(|| LEAST * usual_energy(model))
}

impl<'a> MotionOde<'a> {
    /// Uses a workspace of the model, whose elimination plan is shared by runs.
    pub fn new(model: &'a Model, options: &Options, mut workspace: Workspace) -> Self {
        let projector = match options.stabilization {
            Stabilization::Projection(projection) => Some(Projector::new(model, projection)),
            _ => None,
        };
        // only projection keeps a state on its branch
        let passing = projector.is_some();
        if passing {
            workspace.matrix.set_near_singular(NearSingular::Regularise);
        }
        let passage = SingularityPassage::new(options, passing);
        let stepwise = match options.stabilization {
            Stabilization::BaumgarteFromStep => Some(StepwiseBaumgarte::new(model)),
            _ => None,
        };
        let (gains, paradox) = (options.gains(), None);
        let least_energy = least_energy(model);
        Self {
            model,
            workspace,
            gains,
            stepwise,
            projector,
            passing,
            passage,
            factored: f64::NAN,
            part: (options.method.control().rtol / BRANCH).min(1.0),
            least_energy,
            paradox,
        }
    }

    /// The options of projection, if the run uses projection.
    pub fn projection(&self) -> Option<Projection> {
        self.projector.as_ref().map(Projector::options)
    }

    /// Number of factorisations in addition to the factorisations of evaluations.
    pub fn factorisations(&self) -> usize {
        self.projector.as_ref().map_or(0, |projector| projector.factorisations)
    }

    /// Projects the state at the start of a run or of a phase, if the run uses projection. With `velocities`, always
    /// projects the velocities. With `samples`, then computes the laws with a sample there. Fails if the constraints
    /// are redundant.
    ///
    /// # Errors
    /// [`Breakdown`].
    pub fn begin_phase(
        &mut self,
        t: f64,
        y: &mut [f64],
        velocities: bool,
        samples: bool,
    ) -> Result<(), Breakdown> {
        self.exchange_rows(t, y);
        if velocities && self.projector.is_none() {
            let mut projector = Projector::new(self.model, Projection::default());
            let [q, v, ..] = self.model.layout.split_mut(y);
            projector.project_velocities(&mut self.workspace, t, (q, v))?;
        }
        self.project_state(t, y, false)?;
        if let Some(sample) = samples.then(|| Sample::take(self.model, t, y)).flatten() {
            sample.put(self.model, y);
        }
        self.begin(t, y)
    }

    /// Begins the forecast of singular positions at a state. Fails if the constraints are redundant at the start; a
    /// start at a singular position is allowed.
    pub fn begin(&mut self, t: f64, y: &[f64]) -> Result<(), Breakdown> {
        let [q, v, z, _] = self.model.layout.split(y);
        if self.workspace.accelerate(self.model, t, [q, v, z], self.gains).is_err() {
            return Ok(()); // the first step fails
        }
        self.passage.begin(t, &self.workspace, self.part < 1.0 && self.is_held());
        let near = self.workspace.matrix.regularised();
        match self.workspace.matrix.cancellation().filter(|_| near) {
            Some((row, _)) if self.is_redundant(t, q) => Err(Breakdown::Row(row)),
            _ => Ok(()),
        }
    }

    /// Whether constraints are redundant although the model does not allow redundancy.
    fn is_redundant(&self, t: f64, q: &[f64]) -> bool {
        !self.model.allow_redundancy && !mobility(self.model, t, q).redundant.is_empty()
    }

    /// Omits other redundant rows if the state at the end of a step requires it.
    pub fn exchange_rows(&mut self, t: f64, y: &[f64]) {
        let [q, v, z, _] = self.model.layout.split(y);
        if redundant_rows::exchange(self.model, &mut self.workspace, t, [q, v, z]) {
            // a forecast needs samples of the same rows
            let solved = self.workspace.accelerate(self.model, t, [q, v, z], self.gains);
            if solved.is_ok() {
                self.passage.begin(t, &self.workspace, self.part < 1.0 && self.is_held());
            }
        }
    }

    /// Computes dy at y. `placed` states that the bodies are already at y. This is a single function because two
    /// copies would exceed the instruction cache.
    #[inline(never)]
    fn evaluate(
        &mut self,
        t: f64,
        y: &[f64],
        dy: &mut [f64],
        placed: bool,
    ) -> Result<(), Breakdown> {
        let close = self.passage.is_close();
        self.workspace.sharpen(close);
        let mut nearest = Vec::new();
        let y = match close && !placed {
            true => {
                nearest.extend_from_slice(y);
                if self.project_state(t, &mut nearest, false).is_err() {
                    dy.fill(f64::NAN); // a shorter step may avoid it
                    return Ok(());
                }
                &nearest[..]
            }
            false => y,
        };
        let [q, v, z, _] = self.model.layout.split(y);
        if !placed {
            self.workspace.place(self.model, [q, v, z]);
        }
        self.workspace.place_states(z); // projection does not set z
        self.paradox = None;
        if let Err(breakdown) = self.workspace.respond(self.model, t, self.gains) {
            dy.fill(f64::NAN);
            if self.is_undefined(t) {
                return Ok(()); // a shorter step may avoid it
            }
            if matches!(breakdown, Breakdown::Reaction(_))
                || is_astray(self.model, &self.workspace.motions, t, q)
                || self.is_beyond(t, breakdown)
            {
                self.paradox = Some((t, breakdown));
                return Ok(());
            }
            return self.stop_if_finite(breakdown, t, y);
        }
        self.factored = t;
        if !self.passage.watch(self.model, &self.workspace, t, v) {
            dy.fill(f64::NAN); // a shorter step may avoid it
            return Ok(());
        }
        rates(self.model, &self.workspace, t, v, dy);
        Ok(())
    }

    /// Whether the constraints determine positions and rates, so that the motion has no freedom.
    #[inline(always)]
    fn is_held(&self) -> bool {
        let layout = &self.model.layout;
        layout.n_rows >= layout.n_q + self.workspace.matrix.omitted().len()
    }

    /// Whether a constraint has no derivative at a trial state, for instance because a table of a curve is evaluated
    /// beyond its ends.
    #[cold]
    fn is_undefined(&self, t: f64) -> bool {
        let mut jacobian = vec![0.0; self.model.layout.n_entries];
        constraints::jacobian(self.model, &self.workspace.motions, t, &mut jacobian);
        !all_finite(&jacobian)
    }

    /// Whether the equation that breaks down has no derivatives at a trial state: a place on a curve does not move
    /// beyond the ends of the curve.
    #[cold]
    fn is_beyond(&self, t: f64, breakdown: Breakdown) -> bool {
        let Breakdown::Row(of) = breakdown else { return false };
        let layout = &self.model.layout;
        let mut jacobian = vec![0.0; layout.n_entries];
        constraints::jacobian(self.model, &self.workspace.motions, t, &mut jacobian);
        layout.positions().all(|(row, _, at)| row != of || jacobian[at] == 0.0)
    }

    /// Stops where the accelerations are not unique. Rejects a trial state that is not finite, because a shorter step
    /// may avoid it.
    #[cold]
    fn stop_if_finite(&self, breakdown: Breakdown, t: f64, y: &[f64]) -> Result<(), Breakdown> {
        if !all_finite(y) {
            return Ok(());
        }
        let [q, v, z, _] = self.model.layout.split(y);
        match breakdown {
            Breakdown::Row(row)
                if self.projector.is_none() && would_pass(self.model, t, [q, v, z]) =>
            {
                Err(Breakdown::Passable(row))
            }
            other => Err(other),
        }
    }

    /// Projects y if the run uses projection; returns whether y changed. The works do not change, so the energy
    /// balance shows the change of energy by projection.
    fn project_state(&mut self, t: f64, y: &mut [f64], factored: bool) -> Result<bool, Breakdown> {
        let Some(projector) = &mut self.projector else { return Ok(false) };
        // omitted rows may differ from the others by rounding, which must not change with the choice of rows
        let redundant = !self.workspace.matrix.omitted().is_empty();
        projector.sharpen(redundant || self.passage.in_reach(), self.passage.is_close());
        let [q, v, ..] = self.model.layout.split_mut(y);
        projector.project(&mut self.workspace, t, (q, v), factored)
    }
}

/// Computes y′ at the state at which the accelerations of a workspace were computed.
#[inline(always)]
pub(in crate::analyses) fn rates<S: Real>(
    model: &Model<S>,
    workspace: &Workspace<S>,
    t: S,
    v: &[S],
    dy: &mut [S],
) {
    let powers = workspace.powers(model, v);
    let [dq, dv, dz, works] = model.layout.split_mut(dy);
    dq.copy_from_slice(v);
    dv.copy_from_slice(workspace.a());
    workspace.state_rates(model, t, dz);
    works.copy_from_slice(&[powers.dissipated, powers.drivers, powers.applied]);
}

impl Ode for MotionOde<'_> {
    type Stop = Breakdown;

    fn len(&self) -> usize {
        self.model.layout.n_y()
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        self.evaluate(t, y, dy, false)
    }

    fn structure(&self) -> Structure {
        let layout = &self.model.layout;
        Structure { positions: layout.n_q, states: layout.n_z, quadratures: layout.n_works }
    }

    /// The largest of the kinetic energy and the works.
    fn quadrature_scale(&self, y: &[f64]) -> Option<f64> {
        let least = self.least_energy?.max(energy::kinetic(self.model, &self.workspace.motions));
        Some(self.model.layout.split(y)[3].iter().fold(least, |most, work| most.max(work.abs())))
    }

    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = Self::Stop>> {
        match self.projector {
            Some(_) => Some(self),
            None => None,
        }
    }

    fn times_to_avoid(&mut self) -> Option<&mut dyn TimesToAvoid> {
        match self.passing {
            true => Some(self),
            false => None,
        }
    }

    fn trial_changes(&mut self) -> Option<&mut dyn TrialChanges> {
        match self.stepwise {
            Some(_) => Some(self),
            None => None,
        }
    }
}

/// The manifold of states that meet the constraints.
impl Manifold for MotionOde<'_> {
    type Stop = Breakdown;

    /// Uses the factor of the last evaluation, which was near the end of the step.
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<bool, Self::Stop> {
        self.project_state(t, y, true)
    }

    /// After projection, the motions of the workspace belong to y.
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        self.evaluate(t, y, dy, true)
    }

    /// Projects the error near a singular position, where the noise along the lost direction would otherwise reject
    /// every step. A motion without a freedom has no tangential error, so its whole error counts.
    fn project_error(&mut self, dy: &mut [f64]) -> bool {
        let held = self.is_held();
        let [dq, dv, ..] = self.model.layout.split_mut(dy);
        match &mut self.projector {
            Some(projector) if !held && self.passage.near => {
                projector.tangent(&self.workspace, dq);
                projector.tangent(&self.workspace, dv);
                true
            }
            Some(_) if held && self.passage.is_close() => {
                dq.iter_mut().chain(dv).for_each(|x| *x *= self.part);
                true
            }
            _ => false,
        }
    }
}

/// Times of singular positions.
impl TimesToAvoid for MotionOde<'_> {
    fn may_be_near(&self) -> bool {
        self.passage.near || self.passage.in_reach()
    }

    /// The last factors belong to an earlier time than the end of the trial if a stage failed.
    fn next(&mut self, _: f64) -> Option<f64> {
        self.passage.foresee(self.factored, &self.workspace)
    }

    fn on_accepted_end(&mut self, t: f64) {
        self.passage.accept(t, &self.workspace);
    }
}

/// Baumgarte's term with gains from the step.
impl TrialChanges for MotionOde<'_> {
    fn before_trial(&mut self, t: f64, y: &[f64], h: f64) -> bool {
        let Some(stepwise) = &mut self.stepwise else { return false };
        let [q, v, ..] = self.model.layout.split(y);
        stepwise.hold(self.model, &mut self.workspace, t, (q, v), h);
        true
    }
}
