//! Columns of sweeps, such as `C.force.max`: their values for other parameters, and their slopes.

use crate::convert::Fields;
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::is_motion;
use kempe::analyses::readings;
use kempe::analyses::slopes::Gradient;
use kempe::analyses::sweep::{Outcome, Statistic, Sweep, VariantRow, Wanted};
use kempe::build;
use kempe::model::{Entry, Value as Written};
use serde_json::{json, Value};
use std::sync::Arc;

/// Statistics that are values of the time, or of the quantity of the motion.
const OF_TIME: [&str; 3] = ["t_max", "t_min", "settling"];

/// The sweep that reads a column of an analysis of the case, by default of the last one. `until` replaces the end of its
/// motion.
pub fn sweep(
    loaded: &Loaded,
    column: &str,
    analysis: Option<&str>,
    until: Option<&Written>,
) -> Result<Sweep, Fault> {
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
    let kind = match analyses[place].get("type") {
        Some(Written::Text(kind)) => kind.clone(),
        _ => String::new(),
    };
    let (measures, wanted) = match is_motion(&kind) {
        false => (Vec::new(), Wanted::Number(column.to_string())),
        true => {
            let wrong =
                kempe::analyses::sweep::measure_fault(&model, &case.definition.measures, column);
            if let Some(problem) = wrong {
                return Err(Fault::of_problem(problem));
            }
            let (name, statistic) = column.rsplit_once('.').unwrap_or(("", column));
            let Some(statistic) = Statistic::named(statistic) else {
                let hint = "the command 'kempe' computes it";
                let message = format!("the page does not compute '{statistic}'");
                return Err(Fault::new(message).hint(hint));
            };
            let own = case.definition.measures.iter().find(|(known, _)| known == name);
            let expression = match own {
                Some((_, Written::Text(text))) => text.clone(),
                _ => name.to_string(),
            };
            (vec![expression], Wanted::Statistic(0, statistic))
        }
    };
    Ok(Sweep {
        model: Arc::new(model),
        definition: Arc::new(case.definition.clone()),
        set: case.start.set.clone(),
        guess: case.start.guess.clone(),
        analyses,
        measures,
        wanted: vec![wanted],
    })
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

/// The SI unit of a column of a motion.
pub fn unit(loaded: &Loaded, column: &str) -> String {
    let (name, statistic) = column.rsplit_once('.').unwrap_or(("", column));
    if OF_TIME.contains(&statistic) {
        return "s".to_string();
    }
    let own = loaded.case.definition.measures.iter().find(|(known, _)| known == name);
    let expression = match own {
        Some((_, Written::Text(text))) => text.clone(),
        _ => name.to_string(),
    };
    let found = readings::find(&loaded.model, &expression).map(|found| found.unit);
    let found = found.unwrap_or_default();
    if statistic == "integral" {
        format!("{found}*s")
    } else {
        found
    }
}

/// The slopes of a column by all parameters of the case: `{ value, unit, slopes: [{ name, slope, remark }] }`.
pub fn slopes(loaded: &Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
    let column = fields.text("measure")?;
    let analysis = fields.get("analysis").and_then(Value::as_str);
    let sweep = sweep(loaded, column, analysis, None)?;
    let names = sweep.model.blueprint.parameters.clone();
    let values = sweep.model.parameters.clone();
    let row = (names.iter().cloned().zip(values).collect(), Vec::new());
    let found = sweep.gradient(&row, &|| false).map_err(failed)?;
    let Gradient { values, jacobian, remarks } = found;
    let told = names.iter().enumerate().map(|(k, name)| {
        let remark = remarks.iter().find(|one| one.variable == k).map(|one| one.text.clone());
        json!({ "name": name, "slope": jacobian.get(k), "remark": remark })
    });
    let told: Vec<Value> = told.collect();
    Ok(json!({ "value": values.first(), "unit": unit(loaded, column), "slopes": told }))
}
