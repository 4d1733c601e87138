//! Quantities and efforts of a record of equilibria: what sweeps read in addition to its numbers.

use super::options::Options;
use crate::analyses::dynamics::{friction_modes, States};
use crate::analyses::measures::Measure;
use crate::analyses::record::{ErrorClass, NumberList, Outcome, Record, Subject};
use crate::math::{Listed, ShortArray};
use crate::model::Value as Entry;
use serde_json::Value;
use std::sync::Arc;

/// The beginning of the name of the force or torque of a holder or driver, such as `effort.crank.angle`.
pub(super) const EFFORT: &str = "effort.";

/// The points of a record.
pub(super) fn points(record: &Record) -> &[Value] {
    record.findings["points"].as_array().map_or(&[], Vec::as_slice)
}

/// Whether a record is a path over a parameter.
pub(super) fn is_path(record: &Record) -> bool {
    !record.findings["values"].is_null()
}

/// A finding that is a list of numbers.
pub(super) fn numbers(finding: &Value) -> Vec<f64> {
    finding.as_array().into_iter().flatten().filter_map(Value::as_f64).list()
}

/// The effort of a holder, or of a driver, at a point.
pub(super) fn effort(point: &Value, hold: &[String], name: &str) -> Value {
    if let Some(place) = hold.iter().position(|held| held == name) {
        return point["holders"][place].clone();
    }
    let mut drivers = point["efforts"].as_array().into_iter().flatten();
    drivers.find(|pair| pair[0] == name).map_or(Value::Null, |pair| pair[1].clone())
}

/// The values of a measure, or of an expression of quantities, at the points of a record.
pub(super) fn at_rest(
    options: &Options,
    subject: &Subject<'_>,
    record: &Record,
    name: &str,
) -> Result<NumberList, Outcome> {
    let declared = subject.definition.measures.iter().find(|(known, _)| known == name);
    let text = match declared {
        Some((_, Entry::Text(text))) => text,
        _ => name,
    };
    let (model, t) = (subject.released(&record.end), record.end.state.t);
    let over = options.over.iter().zip(std::iter::once(numbers(&record.findings["values"])));
    let over: Vec<Vec<(String, f64)>> =
        over.flat_map(|(name, values)| values.into_iter().map(|x| vec![(name.clone(), x)])).list();
    let value = |(k, point): (usize, &Value)| -> Result<f64, Outcome> {
        let own =
            over.get(k).map(|changes| model.with_values(changes).map(Arc::new)).transpose()?;
        let own = own.as_ref().unwrap_or(&model);
        let [q, z, mut lam] = ["q", "z", "lam"].each(|part| numbers(&point[part]));
        let rest = vec![0.0; q.len()];
        let modes = friction_modes(own, [&[t], &q, &rest, &z]).unwrap_or_default();
        let decided = modes.first().filter(|modes| !modes.is_empty());
        let decided = decided.map(|modes| Arc::new(own.in_modes(modes)));
        let measure = Measure::read(own, text).map_err(|problem| vec![problem])?;
        let own = decided.as_ref().unwrap_or(own);
        // the multipliers of friction at rest follow those of the model; statics has none
        lam.resize(own.layout.n_rows, 0.0);
        let states = States { t: &[t], q: &q, v: &rest, z: &z };
        let found = measure.in_phase(own).values(own, states, Some([&rest, &lam]))[0];
        let message = || format!("{text}: {found} at {t} s; the measure has no value there");
        found.is_finite().then_some(found).ok_or_else(|| Outcome::new(ErrorClass::Model, message()))
    };
    let values = points(record).iter().enumerate().map(value).collect::<Result<Vec<_>, _>>()?;
    Ok(NumberList::list(values))
}
