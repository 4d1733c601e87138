//! The data that a page works with: a text, its mechanism, a motion in progress and the last run.

use crate::cam;
use crate::catalogue::catalogue;
use crate::columns::slopes;
use crate::convert::Fields;
use crate::dragged::drag;
use crate::drawn::{display, scene};
use crate::editing::edit;
use crate::exercise::Exercise;
use crate::fault::Fault;
use crate::foreign;
use crate::live::Live;
use crate::loaded::{load, without_drivers, Loaded};
use crate::modes::configurations;
use crate::named;
use crate::optimize::Search;
use crate::pose::pose;
use crate::readiness::readiness;
use crate::run::Ran;
use crate::synthesis::{Task, Tracing};
use kempe::analyses::assemble::{self, Request};
use kempe::analyses::readings;
use kempe::analyses::record::Outcome;
use kempe::case::{self, Format};
use kempe::{assemble as close, State};
use serde_json::{json, Value};
use std::sync::Arc;

/// The state between two requests.
#[derive(Default)]
pub struct Session {
    text: String,
    loaded: Option<Loaded>,
    live: Option<Live>,
    ran: Option<Ran>,
    search: Option<Search>,
    tracing: Option<Tracing>,
    numbers: Vec<f64>,
}

impl Session {
    /// Answers a request. The request and the reply are JSON texts.
    pub fn call(&mut self, request: &str) -> String {
        let parsed: Result<Value, _> = serde_json::from_str(request);
        let outcome = match parsed.as_ref().map(Value::as_object) {
            Ok(Some(fields)) => self.answer(&Fields(fields)),
            Ok(None) => Err(Fault::new("a request must be a table")),
            Err(fault) => Err(Fault::new(format!("the request is not JSON: {fault}"))),
        };
        match outcome {
            Ok(value) => json!({ "ok": value }).to_string(),
            Err(fault) => fault.reply(),
        }
    }

    /// The numbers of the last reply that contains numbers.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    fn answer(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        match fields.text("do")? {
            "catalogue" => Ok(catalogue()),
            "read" => foreign::read(fields.text("text")?, fields.text("name")?),
            "load" => Ok(self.load(fields.text("text")?)),
            "edit" => edit(&self.text, fields.need("changes")?),
            "save" => self.save(fields),
            "pose" => self.pose(fields),
            "assemble" => self.assemble(fields),
            "drag" => {
                self.live = None;
                drag(self.loaded()?, fields)
            }
            "configurations" => configurations(self.loaded()?, fields),
            "mobility" => self.mobility(),
            "readiness" => Ok(readiness(self.loaded()?)),
            "quantities" => self.quantities(fields.get("of_run").is_some()),
            "quantity" => self.quantity(fields.text("name")?),
            "scene" => scene(self.present()?, self.ran.as_ref()),
            "display" => display(self.present()?, self.ran.as_ref(), fields),
            "live" => self.begin(),
            "advance" => self.advance(fields.number("by")?),
            "pull" => self.pull(fields),
            "parameters" => self.parameters(&fields.values("values")?),
            "run" => self.run(fields),
            "frames" => {
                self.numbers = self.last_run()?.frames()?;
                Ok(json!({ "numbers": self.numbers.len() }))
            }
            "instant" => self.last_run()?.instant(fields.number("at")?),
            "slopes" => slopes(self.loaded()?, fields),
            "optimize" => {
                let search = Search::begin(self.present()?)?;
                Ok(self.search.insert(search).described())
            }
            "improve" => self.searched(),
            "exercise" => Ok(self.exercise(fields)?.described()),
            "variant" => Ok(self.exercise(fields)?.changes()),
            "answer" => {
                let (name, given) = (fields.text("question")?, fields.text("given")?);
                self.exercise(fields)?.checked(name, given)
            }
            "synthesis" => {
                let starts = fields.get("starts").map_or(Ok(0.0), |_| fields.number("starts"))?;
                Ok(self.task()?.described(&mut self.tracing, starts as usize))
            }
            "candidate" => {
                let solved = self.task()?.solved(&mut self.tracing, 0)?;
                solved.taken(fields.number("choice")? as usize)
            }
            "cam" => cam::described(fields),
            "cam_case" => cam::case(fields),
            "cam_drawing" => cam::drawing(fields),
            "values" => self.values(&fields.texts("names")?),
            other => Err(Fault::new(format!("there is no request '{other}'"))),
        }
    }

    /// The exercise of the case, for the seed of the request or of the case.
    fn exercise(&self, fields: &Fields<'_>) -> Result<Exercise<'_>, Fault> {
        let seed = fields.get("seed").map(|_| fields.number("seed")).transpose()?;
        let loaded = self.present()?;
        Exercise::read(loaded, seed.map(|seed| seed as u64))
    }

    /// The task of the section `[synthesis]`.
    fn task(&mut self) -> Result<Task, Fault> {
        Task::read(&self.loaded()?.case.synthesis)
    }

    fn loaded(&mut self) -> Result<&mut Loaded, Fault> {
        self.loaded.as_mut().ok_or_else(no_mechanism)
    }

    fn present(&self) -> Result<&Loaded, Fault> {
        self.loaded.as_ref().ok_or_else(no_mechanism)
    }

    fn last_run(&self) -> Result<&Ran, Fault> {
        self.ran.as_ref().ok_or_else(|| Fault::new("there is no run yet").hint("request 'run'"))
    }

    fn load(&mut self, text: &str) -> Value {
        let (loaded, reply) = load(text);
        self.text = text.to_string();
        (self.loaded, self.live, self.ran, self.search) = (loaded, None, None, None);
        reply
    }

    fn save(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        let format = match fields.text("format")? {
            "toml" => Format::Toml,
            "json" => Format::Json,
            other => return Err(Fault::new(format!("there is no format '{other}'"))),
        };
        Ok(json!({ "text": case::write(&self.loaded()?.case, format) }))
    }

    fn pose(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        let loaded = self.loaded()?;
        if fields.get("q").is_some() {
            let q = fields.numbers("q")?;
            if q.len() != loaded.model.layout.n_q {
                return Err(Fault::new(format!("q has {} numbers", q.len())));
            }
            let near = State { v: vec![0.0; q.len()], q, ..loaded.state.clone() };
            loaded.assemble(Request { t: near.t, state: Some(near), ..Request::default() })?;
            self.live = None;
        }
        let loaded = self.loaded()?;
        Ok(pose(&loaded.model, &loaded.state))
    }

    fn assemble(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        let loaded = self.loaded()?;
        let targets = |section: &str| {
            let written = fields.table(section)?;
            assemble::targets(&loaded.model, section, &written)
                .map_err(|found| Fault::of_problems(&found))
        };
        let (set, guess) = (targets("set")?, targets("guess")?);
        loaded.assemble(Request { set, guess, ..Request::default() })?;
        let reply = pose(&loaded.model, &loaded.state);
        self.live = None;
        Ok(reply)
    }

    fn mobility(&mut self) -> Result<Value, Fault> {
        let loaded = self.loaded()?;
        let found = kempe::analyses::diagnosis::diagnose(&loaded.model, &loaded.state);
        Ok(kempe::analyses::diagnosis::as_json(&found))
    }

    /// The quantities of the case, or those of the last run.
    fn quantities(&self, of_run: bool) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        let found = match of_run {
            true => self.last_run()?.quantities(loaded),
            false => named::all(loaded, &loaded.model),
        };
        Ok(found.iter().map(|one| json!({ "name": one.name, "unit": one.unit })).collect())
    }

    fn quantity(&mut self, name: &str) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        let found = readings::find(&loaded.model, name).map_err(Fault::of_problem)?;
        let still = (&loaded.model, &loaded.state);
        let (model, state) = self.live.as_ref().map_or(still, |live| (live.model(), live.state()));
        let value = readings::of_state(model, state, &[name])[0];
        Ok(json!({ "value": value, "unit": found.unit }))
    }

    fn begin(&mut self) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        let reply = pose(&loaded.model, &loaded.state);
        self.live = Some(Live::begin(loaded)?);
        Ok(reply)
    }

    fn advance(&mut self, by: f64) -> Result<Value, Fault> {
        let live = self.live.as_mut().ok_or_else(not_live)?;
        let reply = live.advance(by.clamp(0.0, 10.0));
        let state = live.state().clone();
        self.loaded()?.state = state;
        Ok(reply)
    }

    fn pull(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        self.live.as_mut().ok_or_else(not_live)?.pull(loaded, fields)
    }

    /// Sets other values of parameters. Lengths may change, so the mechanism is assembled from its current position.
    fn parameters(&mut self, values: &[(String, f64)]) -> Result<Value, Fault> {
        let loaded = self.loaded.as_mut().ok_or_else(no_mechanism)?;
        let model = loaded.model.with_values(values).map_err(|found| Fault::of_problems(&found))?;
        let before = (Arc::clone(&loaded.model), loaded.state.clone());
        loaded.model = Arc::new(model);
        let near =
            Request { state: Some(loaded.state.clone()), t: loaded.state.t, ..Request::default() };
        let live = self.live.as_mut();
        let done =
            loaded.assemble(near).and_then(|()| live.map_or(Ok(()), |l| l.go_on_from(loaded)));
        if let Err(fault) = done {
            (loaded.model, loaded.state) = before;
            return Err(fault);
        }
        loaded.free = without_drivers(&loaded.model, &loaded.state, true);
        Ok(pose(&loaded.model, &loaded.state))
    }

    fn run(&mut self, fields: &Fields<'_>) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        let ran = Ran::of(loaded, fields)?;
        let reply = ran.described();
        self.ran = Some(ran);
        Ok(reply)
    }

    /// The next run of a search.
    fn searched(&mut self) -> Result<Value, Fault> {
        let search = self.search.as_mut();
        let search = search.ok_or_else(|| Fault::new("no search is in progress"))?;
        search.advance();
        Ok(search.described())
    }

    fn values(&mut self, names: &[&str]) -> Result<Value, Fault> {
        let loaded = self.loaded.as_ref().ok_or_else(no_mechanism)?;
        let (units, numbers) = self.last_run()?.values(loaded, names)?;
        self.numbers = numbers;
        Ok(json!({ "units": units, "numbers": self.numbers.len() }))
    }
}

impl Loaded {
    /// Assembles the mechanism. The state does not change if this fails.
    pub fn assemble(&mut self, request: Request) -> Result<(), Fault> {
        let (state, _) = close(&self.model, &request).map_err(|failure| Outcome::from(*failure))?;
        (self.state, self.assembled) = (state, true);
        Ok(())
    }

    /// The values of the parameters.
    pub fn values(&self) -> Vec<(String, kempe::model::Value)> {
        let names = self.model.blueprint.parameters.iter().cloned();
        let values = self.model.parameters.iter().map(|x| kempe::model::Value::Number(*x));
        names.zip(values).collect()
    }
}

fn no_mechanism() -> Fault {
    Fault::new("there is no mechanism").hint("load a text without faults")
}

fn not_live() -> Fault {
    Fault::new("no motion is in progress").hint("request 'live'")
}
