//! The start of a case, written in Rust and read for assembly.

use super::Start;
use crate::analyses::assemble::{targets, Request};
use crate::elements::Number;
use crate::math::Listed;
use crate::model::{Model, Problems};

impl Start {
    /// Nothing prescribed, nothing guessed.
    pub fn new() -> Self {
        Self::default()
    }

    /// Prescribes a coordinate or rate, such as `crank.angle`: m, rad, m/s or rad/s.
    pub fn set(mut self, coordinate: &str, value: impl Into<Number>) -> Self {
        self.set.push((coordinate.to_string(), value.into().into()));
        self
    }

    /// Guesses a coordinate or rate.
    pub fn guess(mut self, coordinate: &str, value: impl Into<Number>) -> Self {
        self.guess.push((coordinate.to_string(), value.into().into()));
        self
    }

    /// The request for [`assemble`](crate::assemble).
    ///
    /// # Errors
    /// Every coordinate that the model does not have, and every faulty value.
    pub fn request(&self, model: &Model) -> Result<Request, Problems> {
        let (set, guess) = (targets(model, "set", &self.set), targets(model, "guess", &self.guess));
        match (set, guess) {
            (Ok(set), Ok(guess)) => Ok(Request { set, guess, ..Request::default() }),
            (set, guess) => {
                let faults = [set.err(), guess.err()].into_iter().flatten().flatten();
                Err(Problems(faults.list()))
            }
        }
    }
}
