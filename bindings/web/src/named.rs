//! Expressions that a page can plot: quantities, the measures of the case and transmission angles by name, and other
//! expressions of quantities.

use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::dynamics::Run;
use kempe::analyses::measures::{Measure, UNKNOWN_UNIT};
use kempe::analyses::readings::{self, Readable};
use kempe::analyses::transmission::{transmission_angle, transmitting};
use kempe::model::Value;
use kempe::Model;

/// An expression with a name, and its unit if it cannot be inferred from the expression.
struct Expression {
    name: String,
    text: String,
    unit: Option<&'static str>,
}

/// The measures of the case, and the transmission angles of its mechanism.
fn expressions(loaded: &Loaded) -> Vec<Expression> {
    let measures = loaded.case.definition.measures.iter().filter_map(|(name, value)| match value {
        Value::Text(text) => {
            Some(Expression { name: name.clone(), text: text.clone(), unit: None })
        }
        _ => None,
    });
    let model = &loaded.model;
    let angles = transmitting(model).into_iter().filter_map(|joint| {
        let name = format!("transmission angle at {}", model.constraints[joint].name);
        Some(Expression { name, text: transmission_angle(model, joint)?, unit: Some("rad") })
    });
    measures.chain(angles).collect()
}

/// All quantities and expressions of a model that can be plotted by name. The model may be that of a run, without the
/// drivers that a quantity replaces.
pub fn all(loaded: &Loaded, model: &Model) -> Vec<Readable> {
    let mut found = readings::readable(model);
    found.extend(expressions(loaded).into_iter().filter_map(|one| {
        let unit = read(model, &one).ok()?.unit;
        Some(Readable { name: one.name, unit })
    }));
    found
}

/// A quantity or expression that is plotted.
pub struct Plotted {
    name: String,
    /// None for a quantity, which is evaluated by its name.
    measure: Option<Measure>,
    /// Its SI unit. Empty if it is not known.
    unit: String,
}

/// The quantity or expression for a name or a text in the model of a run.
pub fn find(loaded: &Loaded, model: &Model, name: &str) -> Result<Plotted, Fault> {
    let own = expressions(loaded).into_iter().find(|one| one.name == name);
    if let Some(own) = own {
        return read(model, &own);
    }
    let dotted = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    if name.contains('.') && name.chars().all(dotted) && name.parse::<f64>().is_err() {
        let Readable { name, unit } = readings::find(model, name).map_err(Fault::of_problem)?;
        return Ok(Plotted { name, measure: None, unit });
    }
    let text = name.to_string();
    read(model, &Expression { name: text.clone(), text, unit: None })
}

fn read(model: &Model, one: &Expression) -> Result<Plotted, Fault> {
    let measure = Measure::read(model, &one.text).map_err(Fault::of_problem)?;
    for name in &measure.quantities {
        readings::find(model, name).map_err(Fault::of_problem)?;
    }
    let unit = one.unit.unwrap_or(match measure.unit.as_str() {
        UNKNOWN_UNIT => "",
        unit => unit,
    });
    Ok(Plotted { unit: unit.to_string(), name: one.name.clone(), measure: Some(measure) })
}

/// The units, and the values at all outputs of a run, one row for each item.
pub fn values(model: &Model, run: &Run, all: &[Plotted]) -> (Vec<String>, Vec<f64>) {
    let quantities = all.iter().filter(|one| one.measure.is_none());
    let quantities: Vec<&str> = quantities.map(|one| one.name.as_str()).collect();
    let mut rows = readings::of_run(model, run, &quantities).into_iter();
    let row = |one: &Plotted| match &one.measure {
        Some(measure) => readings::measure_of_run(model, run, measure),
        None => rows.next().unwrap_or_default(),
    };
    let rows: Vec<Vec<f64>> = all.iter().map(row).collect();
    (all.iter().map(|one| one.unit.clone()).collect(), rows.concat())
}
