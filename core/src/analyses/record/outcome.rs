//! The reason for which an analysis failed, with advice for users of every interface.

use crate::model::{Problem, Problems};

/// The class of an error. Its name is that of the exception of the Python package.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorClass {
    /// The model, an option or a file contains a fault.
    Model,
    /// The mechanism cannot be assembled, or a start does not meet the constraints.
    Assembly,
    /// Some constraints repeat others at every position.
    Redundancy,
    /// The mechanism is in a position at which the task has no unique solution.
    Singularity,
    /// The integrator could not continue.
    Integration,
    /// A file cannot be read or written.
    File,
    /// A fault of kempe itself.
    Internal,
}

impl ErrorClass {
    /// All classes.
    pub const ALL: [Self; 7] = [
        Self::Model,
        Self::Assembly,
        Self::Redundancy,
        Self::Singularity,
        Self::Integration,
        Self::File,
        Self::Internal,
    ];

    /// The name of the exception.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Model => "ModelError",
            Self::Assembly => "AssemblyError",
            Self::Redundancy => "RedundancyError",
            Self::Singularity => "SingularityError",
            Self::Integration => "IntegrationError",
            Self::File => "FileError",
            Self::Internal => "InternalError",
        }
    }
}

/// The reason for which an analysis failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Its class.
    pub class: ErrorClass,
    /// Description.
    pub message: String,
    /// The element, coordinate or option at fault.
    pub name: Option<String>,
    /// The time at which it occurred, s.
    pub t: Option<f64>,
    /// Remedy.
    pub hint: Option<String>,
    /// The faults of single entries, with their paths in a file.
    pub problems: Vec<Problem>,
}

impl Outcome {
    /// A reason with a message alone.
    pub fn new(class: ErrorClass, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { class, message, name: None, t: None, hint: None, problems: Vec::new() }
    }

    /// Names the element, coordinate or option at fault. An empty name is ignored.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into()).filter(|name| !name.is_empty());
        self
    }

    /// Gives the time, s.
    pub const fn at(mut self, t: f64) -> Self {
        self.t = Some(t);
        self
    }

    /// Gives the remedy. An empty remedy is ignored.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into()).filter(|hint| !hint.is_empty());
        self
    }
}

impl From<Vec<Problem>> for Outcome {
    /// The faults of a model or of options.
    fn from(problems: Vec<Problem>) -> Self {
        let message = Problems(problems.clone()).to_string();
        Self { problems, ..Self::new(ErrorClass::Model, message) }
    }
}
