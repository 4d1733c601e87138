//! A run of the case of an FMU, with the values that the host has chosen.

use crate::exported::Exported;
use kempe::analyses::dynamics::{Change, Failure, Prepared, SavedRun, Setting};
use kempe::analyses::measures::Measure;
use kempe::analyses::readings::at_pause;
use kempe::analyses::record::{with_start, Observer, Outcome, StartState, Subject};
use kempe::analyses::{start_of, AnyAnalysis};
use kempe::case::Case;
use kempe::model::{build, Model};
use kempe::{Flow, Options, Stabilization, SteppedRun};
use std::sync::Arc;

/// A run between two steps.
pub struct Running {
    run: SteppedRun<Arc<Model>>,
    model: Arc<Model>,
    outputs: Vec<Measure>,
    /// Whether accelerations near singular positions are those of runs with projection.
    passing: bool,
    /// The setting of the last reading, and its model.
    active: Option<(Setting, Prepared<Arc<Model>>)>,
}

/// The message of a failure with its advice.
fn told(outcome: Outcome) -> String {
    match outcome.hint {
        Some(hint) => format!("{}; {hint}", outcome.message),
        None => outcome.message,
    }
}

fn failed(failure: Box<Failure>) -> String {
    told(Outcome::from(failure.reason))
}

impl Running {
    /// Assembles the mechanism, runs the analyses before the own one, and begins.
    pub fn begin(
        exported: &Exported,
        chosen: &[(usize, f64)],
        tolerance: Option<f64>,
    ) -> Result<Self, String> {
        let case = exported.with(chosen);
        let model = build(&case.definition, &[]).map_err(|found| told(Outcome::from(found)))?;
        let model = Arc::new(model);
        let prepared = Arc::new(Prepared::new(Arc::clone(&model)));
        let (mut options, start) = start(&case, exported.analysis, &prepared).map_err(told)?;
        if let Some(tolerance) = tolerance {
            options.method.control_mut().rtol = tolerance;
        }
        let outputs = &exported.interface.outputs;
        let measure = |text: &String| Measure::read(&model, text).map_err(|it| it.to_string());
        let outputs =
            outputs.iter().map(|output| measure(&output.formula)).collect::<Result<_, _>>()?;
        let passing = matches!(options.stabilization, Stabilization::Projection(_));
        let run = SteppedRun::new(prepared, &start.state, &options).map_err(failed)?;
        Ok(Self { run, model, outputs, passing, active: None })
    }

    /// The time, s.
    pub fn t(&self) -> f64 {
        self.run.t()
    }

    /// The event that has stopped the run.
    pub fn stopped_by(&self) -> Option<&str> {
        self.run.stopped_by()
    }

    /// Doubts about the accuracy of the last step.
    pub fn doubts(&self) -> &[String] {
        &self.run.last_part().doubts
    }

    /// The value of a parameter at present.
    pub fn parameter(&self, name: &str) -> f64 {
        let changed = self.run.setting().parameters.iter().find(|(known, _)| known == name);
        let place = || self.model.blueprint.parameters.iter().position(|known| known == name);
        changed.map_or_else(|| place().map_or(f64::NAN, |k| self.model.parameters[k]), |(_, x)| *x)
    }

    /// Gives parameters other values.
    pub fn change(&mut self, parameters: Vec<(String, f64)>) -> Result<(), String> {
        let named: Vec<String> =
            parameters.iter().map(|(name, x)| format!("{name} = {x}")).collect();
        let outcome = self.run.change(Change { parameters, state: None });
        outcome.map_err(|failure| format!("{}: {}", named.join(", "), failed(failure)))
    }

    /// Advances by a duration, or to the event that stops the run.
    pub fn advance(&mut self, duration: f64) -> Result<(), String> {
        self.run.advance(duration, |_| Flow::Continue, None).map_err(failed).map(|_| ())
    }

    /// The values of all outputs.
    pub fn outputs(&mut self) -> Result<Vec<f64>, String> {
        if self.active.as_ref().is_none_or(|(setting, _)| setting != self.run.setting()) {
            let setting = self.run.setting().clone();
            let own = setting.model(&self.model).map_err(|found| told(Outcome::from(found)))?;
            self.active = Some((setting, Prepared::new(Arc::new(own))));
        }
        let (_, active) = self.active.as_ref().expect("it was made");
        let state = self.run.state();
        at_pause(active, (&state, self.run.works()), &self.outputs, self.passing).map_err(failed)
    }

    /// The present state.
    pub fn save(&self) -> SavedRun {
        self.run.save()
    }

    /// Continues from a saved state. One that was read from bytes lacks its tables.
    pub fn restore(&mut self, saved: &SavedRun, was_read: bool) -> Result<(), String> {
        match was_read {
            true => self.run.adopt(saved.clone()).map_err(failed),
            false => {
                self.run.restore(saved);
                Ok(())
            }
        }
    }
}

/// The options of an analysis, and the state in which it starts.
fn start(
    case: &Case,
    place: usize,
    prepared: &Prepared<Arc<Model>>,
) -> Result<(Options, StartState), Outcome> {
    let subject = Subject { definition: &case.definition, prepared };
    let path = ["analyses".to_string(), case.analyses[place].name.clone()];
    let read = AnyAnalysis::read(subject.model(), &case.fields(place), &path)?;
    let AnyAnalysis::Dynamics(options) = read else {
        unreachable!("an FMU is exported with an analysis of type dynamics")
    };
    let start = match start_of(&case.analyses, place) {
        None => case.assembled(subject.model(), &|| false)?,
        Some(before) => {
            let mut look = |_| Flow::Continue;
            let earlier = case.run_to(before, &subject, Observer::new(&mut look));
            earlier.map_err(|failed| failed.outcome)?.end
        }
    };
    let options = with_start(&options, &start.released, &[]).unwrap_or(options);
    Ok((options, start))
}
