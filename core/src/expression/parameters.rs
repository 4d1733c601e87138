//! Parameters that refer to other parameters, and the order in which they can be evaluated.

use super::{
    is_identifier, is_reserved, Expression, ExpressionError, FormulaValues, Inferred, Names,
    Symbol, Table, Tape, FUNCTIONS,
};
use crate::math::{Listed, Ordered, Real};
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

/// A fault of the definition of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterError {
    /// Index of the parameter in the list.
    pub parameter: usize,
    /// Its name.
    pub name: String,
    /// Description of the fault. The span refers to the text of the expression, and covers the whole text if the name
    /// is at fault.
    pub error: ExpressionError,
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "parameter '{}': {}", self.name, self.error)
    }
}

impl std::error::Error for ParameterError {}

/// Compiled definitions of parameters, in an order in which they can be evaluated.
#[derive(Clone, Debug)]
pub struct Parameters {
    tapes: Vec<Tape>,
    order: Vec<usize>,
    inferred: Vec<Inferred>,
}

impl Parameters {
    /// Compiles definitions, each a name and an expression in the other parameters, which may call tables.
    ///
    /// # Errors
    /// A name that is reserved, not an identifier, the name of a table, or used twice; an expression that does not
    /// compile (the time and the state have no meaning here); circular definitions; a sum of different dimensions.
    pub fn compile<N: AsRef<str>>(
        definitions: &[(N, Expression)],
        tables: &[Arc<Table>],
    ) -> Result<Self, ParameterError> {
        let names = index(definitions, tables)?;
        let mut tapes = Vec::with_capacity(definitions.len());
        for (k, (_, expression)) in definitions.iter().enumerate() {
            let tape = expression.compile(&names).map_err(|error| at(definitions, k, error))?;
            tapes.push(tape);
        }
        let order = order(&tapes).map_err(|circle| circular(definitions, &circle))?;
        let mut inferred = vec![Inferred::Open; definitions.len()];
        for &k in &order {
            let of = |symbol| match symbol {
                Symbol::Parameter(other) => inferred[other],
                Symbol::Time | Symbol::Variable(_) => Inferred::Open,
            };
            let own = definitions[k].1.infer(&names, &of);
            inferred[k] = match own.map_err(|error| at(definitions, k, error))? {
                Inferred::Number => Inferred::Open, // a plain number is in the SI unit of its place
                own => own,
            };
        }
        Ok(Self { tapes, order, inferred })
    }

    /// The dimensions of the parameters, in the order of the definitions.
    pub fn inferred(&self) -> &[Inferred] {
        &self.inferred
    }

    /// The values of all parameters, in the order of the definitions.
    ///
    /// A value of `given(k)` replaces definition `k`, also in the definitions that refer to it. This is used for
    /// sweeps and design derivatives. Domain errors yield NaN.
    pub fn evaluate<S: Real>(&self, given: impl Fn(usize) -> Option<S>) -> Vec<S> {
        let mut values = vec![S::zero(); self.tapes.len()];
        for &k in &self.order {
            let scope = FormulaValues { parameters: &values, time: S::zero(), variables: &[] };
            values[k] = given(k).unwrap_or_else(|| self.tapes[k].evaluate(&scope));
        }
        values
    }
}

/// The names of the definitions.
struct Index<'a>(HashMap<&'a str, usize>, &'a [Arc<Table>]);

impl Names for Index<'_> {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        self.0.get(name).copied().map(Symbol::Parameter)
    }
    fn known(&self) -> Vec<String> {
        let mut known: Vec<_> = self.0.iter().map(|(name, k)| (*k, name.to_string())).list();
        known.order_by_key(|(k, _)| *k);
        known.into_iter().map(|(_, name)| name).list()
    }
    fn tables(&self) -> &[Arc<Table>] {
        self.1
    }
}

fn at<N: AsRef<str>>(
    definitions: &[(N, Expression)],
    parameter: usize,
    error: ExpressionError,
) -> ParameterError {
    ParameterError { parameter, name: definitions[parameter].0.as_ref().to_string(), error }
}

fn index<'a, N: AsRef<str>>(
    definitions: &'a [(N, Expression)],
    tables: &'a [Arc<Table>],
) -> Result<Index<'a>, ParameterError> {
    let mut names = HashMap::with_capacity(definitions.len());
    for (k, (name, expression)) in definitions.iter().enumerate() {
        let name = name.as_ref();
        let message = if !is_identifier(name) {
            "a parameter's name must be letters, digits and '_', and not begin with a digit"
        } else if FUNCTIONS.iter().any(|function| function.name == name) {
            "this name is reserved: it is a function of formulas; rename the parameter"
        } else if is_reserved(name) {
            "this name is reserved"
        } else if tables.iter().any(|table| table.name() == name) {
            "this is the name of a table; rename one of them"
        } else if names.insert(name, k).is_some() {
            "this parameter is defined twice"
        } else {
            continue;
        };
        let span = 0..expression.text().len();
        return Err(at(definitions, k, ExpressionError::new(span, message)));
    }
    Ok(Index(names, tables))
}

/// Depth-first order. For circular definitions, the error contains the indices along the cycle, without repeating the
/// first.
fn order(tapes: &[Tape]) -> Result<Vec<usize>, Vec<usize>> {
    #[derive(Clone, Copy, PartialEq)]
    enum Visit {
        New,
        Open,
        Done,
    }
    let needs: Vec<Vec<usize>> = tapes.iter().map(|tape| tape.parameters().list()).list();
    let mut marks = vec![Visit::New; tapes.len()];
    let mut order = Vec::with_capacity(tapes.len());
    for root in 0..tapes.len() {
        // the open parameters, each with the number of its dependencies that were visited; no recursion is used,
        // because a chain may be as long as the list
        let mut path = if marks[root] == Visit::New { vec![(root, 0)] } else { Vec::new() };
        while let Some((k, looked_at)) = path.last_mut() {
            marks[*k] = Visit::Open;
            match needs[*k].get(*looked_at) {
                None => {
                    marks[*k] = Visit::Done;
                    order.push(*k);
                    path.pop();
                }
                Some(&next) => {
                    *looked_at += 1;
                    match marks[next] {
                        Visit::Done => {}
                        Visit::New => path.push((next, 0)),
                        Visit::Open => {
                            let circle = path.iter().map(|(k, _)| *k);
                            return Err(circle.skip_while(|k| *k != next).list());
                        }
                    }
                }
            }
        }
    }
    Ok(order)
}

fn circular<N: AsRef<str>>(definitions: &[(N, Expression)], circle: &[usize]) -> ParameterError {
    let names: Vec<&str> =
        circle.iter().chain(&circle[..1]).map(|k| definitions[*k].0.as_ref()).list();
    let message = match names.len() {
        2 => format!("the parameter refers to itself: {}", names.join(" → ")),
        _ => format!("parameters refer to each other in a circle: {}", names.join(" → ")),
    };
    let span = 0..definitions[circle[0]].1.text().len();
    at(definitions, circle[0], ExpressionError::new(span, message))
}
