//! Tables of a definition: their fields as data, and their functions.

use super::definition::{Definition, Entry, Value};
use super::problem::Problem;
use crate::elements::{self, Default, Field, Shape};
use crate::expression::{Outside, Points, Table};
use crate::math::{Interpolation, Listed};
use std::sync::Arc;

/// The fields of a table, for the reader of files, the schema and the reference page.
pub fn table_fields() -> elements::Table {
    let field = |name, shape, doc| Field::optional(name, shape, "", Default::Absent, doc);
    let interpolations = &["linear", "cubic", "quintic", "monotone"];
    let outsides = &["refuse", "hold", "linear"];
    elements::Table {
        name: "table",
        doc: "A function through given points, which formulas call by its name: lift(x). A table has x and y, or a \
              file."
            .to_string(),
        fields: vec![
            field("x", Shape::Numbers, "Places, increasing."),
            field("y", Shape::Numbers, "Values, one for each x."),
            field(
                "file",
                Shape::Name,
                "A CSV file with the points, in place of x and y; relative to the case.",
            ),
            field(
                "columns",
                Shape::Columns,
                "Names of the columns of x and y in the file; the first two if absent.",
            ),
            field("x_unit", Shape::Name, "Unit of x, such as \"deg\"; SI and rad if absent."),
            field("y_unit", Shape::Name, "Unit of y, such as \"mm\"; SI and rad if absent."),
            field(
                "interpolation",
                Shape::Word(interpolations),
                "\"cubic\" if absent. \"linear\" has jumps of the slope; \"cubic\" is C², with second derivative 0 at \
                 the ends; \"quintic\" is C⁴, with third and fourth derivative 0 at the ends; \"monotone\" is C¹ and \
                 does not overshoot (PCHIP).",
            ),
            Field::optional(
                "periodic",
                Shape::Flag,
                "",
                Default::Flag(false),
                "Whether the table repeats itself; the last y is the first one, and the period is that of x.",
            ),
            field(
                "outside",
                Shape::Word(outsides),
                "\"refuse\" if absent: a run that reads the table outside its range fails. \"hold\" is the value at \
                 the end, \"linear\" the tangent there.",
            ),
        ],
    }
}

/// The functions of all tables; reports their faults.
pub(super) fn read(definition: &Definition, problems: &mut Vec<Problem>) -> Vec<Arc<Table>> {
    let mut tables = Vec::with_capacity(definition.tables.len());
    for entry in &definition.tables {
        match table(entry) {
            Ok(table) => tables.push(Arc::new(table)),
            Err(problem) => {
                problems.push(problem);
                // so that formulas that call this table report no fault of their own
                tables.push(Arc::new(Table::one(&entry.name)));
            }
        }
    }
    tables
}

fn table(entry: &Entry) -> Result<Table, Problem> {
    let at = |path: &[&str], message: String| {
        let path = [&["tables", entry.name.as_str()], path].concat();
        Problem::at(&path, message)
    };
    let file = text(entry, "file");
    let (x, y) = match (numbers(entry, "x"), numbers(entry, "y")) {
        (Some(x), Some(y)) => (x, y),
        _ => return Err(match file {
            Some(file) => at(&["file"], format!("the points of '{file}' were not read")).hint(
                "write x and y in the case, or load the case in Python or from the command line",
            ),
            None => at(&[], "a table needs x and y, or a file".to_string()),
        }),
    };
    let periodic = entry.get("periodic") == Some(&Value::Flag(true));
    if periodic && entry.get("outside").is_some() {
        let message = "a periodic table has no outside".to_string();
        return Err(at(&["outside"], message).hint("remove outside, or periodic"));
    }
    let interpolation = text(entry, "interpolation").and_then(Interpolation::named);
    let outside = text(entry, "outside").and_then(Outside::named);
    let points = Points {
        x: &x,
        y: &y,
        x_unit: text(entry, "x_unit"),
        y_unit: text(entry, "y_unit"),
        interpolation: interpolation.unwrap_or(Interpolation::Cubic),
        periodic,
        outside: outside.unwrap_or(Outside::Refuse),
    };
    Table::new(&entry.name, &points).map_err(|fault| {
        let entry_of = fault.entry.map(|k| k.to_string());
        let path: Vec<&str> = std::iter::once(fault.field).chain(entry_of.as_deref()).list();
        let message = match (file, fault.entry) {
            (Some(file), Some(k)) => format!("{} (point {} of {file})", fault.message, k + 1),
            (Some(file), None) => format!("{} ({file})", fault.message),
            (None, _) => fault.message,
        };
        at(&path, message).maybe_hint(fault.hint)
    })
}

fn text<'e>(entry: &'e Entry, field: &str) -> Option<&'e str> {
    match entry.get(field) {
        Some(Value::Text(text)) => Some(text),
        _ => None,
    }
}

fn numbers(entry: &Entry, field: &str) -> Option<Vec<f64>> {
    let Some(Value::List(items)) = entry.get(field) else { return None };
    let number = |item: &Value| match item {
        Value::Number(x) => *x,
        _ => f64::NAN,
    };
    Some(items.iter().map(number).list())
}
