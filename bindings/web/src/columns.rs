//! Columns of sweeps, such as `C.force.max`: their values for other parameters, and their slopes.

use crate::convert::Fields;
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::dynamics::Prepared;
use kempe::analyses::readings;
use kempe::analyses::record::{StartState, Subject};
use kempe::analyses::slopes::{Gradient, Remark};
use kempe::analyses::sweep::{Outcome, Statistic, Sweep, VariantRow, Wanted};
use kempe::analyses::{fields_of, is_motion, AnyAnalysis};
use kempe::model::{Entry, Value as Written};
use kempe::{build, Case, Model};
use serde_json::{json, Value};
use std::sync::Arc;

/// Statistics that are values of the time, or of the quantity of the motion.
const OF_TIME: [&str; 3] = ["t_max", "t_min", "settling"];

/// The sweep that reads columns of an analysis of the case, by default of the last one, and the model in which they are
/// read. `until` replaces the end of its motion.
pub fn sweep(
    loaded: &Loaded,
    columns: &[&str],
    analysis: Option<&str>,
    until: Option<&Written>,
) -> Result<(Sweep, Arc<Model>), Fault> {
    let case = &loaded.case;
    let place = match analysis {
        Some(name) => case.analyses.iter().position(|entry| entry.name == name),
        None => case.analyses.len().checked_sub(1),
    };
    let hint = "add an analysis, such as dynamics, in the properties of the mechanism";
    let place = place.ok_or_else(|| Fault::new("the case has no such analysis").hint(hint))?;
    let mut analyses: Vec<Entry> = case.analyses[..=place].to_vec();
    if let Some(end) = until {
        ending(&mut analyses[place], end)?;
    }
    // parameters of the page may differ from those of the text
    let model = build(&case.definition, &[]).map_err(|found| Fault::of_problems(&found))?;
    let model = Arc::new(model);
    let read = driven(loaded, &model, &analyses[place])?;
    let kind = match analyses[place].get("type") {
        Some(Written::Text(kind)) => kind.clone(),
        _ => String::new(),
    };
    let (mut measures, mut wanted) = (Vec::new(), Vec::new());
    for column in columns {
        if !is_motion(&kind) {
            wanted.push(Wanted::Number(column.to_string()));
            continue;
        }
        wanted.push(Wanted::Statistic(measures.len(), statistic(case, &read, column)?));
        measures.push(expression(case, column));
    }
    let sweep = Sweep {
        model,
        definition: Arc::new(case.definition.clone()),
        set: case.start.set.clone(),
        guess: case.start.guess.clone(),
        analyses,
        measures,
        wanted,
    };
    Ok((sweep, read))
}

/// The model of the motion of an analysis: where it runs over a quantity, this has the driver `over`.
fn driven(loaded: &Loaded, model: &Arc<Model>, analysis: &Entry) -> Result<Arc<Model>, Fault> {
    let Some(Written::Text(over)) = analysis.get("over") else { return Ok(Arc::clone(model)) };
    let prepared = Prepared::new(Arc::clone(model));
    let subject = Subject { definition: &loaded.case.definition, prepared: &prepared };
    let found = subject.driven_by(&StartState::new(loaded.state.clone()), over, false);
    found.map(|driven| driven.model).map_err(|found| Fault::of_problems(&found))
}

/// The statistic of a column of a motion, which must exist.
fn statistic(case: &Case, model: &Model, column: &str) -> Result<Statistic, Fault> {
    let measures = &case.definition.measures;
    let wrong = kempe::analyses::sweep::measure_fault(model, measures, column);
    if let Some(problem) = wrong {
        return Err(Fault::of_problem(problem));
    }
    let name = column.rsplit_once('.').map_or(column, |(_, statistic)| statistic);
    Statistic::named(name).ok_or_else(|| {
        let message = format!("the page does not compute '{name}'");
        Fault::new(message).hint("the command 'kempe' computes it")
    })
}

/// The expression of the measure or quantity of a column.
fn expression(case: &Case, column: &str) -> String {
    let name = column.rsplit_once('.').map_or("", |(name, _)| name);
    let own = case.definition.measures.iter().find(|(known, _)| known == name);
    match own {
        Some((_, Written::Text(text))) => text.clone(),
        _ => name.to_string(),
    }
}

/// Gives a motion another end.
fn ending(analysis: &mut Entry, end: &Written) -> Result<(), Fault> {
    let over = analysis.get("over").is_some();
    let key = if over { "range" } else { "t_end" };
    let value = match (over, analysis.get("range")) {
        (true, Some(Written::List(ends))) if ends.len() == 2 => {
            Written::List(vec![ends[0].clone(), end.clone()])
        }
        (true, _) => return Err(Fault::new("'at' needs a range with two ends")),
        _ => end.clone(),
    };
    match analysis.fields.iter_mut().find(|(known, _)| known == key) {
        Some((_, old)) => *old = value,
        None => analysis.fields.push((key.to_string(), value)),
    }
    Ok(())
}

/// The value of the column of a sweep with other values of parameters.
pub fn value(sweep: &Sweep, parameters: &[(String, f64)]) -> Result<f64, Fault> {
    let row: VariantRow = (parameters.to_vec(), Vec::new());
    let outcome = sweep.variants(&[row], &|| false).remove(0);
    match outcome {
        Outcome::Values(values) if values[0].is_finite() => Ok(values[0]),
        Outcome::Values(_) => Err(Fault::new("this number has no value")),
        other => Err(failed(other)),
    }
}

fn failed(outcome: Outcome) -> Fault {
    match outcome {
        Outcome::Failed(reason) => Fault::new(reason),
        _ => Fault::new("the page does not compute this number, because joints are redundant")
            .hint("set the free coordinates, or run the command 'kempe'"),
    }
}

/// The SI unit of a column of a motion of a model.
pub fn unit(case: &Case, model: &Model, column: &str) -> String {
    let statistic = column.rsplit_once('.').map_or(column, |(_, statistic)| statistic);
    if OF_TIME.contains(&statistic) {
        return "s".to_string();
    }
    let found = readings::find(model, &expression(case, column));
    let found = found.map(|found| found.unit);
    let found = found.unwrap_or_default();
    if statistic == "integral" {
        format!("{found}*s")
    } else {
        found
    }
}

/// Part of the value of a parameter by which it changes, to see which formulas of analyses contain it.
const CHANGE: f64 = 1e-6;
/// Why there is no slope by a parameter of a formula of an analysis.
const IN_ANALYSIS: &str = "an analysis depends on it, and such slopes are not available yet";
/// Changes of a variable for differences, as parts of its range.
const CHANGES: [f64; 2] = [1e-4, 1e-6];

/// Whether an analysis of a sweep depends on each parameter of a row, so that slopes by it are not those of all that it
/// changes.
fn in_analyses(sweep: &Sweep, row: &[(String, f64)]) -> Vec<bool> {
    let read = |row: &[(String, f64)]| {
        let model = sweep.model.with_values(row).ok()?;
        let one =
            |entry: &Entry| AnyAnalysis::read(&model, &fields_of(entry, &sweep.set), &[]).ok();
        sweep.analyses.iter().map(one).collect::<Option<Vec<_>>>()
    };
    let before = read(row);
    let changed = |k: usize| {
        let mut row = row.to_vec();
        row[k].1 += CHANGE * if row[k].1 == 0.0 { 1.0 } else { row[k].1 };
        read(&row) != before
    };
    (0..row.len()).map(changed).collect()
}

/// The slopes of the columns of a sweep by the parameters of a row.
pub fn gradient(sweep: &Sweep, row: &[(String, f64)]) -> Result<Gradient, Fault> {
    let mut found = sweep.gradient(&(row.to_vec(), Vec::new()), &|| false).map_err(failed)?;
    for (k, _) in in_analyses(sweep, row).iter().enumerate().filter(|(_, depends)| **depends) {
        for number in 0..found.values.len() {
            found.jacobian[number * row.len() + k] = f64::NAN;
            found.remarks.retain(|one| (one.number, one.variable) != (number, k));
            let text = IN_ANALYSIS.to_string();
            found.remarks.push(Remark { number, variable: k, text });
        }
    }
    Ok(found)
}

/// The values of the columns of a sweep, and their slopes by the parameters of a row; differences of runs where the core
/// has none. A parameter stays between its ends.
pub fn with_slopes(
    sweep: &Sweep,
    row: &[(String, f64)],
    ends: &[[f64; 2]],
) -> Result<(Vec<f64>, Vec<f64>), Fault> {
    let Gradient { values, mut jacobian, .. } = gradient(sweep, row)?;
    let n = row.len();
    for (k, [least, largest]) in ends.iter().enumerate() {
        for change in CHANGES {
            let none = |j: usize| jacobian[j * n + k].is_nan();
            if !(0..values.len()).any(none) {
                break;
            }
            let beside = |change: f64| {
                let mut row = row.to_vec();
                row[k].1 = (row[k].1 + change * (largest - least)).clamp(*least, *largest);
                match sweep.variants(&[(row.clone(), Vec::new())], &|| false).pop() {
                    Some(Outcome::Values(values)) => Some((row[k].1, values)),
                    _ => None,
                }
            };
            let here = || (row[k].1, values.clone());
            let (up, high) = beside(change).unwrap_or_else(here);
            let (down, low) = beside(-change).unwrap_or_else(here);
            for j in 0..values.len() {
                let slope = &mut jacobian[j * n + k];
                if slope.is_nan() {
                    *slope = (high[j] - low[j]) / (up - down);
                }
            }
        }
        if !values.is_empty() && (0..values.len()).all(|j| jacobian[j * n + k].is_nan()) {
            let name = &row[k].0;
            return Err(Fault::new(format!("{name} cannot be changed a little")));
        }
    }
    Ok((values, jacobian))
}

/// The slopes of a column by all parameters of the case: `{ value, unit, slopes: [{ name, slope, remark }] }`.
pub fn slopes(loaded: &Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
    let column = fields.text("measure")?;
    let analysis = fields.get("analysis").and_then(Value::as_str);
    let (sweep, model) = sweep(loaded, &[column], analysis, None)?;
    let names = sweep.model.blueprint.parameters.iter().cloned();
    let row: Vec<_> = names.zip(sweep.model.parameters.iter().copied()).collect();
    let Gradient { values, jacobian, remarks } = gradient(&sweep, &row)?;
    let told = row.iter().enumerate().map(|(k, (name, _))| {
        let remark = remarks.iter().find(|one| one.variable == k).map(|one| one.text.clone());
        json!({ "name": name, "slope": jacobian.get(k).filter(|x| x.is_finite()), "remark": remark })
    });
    let told: Vec<Value> = told.collect();
    Ok(
        json!({ "value": values.first(), "unit": unit(&loaded.case, &model, column), "slopes": told }),
    )
}
