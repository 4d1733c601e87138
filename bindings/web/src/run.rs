//! Analyses of a case, and runs without one.

use crate::convert::{written, Fields};
use crate::fault::Fault;
use crate::findings;
use crate::instant;
use crate::loaded::Loaded;
use crate::named;
use kempe::analyses::dynamics::{shared_loads, Prepared, Run};
use kempe::analyses::readings::Readable;
use kempe::analyses::record::{Observer, Record, RunResult, StartState, Subject, Variable};
use kempe::analyses::{not_unique, AnyAnalysis};
use kempe::equations::kinematics::Motions;
use kempe::model::Value as Written;
use kempe::{Flow, Model};
use serde_json::{json, Value};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Number of outputs at which reactions are examined.
const EXAMINED: usize = 11;
/// Number of outputs of a run without an analysis of the case.
const OUTPUTS: f64 = 500.0;

/// The last run, with the model that it used.
pub struct Ran {
    model: Arc<Model>,
    record: Record,
    error: Option<String>,
}

impl Ran {
    /// Runs an analysis of the case by its name. Otherwise runs, from the current state, kinematics over a quantity,
    /// or dynamics until `t_end`.
    pub fn of(loaded: &Loaded, fields: &Fields<'_>) -> Result<Self, Fault> {
        if !loaded.assembled {
            return Err(Fault::new("the mechanism does not close").hint("assemble it first"));
        }
        let prepared = Prepared::new(Arc::clone(&loaded.model));
        let subject = Subject { definition: &loaded.case.definition, prepared: &prepared };
        let mut look = |_| Flow::Continue;
        let mut observer = Observer::new(&mut look);
        if fields.get("analysis").is_some() {
            return Self::named(loaded, &subject, fields.text("analysis")?, observer);
        }
        let (kind, given) = match fields.get("over") {
            Some(_) => ("kinematics", ["over", "range", "n"].as_slice()),
            None => ("dynamics", ["t_end", "output_step"].as_slice()),
        };
        let given =
            given.iter().filter_map(|key| Some(((*key).into(), written(fields.get(key)?)?)));
        let kind = [("type".to_string(), Written::Text(kind.to_string()))];
        let given: Vec<_> = kind.into_iter().chain(given).collect();
        let analysis = AnyAnalysis::read(&loaded.model, &given, &[]);
        let mut analysis = analysis.map_err(|found| Fault::of_problems(&found))?;
        let start = StartState::new(loaded.state.clone());
        if let AnyAnalysis::Dynamics(options) = &mut analysis {
            let step = (options.t_end - start.state.t) / OUTPUTS;
            options.output_step = options.output_step.or(Some(step)).filter(|step| *step > 0.0);
            options.dense_output = false;
        }
        Self::recorded(&subject, analysis.run(&subject, &start, observer.again()))
    }

    /// Runs an analysis after the analyses at whose ends it starts.
    fn named(
        loaded: &Loaded,
        subject: &Subject<'_>,
        name: &str,
        observer: Observer<'_>,
    ) -> Result<Self, Fault> {
        let all = &loaded.case.analyses;
        let place = all.iter().position(|entry| entry.name == name);
        let place = place.ok_or_else(|| Fault::new(format!("there is no analysis '{name}'")))?;
        Self::recorded(subject, loaded.case.run_to(place, subject, observer))
    }

    /// The run of a record, also of a record up to a failure.
    fn recorded(subject: &Subject<'_>, outcome: RunResult) -> Result<Self, Fault> {
        let (record, error) = match outcome {
            Ok(record) => (record, None),
            Err(failed) => match failed.record {
                Some(record) => (record, Some(failed.outcome.message)),
                None => return Err(failed.outcome.into()),
            },
        };
        let driven = record.driven.as_ref().map(|driven| Arc::clone(&driven.model));
        let model = driven.unwrap_or_else(|| Arc::clone(subject.model()));
        Ok(Self { model, record, error })
    }

    fn run(&self) -> Result<&Run, Fault> {
        let motion = self.record.motion.as_ref();
        motion.ok_or_else(|| Fault::new("the result of the last run is not a motion"))
    }

    /// The run as a reply.
    pub fn described(&self) -> Value {
        match &self.record.motion {
            Some(run) => self.motion(run),
            None => findings::described(&self.model, &self.record),
        }
    }

    fn motion(&self, run: &Run) -> Value {
        let Run { trajectory, statistics, events, .. } = run;
        let times = events
            .iter()
            .flat_map(|event| event.states.t.iter().map(|t| json!({ "name": event.name, "t": t })));
        let mut times: Vec<Value> = times.collect();
        times.sort_by(|a, b| a["t"].as_f64().partial_cmp(&b["t"].as_f64()).expect("numbers"));
        let status = match (&self.error, run.reached, &run.stopped_by) {
            (Some(_), ..) => "failed",
            (None, true, _) => "reached",
            (None, false, Some(_)) => "event",
            (None, false, None) => "stopped",
        };
        json!({
            "count": trajectory.t.len(), "t_end": trajectory.t.last(), "status": status,
            "stopped_by": run.stopped_by, "events": times,
            "method": run.choice.as_ref().map(|choice| json!(choice.method)),
            "statistics": {
                "steps": statistics.steps, "rejected": statistics.rejected,
                "evaluations": statistics.evaluations,
            },
            "over": self.over().map(
                |of| json!({ "name": of.name, "unit": of.unit, "condition": of.condition() })),
            "error": self.error.as_ref().map(|message| json!({ "message": message })),
            "not_unique": self.not_unique(run), "shared": self.shared(run),
            "remarks": self.record.remarks.iter().chain(&run.doubts).chain(&run.notes).collect::<Vec<_>>(),
        })
    }

    /// The names of the joints and drivers without a unique reaction.
    fn not_unique(&self, run: &Run) -> Vec<&str> {
        let (model, track) = (&self.model, &run.trajectory);
        let Some(last) = track.t.len().checked_sub(1) else { return Vec::new() };
        let n = model.layout.n_q;
        let some: BTreeSet<usize> = (0..EXAMINED).map(|k| k * last / (EXAMINED - 1)).collect();
        let at = |k: usize| not_unique(model, track.t[k], &track.q[n * k..n * (k + 1)]).all();
        let found: BTreeSet<usize> = some.into_iter().flat_map(at).collect();
        found.into_iter().map(|k| &model.constraints[k].name[..]).collect()
    }

    /// The names of forces, joints and drivers whose load contacts and friction at rest share in more than one way, at
    /// the ends of some phases.
    fn shared(&self, run: &Run) -> BTreeSet<String> {
        let depends = |phase: &usize| run.settings[*phase].modes.iter().any(|of| of.mode.depends());
        let all: Vec<usize> = (0..run.settings.len()).filter(depends).collect();
        let Some(last) = all.len().checked_sub(1) else { return BTreeSet::new() };
        let some: BTreeSet<usize> = (0..EXAMINED).map(|k| all[k * last / (EXAMINED - 1)]).collect();
        let at_ends = |phase: usize| {
            let (setting, states) = (&run.settings[phase], run.states_of(phase));
            let open = setting.open(&self.model).ok()?;
            let count = states.t.len();
            let at = |k: usize| {
                let rows = [states.q, states.v, states.z].map(|table| nth(table, k, count));
                shared_loads(&open, &setting.modes, states.t[k], rows)
            };
            Some([0, count.checked_sub(1)?].into_iter().flat_map(at).collect::<Vec<_>>())
        };
        some.into_iter().filter_map(at_ends).flatten().collect()
    }

    /// Times and poses of the moving bodies, row by row.
    pub fn frames(&self) -> Result<Vec<f64>, Fault> {
        let (layout, track) = (&self.model.layout, &self.run()?.trajectory);
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
        Ok(found)
    }

    /// Everything at the output with this number.
    pub fn instant(&self, at: f64) -> Result<Value, Fault> {
        instant::described(&self.model, self.run()?, at as usize)
    }

    /// The quantities and expressions that can be read from the run.
    pub fn quantities(&self, loaded: &Loaded) -> Vec<Readable> {
        let all = named::all(loaded, &self.model).into_iter();
        all.map(|one| Readable { unit: self.unit(&one.unit), ..one }).collect()
    }

    /// The quantity that replaces the time, if one does.
    fn over(&self) -> Option<&Variable> {
        self.record.driven.as_ref().map(|driven| &driven.variable)
    }

    /// The unit in this run of a quantity whose unit over time is `unit`.
    fn unit(&self, unit: &str) -> String {
        self.over().map_or_else(|| unit.to_string(), |over| over.rate(unit))
    }

    /// The units of quantities and expressions, and their values, one row for each.
    pub fn values(
        &self,
        loaded: &Loaded,
        names: &[&str],
    ) -> Result<(Vec<String>, Vec<f64>), Fault> {
        let found: Result<Vec<_>, _> =
            names.iter().map(|name| named::find(loaded, &self.model, name)).collect();
        let (units, numbers) = named::values(&self.model, self.run()?, &found?);
        Ok((units.iter().map(|unit| self.unit(unit)).collect(), numbers))
    }
}

/// Row `k` of a table with so many rows.
fn nth(table: &[f64], k: usize, count: usize) -> &[f64] {
    let width = table.len() / count;
    &table[k * width..(k + 1) * width]
}
