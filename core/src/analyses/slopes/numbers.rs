//! The numbers of analyses whose results are not motions, with their derivatives.

use crate::analyses::record::Record;
use crate::analyses::sweep::{Ready, Sweep, VariantRow};
use crate::analyses::AnyAnalysis;

/// The derivatives of each number by each variable, or the reasons for which there are none.
pub(super) type NumberSlopes = Vec<Vec<Result<f64, String>>>;

impl Sweep {
    /// The derivatives of the numbers of a result that is not a motion.
    pub(super) fn of_numbers(
        &self,
        ready: &Ready,
        analysis: &AnyAnalysis,
        record: &Record,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> NumberSlopes {
        let count = row.0.len() + row.1.len();
        let none = |reason: &str| vec![vec![Err(reason.to_string()); count]; self.wanted.len()];
        match analysis {
            AnyAnalysis::Modes(options) => self.of_modes(ready, options, row, stop),
            AnyAnalysis::Limits(_) => self.of_limits(ready, record, row, stop),
            AnyAnalysis::Configurations(_) | AnyAnalysis::Mobility(_) => {
                none("it counts, or says yes or no, and does not change gradually")
            }
            _ => none("kempe has no derivatives of this number yet"),
        }
    }
}

/// The derivatives of all numbers, row by row, and the reasons for missing ones, by number and variable.
pub(super) fn listed(found: NumberSlopes) -> (Vec<f64>, Vec<([usize; 2], String)>) {
    let (mut jacobian, mut reasons) = (Vec::new(), Vec::new());
    for (number, slopes) in found.into_iter().enumerate() {
        for (variable, slope) in slopes.into_iter().enumerate() {
            let finite = |x: f64| {
                if x.is_finite() {
                    Ok(x)
                } else {
                    Err(format!("the derivative is {x}"))
                }
            };
            match slope.and_then(finite) {
                Ok(slope) => jacobian.push(slope),
                Err(reason) => {
                    jacobian.push(f64::NAN);
                    reasons.push(([number, variable], reason));
                }
            }
        }
    }
    (jacobian, reasons)
}
