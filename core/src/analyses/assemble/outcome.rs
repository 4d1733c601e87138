//! The failure of an assembly as the reason that an analysis fails.

use super::failure::{Failure, Fault};
use crate::analyses::record::{ErrorClass, Outcome};
use crate::math::Listed;
use crate::model::Problem;

impl From<Failure> for Outcome {
    fn from(failure: Failure) -> Self {
        let class = match failure.fault {
            Fault::Redundant => ErrorClass::Redundancy,
            Fault::Open | Fault::Rates | Fault::Stopped => ErrorClass::Assembly,
        };
        let contradicts =
            |path: Vec<String>| Problem { path, ..Problem::new("contradicts the others") };
        let problems = failure.places.into_iter().map(contradicts).list();
        let outcome = Self::new(class, failure.message).name(failure.name).hint(failure.hint);
        Self { problems, ..outcome }
    }
}
