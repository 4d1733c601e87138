//! Analyses of a case whose result is a motion.

use crate::convert::{written, Fields};
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::named;
use crate::over::{driven_by, Variable};
use kempe::analyses::dynamics::{read, Prepared, Run};
use kempe::analyses::kinematics as driven;
use kempe::analyses::kinematics::{kinematics, recorded, Motion};
use kempe::analyses::not_unique;
use kempe::analyses::options::Declared;
use kempe::analyses::readings::Readable;
use kempe::equations::kinematics::Motions;
use kempe::model::{Entry, Value as Written};
use kempe::{Flow, Model, Options, State};
use serde_json::{json, Value};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Number of outputs of kinematics without output_step.
const DEGREES: f64 = 360.0;
/// Largest number of outputs of kinematics.
const MOST_OUTPUTS: f64 = 1e6;
/// Number of outputs at which reactions are examined.
const EXAMINED: usize = 11;
/// Number of outputs of a run without an analysis of the case.
const OUTPUTS: f64 = 500.0;

/// The last run, with the model that it used.
pub struct Ran {
    model: Arc<Model>,
    run: Run,
    error: Option<String>,
    /// The variable that replaces time, if there is one.
    over: Option<Variable>,
}

impl Ran {
    /// Runs an analysis of the case by its name. Otherwise runs, from the current state, kinematics over a quantity,
    /// or dynamics until `t_end`.
    pub fn of(loaded: &Loaded, fields: &Fields<'_>) -> Result<Self, Fault> {
        if !loaded.assembled {
            return Err(Fault::new("the mechanism does not close").hint("assemble it first"));
        }
        if fields.get("analysis").is_some() {
            return Self::named(loaded, fields.text("analysis")?);
        }
        if fields.get("over").is_some() {
            let given = ["over", "range", "n"].into_iter();
            let fields = given.filter_map(|key| Some((key.into(), written(fields.get(key)?)?)));
            let options = driven::Options::checked(&loaded.model, &fields.collect::<Vec<_>>(), &[]);
            let options = options.map_err(|found| Fault::of_problems(&found))?;
            return Self::kinematics(loaded, &loaded.state, &options);
        }
        let (t, t_end) = (loaded.state.t, fields.number("t_end")?);
        let mut options = Options::new(t_end);
        let step = fields.number_or("output_step", (t_end - t) / OUTPUTS)?;
        options.output_step = Some(step).filter(|step| *step > 0.0);
        if let Some(problem) = options.backward(t, &["t_end"]) {
            return Err(Fault::of_problems(&[problem]));
        }
        Ok(Self::dynamics(&loaded.model, &loaded.state, &options))
    }

    /// Runs an analysis after the analyses at whose ends it starts.
    fn named(loaded: &Loaded, name: &str) -> Result<Self, Fault> {
        let all = &loaded.case.analyses;
        let place = all.iter().position(|entry| entry.name == name);
        let place = place.ok_or_else(|| Fault::new(format!("there is no analysis '{name}'")))?;
        let before = match all[place].get("from") {
            Some(Written::Text(from)) if from == "start" => None,
            Some(Written::Text(from)) => Some(from.clone()),
            _ => place.checked_sub(1).map(|k| all[k].name.clone()),
        };
        let start = match before {
            None => loaded.start()?,
            Some(before) => Self::named(loaded, &before)?.end(),
        };
        Self::entry(loaded, &all[place], &start)
    }

    fn entry(loaded: &Loaded, entry: &Entry, start: &State) -> Result<Self, Fault> {
        let model = &loaded.model;
        let path = ["analyses".to_string(), entry.name.clone()];
        let problems = |found: Vec<kempe::Problem>| Fault::of_problems(&found);
        match entry.get("type") {
            Some(Written::Text(kind)) if kind == "dynamics" => {
                let options = read(model, &entry.fields, &path).map_err(problems)?;
                Ok(Self::dynamics(model, start, &options))
            }
            Some(Written::Text(kind)) if kind == "kinematics" => {
                let options = driven::Options::checked(model, &entry.fields, &path);
                Self::kinematics(loaded, start, &options.map_err(problems)?)
            }
            Some(Written::Text(kind)) if kind == "inverse_dynamics" => {
                let options = driven::InverseOptions::checked(model, &entry.fields, &path);
                let options = options.map_err(problems)?;
                if options.r#static {
                    let message = format!("the analysis '{}' is static", entry.name);
                    return Err(Fault::new(message).hint("kempe run computes it"));
                }
                Self::kinematics(loaded, start, &options.into())
            }
            _ => Err(Fault::new(format!("the analysis '{}' has no motion", entry.name)).hint(
                "its result is in kempe.run; here dynamics, kinematics and inverse_dynamics run",
            )),
        }
    }

    fn dynamics(model: &Arc<Model>, start: &State, options: &Options) -> Self {
        let options = Options { dense_output: false, ..options.clone() };
        let outcome =
            Prepared::new(Arc::clone(model)).dynamics(start, &options, |_| Flow::Continue);
        let (run, error) = match outcome {
            Ok(run) => (run, None),
            Err(failure) => (failure.run, Some(failure.reason.to_string())),
        };
        Self { model: Arc::clone(model), run, error, over: None }
    }

    fn kinematics(
        loaded: &Loaded,
        start: &State,
        options: &driven::Options,
    ) -> Result<Self, Fault> {
        let Some((over, [first, last])) = options.over.as_ref().zip(options.range) else {
            let times = times(start.t, options);
            return Ok(Self::through(&loaded.model, start, &times, None));
        };
        let (model, start, variable) = driven_by(loaded, over, start)?;
        let mut begin = Self::through(&model, &start, &[first], Some(variable));
        if begin.error.is_some() {
            return Ok(begin);
        }
        let step = (last - first) / (options.n - 1) as f64;
        let at = |k: usize| if k + 1 == options.n { last } else { first + step * k as f64 };
        let values: Vec<f64> = (0..options.n).map(at).collect();
        Ok(Self::through(&model, &begin.end(), &values, begin.over.take()))
    }

    /// The motion at times, or at values of the variable that replaces time.
    fn through(model: &Arc<Model>, start: &State, times: &[f64], over: Option<Variable>) -> Self {
        let (motion, error) = match kinematics(model, start, times, |_| Flow::Continue) {
            Ok(motion) => (motion, None),
            Err(failure) => (failure.motion, Some(failure.reason.to_string())),
        };
        Self { run: run_of(model, start, &motion), model: Arc::clone(model), error, over }
    }

    /// The run as a reply.
    pub fn described(&self) -> Value {
        let Run { trajectory, statistics, events, .. } = &self.run;
        let times = events
            .iter()
            .flat_map(|event| event.states.t.iter().map(|t| json!({ "name": event.name, "t": t })));
        let mut times: Vec<Value> = times.collect();
        times.sort_by(|a, b| a["t"].as_f64().partial_cmp(&b["t"].as_f64()).expect("numbers"));
        let status = match (&self.error, self.run.reached, &self.run.stopped_by) {
            (Some(_), ..) => "failed",
            (None, true, _) => "reached",
            (None, false, Some(_)) => "event",
            (None, false, None) => "stopped",
        };
        json!({
            "count": trajectory.t.len(), "t_end": trajectory.t.last(), "status": status,
            "stopped_by": self.run.stopped_by, "events": times,
            "method": self.run.choice.as_ref().map(|choice| json!(choice.method)),
            "statistics": {
                "steps": statistics.steps, "rejected": statistics.rejected,
                "evaluations": statistics.evaluations,
            },
            "over": self.over.as_ref().map(|one| json!({ "name": one.name, "unit": one.unit })),
            "error": self.error.as_ref().map(|message| json!({ "message": message })),
            "not_unique": self.not_unique(),
        })
    }

    /// The names of the joints and drivers without a unique reaction.
    fn not_unique(&self) -> Vec<&str> {
        let (model, track) = (&self.model, &self.run.trajectory);
        let Some(last) = track.t.len().checked_sub(1).filter(|_| model.allow_redundancy) else {
            return Vec::new();
        };
        let n = model.layout.n_q;
        let some: BTreeSet<usize> = (0..EXAMINED).map(|k| k * last / (EXAMINED - 1)).collect();
        let at = |k: usize| not_unique(model, track.t[k], &track.q[n * k..n * (k + 1)]);
        let found: BTreeSet<usize> = some.into_iter().flat_map(at).collect();
        found.into_iter().map(|k| &model.constraints[k].name[..]).collect()
    }

    /// Times and poses of the moving bodies, row by row.
    pub fn frames(&self) -> Vec<f64> {
        let (layout, track) = (&self.model.layout, &self.run.trajectory);
        let mut motions = Motions::new(layout);
        let mut found = Vec::new();
        for (k, t) in track.t.iter().enumerate() {
            let rows = layout.n_q * k..layout.n_q * (k + 1);
            motions.place(layout, &track.q[rows.clone()], &track.v[rows]);
            found.push(*t);
            for body in 1..self.model.bodies.len() {
                let pose = &motions[body].pose;
                found.extend([pose.r.x, pose.r.y, pose.angle]);
            }
        }
        found
    }

    /// The quantities and expressions that can be read from the run.
    pub fn quantities(&self, loaded: &Loaded) -> Vec<Readable> {
        named::all(loaded, &self.model)
    }

    /// The units of quantities and expressions, and their values, one row for each.
    pub fn values(
        &self,
        loaded: &Loaded,
        names: &[&str],
    ) -> Result<(Vec<String>, Vec<f64>), Fault> {
        let found: Result<Vec<_>, _> =
            names.iter().map(|name| named::find(loaded, &self.model, name)).collect();
        Ok(named::values(&self.model, &self.run, &found?))
    }

    fn end(&self) -> State {
        let (layout, track) = (&self.model.layout, &self.run.trajectory);
        let last = |table: &[f64], width: usize| table[table.len() - width..].to_vec();
        State {
            t: *track.t.last().expect("a run has its start"),
            q: last(&track.q, layout.n_q),
            v: last(&track.v, layout.n_q),
            z: last(&track.z, layout.n_z),
        }
    }
}

/// The times of the outputs after the start.
fn times(begin: f64, options: &driven::Options) -> Vec<f64> {
    let end = options.t_end.unwrap_or(begin);
    let step = options.output_step.unwrap_or((end - begin) / DEGREES).max(f64::MIN_POSITIVE);
    let count = ((end - begin) / step * (1.0 - 1e-12)).ceil().clamp(0.0, MOST_OUTPUTS) as usize;
    let at = |k: usize| if k == count { end } else { begin + step * k as f64 };
    (0..=count).map(at).collect()
}

fn run_of(model: &Model, start: &State, motion: &Motion) -> Run {
    Run {
        trajectory: recorded(model, start, motion, false).trajectory,
        phases: vec![0],
        reached: motion.reached,
        passing: true,
        ..Run::default()
    }
}
