//! Random trees: their value by a direct evaluation (sine is that of the core, tested beside it), and print → parse → print.

use super::{value, Model, PARAMETERS, SCOPE, VARIABLES};
use kempe::expression::Expression;
use kempe::math::Real;

/// A small generator of pseudo-random numbers (Marsaglia 2003, xorshift64).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % bound
    }
}

/// A random expression, fully parenthesised or with random spaces, and its value.
fn tree(random: &mut Random, depth: usize) -> (String, f64) {
    if depth == 0 || random.below(6) == 0 {
        return leaf(random);
    }
    let (x, x_value) = tree(random, depth - 1);
    let (y, y_value) = tree(random, depth - 1);
    match random.below(10) {
        0 => (format!("({x}) + ({y})"), x_value + y_value),
        1 => (format!("({x})-({y})"), x_value - y_value),
        2 => (format!("({x}) *({y})"), x_value * y_value),
        3 => (format!("({x})/(2 + ({y})^2)"), x_value / (2.0 + y_value * y_value)),
        4 => (format!("-({x})"), -x_value),
        5 => (format!("({x})^2"), x_value * x_value),
        6 => (format!("sin({x})"), Real::sin(x_value)),
        7 => (format!("max({x} , {y})"), x_value.max(y_value)),
        8 => (format!("atan2({x},{y})"), x_value.atan2(y_value)),
        _ => {
            let chosen = if x_value < y_value { x_value } else { 0.5 };
            (format!("if({x} < {y}, {x}, .5)"), chosen)
        }
    }
}

fn leaf(random: &mut Random) -> (String, f64) {
    match random.below(4) {
        0 => {
            let x = random.below(1000) as f64 / 16.0;
            (format!("{x:?}"), x)
        }
        1 => ("t".to_string(), SCOPE.time),
        2 => {
            let k = random.below(4);
            (PARAMETERS[k].to_string(), SCOPE.parameters[k])
        }
        _ => {
            let k = random.below(3);
            (VARIABLES[k].to_string(), SCOPE.variables[k])
        }
    }
}

#[test]
fn random_trees_have_their_value_and_print_as_themselves() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut read = 0;
    while read < 2000 {
        let (text, expected) = tree(&mut random, 4);
        if text.len() > 4096 || !expected.is_finite() {
            continue;
        }
        read += 1;
        let found = value(&text);
        // the same operations in the same order: equal to the last bit (0 and -0 count as equal)
        assert!(found == expected, "{text} = {found}, expected {expected}");
        let expression = Expression::parse(&text).unwrap();
        let printed = expression.to_string();
        assert!(printed.len() <= text.len());
        let again = Expression::parse(&printed).unwrap();
        assert_eq!(again, expression, "{text} printed as {printed}");
        assert_eq!(again.to_string(), printed);
        assert_eq!(again.compile(&Model).unwrap().evaluate(&SCOPE), found);
    }
}
