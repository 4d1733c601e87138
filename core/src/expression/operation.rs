//! The operations of the language on any [`Real`].
//!
//! NaN is never lost: a decision on NaN gives NaN. [`Real::select`] would take the last branch, so decisions use
//! [`by_sign`].

use super::motion_law::MotionLaw;
use crate::math::Real;

/// An operation on one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
    Abs,
    Sign,
    Step,
    Floor,
    Motion(MotionLaw),
}

/// An operation on two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Atan2,
    Min,
    Max,
    Hypot,
}

/// How the two sides of a condition are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Relation {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// The operation of a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Call {
    Unary(Unary),
    Binary(Binary),
    If,
    Step5,
}

/// A function of the language, for reference pages and completion.
#[derive(Debug)]
pub struct Function {
    /// Its name, a reserved word.
    pub name: &'static str,
    /// The names of its arguments, in order.
    pub arguments: &'static [&'static str],
    /// Description in one line.
    pub doc: &'static str,
    pub(super) call: Call,
}

const fn one(name: &'static str, operation: Unary, doc: &'static str) -> Function {
    Function { name, arguments: &["x"], doc, call: Call::Unary(operation) }
}

const fn rise(name: &'static str, law: MotionLaw, doc: &'static str) -> Function {
    Function { name, arguments: &["s"], doc, call: Call::Unary(Unary::Motion(law)) }
}

const fn two(
    name: &'static str,
    arguments: &'static [&'static str],
    operation: Binary,
    doc: &'static str,
) -> Function {
    Function { name, arguments, doc, call: Call::Binary(operation) }
}

/// Every function of the language.
pub const FUNCTIONS: &[Function] = &[
    one("sin", Unary::Sin, "sine, x in rad"),
    one("cos", Unary::Cos, "cosine, x in rad"),
    one("tan", Unary::Tan, "tangent, x in rad"),
    one("asin", Unary::Asin, "inverse sine in [-π/2, π/2], |x| ≤ 1"),
    one("acos", Unary::Acos, "inverse cosine in [0, π], |x| ≤ 1"),
    one("atan", Unary::Atan, "inverse tangent in (-π/2, π/2)"),
    two("atan2", &["y", "x"], Binary::Atan2, "angle of the vector (x, y) in (-π, π]"),
    one("sinh", Unary::Sinh, "hyperbolic sine"),
    one("cosh", Unary::Cosh, "hyperbolic cosine"),
    one("tanh", Unary::Tanh, "hyperbolic tangent"),
    one("exp", Unary::Exp, "e to the power x"),
    one("ln", Unary::Ln, "natural logarithm, x > 0"),
    one("log10", Unary::Log10, "decimal logarithm, x > 0"),
    one("sqrt", Unary::Sqrt, "square root, x ≥ 0"),
    one("abs", Unary::Abs, "absolute value; its derivative at 0 is taken as 0"),
    two("min", &["a", "b"], Binary::Min, "the smaller; the mean of both derivatives at a tie"),
    two("max", &["a", "b"], Binary::Max, "the larger; the mean of both derivatives at a tie"),
    one("sign", Unary::Sign, "-1, 0 or 1"),
    one("step", Unary::Step, "0 for x < 0, 1 for x ≥ 0"),
    one("floor", Unary::Floor, "the largest integer not above x"),
    two("hypot", &["a", "b"], Binary::Hypot, "sqrt(a^2 + b^2)"),
    Function {
        name: "if",
        arguments: &["condition", "a", "b"],
        doc: "a where the condition (<, <=, > or >=) holds, else b",
        call: Call::If,
    },
    rise(
        "cycloidal",
        MotionLaw::Cycloidal,
        "0 → 1 for s in [0, 1], constant outside: s - sin(2πs)/(2π)",
    ),
    rise(
        "harmonic",
        MotionLaw::Harmonic,
        "0 → 1 for s in [0, 1], constant outside: (1 - cos πs)/2",
    ),
    rise(
        "poly345",
        MotionLaw::Poly345,
        "0 → 1 for s in [0, 1], constant outside: 10 s³ - 15 s⁴ + 6 s⁵",
    ),
    rise(
        "poly4567",
        MotionLaw::Poly4567,
        "0 → 1 for s in [0, 1], constant outside: 35 s⁴ - 84 s⁵ + 70 s⁶ - 20 s⁷",
    ),
    rise(
        "modified_sine",
        MotionLaw::ModifiedSine,
        "0 → 1 for s in [0, 1], constant outside: modified sine",
    ),
    rise(
        "modified_trapezoid",
        MotionLaw::ModifiedTrapezoid,
        "0 → 1 for s in [0, 1], constant outside: modified trapezoidal acceleration",
    ),
    Function {
        name: "step5",
        arguments: &["t", "t0", "y0", "t1", "y1"],
        doc: "y0 before t0, y1 after t1, between them y0 + (y1 - y0) poly345((t - t0)/(t1 - t0))",
        call: Call::Step5,
    },
];

/// One of three values, selected by the sign of `d`, lane by lane; NaN where `d` is NaN.
fn by_sign<S: Real>(d: S, positive: S, negative: S, zero: S) -> S {
    // this value is used only where d is 0 or NaN; floor(d) is then 0 or NaN, and has no derivative
    S::select(d, positive, S::select(-d, negative, zero + d.floor()))
}

fn larger<S: Real>(a: S, b: S) -> S {
    let half = S::constant(0.5);
    // by_sign is not used, because the larger of two equal infinities is that infinity although a - b is NaN
    S::select(a - b, a, S::select(b - a, b, half * a + half * b))
}

impl Unary {
    /// The value of the operation.
    pub fn apply<S: Real>(self, x: S) -> S {
        match self {
            Self::Negate => -x,
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log10 => x.ln() / S::constant(std::f64::consts::LN_10),
            Self::Sqrt => x.sqrt(),
            Self::Abs => larger(x, -x),
            Self::Sign => by_sign(x, S::one(), -S::one(), S::zero()),
            Self::Step => by_sign(x, S::one(), S::zero(), S::one()),
            Self::Floor => x.floor(),
            Self::Motion(law) => law.apply(x),
        }
    }
}

impl Binary {
    /// The value of the operation.
    pub fn apply<S: Real>(self, a: S, b: S) -> S {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => a.pow(b),
            Self::Atan2 => a.atan2(b),
            Self::Min => -larger(-a, -b),
            Self::Max => larger(a, b),
            Self::Hypot => (a * a + b * b).sqrt(),
        }
    }

    /// The mark of an operator; empty for a function.
    pub fn mark(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
            Self::Atan2 | Self::Min | Self::Max | Self::Hypot => "",
        }
    }
}

impl Relation {
    /// `a` where the difference of the two sides (left - right) satisfies the relation, otherwise `b`.
    pub fn choose<S: Real>(self, difference: S, a: S, b: S) -> S {
        match self {
            Self::Less => by_sign(difference, b, a, b),
            Self::LessOrEqual => by_sign(difference, b, a, a),
            Self::Greater => by_sign(difference, a, b, b),
            Self::GreaterOrEqual => by_sign(difference, a, b, a),
        }
    }

    /// The written form.
    pub fn mark(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
        }
    }
}

impl Call {
    /// The function of that name.
    pub fn named(name: &str) -> Option<&'static Function> {
        FUNCTIONS.iter().find(|f| f.name == name)
    }

    /// The name of the function that performs this operation.
    pub fn name(self) -> &'static str {
        FUNCTIONS.iter().find(|f| f.call == self).map_or("", |f| f.name)
    }
}
