//! Formulas of the columns of a sweep, such as `C.force.max + 0.1*motor.effort.rms`.

use crate::convert::refuse;
use crate::errors::{raise_plain, Kind};
use crate::guard::guard;
use kempe::expression::unit::Unit;
use kempe::expression::{Expression, ExpressionError, FormulaValues, Inferred, Names, Symbol};
use kempe::math::Dual;
use pyo3::prelude::*;
use std::cell::RefCell;

/// A value with the derivative by one name.
type Slope = Dual<3>;

/// Accepts every name but the time, and notes it.
#[derive(Default)]
struct Noted(RefCell<Vec<String>>);

impl Names for Noted {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        let mut known = self.0.borrow_mut();
        let place = known.iter().position(|one| one == name).unwrap_or_else(|| {
            known.push(name.to_string());
            known.len() - 1
        });
        (name != "t").then_some(Symbol::Parameter(place))
    }
    fn known(&self) -> Vec<String> {
        self.0.borrow().clone()
    }
}

fn raised(py: Python<'_>, error: ExpressionError) -> PyErr {
    raise_plain(py, Kind::Model, &[error.into()])
}

/// The names that a formula uses, each once.
#[pyfunction]
#[pyo3(signature = (text))]
pub fn formula_names(py: Python<'_>, text: &str) -> PyResult<Vec<String>> {
    guard("formula_names", || {
        let names = Noted::default();
        let read = Expression::parse(text).and_then(|formula| formula.compile(&names));
        read.map_err(|error| raised(py, error))?;
        Ok(names.0.take())
    })
}

/// The SI unit of a formula whose names have these units; empty if it is not known.
#[pyfunction]
#[pyo3(signature = (text, names, units))]
pub fn formula_unit(
    py: Python<'_>,
    text: &str,
    names: Vec<String>,
    units: Vec<String>,
) -> PyResult<String> {
    guard("formula_unit", || {
        let formula = Expression::parse(text).map_err(|error| raised(py, error))?;
        let of = |symbol: Symbol| match symbol {
            Symbol::Parameter(k) => match units.get(k).map(String::as_str) {
                Some("1") => Inferred::Number,
                Some(unit) => {
                    Unit::parse(unit).map_or(Inferred::Open, |u| Inferred::Of(u.dimension))
                }
                None => Inferred::Open,
            },
            _ => Inferred::Open,
        };
        let found = formula.infer(&names[..], &of).map_err(|error| raised(py, error))?;
        Ok(found.unit().unwrap_or_default())
    })
}

/// The value of a formula, and its derivatives by its names.
#[pyfunction]
#[pyo3(signature = (text, names, values))]
pub fn formula_value(
    py: Python<'_>,
    text: &str,
    names: Vec<String>,
    values: Vec<f64>,
) -> PyResult<(f64, Vec<f64>)> {
    guard("formula_value", || {
        if names.len() != values.len() {
            return Err(refuse(py, "values", "they do not fit the names".to_string()));
        }
        let read = Expression::parse(text).and_then(|formula| formula.compile(&names[..]));
        let tape = read.map_err(|error| raised(py, error))?;
        let of = |varied: Option<usize>| {
            let constant = |x: &f64| Slope { value: *x, slope: [0.0; 3] };
            let mut given: Vec<Slope> = values.iter().map(constant).collect();
            if let Some(k) = varied {
                given[k].slope[0] = 1.0;
            }
            let time = constant(&0.0);
            tape.evaluate(&FormulaValues { parameters: &given, time, variables: &[] })
        };
        let slopes = (0..values.len()).map(|k| of(Some(k)).slope[0]).collect();
        Ok((of(None).value, slopes))
    })
}
