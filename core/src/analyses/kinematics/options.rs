//! Options of kinematics and of inverse dynamics, which are the same.

use super::over::position_named;
use crate::analyses::options::{count, flag, interval, kind, name, number, options, positive};
use crate::elements::Group;
use crate::model::Value;

/// Default number of values over a range: one value for each degree of a full turn.
pub(super) const POINTS: usize = 361;
/// Largest number of values or times of one motion.
pub(super) const MOST_OUTPUTS: usize = 1_000_000;

kind! {
    /// A driver, or a position quantity such as `crank.angle`.
    driven_value: String, Name, |reader, key| {
        let Value::Text(name) = reader.get(key)? else {
            return reader.refuse(key, "must be a name");
        };
        let items = &reader.model().constraints;
        if items.iter().any(|item| item.group == Group::Drivers && item.name == *name) {
            return Some(name.clone());
        }
        match position_named(reader.model(), name) {
            Ok(_) => Some(name.clone()),
            Err(problem) => reader.report(key, problem),
        }
    }
}

/// Declares an analysis of a driven motion.
macro_rules! driven_motion {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal, $class:literal, {$($more:tt)*}, $fault:expr) => {
        options! {
            $(#[doc = $doc])*
            $Name, $name, $class () {
                /// Time at which the motion ends.
                t_end: Option<number> [s] = None,
                /// Time between the reported states; if absent, 1/360 of the interval.
                output_step: Option<positive> [s] = None,
                /// Driver, or position quantity such as `crank.angle`, whose value replaces the
                /// time as the independent variable.
                over: Option<driven_value> = None,
                /// First and last value of `over`, in SI units and rad.
                range: Option<interval> = None,
                /// Number of values in the range, including both ends.
                n: count = POINTS,
                /// State at which the analysis starts: "start", or the name of an earlier analysis
                /// to use its final state. If absent, the final state of the previous analysis.
                from: Option<name> = None,
                $($more)*
            }
            excludes { over: t_end, output_step; }
            conflict |options, _| {
                let (key, message) = match (&options.over, options.range, options.t_end) {
                    (Some(_), None, _) => ("range", "missing; over needs it: range = [first, last]"),
                    (None, Some(_), _) => ("over", "missing; range needs it: over = \"crank.angle\""),
                    (None, None, None) => ("t_end", "missing; give t_end, or over and range"),
                    _ if !(2..=MOST_OUTPUTS).contains(&options.n) => {
                        let message = format!("{}; must be a whole number from 2 to {MOST_OUTPUTS}", options.n);
                        return Some(("n", message));
                    }
                    _ => return $fault(options),
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
    Options, "kinematics", "Kinematics", {}, |_: &Options| None
}

driven_motion! {
    /// Efforts of drivers and reactions of joints in the motion that the drivers prescribe, as
    /// computed by `kinematics`.
    InverseOptions, "inverse_dynamics", "InverseDynamics", {
        /// Whether the mechanism is at rest at each value of `over`: without inertia, damping and
        /// other forces that depend on rates. Otherwise the value grows at unit rate.
        r#static: flag = false,
    }, |options: &InverseOptions| {
        let fault = || ("static", "true, over time; give over and range".to_string());
        (options.r#static && options.over.is_none()).then(fault)
    }
}

impl From<InverseOptions> for Options {
    fn from(of: InverseOptions) -> Self {
        let InverseOptions { t_end, output_step, over, range, n, from, r#static: _ } = of;
        Self { t_end, output_step, over, range, n, from }
    }
}
