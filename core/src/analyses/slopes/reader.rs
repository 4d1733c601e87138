//! Measures with derivatives at the times of a run.

use super::dissipation::Dissipation;
use super::driven;
use super::motion::MotionSlopes;
use super::triggers::{agreed, Trigger};
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::equations::actions;
use crate::equations::forces::Acting;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::Workspace;
use crate::math::{Dual, Listed, Real};
use crate::model::Model;
use std::sync::Arc;

/// How the derivatives of the states are found.
pub(super) enum StateSlopes<'a> {
    /// Along the steps of forward dynamics.
    Dynamics(Box<MotionSlopes<'a>>),
    /// At each time, because drivers determine the motion.
    Driven(Vec<Sensitivity>, States<'a>),
}

/// The states of a motion at any time, q, v and z, and for positions at rest that follow one another the rates of q.
pub(super) type States<'a> = &'a dyn Fn(f64) -> Option<[Vec<f64>; 4]>;

/// Reads measures with derivatives.
pub(super) struct Reader<'a> {
    model: Arc<Model>,
    pub measures: Vec<Measure>,
    course: StateSlopes<'a>,
    /// The changes of the motion so far.
    pub corners: Vec<Corner>,
    workspace: Workspace,
    /// The equations with derivatives by the time.
    over_time: Sensitivity,
    dissipation: Dissipation,
}

/// A time at which the motion changes.
pub(super) struct Corner {
    /// Its derivatives by each variable.
    pub late: Vec<f64>,
    /// What changes there.
    names: Vec<String>,
    /// The measures before and after the change.
    pub sides: [SlopeRow; 2],
}

impl Corner {
    /// What changes there, for messages.
    fn name(&self) -> &str {
        self.names.first().map_or("another change", |name| name)
    }
}

/// Part of its value at the last change below which the rate of a function, over the time since, counts as zero.
const GRAZES: f64 = 1e-6;
/// Part of the duration of a run within which two changes count as simultaneous.
const NEAR: f64 = 1e-10;

/// The values of all measures at a time.
#[derive(Clone, Debug)]
pub(super) struct SlopeRow {
    pub t: f64,
    /// The derivatives by each variable, for each measure.
    pub slopes: Vec<Vec<f64>>,
    /// The value, and its derivative by the time, for each measure.
    pub values: Vec<[f64; 2]>,
    /// The derivatives of the time of the last change of the motion by each variable while what it has begun decays, then 0.
    pub late: Vec<f64>,
    /// The number of variables of all blocks, and of those that are asked.
    variables: [usize; 2],
    /// The largest error of a coordinate of the run, relative to its scale.
    pub error: f64,
}

impl<'a> Reader<'a> {
    /// The variables whose change would end a rest at the start, before any state is read.
    pub fn caught(&self) -> Vec<bool> {
        let StateSlopes::Dynamics(motion) = &self.course else { return Vec::new() };
        motion.ode.caught.clone()
    }

    /// `bounds` are the ends of the steps of the run.
    pub fn new(
        model: &Arc<Model>,
        mut measures: Vec<Measure>,
        course: StateSlopes<'a>,
        bounds: &[f64],
    ) -> Self {
        let (workspace, over_time) = (Workspace::new(model), Sensitivity::new(model.lift()));
        let (model, corners) = (Arc::clone(model), Vec::new());
        let conditions = match &course {
            StateSlopes::Dynamics(motion) => motion.conditions(),
            StateSlopes::Driven(..) => Vec::new(),
        };
        let dissipation = Dissipation::new(&model, &mut measures, &conditions, bounds.to_vec());
        let mut reader =
            Self { model, measures, course, corners, workspace, over_time, dissipation };
        reader.follow();
        reader
    }

    /// Takes the model and the pieces of the present phase.
    fn follow(&mut self) {
        let StateSlopes::Dynamics(motion) = &mut self.course else { return };
        let (ode, pieces) =
            (motion.ode(), |workspace: &Workspace| workspace.motions.pieces.clone());
        if !Arc::ptr_eq(&self.model, &ode.model) {
            self.model = Arc::clone(&ode.model);
            self.measures = self.measures.iter().map(|of| of.in_phase(&self.model)).list();
            self.workspace = Workspace::new(&self.model);
            self.over_time = Sensitivity::new(self.model.lift());
        }
        self.workspace.motions.pieces = pieces(&ode.workspace);
    }

    /// The measures at a time; times ascend from call to call. Where the motion changes, those after it.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn at(&mut self, t: f64) -> Result<SlopeRow, String> {
        while self.dissipation.is_behind(t) {
            self.dissipate(t)?;
        }
        let states = self.arrive(t)?;
        self.whole_row(t, states, &[])
    }

    /// Sums the dissipated energies over a step, or to the start of the run.
    fn dissipate(&mut self, t: f64) -> Result<(), String> {
        if self.dissipation.t.is_nan() {
            let count = ABREAST * self.arrive(self.dissipation.start())?.len();
            let late = match &self.course {
                StateSlopes::Dynamics(motion) => motion.late_start().to_vec(),
                StateSlopes::Driven(..) => vec![0.0; count],
            };
            self.dissipation.begin(&late);
            return Ok(());
        }
        let (end, points) = self.dissipation.panel(t);
        for [t, duration] in points {
            let states = self.arrive(t)?;
            let row = self.row(t, states, &[])?;
            self.dissipation.add(duration, &row.values, &row.slopes);
        }
        self.dissipation.t = end;
        Ok(())
    }

    /// Goes beyond the changes of the motion up to a time, and returns the states there.
    fn arrive(&mut self, t: f64) -> Result<Vec<Vec<Slope>>, String> {
        while let StateSlopes::Dynamics(motion) = &mut self.course {
            match motion.corner().filter(|corner| *corner <= t) {
                Some(corner) => self.turn(corner)?,
                None => break,
            }
        }
        self.states(t)
    }

    /// The measures and the functions of triggers at a state, with the derivatives of the energies there.
    fn whole_row(
        &mut self,
        t: f64,
        states: Vec<Vec<Slope>>,
        triggers: &[Trigger],
    ) -> Result<SlopeRow, String> {
        if !self.dissipation.forces.is_empty() {
            let powers = self.row(t, states.clone(), triggers)?.values;
            self.dissipation.hold_time(&powers);
        }
        self.row(t, states, triggers)
    }

    /// The state at the end of the motion with its whole derivatives, in blocks of variables, and the derivatives of
    /// this time. The motion ends where the first measure is zero, if there are measures.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn end(&mut self, t: f64) -> Result<(Vec<Vec<Slope>>, Vec<f64>), String> {
        let row = self.at(t)?;
        let late = match self.dissipation.first == 0 {
            true => vec![0.0; row.variables[0]],
            false => {
                let name = "the condition that ends the motion";
                row.late(name, 0, (0.0, 0.0))?.ok_or_else(|| touches(name, t))?
            }
        };
        let mut states = self.states(t)?;
        if let StateSlopes::Dynamics(motion) = &mut self.course {
            let mut y = motion.at(t)?;
            let ode = motion.ode();
            let rates = ode.rates(t, &y).map_err(|_| format!("{t:.6} s is a singular position"))?;
            ode.shift((&rates, &late), 1.0, &mut y);
            states = (0..ode.blocks.len()).map(|b| ode.state(b, &y)).list();
        }
        Ok((states, late))
    }

    /// Goes beyond a change of the motion.
    fn turn(&mut self, t: f64) -> Result<(), String> {
        let states = self.states(t)?;
        let StateSlopes::Dynamics(motion) = &mut self.course else { return Ok(()) };
        let triggers = motion.triggers()?;
        let (begun, start) = motion.since();
        let (n_y, start) = (self.model.layout.n_y(), start.to_vec());
        let first = self.over_time(begun, &start[..n_y], (true, &triggers))?;
        let mut before = self.whole_row(t, states, &triggers)?;
        let StateSlopes::Dynamics(motion) = &self.course else { return Ok(()) };
        let (own, since, mut times) = (self.measures.len(), t - begun, Vec::new());
        let others = self.corners.last().filter(|_| since <= NEAR * motion.duration());
        let is_shared = others.is_some() || triggers.iter().any(Trigger::is_switch);
        let jumps = |k: usize| before.jumps(own + k, motion.sizes(), NEAR * motion.duration());
        let jumped = |(k, of): &(usize, &Trigger)| is_shared && !of.is_switch() && jumps(*k);
        for (k, trigger) in triggers.iter().enumerate().filter(|of| !jumped(of)) {
            let found = before.late(&trigger.name, own + k, (first[own + k][0], since))?;
            times.extend(found.map(|late| (&trigger.name[..], late)));
        }
        let names = triggers.iter().map(|trigger| trigger.name.clone()).list();
        let others = others.filter(|last| last.names.iter().all(|name| !names.contains(name)));
        times.extend(others.map(|last| (last.name(), last.late.clone())));
        let late = match triggers.iter().enumerate().find(jumped) {
            Some((_, of)) if times.is_empty() => return Err(touches(&of.name, t)),
            None if times.is_empty() => vec![0.0; motion.sizes().len()],
            _ => agreed(t, &times, &motion.sizes()[..motion.count()])?,
        };
        let StateSlopes::Dynamics(motion) = &mut self.course else { return Ok(()) };
        motion.turn(&late)?;
        self.follow();
        self.dissipation.turn(&before.values, &late);
        let states = self.states(t)?;
        let after = self.whole_row(t, states, &[])?;
        before.slopes.truncate(self.measures.len());
        before.values.truncate(self.measures.len());
        self.corners.push(Corner { late, names, sides: [before, after] });
        Ok(())
    }

    /// The states with derivatives by the variables of each block.
    fn states(&mut self, t: f64) -> Result<Vec<Vec<Slope>>, String> {
        match &mut self.course {
            StateSlopes::Dynamics(motion) => {
                let y = motion.at(t)?;
                let ode = motion.ode();
                Ok((0..ode.blocks.len()).map(|b| ode.state(b, &y)).list())
            }
            StateSlopes::Driven(blocks, states) => {
                let [q, v, z, _] = states(t).ok_or("its state is not known")?;
                let Self { model, workspace, .. } = self;
                let of = |block| driven::state((model, workspace), block, t, [&q, &v, &z]);
                blocks.iter_mut().map(of).collect()
            }
        }
    }

    /// The measures and the functions of triggers at a state.
    fn row(
        &mut self,
        t: f64,
        mut states: Vec<Vec<Slope>>,
        triggers: &[Trigger],
    ) -> Result<SlopeRow, String> {
        let (model, layout) = (&*self.model, &self.model.layout);
        let failed = |_| format!("the equations of motion have no unique solution at t = {t:.6} s");
        let values: Vec<f64> = states[0].iter().map(|x| x.value).list();
        let [q, v, z, _] = layout.split(&values);
        let solved = self.workspace.react(model, t, [q, v, z]);
        let solves = self.measures.iter().any(|measure| measure.needs_solution(model))
            || triggers.iter().any(|trigger| trigger.needs_solution(model));
        if solves {
            solved.map_err(failed)?;
        }
        let blocks = match &mut self.course {
            StateSlopes::Dynamics(motion) => &mut motion.ode().blocks,
            StateSlopes::Driven(blocks, _) => blocks,
        };
        let mut slopes = vec![Vec::new(); self.measures.len() + triggers.len()];
        for (b, (block, state)) in blocks.iter_mut().zip(&mut states).enumerate() {
            let at = Slope::constant(t);
            self.dissipation.append(model, b, state);
            let [q, v, z, works] = layout.split(state);
            match solves {
                true => {
                    block.respond((model, &mut self.workspace), at, [q, v, z]).map_err(failed)?
                }
                false => block.place(q, v, &self.workspace.motions.pieces),
            }
            let all = read((&self.measures, triggers), block, at, [q, v, z, works]);
            slopes.iter_mut().zip(all).for_each(|(slopes, found)| slopes.extend(found.slope));
        }
        let values = self.over_time(t, &values, (solves, triggers))?;
        let all = ABREAST * states.len();
        let (count, error, late) = match &mut self.course {
            StateSlopes::Dynamics(motion) => {
                (motion.count(), motion.error(&states), motion.ode().late.clone())
            }
            StateSlopes::Driven(..) => (all, 0.0, vec![0.0; all]),
        };
        Ok(SlopeRow { t, slopes, values, late, variables: [all, count], error })
    }

    /// The measures and their derivatives by the time.
    fn over_time(
        &mut self,
        t: f64,
        y: &[f64],
        (solves, triggers): (bool, &[Trigger]),
    ) -> Result<Vec<[f64; 2]>, String> {
        let Self { model, workspace, over_time, measures, dissipation, course, .. } = self;
        let model: &Model = model;
        let failed = |_| format!("the equations of motion have no unique solution at t = {t:.6} s");
        let [q, v, z, works] = model.layout.split(y);
        if solves {
            workspace.react(model, t, [q, v, z]).map_err(failed)?;
        }
        let mut dz = vec![0.0; z.len()];
        workspace.state_rates(model, t, &mut dz);
        let powers = workspace.powers(model, v);
        let mut rates = [v, workspace.a(), &dz].concat();
        if let StateSlopes::Driven(_, states) = course {
            driven::follow(|| states(t), &mut rates, v.len());
        }
        let along = |(x, rate): (&f64, &f64)| {
            let mut slope = [0.0; ABREAST];
            slope[0] = *rate;
            Dual { value: *x, slope }
        };
        let mut state: Vec<Slope> = y.iter().zip(&rates).map(along).list();
        let powers = [powers.dissipated, powers.drivers, powers.applied];
        state.extend(works.iter().zip(&powers).map(along));
        dissipation.append_each(model, &mut state, |place| {
            let acting = Acting { z, lam: Some(workspace.lam()), t };
            let force = dissipation.forces[place];
            let power = actions::dissipated(model, force, &workspace.motions, acting);
            along((&dissipation.values[place], &power))
        });
        let at = Dual::variable(t, 0);
        let [q, v, z, works] = model.layout.split(&state);
        match solves {
            true => over_time.respond((model, workspace), at, [q, v, z]).map_err(failed)?,
            false => over_time.place(q, v, &workspace.motions.pieces),
        }
        let all = read((measures, triggers), over_time, at, [q, v, z, works]);
        Ok(all.iter().map(|found| [found.value, found.slope[0]]).list())
    }
}

impl SlopeRow {
    /// Whether function `k` is not zero where it changes its sign, because a force or speed jumps there: another change at
    /// this time determines it.
    fn jumps(&self, k: usize, sizes: &[f64], near: f64) -> bool {
        let [value, rate] = self.values[k];
        let effects = self.slopes[k].iter().zip(sizes).take(self.variables[1]);
        let most = effects.fold(0.0_f64, |most, (slope, size)| most.max((slope * size).abs()));
        value.abs() > (GRAZES * most).max((rate * near).abs())
    }

    /// The derivatives of the time at which function `k`, called `name`, becomes zero. `before` is its value at the last
    /// change, a time `since` ago. None if it is zero all the time, whatever the variables are.
    ///
    /// # Errors
    /// The function only touches zero.
    fn late(
        &self,
        name: &str,
        k: usize,
        (before, since): (f64, f64),
    ) -> Result<Option<Vec<f64>>, String> {
        let rate = self.values[k][1];
        if (rate * since).abs() >= GRAZES * before.abs() && rate != 0.0 {
            return Ok(Some(self.slopes[k].iter().map(|slope| -slope / rate).list()));
        }
        let mut slopes = self.slopes[k].iter().take(self.variables[1]);
        match rate == 0.0 && slopes.all(|slope| *slope == 0.0) {
            true => Ok(None),
            false => Err(touches(name, self.t)),
        }
    }
}

fn touches(name: &str, t: f64) -> String {
    format!("{name} only touches its limit at t = {t:.6} s")
}

/// The measures and the functions of triggers at a state whose accelerations and multipliers are known.
fn read(
    (measures, triggers): (&[Measure], &[Trigger]),
    block: &Sensitivity,
    t: Slope,
    [q, v, z, works]: [&[Slope]; 4],
) -> Vec<Slope> {
    let (motions, solved) = (&block.motions, [&block.a[..], &block.lam]);
    let seen = Seen { t, state: [q, v, z], works, motions, solved, so_far: None };
    let of_measures = measures.iter().map(|measure| measure.value_at(&block.model, &seen));
    let of_triggers = triggers.iter().map(|trigger| trigger.value(&block.model, &seen));
    of_measures.chain(of_triggers).list()
}
