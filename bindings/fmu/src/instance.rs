//! An instance of an FMU: its states, and its variables. Nothing here depends on C or on the version of the standard.

use crate::exported::Exported;
use crate::running::Running;
use crate::snapshot::Snapshot;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The states of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Before initialization.
    Instantiated,
    /// Between the start and the end of initialization.
    Initialization,
    /// Steps are possible.
    Step,
    /// After the end.
    Terminated,
}

/// How a step ended.
#[derive(Debug, PartialEq)]
pub struct Stepped {
    /// The event that has stopped the run before the end of the step.
    pub stopped_by: Option<String>,
    /// New doubts about the accuracy.
    pub doubts: Vec<String>,
}

/// An instance.
pub struct Instance {
    exported: Exported,
    phase: Phase,
    /// The values of parameters with which the mechanism is assembled, by their places.
    chosen: Vec<(usize, f64)>,
    /// Inputs that the next step or reading will have. Together they may meet constraints that one alone violates.
    pending: Vec<(usize, f64)>,
    tolerance: Option<f64>,
    /// The time at which the host starts, s.
    begin: Option<f64>,
    run: Option<Running>,
    /// The values of the outputs at present.
    outputs: Option<Vec<f64>>,
    doubted: bool,
}

/// Puts a value at a place.
fn put(values: &mut Vec<(usize, f64)>, place: usize, value: f64) {
    match values.iter_mut().find(|(known, _)| *known == place) {
        Some((_, old)) => *old = value,
        None => values.push((place, value)),
    }
}

impl Instance {
    /// An instance of the FMU with this token and this folder of resources.
    pub fn new(token: &str, folder: &Path) -> Result<Self, String> {
        let exported = Exported::read(folder)?;
        if exported.interface.token != token {
            return Err(format!("the token {token} is not that of the resources of this FMU"));
        }
        Ok(Self::of(exported))
    }

    /// An instance of this content.
    pub fn of(exported: Exported) -> Self {
        Self {
            exported,
            phase: Phase::Instantiated,
            chosen: Vec::new(),
            pending: Vec::new(),
            tolerance: None,
            begin: None,
            run: None,
            outputs: None,
            doubted: false,
        }
    }

    fn need(&self, phase: Phase, what: &str) -> Result<(), String> {
        match self.phase == phase {
            true => Ok(()),
            false => Err(format!("{what} is not allowed in the state {:?}", self.phase)),
        }
    }

    /// Notes the tolerance and the time at which the host starts.
    pub fn set_up(&mut self, tolerance: Option<f64>, start: f64) -> Result<(), String> {
        self.need(Phase::Instantiated, "a set-up")?;
        if tolerance.is_some_and(|given| !(given > 0.0 && given < 1.0)) {
            return Err(format!("tolerance {}; must be between 0 and 1", tolerance.unwrap_or(0.0)));
        }
        (self.tolerance, self.begin) = (tolerance, Some(start));
        (self.run, self.outputs) = (None, None);
        Ok(())
    }

    /// Begins initialization.
    pub fn enter_initialization(&mut self) -> Result<(), String> {
        self.need(Phase::Instantiated, "initialization")?;
        self.phase = Phase::Initialization;
        Ok(())
    }

    /// Ends initialization; the mechanism is assembled with the values that were set.
    pub fn exit_initialization(&mut self) -> Result<(), String> {
        self.need(Phase::Initialization, "the end of initialization")?;
        self.running()?;
        self.phase = Phase::Step;
        Ok(())
    }

    /// Ends the simulation.
    pub fn terminate(&mut self) -> Result<(), String> {
        self.need(Phase::Step, "the end of the simulation")?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    /// Returns to the state after the creation.
    pub fn reset(&mut self) {
        self.phase = Phase::Instantiated;
        (self.chosen, self.pending) = (Vec::new(), Vec::new());
        (self.run, self.outputs, self.doubted) = (None, None, false);
        (self.tolerance, self.begin) = (None, None);
    }

    /// The run with all values that were set.
    fn running(&mut self) -> Result<&mut Running, String> {
        if self.run.is_none() {
            let run = Running::begin(&self.exported, &self.chosen, self.tolerance)?;
            if let Some(begin) = self.begin.filter(|begin| *begin != run.t()) {
                return Err(format!("start time {begin} s; the analysis starts at {} s", run.t()));
            }
            self.run = Some(run);
        }
        let run = self.run.as_mut().expect("it was made");
        if !self.pending.is_empty() {
            let name = |place: usize| self.exported.interface.parameters[place].name.clone();
            let new = self.pending.iter().map(|(place, value)| (name(*place), *value));
            let new: Vec<_> = new.filter(|(name, value)| run.parameter(name) != *value).collect();
            // after a refusal, the run has its former inputs
            self.pending.clear();
            if !new.is_empty() {
                self.outputs = None;
                run.change(new)?;
            }
        }
        Ok(run)
    }

    /// Advances from a time by a duration, s.
    pub fn step(&mut self, at: f64, duration: f64) -> Result<Stepped, String> {
        self.need(Phase::Step, "a step")?;
        let run = self.running()?;
        let t = run.t();
        // not the exact time: hosts sum the durations of their steps
        let off = (at - t).abs();
        if off.is_nan() || off > 1e-9 * t.abs() + 1e-6 * duration.abs() {
            return Err(format!("a step from {at} s; the instance is at {t} s"));
        }
        run.advance(duration)?;
        let stopped_by = run.stopped_by().map(str::to_string);
        let doubts = run.doubts().to_vec();
        self.outputs = None;
        let new = !doubts.is_empty() && !self.doubted;
        self.doubted |= new;
        Ok(Stepped { stopped_by, doubts: if new { doubts } else { Vec::new() } })
    }

    /// The time, s.
    pub fn t(&mut self) -> Result<f64, String> {
        Ok(self.running()?.t())
    }

    /// Whether an event has stopped the run.
    pub fn is_stopped(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.stopped_by().is_some())
    }

    /// The value of a variable: the time, an output, or a parameter.
    pub fn get(&mut self, reference: u32) -> Result<f64, String> {
        let (place, count) = (reference as usize, self.exported.interface.outputs.len());
        if place == 0 {
            return self.t();
        }
        if place > count {
            return self.parameter(place - count - 1);
        }
        self.running()?;
        if self.outputs.is_none() {
            self.outputs = Some(self.running()?.outputs()?);
        }
        let value = self.outputs.as_ref().map_or(f64::NAN, |all| all[place - 1]);
        match value.is_finite() {
            true => Ok(value),
            false => {
                let t = self.t()?;
                let name = &self.exported.interface.outputs[place - 1].name;
                Err(format!("{name} has no value at {t} s: it is not unique there"))
            }
        }
    }

    fn parameter(&mut self, place: usize) -> Result<f64, String> {
        let Some(of) = self.exported.interface.parameters.get(place) else {
            return Err(unknown());
        };
        let name = of.name.clone();
        if self.run.is_none() && self.phase == Phase::Instantiated && self.chosen.is_empty() {
            return Ok(self.exported.defaults[place]);
        }
        Ok(self.running()?.parameter(&name))
    }

    /// Sets a parameter: an input, or any parameter before the end of initialization.
    pub fn set(&mut self, reference: u32, value: f64) -> Result<(), String> {
        let before = self.exported.interface.outputs.len() + 1;
        let Some(place) = (reference as usize).checked_sub(before) else {
            return Err("the time and outputs cannot be set".to_string());
        };
        let of = self.exported.interface.parameters.get(place).ok_or_else(unknown)?;
        if !value.is_finite() {
            return Err(format!("{} = {value}; must be finite", of.name));
        }
        match self.phase {
            Phase::Terminated => Err(format!("{}: the simulation has ended", of.name)),
            Phase::Step if of.input => {
                put(&mut self.pending, place, value);
                Ok(())
            }
            Phase::Step => Err(format!(
                "{} is fixed during the simulation; export it as an input to change it",
                of.name
            )),
            _ => {
                self.choose(place, value);
                Ok(())
            }
        }
    }

    /// Chooses a value for the assembly. The value of the case is left out: it may be a formula of other parameters.
    fn choose(&mut self, place: usize, value: f64) {
        let default = self.exported.defaults[place];
        let known = self.chosen.iter().position(|(of, _)| *of == place);
        match known {
            Some(k) if value == default => {
                self.chosen.remove(k);
            }
            None if value == default => return,
            _ => put(&mut self.chosen, place, value),
        }
        (self.run, self.outputs) = (None, None);
    }

    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            token: self.exported.interface.token.clone(),
            phase: self.phase,
            chosen: self.chosen.clone(),
            pending: self.pending.clone(),
            tolerance: self.tolerance,
            doubted: self.doubted,
            run: self.run.as_ref().map(Running::save),
            was_read: false,
        }
    }

    /// Continues from a state of this FMU. After an error, the instance is where it was.
    pub fn restore(&mut self, of: &Snapshot) -> Result<(), String> {
        let places = of.chosen.iter().chain(&of.pending).map(|(place, _)| *place);
        let known = self.exported.interface.parameters.len();
        if of.token != self.exported.interface.token || places.into_iter().any(|k| k >= known) {
            return Err("the state is that of another FMU".to_string());
        }
        let same = of.chosen == self.chosen && of.tolerance == self.tolerance;
        let mut run = if same { self.run.take() } else { None };
        let outcome = self.continued(&mut run, of);
        if outcome.is_err() {
            self.run = self.run.take().or(run);
            return outcome;
        }
        (self.run, self.outputs, self.phase) = (run, None, of.phase);
        (self.chosen, self.pending) = (of.chosen.clone(), of.pending.clone());
        (self.tolerance, self.doubted) = (of.tolerance, of.doubted);
        Ok(())
    }

    fn continued(&self, run: &mut Option<Running>, of: &Snapshot) -> Result<(), String> {
        let Some(saved) = &of.run else {
            *run = None;
            return Ok(());
        };
        if run.is_none() {
            *run = Some(Running::begin(&self.exported, &of.chosen, of.tolerance)?);
        }
        run.as_mut().map_or(Ok(()), |run| run.restore(saved, of.was_read))
    }
}

fn unknown() -> String {
    "there is no variable with this value reference".to_string()
}
