//! The expression language against its definition.

mod errors;
mod functions;
mod hostile;
mod language;
mod motion_laws;
mod parameters;
mod tables;
mod trees;
mod units;

use kempe::expression::{Expression, ExpressionError, FormulaValues, Names, Symbol};

/// Parameters a b c d, the time, and the variables crank.x, crank.angle, crank.omega, my body.vx.
struct Model;

const PARAMETERS: [&str; 4] = ["a", "b", "c", "d"];
const VARIABLES: [&str; 4] = ["crank.x", "crank.angle", "crank.omega", "my body.vx"];

impl Names for Model {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        let find = |list: [&str; 4]| list.iter().position(|known| *known == name);
        match name {
            "t" => Some(Symbol::Time),
            _ => find(PARAMETERS)
                .map(Symbol::Parameter)
                .or_else(|| find(VARIABLES).map(Symbol::Variable)),
        }
    }
    fn known(&self) -> Vec<String> {
        PARAMETERS.iter().chain(&VARIABLES).chain(&["t"]).map(ToString::to_string).collect()
    }
}

/// a = 2, b = 3, c = -1.5, d = 0.25; t = 0.75; crank.x = 10, angle = 20, omega = 30; vx = 40.
const SCOPE: FormulaValues<f64> = FormulaValues {
    parameters: &[2.0, 3.0, -1.5, 0.25],
    time: 0.75,
    variables: &[10.0, 20.0, 30.0, 40.0],
};

fn value(text: &str) -> f64 {
    let expression = Expression::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let tape = expression.compile(&Model).unwrap_or_else(|error| panic!("{text}: {error}"));
    tape.evaluate(&SCOPE)
}

fn error(text: &str) -> ExpressionError {
    match Expression::parse(text).and_then(|expression| expression.compile(&Model)) {
        Ok(tape) => panic!("{text} was read as {tape:?}"),
        Err(error) => {
            assert!(text.get(error.span.clone()).is_some(), "{text}: span {:?}", error.span);
            error
        }
    }
}
