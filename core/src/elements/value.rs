//! A value as written in a file, and the arguments of typed methods that are converted to values.

use crate::math::{Listed, ShortArray};
/// A value as written in a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A name or a formula.
    Text(String),
    /// true or false.
    Flag(bool),
    /// A list.
    List(Vec<Value>),
    /// Keys with values, in order.
    Table(Vec<(String, Value)>),
    /// A law that the calling program computes, by its index. Files cannot contain such a law.
    Function(usize),
}

impl Value {
    /// The kind of value, in the words of error messages.
    pub fn noun(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::Flag(_) => "true or false",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Function(_) => "a function",
        }
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_string())
    }
}
impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}
impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}
impl From<Numbers> for Value {
    fn from(numbers: Numbers) -> Self {
        Self::List(numbers.0.into_iter().map(Self::from).list())
    }
}
impl From<Number> for Value {
    fn from(number: Number) -> Self {
        number.0
    }
}
impl From<Terms> for Value {
    fn from(terms: Terms) -> Self {
        Self::Table(terms.0.into_iter().map(|(name, factor)| (name, factor.0)).list())
    }
}
impl From<Words> for Value {
    fn from(words: Words) -> Self {
        Self::List(words.0.into_iter().map(Self::Text).list())
    }
}
impl From<Pair> for Value {
    fn from(pair: Pair) -> Self {
        Self::List(pair.0.each(Self::from).into())
    }
}

/// A number, or the text of a formula such as `"m*L^2/12"` or of a quantity such as `"30 deg"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Number(Value);

impl From<f64> for Number {
    fn from(x: f64) -> Self {
        Self(Value::Number(x))
    }
}
impl From<i32> for Number {
    fn from(x: i32) -> Self {
        Self(Value::Number(f64::from(x)))
    }
}
impl From<&str> for Number {
    fn from(formula: &str) -> Self {
        Self(formula.into())
    }
}
impl From<String> for Number {
    fn from(formula: String) -> Self {
        Self(formula.into())
    }
}

/// Two numbers or formulas, as an array or as a tuple: `[0.0, 1.0]`, `("L/2", 0.0)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair([Number; 2]);

impl<N: Into<Number>> From<[N; 2]> for Pair {
    fn from(pair: [N; 2]) -> Self {
        Self(pair.each(Into::into))
    }
}
impl<X: Into<Number>, Y: Into<Number>> From<(X, Y)> for Pair {
    fn from((x, y): (X, Y)) -> Self {
        Self([x.into(), y.into()])
    }
}

/// A list of numbers or formulas: `["a + t", "2"]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(Vec<Number>);

impl<N: Into<Number>, const COUNT: usize> From<[N; COUNT]> for Numbers {
    fn from(numbers: [N; COUNT]) -> Self {
        Self(numbers.map(Into::into).into())
    }
}
impl<N: Into<Number>> From<Vec<N>> for Numbers {
    fn from(numbers: Vec<N>) -> Self {
        Self(numbers.into_iter().map(Into::into).list())
    }
}

/// Quantities with numbers or formulas: `[("A.angle", 2.0), ("B.angle", -1.0)]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms(Vec<(String, Number)>);

impl<Q: Into<String>, N: Into<Number>, const COUNT: usize> From<[(Q, N); COUNT]> for Terms {
    fn from(terms: [(Q, N); COUNT]) -> Self {
        Self(terms.map(|(name, factor)| (name.into(), factor.into())).into())
    }
}

/// A list of words: `["m", "rad"]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Words(Vec<String>);

impl<W: Into<String>, const COUNT: usize> From<[W; COUNT]> for Words {
    fn from(words: [W; COUNT]) -> Self {
        Self(words.map(Into::into).into())
    }
}
