//! Dynamics in real time while a page displays it: computed slightly ahead, and restarted when the user interferes.

use crate::convert::Fields;
use crate::dragged::moving;
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::pose::{pose, residual};
use kempe::analyses::dynamics::{Prepared, Run, ENERGIES};
use kempe::case::Case;
use kempe::model::{Entry, Value as Written, WORKS};
use kempe::{build, Flow, Model, Options, State};
use serde_json::{json, Value};
use std::sync::Arc;

/// Number of advances that are computed ahead, and the longest time for them, s, unless one advance is longer.
const ADVANCES: f64 = 15.0;
const AHEAD: f64 = 0.25;
/// Advances below this length, s, are computed ahead with this length, because two frames may have almost equal
/// times.
const SHORTEST: f64 = 1e-4;
/// Number of outputs in one advance. The picture lags by less than the time between outputs.
const OUTPUTS: f64 = 4.0;
/// Fraction of an advance that counts as rounding.
const SAME: f64 = 1e-6;
/// Largest number of steps between two replies. With more steps, the motion is slower than real time.
const MOST_STEPS: usize = 4000;
/// Name of the spring to the mouse. Users cannot write names with a leading space.
const PULL: &str = "pull by hand";

/// A motion in progress.
pub struct Live {
    prepared: Prepared<Arc<Model>>,
    state: State,
    /// The requested time, s. The state is at the last output before it.
    goal: f64,
    /// Works before the current run, J.
    works: [f64; WORKS],
    /// The total energy at the start, J, and the scale of energies so far, J.
    start: f64,
    scale: f64,
    ahead: Option<Run>,
    events: Vec<Value>,
    pull: Option<Pull>,
}

/// The spring between the mouse and a point of a body.
#[derive(Clone, PartialEq)]
struct Pull {
    body: String,
    point: [f64; 2],
    to: [f64; 2],
    stiffness: f64,
    damping: f64,
}

impl Live {
    /// Begins at the current state.
    pub fn begin(loaded: &Loaded) -> Result<Self, Fault> {
        if !loaded.assembled {
            return Err(Fault::new("the mechanism does not close").hint("assemble it first"));
        }
        let mut live = Self {
            prepared: Prepared::new(Arc::clone(&loaded.model)),
            state: loaded.state.clone(),
            goal: loaded.state.t,
            works: [0.0; WORKS],
            start: 0.0,
            scale: 0.0,
            ahead: None,
            events: Vec::new(),
            pull: None,
        };
        live.mark_energy();
        Ok(live)
    }

    /// The current state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The model that moves: the model of the case with the spring.
    pub fn model(&self) -> &Arc<Model> {
        self.prepared.model()
    }

    /// Advances by a time. The reply contains the new state.
    pub fn advance(&mut self, by: f64) -> Value {
        let (mut steps, mut ended) = (0, None);
        self.goal += by;
        loop {
            // outputs are close enough for a picture; the next run begins at the last output
            let next = self.row_before(self.goal + SAME * by);
            if let Some(next) = next.map(|(run, row)| row_of(run, row, self.prepared.model())) {
                self.state = next;
            }
            let last = self.ahead.as_ref().and_then(|run| run.trajectory.t.last());
            let left = last.is_none_or(|last| *last < self.goal - by / OUTPUTS);
            if !left || steps >= MOST_STEPS || ended.is_some() || by <= 0.0 {
                break;
            }
            ended = self.compute(by, &mut steps);
        }
        if steps >= MOST_STEPS || ended.is_some() {
            self.goal = self.state.t;
        }
        self.reply(ended)
    }

    /// Computes ahead from the current state. Returns the reason if the motion ended.
    fn compute(&mut self, by: f64, steps: &mut usize) -> Option<String> {
        self.settle_works();
        let by = by.max(SHORTEST);
        let span = (ADVANCES * by).min(AHEAD).max(self.goal - self.state.t);
        let mut options = Options::new(self.state.t + span);
        options.output_step = Some(by / OUTPUTS);
        options.dense_output = false;
        let mut count = 0;
        let outcome = self.prepared.dynamics(&self.state, &options, |_| {
            count += 1;
            if count >= MOST_STEPS {
                Flow::Stop
            } else {
                Flow::Continue
            }
        });
        *steps += count;
        let (run, ended) = match outcome {
            Ok(run) => (run, None),
            Err(failure) => (failure.run, Some(failure.reason.to_string())),
        };
        for event in &run.events {
            let times = event.states.t.iter();
            self.events.extend(times.map(|t| json!({ "name": event.name, "t": t })));
        }
        let moves = run.trajectory.t.len() > 1;
        self.ahead = Some(run);
        ended.filter(|_| !moves)
    }

    /// The run ahead, and its last row up to a time.
    fn row_before(&self, t: f64) -> Option<(&Run, usize)> {
        let run = self.ahead.as_ref()?;
        Some((run, run.trajectory.t.iter().take_while(|own| **own <= t).count().checked_sub(1)?))
    }

    /// Works up to the current state.
    fn present_works(&self) -> [f64; WORKS] {
        let mut works = self.works;
        if let Some((run, row)) = self.row_before(self.state.t) {
            let own = &run.trajectory.works[WORKS * row..WORKS * (row + 1)];
            works.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
        works
    }

    fn settle_works(&mut self) {
        self.works = self.present_works();
        self.ahead = None;
    }

    /// Kinetic and potential energy, dissipated energy, and works of drivers and of applied forces, J.
    fn energies(&self) -> [f64; ENERGIES] {
        let State { t, q, v, z } = &self.state;
        let states = kempe::analyses::dynamics::States { t: &[*t], q, v, z };
        let found = self.prepared.energies(states, &self.present_works()).unwrap_or_default();
        found.try_into().unwrap_or([f64::NAN; ENERGIES])
    }

    /// Restarts the energy balance, so that earlier works do not count.
    fn mark_energy(&mut self) {
        self.works = [0.0; WORKS];
        self.ahead = None;
        let [kinetic, potential, ..] = self.energies();
        (self.start, self.scale) = (kinetic + potential, kinetic.abs());
    }

    fn reply(&mut self, ended: Option<String>) -> Value {
        let model = Arc::clone(self.prepared.model());
        let [kinetic, potential, dissipated, drivers, forces] = self.energies();
        let work = drivers + forces;
        let total = kinetic + potential + dissipated - work;
        let moved = (potential + dissipated - work - self.start).abs();
        self.scale = self.scale.max(kinetic).max(moved).max(dissipated).max(work.abs());
        let balance = if self.scale > 0.0 { (total - self.start) / self.scale } else { 0.0 };
        let mut reply = pose(&model, &self.state);
        reply["energy"] = json!({
            "kinetic": kinetic, "potential": potential, "dissipated": dissipated, "work": work,
            "balance": balance,
        });
        reply["drift"] = json!(residual(&model, self.state.t, &self.state.q));
        let (now, later): (Vec<Value>, Vec<Value>) = std::mem::take(&mut self.events)
            .into_iter()
            .partition(|event| event["t"].as_f64() <= Some(self.state.t));
        self.events = later;
        reply["events"] = json!(now);
        reply["ended"] = json!(ended);
        reply
    }

    /// Pulls at a point, or releases it.
    pub fn pull(&mut self, loaded: &Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
        let pull = match fields.get("body") {
            None => None,
            Some(_) => Some(Pull {
                body: fields.text("body")?.to_string(),
                point: fields.pair("point")?,
                to: fields.pair("to")?,
                stiffness: fields.number("stiffness")?,
                damping: fields.number_or("damping", 0.0)?,
            }),
        };
        if pull == self.pull {
            return Ok(json!({}));
        }
        let model = with_pull(loaded, pull.as_ref())?;
        self.pull = pull;
        self.settle_works();
        self.go_on_with(model);
        Ok(json!({}))
    }

    /// Continues from the state of a case with other parameters. A pull continues.
    ///
    /// # Errors
    /// The pull cannot act on the new model.
    pub fn go_on_from(&mut self, loaded: &Loaded) -> Result<(), Fault> {
        let model = with_pull(loaded, self.pull.as_ref())?;
        self.settle_works();
        (self.goal, self.state) = (loaded.state.t, loaded.state.clone());
        self.go_on_with(model);
        Ok(())
    }

    /// Continues with another model of the same coordinates.
    fn go_on_with(&mut self, model: Arc<Model>) {
        self.prepared = Prepared::new(model);
        self.mark_energy();
    }
}

/// The model of a case with the spring, if there is a pull.
fn with_pull(loaded: &Loaded, pull: Option<&Pull>) -> Result<Arc<Model>, Fault> {
    match pull {
        None => Ok(Arc::clone(&loaded.model)),
        Some(pull) => Ok(Arc::new(pulled(loaded, pull)?)),
    }
}

/// The model with a spring between a point of a body and a fixed point.
fn pulled(loaded: &Loaded, pull: &Pull) -> Result<Model, Fault> {
    moving(&loaded.model, &pull.body)?;
    let Case { definition, .. } = &loaded.case;
    let mut definition = definition.clone();
    let place = |[x, y]: [f64; 2]| Written::List(vec![Written::Number(x), Written::Number(y)]);
    add_point(&mut definition.bodies, "ground", place(pull.to));
    add_point(&mut definition.bodies, &pull.body, place(pull.point));
    let text = |text: String| Written::Text(text);
    let triple = |x: f64| Written::List([x, x, 0.0].map(Written::Number).to_vec());
    definition.forces.push(Entry {
        name: PULL.to_string(),
        fields: vec![
            ("type".to_string(), text("bushing".to_string())),
            ("i".to_string(), text(format!("ground.{PULL}"))),
            ("j".to_string(), text(format!("{}.{PULL}", pull.body))),
            ("stiffness".to_string(), triple(pull.stiffness)),
            ("damping".to_string(), triple(pull.damping)),
        ],
    });
    let parameters: Vec<(String, Written)> = loaded.values();
    build(&definition, &parameters).map_err(|found| Fault::of_problems(&found))
}

fn add_point(bodies: &mut Vec<Entry>, body: &str, at: Written) {
    if !bodies.iter().any(|entry| entry.name == body) {
        bodies.push(Entry { name: body.to_string(), fields: Vec::new() });
    }
    let Some(entry) = bodies.iter_mut().find(|entry| entry.name == body) else { return };
    if entry.get("points").is_none() {
        entry.fields.push(("points".to_string(), Written::Table(Vec::new())));
    }
    for (key, value) in &mut entry.fields {
        if let (true, Written::Table(points)) = (key == "points", value) {
            points.push((PULL.to_string(), at.clone()));
        }
    }
}

fn row_of(run: &Run, row: usize, model: &Model) -> State {
    let part = |table: &[f64], width: usize| table[width * row..width * (row + 1)].to_vec();
    let (track, layout) = (&run.trajectory, &model.layout);
    State {
        t: track.t[row],
        q: part(&track.q, layout.n_q),
        v: part(&track.v, layout.n_q),
        z: part(&track.z, layout.n_z),
    }
}
