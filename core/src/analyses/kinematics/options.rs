//! Options of kinematics and of inverse dynamics, which are the same.

use crate::analyses::options::{count, interval, name, number, options, positive};

/// Default number of values over a range: one value for each degree of a full turn.
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
                /// Driver, or position quantity such as `crank.angle`, whose value replaces the
                /// time as the independent variable.
                over: Option<name> = None,
                /// First and last value of `over`, in SI units and rad.
                range: Option<interval> = None,
                /// Number of values in the range, including both ends.
                n: count = VALUES,
                /// State at which the analysis starts: "start", or the name of an earlier analysis
                /// to use its final state. If absent, the final state of the previous analysis.
                from: Option<name> = None,
            }
            excludes { over: t_end, output_step; }
            conflict |options, _| {
                let (key, message) = match (&options.over, options.range, options.t_end) {
                    (Some(_), None, _) => ("range", "missing; over needs it: range = [first, last]"),
                    (None, Some(_), _) => ("over", "missing; range needs it: over = \"crank.angle\""),
                    (None, None, None) => ("t_end", "missing; give t_end, or over and range"),
                    _ if options.n < 2 => ("n", "1; must be a whole number from 2"),
                    _ => return None,
                };
                Some((key, message.to_string()))
            };
        }
    };
}

driven_motion! {
    /// Positions, velocities and accelerations of a mechanism whose drivers determine its motion.
    /// They are computed without integration: over time, or over the value of a driver or position
    /// quantity.
    Options, "kinematics", "Kinematics"
}

driven_motion! {
    /// Efforts of drivers and reactions of joints in the motion that the drivers prescribe, as
    /// computed by `kinematics`.
    InverseOptions, "inverse_dynamics", "InverseDynamics"
}
