//! Failures of analyses as errors of Rust.

use super::{assemble, dynamics};
use std::error::Error;
use std::fmt;

impl Error for assemble::Failure {}

impl fmt::Display for dynamics::Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.reason)
    }
}

impl Error for dynamics::Failure {}
