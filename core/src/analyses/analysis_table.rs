//! All analyses and options: as data for the reader of files, the schema, Python and docs, and as one type.

use super::configurations;
use super::diagnosis;
use super::dynamics;
use super::equilibrium;
use super::kinematics;
use super::limits;
use super::linearization;
use super::options::{Declaration, Declared, Family, Member};
use super::reachable;
use super::record::{
    parts, Analysis, ErrorClass, Observer, Outcome, Record, RunResult, StartState, Subject,
};
use crate::math::Listed;
use crate::model::{Model, Problem, Value};
use std::sync::LazyLock;

/// The declaration of an analysis.
fn declaration<A: Analysis>() -> Declaration {
    let numbers = A::NUMBERS.iter().map(|number| (number.name, number.unit)).list();
    Declaration { numbers, motion: A::MOTION, ..A::declaration() }
}

/// A number of a record of an analysis; see [`AnyAnalysis::number`].
fn number<A: Analysis>(
    options: &A,
    subject: &Subject<'_>,
    record: &Record,
    text: &str,
) -> Result<f64, Outcome> {
    let (name, _) = parts(text);
    let found = match A::NUMBERS.iter().find(|number| number.name == name) {
        Some(number) => (number.read)(record, name),
        None => options.quantity(subject, record, name)?,
    };
    found.at(text).map_err(|message| Outcome::new(ErrorClass::Model, message))
}

/// Lists the analyses.
macro_rules! analyses {
    ($($Name:ident($Options:ty)),+ $(,)?) => {
        /// An analysis of any type, with its options.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(clippy::large_enum_variant)] // one exists for each run
        pub enum AnyAnalysis {
            $(
                #[doc = stringify!($Options)]
                $Name($Options)
            ),+
        }

        // created once, because every simulation is checked with them
        static ANALYSES: LazyLock<Vec<Declaration>> =
            LazyLock::new(|| vec![$(declaration::<$Options>()),+]);

        impl AnyAnalysis {
            /// Reads the fields of an analysis; `path` is its path in the file.
            ///
            /// # Errors
            /// Every faulty value, with its path.
            pub fn read(
                model: &Model,
                fields: &[(String, Value)],
                path: &[String],
            ) -> Result<Self, Vec<Problem>> {
                match kind_of(fields) {
                    $(<$Options as Declared>::NAME => {
                        <$Options>::checked(model, fields, path).map(Self::$Name)
                    })+
                    other => Err(vec![Problem::at(path, format!("there is no analysis '{other}'"))]),
                }
            }

            /// The time at which the analysis ends; see [`Analysis::ends`].
            ///
            /// # Errors
            /// The faults that follow from the time of the start.
            pub fn ends(
                &self,
                model: &Model,
                begin: Option<f64>,
            ) -> Result<Option<f64>, Vec<Problem>> {
                match self {
                    $(Self::$Name(options) => options.ends(model, begin)),+
                }
            }

            /// Whether the analysis changes parameters, so that its start may not meet the constraints.
            pub fn changes_parameters(&self) -> bool {
                match self {
                    $(Self::$Name(options) => options.changes_parameters()),+
                }
            }

            /// Checks whether the analysis can begin; see [`Analysis::begins`].
            ///
            /// # Errors
            /// The obstacle.
            pub fn begins(
                &self,
                subject: &Subject<'_>,
                start: &StartState,
            ) -> Result<(), Outcome> {
                let own = subject.meshed(start);
                let subject = &own.as_ref().map_or(*subject, |own| Subject { prepared: own, ..*subject });
                match self {
                    $(Self::$Name(options) => options.begins(subject, start)),+
                }
            }

            /// A number of a record of the analysis, such as `lower`, `frequency[0]` or `rocker.angle`.
            ///
            /// # Errors
            /// There is none of this name or place, or it has no value.
            pub fn number(
                &self,
                subject: &Subject<'_>,
                record: &Record,
                text: &str,
            ) -> Result<f64, Outcome> {
                match self {
                    $(Self::$Name(options) => number(options, subject, record, text)),+
                }
            }

            /// Runs the analysis; see [`Analysis::run`].
            ///
            /// # Errors
            /// [`Unfinished`], with the record so far if there is one.
            pub fn run(
                &self,
                subject: &Subject<'_>,
                start: &StartState,
                observer: Observer<'_>,
            ) -> RunResult {
                let own = subject.meshed(start);
                let subject = &own.as_ref().map_or(*subject, |own| Subject { prepared: own, ..*subject });
                match self {
                    $(Self::$Name(options) => Analysis::run(options, subject, start, observer)),+
                }
            }
        }
    };
}

analyses! {
    Dynamics(dynamics::Options),
    Kinematics(kinematics::Options),
    InverseDynamics(kinematics::InverseOptions),
    Equilibrium(equilibrium::Options),
    Modes(linearization::Options),
    Limits(limits::Options),
    Mobility(diagnosis::Options),
    Configurations(configurations::Options),
    Reachable(reachable::Options),
}

static FAMILIES: LazyLock<Vec<Family>> =
    LazyLock::new(|| vec![dynamics::Scheme::family(), dynamics::Stabilization::family()]);

/// The analyses, by the `type` in the file.
pub fn declarations() -> &'static [Declaration] {
    &ANALYSES
}

/// The families of options that the analyses use.
pub fn option_families() -> &'static [Family] {
    &FAMILIES
}

/// The type of an analysis in a file; empty without one.
pub fn kind_of(fields: &[(String, Value)]) -> &str {
    match fields.iter().find(|(key, _)| key == "type") {
        Some((_, Value::Text(kind))) => kind,
        _ => "",
    }
}

/// Whether the result of a type of analysis is a motion. Measures have statistics for these analyses only.
pub fn is_motion(kind: &str) -> bool {
    declarations().iter().any(|declared| declared.table.name == kind && declared.motion)
}
