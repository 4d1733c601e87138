//! Options of kinematics and of inverse dynamics, which are the same.

use crate::analyses::options::{count, interval, name, number, options, positive, Reader};
use crate::model::{Model, Problem, Value};

/// Number of values over a range, if none is given: one for each degree of a turn.
const VALUES: usize = 361;

/// Declares an analysis of a driven motion.
macro_rules! driven_motion {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal, $class:literal) => {
        options! {
            $(#[doc = $doc])*
            $Name, $name, $class () {
                /// Time at which the motion ends.
                t_end: Option<number> [s] = None,
                /// Time between the reported states; if absent, 1/360 of the interval.
                output_step: Option<positive> [s] = None,
                /// A driver, or a position quantity such as `crank.angle`, whose value takes the place of the time.
                over: Option<name> = None,
                /// First and last value of `over`, in SI units and rad.
                range: Option<interval> = None,
                /// Number of values in the range, both ends included.
                n: count = VALUES,
                /// State at which it starts: "start", or the name of an earlier analysis for the end of that analysis.
                /// If absent, the end of the analysis before it.
                from: Option<name> = None,
            }
            excludes { over: t_end, output_step; }
        }

        impl $Name {
            /// Reads the fields of an analysis of this type; `path` is its path in the file.
            ///
            /// # Errors
            /// Every faulty value, with its path.
            pub fn checked(
                model: &Model,
                fields: &[(String, Value)],
                path: &[String],
            ) -> Result<Self, Vec<Problem>> {
                use crate::analyses::options::Declared;
                let read = Reader::read(model, fields, path, Self::read)?;
                let missing = match (&read.over, read.range, read.t_end) {
                    (Some(_), None, _) => Some(("range", "missing; over needs it: range = [first, last]")),
                    (None, Some(_), _) => Some(("over", "missing; range needs it: over = \"crank.angle\"")),
                    (None, None, None) => Some(("t_end", "missing; give t_end, or over and range")),
                    _ if read.n < 2 => Some(("n", "1; must be a whole number from 2")),
                    _ => None,
                };
                match missing {
                    None => Ok(read),
                    Some((key, message)) => {
                        let path: Vec<&str> = path.iter().map(String::as_str).chain([key]).collect();
                        Err(vec![Problem::at(&path, message)])
                    }
                }
            }
        }
    };
}

driven_motion! {
    /// Positions, velocities and accelerations of a mechanism whose drivers determine its motion, without integration:
    /// over time, or over the value of a driver or position quantity.
    Options, "kinematics", "Kinematics"
}

driven_motion! {
    /// Efforts of drivers and reactions of joints for the motion that the drivers prescribe, which is that of
    /// `kinematics`.
    InverseOptions, "inverse_dynamics", "InverseDynamics"
}
