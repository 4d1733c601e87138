//! Functions that remain in an expression.

/// Functions with their names in the language of expressions.
macro_rules! functions {
    ($($Function:ident $name:literal),+ $(,)?) => {
        /// A function of one or two expressions.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub(super) enum Function {
            $($Function),+
        }

        impl Function {
            /// The name in the language of expressions; a power is written as an operator.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Function => $name),+
                }
            }
        }
    };
}

functions! {
    Sin "sin", Cos "cos", Tan "tan", Asin "asin", Acos "acos", Atan "atan", Atan2 "atan2",
    Sinh "sinh", Cosh "cosh", Tanh "tanh", Exp "exp", Ln "ln", Floor "floor",
    Abs "abs", Sign "sign", Step "step", Max "max", Min "min", Power "^",
}

impl Function {
    /// The value for constant arguments. `None` if the function itself is easier to read.
    pub fn value(self, x: &[f64]) -> Option<f64> {
        use std::f64::consts::FRAC_PI_2;
        let quarters = x[0] / FRAC_PI_2;
        match self {
            Self::Sin | Self::Cos if quarters == quarters.round() && quarters.abs() < 1e6 => {
                let turn = quarters.rem_euclid(4.0) as usize;
                Some(match self {
                    Self::Sin => [0.0, 1.0, 0.0, -1.0][turn],
                    _ => [1.0, 0.0, -1.0, 0.0][turn],
                })
            }
            Self::Tan | Self::Asin | Self::Atan | Self::Sinh | Self::Tanh if x[0] == 0.0 => {
                Some(0.0)
            }
            Self::Cosh | Self::Exp if x[0] == 0.0 => Some(1.0),
            Self::Ln if x[0] == 1.0 => Some(0.0),
            Self::Floor => Some(x[0].floor()),
            Self::Abs => Some(x[0].abs()),
            Self::Sign if x[0] == 0.0 => Some(0.0),
            Self::Sign => Some(x[0].signum()),
            Self::Step => Some(f64::from(u8::from(x[0] >= 0.0))),
            Self::Max => Some(x[0].max(x[1])),
            Self::Min => Some(x[0].min(x[1])),
            Self::Power => Some(x[0].powf(x[1])),
            _ if x.iter().any(|x| x.is_nan()) => Some(f64::NAN),
            _ => None,
        }
    }
}
