//! The derivatives of a motion along the steps of its run.
//!
//! The equations and their derivatives are integrated together, with an error control of their own, between ends of steps
//! of the run. There the motion takes the states of the run.

use super::impacts;
use super::ode::SlopeOde;
use super::run_ends::{distance, last_state, scales, DOUBTFUL};
use super::stepper::SlopeStepper;
use super::triggers::Trigger;
use crate::analyses::dynamics::{
    planned, Options, Passage, PiecewiseInterpolant, Run, Scheme, Setting,
};
use crate::analyses::measures::Measure;
use crate::elements::Behaviour;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::math::Listed;
use crate::model::{column_scales, ForceMode, Model};
use std::sync::Arc;

/// Largest and least tolerance of states and derivatives, relative to each.
const TOLERANCES: [f64; 2] = [1e-7, 1e-12];
/// Absolute tolerance, as a part of the relative one and of the scale.
const ABSOLUTE: f64 = 1e-3;
/// Number of steps after which the motion is compared with the run, and while something decays that a change has begun.
const APART: [f64; 2] = [50.0, 4.0];
/// Distance of a coordinate from the run, relative to the size of the mechanism or to a radian, from which the motion goes on
/// from the state of the run: a hundredth of the error that is remarked. In a stiff motion, the velocities of explicit steps
/// have errors that decay at once. Derivatives would keep something of each one.
const CLOSE: f64 = 0.01 * DOUBTFUL;

/// The equations of the model of a phase, for blocks of variables.
type PhaseEquations<'a> = Box<dyn Fn(&Model, &Setting) -> Result<Vec<Sensitivity>, String> + 'a>;

/// The run of forward dynamics whose derivatives are requested.
pub(super) struct AskedRun<'a> {
    pub model: &'a Model,
    pub run: &'a Run,
    pub options: &'a Options,
    /// The derivatives of the start, one block after the other, and of its time.
    pub starts: (Vec<Vec<Slope>>, Vec<f64>),
    /// The magnitudes of the variables of all blocks.
    pub sizes: Vec<f64>,
    /// The number of variables. The place after them has the error of the run.
    pub count: usize,
    pub equations: PhaseEquations<'a>,
}

/// A run whose derivatives are computed at ascending times.
pub(super) struct MotionSlopes<'a> {
    asked: AskedRun<'a>,
    pub ode: SlopeOde,
    /// The ends of the steps, and the states at their starts.
    steps: &'a PiecewiseInterpolant,
    /// The state at the end of the run.
    last: Vec<f64>,
    /// The index of the step that begins at the last state that was taken from the run, and of the one that begins at the
    /// next.
    step: usize,
    next: usize,
    /// The last state that was taken from the run, with its derivatives at a time that moves as the last change of the
    /// motion does.
    y: Vec<f64>,
    /// The scale of each component.
    scales: Vec<f64>,
    stepper: SlopeStepper,
    /// The first steps of the parts that explicit and implicit methods have taken.
    methods: Vec<usize>,
    /// The first step of each phase, and the present phase.
    begins: Vec<usize>,
    phase: usize,
    /// The index of the held pieces of switches; those of the next index follow.
    held: usize,
    /// The time and the state at which the motion has changed last.
    since: (f64, Vec<f64>),
}

impl<'a> MotionSlopes<'a> {
    /// Begins at the start of a run.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn new(asked: AskedRun<'a>) -> Result<Self, String> {
        let AskedRun { model, run, options, starts, sizes, .. } = &asked;
        let steps = run.dense.as_ref().ok_or_else(|| "the run has no interpolant".to_string())?;
        let scheme = &options.method;
        if matches!(scheme, Scheme::GeneralizedAlpha(_)) {
            let text =
                "slopes do not follow steps of generalized_alpha; choose method auto or radau";
            return Err(text.to_string());
        }
        let (first, last) = (steps.t[0], steps.t[steps.t.len() - 1]);
        if last < first {
            return Err("the run goes backward in time".to_string());
        }
        let begins = run.phases.iter().map(|row| {
            let t = run.trajectory.t[*row];
            steps.t.partition_point(|end| *end < t)
        });
        let begins: Vec<usize> = begins.list();
        let ode = Self::equations_of(&asked, 0)?;
        let n_y = model.layout.n_y();
        let mut y = vec![0.0; n_y * (1 + ABREAST * ode.blocks.len())];
        for (b, slopes) in starts.0.iter().enumerate() {
            let mut state = ode.state(b, &y);
            state.iter_mut().zip(slopes).for_each(|(to, of)| *to = *of);
            ode.put(b, &state, &mut y);
            y.iter_mut().zip(slopes).for_each(|(y, of)| *y = of.value);
        }
        let [loose, tight] = TOLERANCES;
        let rtol = scheme.control().rtol.clamp(tight, loose);
        let scales = scales(model, run, sizes);
        let atol = scales.iter().map(|x| ABSOLUTE * rtol * x).list();
        let stepper = SlopeStepper::new(&ode, (rtol, atol), (first, last), &y);
        let stepper = stepper.map_err(|_| "the run has no steps".to_string())?;
        let last = last_state(model, run);
        let methods = run.implicit.windows(2).enumerate().filter(|(_, pair)| pair[0] != pair[1]);
        let methods = methods.map(|(k, _)| k + 1).list();
        let (phase, held, since) = (0, 0, (first, y.clone()));
        let late = starts.1.clone();
        let mut slopes = Self {
            asked,
            ode,
            steps,
            last,
            step: 0,
            next: 0,
            y,
            scales,
            stepper,
            methods,
            begins,
            phase,
            held,
            since,
        };
        slopes.begin_phase(&late)?;
        slopes.since.1.clone_from(&slopes.y);
        slopes.go_on()?;
        Ok(slopes)
    }

    /// The equations of a phase.
    fn equations_of(asked: &AskedRun<'a>, phase: usize) -> Result<SlopeOde, String> {
        let setting = asked.run.settings.get(phase).cloned().unwrap_or_default();
        let model = setting.model(asked.model).map_err(|_| impossible(phase))?;
        let blocks = (asked.equations)(&model, &setting)?;
        Ok(SlopeOde::new(Arc::new(model), blocks, asked.sizes.clone()))
    }

    /// The time at which the motion changes next: a phase ends, or a switch changes its piece.
    pub fn corner(&self) -> Option<f64> {
        let steps = [self.begins.get(self.phase + 1).copied(), self.next_pieces()];
        let next = steps.into_iter().flatten().min()?;
        self.steps.t.get(next).copied()
    }

    /// The step at which other pieces of switches hold.
    fn next_pieces(&self) -> Option<usize> {
        self.asked.run.held.get(self.held + 1).map(|held| held.step)
    }

    /// Whether a phase ends at the present step.
    fn ends_phase(&self, step: usize) -> bool {
        self.begins.get(self.phase + 1) == Some(&step)
    }

    /// The state with its derivatives at a fixed time that is not before the last one, and not beyond the next corner. At a
    /// corner it is the state before the change.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn at(&mut self, t: f64) -> Result<Vec<f64>, String> {
        while t > self.steps.t[self.step] {
            if t < self.stepper.t() {
                let mut y = self.stepper.at(&mut self.ode, t).map_err(|_| singular(t))?;
                self.ode.project(t, &mut y).map_err(|_| singular(t))?;
                return self.ode.at_fixed_time(t, y).map_err(|_| singular(t));
            } else if self.stepper.t() == self.steps.t[self.next] {
                self.arrive()?;
            } else {
                let failed = |_| singular(self.steps.t[self.step]);
                self.stepper.step(&mut self.ode).map_err(failed)?;
            }
        }
        self.ode.at_fixed_time(t, self.y.clone()).map_err(|_| singular(t))
    }

    /// Takes the state of the run at the end of steps.
    fn arrive(&mut self) -> Result<(), String> {
        let (n_y, end) = (self.ode.model.layout.n_y(), self.steps.t[self.next]);
        let mut y = self.stepper.y(&self.ode);
        self.step = self.next;
        let is_last = self.step + 1 == self.steps.t.len();
        let known = if is_last { &self.last } else { &self.steps.y[self.step * n_y..][..n_y] };
        let n_q = self.ode.model.layout.n_q;
        let is_far = || distance(known, &y, &self.scales[..n_q]) > CLOSE;
        if !self.ends_phase(self.step) && (is_last || is_far()) {
            take(known, self.asked.count, &mut y);
        }
        self.ode.project(end, &mut y).map_err(|_| singular(end))?;
        self.y = y;
        let of = (end, &self.asked.sizes[..]);
        self.ode.calm_down(of, &self.scales, &mut self.y).map_err(|_| singular(end))?;
        self.go_on()
    }

    /// Continues from the present state, to the end of as many steps of the run as fit into some steps.
    fn go_on(&mut self) -> Result<(), String> {
        let (t, step) = (&self.steps.t, self.step);
        let (begin, mut last) = (t[step], self.corner().unwrap_or(t[t.len() - 1]));
        if step + 1 == t.len() || begin == last {
            return Ok(());
        }
        let is_implicit = self.asked.run.implicit.get(step) == Some(&true);
        let other = self.methods.get(self.methods.partition_point(|first| *first <= step));
        last = other.map_or(last, |first| last.min(t[*first]));
        let known = self.stepper.next_size().filter(|_| self.stepper.is_implicit() == is_implicit);
        let decays = self.ode.late.iter().any(|late| *late != 0.0);
        let size = APART[usize::from(decays)] * known.unwrap_or(0.0);
        let most = t.partition_point(|end| *end <= last && end - begin <= size);
        self.next = most.saturating_sub(1).max(step + 1);
        let first = is_implicit.then_some(t[step + 1] - begin);
        let again = self.stepper.go_on(&self.ode, (begin, t[self.next]), &self.y, first);
        again.map_err(|_| singular(begin))
    }

    /// The functions whose zeros determine the time of the present corner.
    ///
    /// # Errors
    /// The reason for which this time has no derivatives.
    pub fn triggers(&self) -> Result<Vec<Trigger>, String> {
        let AskedRun { model, run, options, .. } = &self.asked;
        let (mut all, t) = (Vec::new(), self.steps.t[self.step]);
        if self.next_pieces() == Some(self.step) {
            all.extend(Trigger::of_switches(&self.ode.model, &run.held[self.held + 1]));
        }
        if self.ends_phase(self.step) {
            let unknown = || format!("the change at t = {t:.6} s is not known");
            let passage = run.passages.get(self.phase + 1).ok_or_else(unknown)?;
            if let Some(name) = self.ends_rebounds(passage) {
                return Err(format!(
                    "{name} comes to rest at t = {t:.6} s after impacts without end, which derivatives do not follow"
                ));
            }
            if passage.couples {
                return Err(format!("an impact with friction or at once at t = {t:.6} s"));
            }
            if passage.replaced {
                return Err(format!("an action replaces the state at t = {t:.6} s"));
            }
            all.extend(Trigger::of_passage((model, &self.ode.model), options, passage)?);
        }
        Ok(all)
    }

    /// The contact with restitution that comes to rest in the next phase.
    fn ends_rebounds(&self, passage: &Passage) -> Option<&str> {
        let after = self.asked.run.settings.get(self.phase + 1)?;
        let rebounds = |force: usize| match self.ode.model.forces[force].element.behaviour() {
            Some(Behaviour::Impacts { restitution, .. }) => restitution > 0.0,
            _ => false,
        };
        let was_free = |force: usize| !self.ode.model.forces[force].mode.holds();
        let rests = |own: &&ForceMode| {
            let rests = own.mode.holds() && was_free(own.force);
            rebounds(own.force) && (rests || passage.collapsed)
        };
        let own = after.modes.iter().find(rests)?;
        Some(&self.ode.model.forces[own.force].name)
    }

    /// Goes beyond the present corner, whose time has the derivatives `late`: the derivatives of the state jump by the
    /// difference of the rates before and after (saltation).
    ///
    /// # Errors
    /// The reason for which there are no derivatives beyond it.
    pub fn turn(&mut self, late: &[f64]) -> Result<(), String> {
        let t = self.steps.t[self.step];
        let failed = |_| singular(t);
        let rates = self.ode.rates(t, &self.y).map_err(failed)?;
        self.ode.shift((&rates, &self.ode.late), -1.0, &mut self.y);
        self.ode.shift((&rates, late), 1.0, &mut self.y);
        self.ode.late = late.to_vec();
        while self.next_pieces() == Some(self.step) {
            self.held += 1;
        }
        match self.ends_phase(self.step) {
            true => {
                self.phase += 1;
                self.begin_phase(late)?;
            }
            false => self.hold_pieces(),
        }
        self.since = (t, self.y.clone());
        self.go_on()
    }

    /// Begins the present phase at a time with derivatives `late`, at which the state has its whole derivatives.
    fn begin_phase(&mut self, late: &[f64]) -> Result<(), String> {
        let Self { asked, steps, .. } = self;
        let (t, n_y) = (steps.t[self.step], asked.model.layout.n_y());
        let failed = |_| singular(t);
        let setting = asked.run.settings.get(self.phase).cloned().unwrap_or_default();
        if let Some(passage) = asked.run.passages.get(self.phase) {
            for struck in &passage.impacts {
                let setting = Setting { modes: Vec::new(), ..setting.clone() };
                let open = setting.model(asked.model).map_err(|_| impossible(self.phase))?;
                let closed = impacts::closed(&open.limited(), struck);
                let mut blocks = (asked.equations)(&closed, &setting)?;
                let at = (t, late);
                impacts::strike(&self.ode, (&closed, &mut blocks), struck, at, &mut self.y)
                    .map_err(failed)?;
            }
        }
        if self.phase > 0 {
            self.ode = Self::equations_of(asked, self.phase)?;
            self.stepper.forget();
        }
        self.ode.late = late.to_vec();
        if let Some(known) = steps.y.get(self.step * n_y..(self.step + 1) * n_y) {
            take(known, asked.count, &mut self.y);
        }
        self.hold_pieces();
        self.ode.begin(t, &mut self.y, &self.scales).map_err(failed)
    }

    fn hold_pieces(&mut self) {
        let pieces = self.asked.run.held.get(self.held).map(|held| &held.pieces[..]);
        self.ode.workspace.motions.pieces = pieces.unwrap_or_default().to_vec();
    }

    /// The number of variables.
    pub fn count(&self) -> usize {
        self.asked.count
    }

    /// The largest error of a coordinate of the run in a state with derivatives, relative to the size of the mechanism or
    /// to a radian.
    pub fn error(&self, states: &[Vec<Slope>]) -> f64 {
        let (b, place) = (self.asked.count / ABREAST, self.asked.count % ABREAST);
        let scales = column_scales(&self.ode.model);
        let errors = states[b].iter().zip(&scales).map(|(x, scale)| x.slope[place].abs() / scale);
        errors.fold(0.0, f64::max)
    }

    /// The magnitudes of the variables of all blocks.
    pub fn sizes(&self) -> &[f64] {
        &self.asked.sizes
    }

    /// The duration of the run.
    pub fn duration(&self) -> f64 {
        self.steps.t[self.steps.t.len() - 1] - self.steps.t[0]
    }

    /// The conditions that may change the motion.
    pub fn conditions(&self) -> Vec<Measure> {
        let AskedRun { model, options, .. } = &self.asked;
        let all = planned(model, options);
        all.iter().filter_map(|event| Measure::of_condition(model, &event.condition).ok()).list()
    }

    /// The derivatives of the time of the start.
    pub fn late_start(&self) -> &[f64] {
        &self.asked.starts.1
    }

    /// The time and the state at which the motion has changed last.
    pub fn since(&self) -> (f64, &[f64]) {
        (self.since.0, &self.since.1)
    }

    /// The equations with derivatives.
    pub fn ode(&mut self) -> &mut SlopeOde {
        &mut self.ode
    }
}

/// Takes a state of the run. Its distance from the more accurate steps of the derivatives is an error, which the motion
/// carries on as it does the derivatives by a variable, at this place.
fn take(known: &[f64], place: usize, y: &mut [f64]) {
    let n_y = known.len();
    for (k, known) in known.iter().enumerate() {
        y[n_y * (1 + place) + k] += known - y[k];
        y[k] = *known;
    }
}

fn impossible(phase: usize) -> String {
    format!("phase {phase} of the run has no model")
}

fn singular(t: f64) -> String {
    format!("it has no bound: the position at t = {t:.6} s is singular, or the forces there have no derivative")
}
