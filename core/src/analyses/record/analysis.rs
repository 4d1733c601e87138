//! The trait of analyses.

use super::numbers::NumberList;
use super::outcome::{ErrorClass, Outcome};
use super::result::{NamedNumber, Record, RunResult};
use super::start_state::StartState;
use crate::analyses::dynamics::{Act, Prepared};
use crate::analyses::meshing::meshed;
use crate::analyses::options::Declared;
use crate::analyses::State;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{build, Definition, Model, Problem, Value};
use std::sync::Arc;

/// An analysis: its options, which the macro `options!` declares, and its computation.
pub trait Analysis: Declared {
    /// The numbers of its result that sweeps read. Results that are motions have none: their quantities are numbers.
    const NUMBERS: &'static [NamedNumber] = &[];
    /// Whether its result is a motion.
    const MOTION: bool = false;

    /// The time at which an analysis ends that begins at `begin`, where both are known.
    ///
    /// # Errors
    /// The faults that follow from the time of the start, with their paths in the analysis.
    fn ends(&self, _: &Model, begin: Option<f64>) -> Result<Option<f64>, Vec<Problem>> {
        Ok(begin)
    }

    /// Whether it changes parameters, so that its start may not meet the constraints.
    fn changes_parameters(&self) -> bool {
        false
    }

    /// A number of its result, or numbers along a path, that is not in [`NUMBERS`](Self::NUMBERS): a quantity at rest.
    ///
    /// # Errors
    /// There is none of this name, or it has no value.
    fn quantity(&self, _: &Subject<'_>, _: &Record, name: &str) -> Result<NumberList, Outcome> {
        Err(Outcome::new(ErrorClass::Model, format!("there is no number '{name}'")))
    }

    /// Checks whether the analysis can begin. Without checks of its own, it runs until it first calls an observer.
    ///
    /// # Errors
    /// The obstacle.
    fn begins(&self, subject: &Subject<'_>, start: &StartState) -> Result<(), Outcome> {
        let mut look = |_| Flow::Stop;
        self.run(subject, start, Observer::new(&mut look))
            .map_or_else(|it| Err(it.outcome), |_| Ok(()))
    }

    /// Runs the analysis.
    ///
    /// # Errors
    /// [`Unfinished`](super::Unfinished), with the record so far if there is one.
    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult;
}

/// The mechanism that an analysis examines.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// Its definition, in which an analysis may drive another quantity.
    pub definition: &'a Definition,
    /// Its model, prepared for runs.
    pub prepared: &'a Prepared<Arc<Model>>,
}

impl<'a> Subject<'a> {
    /// The model, with all drivers.
    pub fn model(&self) -> &'a Arc<Model> {
        self.prepared.model()
    }

    /// The mechanism with the phases of meshed wheels at a start, if they differ.
    pub fn meshed(&self, start: &StartState) -> Option<Prepared<Arc<Model>>> {
        let State { t, q, .. } = &start.state;
        meshed(self.model(), *t, q).map(|model| Prepared::new(Arc::new(model)))
    }

    /// The model without the drivers that were released before a start.
    pub fn released(&self, start: &StartState) -> Arc<Model> {
        match start.released.is_empty() {
            true => Arc::clone(self.model()),
            false => Arc::new(self.model().without(&start.released)),
        }
    }

    /// The definition without the drivers that were released before a start.
    pub fn acting(&self, start: &StartState) -> Definition {
        let mut definition = self.definition.clone();
        definition.drivers.retain(|driver| !start.released.contains(&driver.name));
        definition
    }

    /// The model of a changed definition, with the same parameters.
    ///
    /// # Errors
    /// The faults of the definition.
    pub fn rebuilt(&self, definition: &Definition) -> Result<Arc<Model>, Vec<Problem>> {
        let model = self.model();
        let values = model.parameters.iter().map(|x| Value::Number(*x));
        let values: Vec<_> = model.blueprint.parameters.iter().cloned().zip(values).list();
        let built = build(definition, &values)?.with_formulas_of(model);
        let built = if model.allow_redundancy { built.allowing_redundancy() } else { built };
        Ok(Arc::new(built.with_phases(model.blueprint.phases.clone())))
    }
}

/// Who watches an analysis.
pub struct Observer<'a> {
    /// Called with the time or value that was reached, or with the number of steps. It may stop the analysis.
    pub look: &'a mut dyn FnMut(f64) -> Flow,
    /// Whether the analysis is to stop. It is asked where `look` is not called.
    pub stop: &'a dyn Fn() -> bool,
    /// Acts at events of forward dynamics.
    pub acting: Option<EventActions<'a>>,
}

/// Acts at events of forward dynamics.
pub struct EventActions<'a> {
    /// The names of the events.
    pub events: &'a [String],
    /// Called at each of them.
    pub act: Act<'a>,
}

impl<'a> Observer<'a> {
    /// An observer without actions. `stop` is not needed if `look` stops the analysis.
    pub fn new(look: &'a mut dyn FnMut(f64) -> Flow) -> Self {
        Self { look, stop: &|| false, acting: None }
    }

    /// The same observer for a part of the analysis.
    pub fn again(&mut self) -> Observer<'_> {
        let acting =
            self.acting.as_mut().map(|EventActions { events, act }| EventActions { events, act });
        Observer { look: self.look, stop: self.stop, acting }
    }
}
