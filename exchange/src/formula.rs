//! Formulas of other tools: text → tree → text of kempe, or value.

use std::fmt::Write;

/// Deepest nesting of a formula.
const DEEPEST: usize = 100;

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Formula {
    Number(f64),
    /// A name without arguments.
    Name(String),
    /// A sign or an operator between two operands: `+ - * / ^`.
    Operation(char, Vec<Formula>),
    /// A function of kempe.
    Call(String, Vec<Formula>),
}

/// What names and functions mean in kempe.
pub(crate) trait Words {
    /// The meaning of a name without arguments.
    fn name(&self, name: &str) -> Option<Formula>;
    /// The meaning of a function.
    fn call(&self, name: &str, arguments: Vec<Formula>) -> Option<Formula>;
}

/// The functions that have one argument and the same meaning here and there, with their name in kempe.
const SAME: [(&str, &str); 17] = [
    ("sin", "sin"),
    ("cos", "cos"),
    ("tan", "tan"),
    ("asin", "asin"),
    ("arcsin", "asin"),
    ("acos", "acos"),
    ("arccos", "acos"),
    ("atan", "atan"),
    ("arctan", "atan"),
    ("sinh", "sinh"),
    ("cosh", "cosh"),
    ("tanh", "tanh"),
    ("exp", "exp"),
    ("ln", "ln"),
    ("log10", "log10"),
    ("sqrt", "sqrt"),
    ("abs", "abs"),
];

/// The function of kempe with the same meaning.
pub(crate) fn same(name: &str, arguments: &[Formula]) -> Option<Formula> {
    let (_, known) = SAME.iter().find(|(word, _)| word.eq_ignore_ascii_case(name))?;
    (arguments.len() == 1).then(|| Formula::Call(known.to_string(), arguments.to_vec()))
}

impl Formula {
    /// Reads a text. The error says what is wrong, for people.
    pub(crate) fn read(text: &str, words: &dyn Words) -> Result<Self, String> {
        let mut parser = Parser { rest: text, words, depth: 0 };
        let formula = parser.sum()?;
        parser.blank();
        match parser.rest.chars().next() {
            None => Ok(formula),
            Some(c) => Err(format!("'{c}' is not expected in a formula")),
        }
    }

    /// The value; `None` if it uses a name other than `t` and `pi`, or a function of several arguments.
    pub(crate) fn value(&self, t: f64) -> Option<f64> {
        Some(match self {
            Self::Number(x) => *x,
            Self::Name(name) if name == "t" => t,
            Self::Name(name) if name == "pi" => std::f64::consts::PI,
            Self::Name(_) => return None,
            Self::Operation(sign, of) => {
                let values: Option<Vec<f64>> = of.iter().map(|part| part.value(t)).collect();
                match (sign, &values?[..]) {
                    ('-', [a]) => -a,
                    ('+', [a, b]) => a + b,
                    ('-', [a, b]) => a - b,
                    ('*', [a, b]) => a * b,
                    ('/', [a, b]) => a / b,
                    ('^', [a, b]) => a.powf(*b),
                    _ => return None,
                }
            }
            Self::Call(name, of) => {
                let [a] = &of[..] else { return None };
                let a = a.value(t)?;
                match name.as_str() {
                    "sin" => a.sin(),
                    "cos" => a.cos(),
                    "tan" => a.tan(),
                    "asin" => a.asin(),
                    "acos" => a.acos(),
                    "atan" => a.atan(),
                    "sinh" => a.sinh(),
                    "cosh" => a.cosh(),
                    "tanh" => a.tanh(),
                    "exp" => a.exp(),
                    "ln" => a.ln(),
                    "log10" => a.log10(),
                    "sqrt" => a.sqrt(),
                    "abs" => a.abs(),
                    _ => return None,
                }
            }
        })
    }

    /// The text in kempe's notation.
    pub(crate) fn text(&self) -> String {
        let mut out = String::new();
        self.print(&mut out);
        out
    }

    fn print(&self, out: &mut String) {
        match self {
            Self::Number(x) if *x < 0.0 => write!(out, "({x})").expect("a text grows"),
            Self::Number(x) => write!(out, "{x}").expect("a text grows"),
            Self::Name(name) => out.push_str(name),
            Self::Operation(sign, of) => {
                let (first, second) = (of.first(), of.get(1));
                if let (Some(only), None) = (first, second) {
                    out.push_str("(-");
                    only.print_within(out, *sign, true);
                    return out.push(')');
                }
                for (k, part) in of.iter().enumerate() {
                    if k > 0 {
                        out.push_str(&if "+-".contains(*sign) {
                            format!(" {sign} ")
                        } else {
                            sign.to_string()
                        });
                    }
                    part.print_within(out, *sign, k > 0);
                }
            }
            Self::Call(name, of) => {
                out.push_str(name);
                out.push('(');
                for (k, part) in of.iter().enumerate() {
                    out.push_str(if k > 0 { ", " } else { "" });
                    part.print(out);
                }
                out.push(')');
            }
        }
    }

    /// Prints an operand, in parentheses if it binds less than its operator.
    fn print_within(&self, out: &mut String, outer: char, second: bool) {
        let weaker = match self {
            Self::Operation(inner, of) if of.len() == 2 => {
                let (inner, outer) = (strength(*inner), strength(outer));
                inner < outer || inner == outer && (second || inner == 3)
            }
            _ => false,
        };
        if weaker {
            out.push('(');
        }
        self.print(out);
        if weaker {
            out.push(')');
        }
    }
}

const fn strength(operator: char) -> u8 {
    match operator {
        '+' | '-' => 1,
        '*' | '/' => 2,
        _ => 3,
    }
}

struct Parser<'a> {
    rest: &'a str,
    words: &'a dyn Words,
    depth: usize,
}

impl Parser<'_> {
    /// Skips blanks, written line ends `<n>` and comments in quotation marks.
    fn blank(&mut self) {
        loop {
            self.rest = self.rest.trim_start();
            if let Some(rest) = self.rest.strip_prefix("<n>") {
                self.rest = rest;
            } else if let Some((_, rest)) =
                self.rest.strip_prefix('"').and_then(|rest| rest.split_once('"'))
            {
                self.rest = rest;
            } else {
                return;
            }
        }
    }

    fn takes(&mut self, sign: char) -> bool {
        self.blank();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Result<Formula, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("the formula is nested more than {DEEPEST} deep"));
        }
        let mut left = self.term()?;
        while let Some(sign) = ['+', '-'].into_iter().find(|sign| self.takes(*sign)) {
            left = Formula::Operation(sign, vec![left, self.term()?]);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn term(&mut self) -> Result<Formula, String> {
        let mut left = self.signed()?;
        loop {
            self.blank();
            if self.rest.starts_with("**") {
                return Ok(left);
            }
            let Some(sign) = ['*', '/'].into_iter().find(|sign| self.takes(*sign)) else {
                return Ok(left);
            };
            left = Formula::Operation(sign, vec![left, self.signed()?]);
        }
    }

    fn signed(&mut self) -> Result<Formula, String> {
        let mut negative = false;
        loop {
            if self.takes('-') {
                negative = !negative;
            } else if !self.takes('+') {
                break;
            }
        }
        let power = self.power()?;
        Ok(if negative { Formula::Operation('-', vec![power]) } else { power })
    }

    fn power(&mut self) -> Result<Formula, String> {
        let base = self.factor()?;
        self.blank();
        let Some(rest) = self.rest.strip_prefix("**").or_else(|| self.rest.strip_prefix('^'))
        else {
            return Ok(base);
        };
        self.rest = rest;
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("the formula is nested more than {DEEPEST} deep"));
        }
        let exponent = self.signed()?;
        self.depth -= 1;
        Ok(Formula::Operation('^', vec![base, exponent]))
    }

    fn factor(&mut self) -> Result<Formula, String> {
        if self.takes('(') {
            let inside = self.sum()?;
            return if self.takes(')') { Ok(inside) } else { Err("a ')' is missing".into()) };
        }
        match self.rest.chars().next() {
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.word(),
            Some(c) => Err(format!("'{c}' is not expected in a formula")),
            None => Err("the formula ends too early".into()),
        }
    }

    /// A number; `d` marks its precision or its exponent: `45.0d`, `1.0d3`.
    fn number(&mut self) -> Result<Formula, String> {
        let digits = |text: &str| text.bytes().take_while(|b| b.is_ascii_digit()).count();
        let mut length = digits(self.rest);
        if self.rest[length..].starts_with('.') {
            length += 1 + digits(&self.rest[length + 1..]);
        }
        let mut text = self.rest[..length].to_string();
        if self.rest[length..].starts_with(['e', 'E', 'd', 'D']) {
            let after = &self.rest[length + 1..];
            let sign = usize::from(after.starts_with(['+', '-']));
            let exponent = digits(&after[sign..]);
            if exponent > 0 {
                text += &format!("e{}", &after[..sign + exponent]);
                length += 1 + sign + exponent;
            } else if self.rest[length..].starts_with(['d', 'D']) {
                length += 1;
            }
        }
        self.rest = &self.rest[length..];
        let number = text.parse::<f64>().ok().filter(|x| x.is_finite());
        number.map(Formula::Number).ok_or_else(|| format!("'{text}' is not a number"))
    }

    fn word(&mut self) -> Result<Formula, String> {
        let rest =
            self.rest.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_' || c == '.');
        let name = &self.rest[..self.rest.len() - rest.len()];
        self.rest = rest;
        if !self.takes('(') {
            return self
                .words
                .name(name)
                .ok_or_else(|| format!("the name '{name}' has no meaning in kempe"));
        }
        let mut arguments = Vec::new();
        while !self.takes(')') {
            if !arguments.is_empty() && !self.takes(',') {
                return Err("a ')' is missing".into());
            }
            arguments.push(self.sum()?);
        }
        let count = arguments.len();
        let found = self.words.call(name, arguments);
        found.ok_or_else(|| {
            format!("the function {name} with {count} arguments has no equal in kempe")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Time;

    impl Words for Time {
        fn name(&self, name: &str) -> Option<Formula> {
            let known = match name {
                "time" => "t",
                "pi" => "pi",
                _ => return None,
            };
            Some(Formula::Name(known.into()))
        }

        fn call(&self, name: &str, arguments: Vec<Formula>) -> Option<Formula> {
            same(name, &arguments)
        }
    }

    fn same_value(text: &str, expected: f64) {
        let formula = Formula::read(text, &Time).unwrap_or_else(|e| panic!("{text}: {e}"));
        let value = formula.value(0.25).unwrap();
        assert!((value - expected).abs() < 1e-12 * expected.abs().max(1.0), "{text}: {value}");
        let again =
            Formula::read(&formula.text().replace("t", "time").replace("satimen", "arctan"), &Time);
        if let Ok(again) = again {
            assert!(
                (again.value(0.25).unwrap() - expected).abs() < 1e-12 * expected.abs().max(1.0),
                "{}",
                formula.text()
            );
        }
    }

    #[test]
    fn formulas_keep_their_value() {
        same_value(
            "(45.0d + 45.0d*sin((360.0d*time - 90.0d)*pi/180.0d))*pi/180.0d",
            std::f64::consts::FRAC_PI_4,
        );
        same_value("2 - (3 - time)", -0.75);
        same_value("-2^2", -4.0);
        same_value("2**3**2", 512.0);
        same_value("(2^3)^2", 64.0);
        same_value("8/(4/2)/2", 2.0);
        same_value("1.5d2 + 1e-1", 150.1);
        same_value("\"a comment\"<n>1 - -time*-2", 0.5);
        same_value("2*-(1 + time)", -2.5);
        same_value("(-2)^2", 4.0);
    }

    #[test]
    fn what_has_no_meaning_is_named() {
        for (text, part) in [
            ("2*x", "'x'"),
            ("spline(time)", "spline"),
            ("2 +", "early"),
            ("(1", "')'"),
            ("1 $", "'$'"),
        ] {
            let error = Formula::read(text, &Time).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(Formula::read(&"(".repeat(100_000), &Time).unwrap_err().contains("nested"));
        assert!(Formula::read(&format!("1{}", "^2".repeat(100_000)), &Time)
            .unwrap_err()
            .contains("nested"));
    }
}
