//! Values of quantities by name at the states of a run.
//!
//! The names are those of conditions and measures, such as `crank.B.vx` or `C.force`. A run has phases, with released
//! drivers and modes of forces. Each state is evaluated with the model of its phase.

use super::dynamics::{Failure, Prepared, Run, Setting, States};
use super::measures::Measure;
use super::signal_names::{names, signal};
use super::signal_rows::{each, Rows};
use super::signal_units::unit_of;
use super::signals::{Energy, Signal};
use super::State;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{did_you_mean, Model, Problem, WORKS};
use std::borrow::Cow;
use std::sync::Arc;

/// A quantity that can be evaluated at states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Readable {
    /// Its name, such as `crank.angle`.
    pub name: String,
    /// Its SI unit, such as `rad`; `1` for a number.
    pub unit: String,
}

/// All quantities of a model except those that need the interpolants of a run: the dissipated energy of one element,
/// and the balances.
pub fn readable(model: &Model) -> Vec<Readable> {
    let known = names(model, "").into_iter().filter_map(|name| Some((signal(model, &name)?, name)));
    let readable = known.filter(|(signal, _)| !needs_interpolants(signal));
    readable.map(|(signal, name)| Readable { unit: unit_of(model, &name, &signal), name }).list()
}

/// The quantity with this name.
///
/// # Errors
/// The model has no such quantity, or the quantity needs the interpolants of a run.
pub fn find(model: &Model, name: &str) -> Result<Readable, Problem> {
    match signal(model, name) {
        Some(signal) if needs_interpolants(&signal) => {
            let message = format!("'{name}' cannot be read here");
            Err(Problem::new(message).hint("it is a result of kempe.run"))
        }
        Some(signal) => {
            Ok(Readable { name: name.to_string(), unit: unit_of(model, name, &signal) })
        }
        None => {
            let known = names(model, name);
            let problem = Problem::new(format!("there is no quantity '{name}'"));
            let known: Vec<&str> = known.iter().map(String::as_str).list();
            let near = did_you_mean(name, &known, "quantities");
            let any = || known.first().map(|name| format!("write the name of one, such as {name}"));
            Err(problem.maybe_hint(near.or_else(any)))
        }
    }
}

/// The values of quantities at all reported states, one row per quantity. NaN where accelerations or reactions are
/// not unique.
pub fn of_run(model: &Model, run: &Run, names: &[&str]) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = names.iter().map(|_| Vec::new()).list();
    let plain = Setting::default();
    for phase in 0..run.phases.len() {
        let setting = run.settings.get(phase).unwrap_or(&plain);
        let (states, first) = (run.states_of(phase), run.phases[phase]);
        let works = &run.trajectory.works[WORKS * first..WORKS * (first + states.t.len())];
        let active = setting.model(model).unwrap_or_else(|_| model.clone());
        let rows = of_states(&active, (states, works), names, run.passing);
        found.iter_mut().zip(rows).for_each(|(all, own)| all.extend(own));
    }
    found
}

/// The values of an expression of quantities at all reported states. NaN where one of its quantities is NaN.
pub fn measure_of_run(model: &Model, run: &Run, measure: &Measure) -> Vec<f64> {
    let names: Vec<&str> = measure.quantities.iter().map(String::as_str).list();
    let (rows, t) = (of_run(model, run, &names), &run.trajectory.t);
    let plain = Setting::default();
    let mut found = Vec::with_capacity(t.len());
    for phase in 0..run.phases.len() {
        let setting = run.settings.get(phase).unwrap_or(&plain);
        let active = setting.open(model).unwrap_or(Cow::Borrowed(model));
        let first = run.phases[phase];
        for k in first..first + run.states_of(phase).t.len() {
            let quantities: Vec<f64> = rows.iter().map(|row| row[k]).list();
            found.push(measure.value(&active, t[k], &quantities));
        }
    }
    found
}

/// The values of measures at a pause of a run: `active` is the model of its setting, `works` those up to its state.
///
/// # Errors
/// Accelerations or reactions that a measure needs are not unique.
pub fn at_pause(
    active: &Prepared<Arc<Model>>,
    (state, works): (&State, &[f64]),
    measures: &[Measure],
    passing: bool,
) -> Result<Vec<f64>, Box<Failure>> {
    let (model, State { t, q, v, z }) = (active.model(), state);
    let states = States { t: &[*t], q, v, z };
    let own: Vec<Measure> = measures.iter().map(|measure| measure.in_phase(model)).list();
    let solves = own.iter().any(|measure| measure.needs_solution(model));
    let solved = solves.then(|| active.accelerations(states, passing, |_| Flow::Continue));
    let solved = solved.transpose()?;
    let solved = solved.as_ref().map(|solved| [&solved.a[..], &solved.lam]);
    let value = |of: &Measure| of.values_with(model, (states, works), solved)[0];
    Ok(own.iter().map(value).list())
}

/// The values at a single state, without a run.
pub fn of_state(model: &Model, state: &State, names: &[&str]) -> Vec<f64> {
    let State { t, q, v, z } = state;
    let states = States { t: &[*t], q, v, z };
    let rows = of_states(model, (states, &[0.0; WORKS]), names, true);
    rows.into_iter().map(|row| row[0]).list()
}

fn of_states(
    model: &Model,
    (states, works): (States<'_>, &[f64]),
    names: &[&str],
    passing: bool,
) -> Vec<Vec<f64>> {
    // a released driver has zero effort
    let signals: Vec<Signal> =
        names.iter().map(|name| signal(model, name).unwrap_or(Signal::Constant(0.0))).list();
    let solves = signals.iter().any(|signal| signal.needs_solution(model));
    let solved = solves
        .then(|| Prepared::new(model).accelerations(states, passing, |_| Flow::Continue).ok())
        .flatten();
    let solved = solved.as_ref().map(|solved| [&solved.a[..], &solved.lam]);
    let mut found: Vec<Vec<f64>> = names.iter().map(|_| Vec::new()).list();
    each(model, Rows { states, works, solved }, &signals, |_, values| {
        found.iter_mut().zip(values).for_each(|(row, value)| row.push(*value));
    });
    found
}

fn needs_interpolants(signal: &Signal) -> bool {
    let balance = matches!(signal, Signal::Energy(Energy::Balance) | Signal::Balance);
    balance || matches!(signal, Signal::ForceDissipated(_))
}
