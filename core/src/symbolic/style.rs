//! The three forms in which expressions are printed.

use super::function::Function;
use super::name::Name;

/// A printed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The language of expressions, which kempe can read.
    Expression,
    /// Plain text with φ, dots and superscripts.
    Unicode,
    /// LaTeX with amsmath.
    Latex,
}

impl Form {
    pub(super) fn name(self, name: &Name) -> &str {
        match self {
            Self::Expression => &name.text,
            Self::Unicode => &name.unicode,
            Self::Latex => &name.latex,
        }
    }

    pub(super) fn pi(self) -> &'static str {
        ["pi", "π", "\\pi"][self as usize]
    }

    pub(super) fn times(self) -> &'static str {
        ["*", "·", " \\, "][self as usize]
    }

    pub(super) fn minus(self) -> &'static str {
        ["-", "−", "-"][self as usize]
    }

    pub(super) fn brackets(self, inside: &str) -> String {
        match self {
            Self::Latex => format!("\\left({inside}\\right)"),
            _ => format!("({inside})"),
        }
    }

    pub(super) fn quotient(self, top: &str, bottom: &str) -> String {
        match self {
            Self::Latex => format!("\\frac{{{top}}}{{{bottom}}}"),
            _ => format!("{top}/{bottom}"),
        }
    }

    pub(super) fn power(self, base: &str, exponent: &str) -> String {
        match self {
            Self::Expression => format!("{base}^{exponent}"),
            Self::Unicode => match superscript(exponent) {
                Some(raised) => format!("{base}{raised}"),
                None => format!("{base}^{exponent}"),
            },
            Self::Latex if base.contains('\'') => format!("{{{base}}}^{{{exponent}}}"),
            Self::Latex => format!("{base}^{{{exponent}}}"),
        }
    }

    pub(super) fn root(self, inside: &str) -> String {
        match self {
            Self::Expression => format!("sqrt({inside})"),
            Self::Unicode => format!("√({inside})"),
            Self::Latex => format!("\\sqrt{{{inside}}}"),
        }
    }

    pub(super) fn call(self, function: Function, arguments: &[String]) -> String {
        use Function::{Cos, Cosh, Exp, Ln, Max, Min, Sin, Sinh, Tan, Tanh};
        let (name, inside) = (function.name(), arguments.join(", "));
        match (self, function) {
            (Self::Latex, Function::Abs) => format!("\\left|{inside}\\right|"),
            (Self::Latex, Function::Floor) => format!("\\left\\lfloor {inside} \\right\\rfloor"),
            (Self::Latex, Sin | Cos | Tan | Sinh | Cosh | Tanh | Exp | Ln | Max | Min) => {
                let simple = !inside.contains([' ', '+', '-', '\\']) || is_symbol(&inside);
                match simple && arguments.len() == 1 {
                    true => format!("\\{name} {inside}"),
                    false => format!("\\{name}\\left({inside}\\right)"),
                }
            }
            (Self::Latex, _) => format!("\\mathrm{{{name}}}\\left({inside}\\right)"),
            _ => format!("{name}({inside})"),
        }
    }

    /// A derivative of a table, such as lift''(x).
    pub(super) fn table(self, name: &str, order: usize, inside: &str) -> String {
        let primes = "'".repeat(order);
        match self {
            Self::Latex => format!("{}{primes}\\left({inside}\\right)", super::upright(name)),
            _ => format!("{name}{primes}({inside})"),
        }
    }
}

/// Whether a LaTeX text is one symbol with an index.
fn is_symbol(text: &str) -> bool {
    !text.contains([' ', '+', '(']) && !text.contains("\\left") && !text.contains("\\frac")
}

fn superscript(exponent: &str) -> Option<String> {
    let raised = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent.chars().map(|sign| Some(raised[sign.to_digit(10)? as usize])).collect()
}
