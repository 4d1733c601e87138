//! Measures with derivatives at the times of a run.

use super::driven;
use super::motion::MotionSlopes;
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::Workspace;
use crate::math::{Dual, Listed, Real};
use crate::model::Model;

/// How the derivatives of the states are found.
pub(super) enum StateSlopes<'a> {
    /// Along the steps of forward dynamics.
    Dynamics(Box<MotionSlopes<'a>>),
    /// At each time, because drivers determine the motion.
    Driven(Vec<Sensitivity>, States<'a>),
}

/// The states of a motion at any time.
pub(super) type States<'a> = &'a dyn Fn(f64) -> Option<[Vec<f64>; 3]>;

/// Reads measures with derivatives.
pub(super) struct Reader<'a> {
    pub model: &'a Model,
    pub measures: Vec<Measure>,
    pub course: StateSlopes<'a>,
    workspace: Workspace,
    /// The equations with derivatives by the time.
    over_time: Sensitivity,
}

/// The values of all measures at a time.
#[derive(Clone, Debug)]
pub(super) struct SlopeRow {
    pub t: f64,
    /// The derivatives by each variable, for each measure.
    pub slopes: Vec<Vec<f64>>,
    /// The value, and its derivative by the time, for each measure.
    pub values: Vec<[f64; 2]>,
}

impl<'a> Reader<'a> {
    pub fn new(model: &'a Model, measures: Vec<Measure>, course: StateSlopes<'a>) -> Self {
        let over_time = Sensitivity::new(model.lift());
        Self { model, measures, course, workspace: Workspace::new(model), over_time }
    }

    /// The measures at a time; times ascend from call to call.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn at(&mut self, t: f64) -> Result<SlopeRow, String> {
        let (model, layout) = (self.model, &self.model.layout);
        let failed = |_| format!("the equations of motion have no unique solution at t = {t:.6} s");
        let mut states: Vec<Vec<Slope>> = match &mut self.course {
            StateSlopes::Dynamics(motion) => {
                let y = motion.at(t)?;
                let ode = motion.ode();
                (0..ode.blocks.len()).map(|b| ode.state(b, &y)).list()
            }
            StateSlopes::Driven(blocks, states) => {
                let [q, v, z] = states(t).ok_or("its state is not known")?;
                let of = |block| driven::state(model, block, t, [&q, &v, &z]);
                blocks.iter_mut().map(of).collect::<Result<_, _>>()?
            }
        };
        let values: Vec<f64> = states[0].iter().map(|x| x.value).list();
        let [q, v, z, _] = layout.split(&values);
        let solved = self.workspace.react(model, t, [q, v, z]);
        let solves = self.measures.iter().any(|measure| measure.needs_solution(model));
        if solves {
            solved.map_err(failed)?;
        }
        let blocks = match &mut self.course {
            StateSlopes::Dynamics(motion) => &mut motion.ode().blocks,
            StateSlopes::Driven(blocks, _) => blocks,
        };
        let mut slopes = vec![Vec::new(); self.measures.len()];
        for (block, state) in blocks.iter_mut().zip(&mut states) {
            let at = Slope::constant(t);
            let [q, v, z, works] = layout.split(state);
            match solves {
                true => {
                    block.respond((model, &mut self.workspace), at, [q, v, z]).map_err(failed)?
                }
                false => block.place(q, v),
            }
            for (measure, slopes) in self.measures.iter().zip(&mut slopes) {
                slopes.extend(read(measure, block, at, [q, v, z, works]).slope);
            }
        }
        let values = self.over_time(t, &values, solves)?;
        Ok(SlopeRow { t, slopes, values })
    }

    /// The measures and their derivatives by the time.
    fn over_time(&mut self, t: f64, y: &[f64], solves: bool) -> Result<Vec<[f64; 2]>, String> {
        let Self { model, workspace, over_time, measures, .. } = self;
        let failed = |_| format!("the equations of motion have no unique solution at t = {t:.6} s");
        let [_, v, z, works] = model.layout.split(y);
        let mut dz = vec![0.0; z.len()];
        workspace.state_rates(model, t, &mut dz);
        let powers = workspace.powers(model, v);
        let rates = [v, workspace.a(), &dz].concat();
        let along = |(x, rate): (&f64, &f64)| {
            let mut slope = [0.0; ABREAST];
            slope[0] = *rate;
            Dual { value: *x, slope }
        };
        let mut state: Vec<Slope> = y.iter().zip(&rates).map(along).list();
        let powers = [powers.dissipated, powers.drivers, powers.applied];
        state.extend(works.iter().zip(&powers).map(along));
        let at = Dual::variable(t, 0);
        let [q, v, z, works] = model.layout.split(&state);
        match solves {
            true => over_time.respond((model, workspace), at, [q, v, z]).map_err(failed)?,
            false => over_time.place(q, v),
        }
        let all = measures.iter().map(|measure| {
            let found = read(measure, over_time, at, [q, v, z, works]);
            [found.value, found.slope[0]]
        });
        Ok(all.list())
    }
}

/// A measure at a state whose accelerations and multipliers are known.
fn read(
    measure: &Measure,
    block: &Sensitivity,
    t: Slope,
    [q, v, z, works]: [&[Slope]; 4],
) -> Slope {
    let (motions, solved) = (&block.motions, [&block.a[..], &block.lam]);
    let seen = Seen { t, state: [q, v, z], works, motions, solved, so_far: None };
    measure.value_at(&block.model, &seen)
}
