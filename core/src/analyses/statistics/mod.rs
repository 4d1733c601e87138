//! Statistics of a quantity over a run: extreme values and integrals on the interpolant, and the settling time.
//!
//! A quantity is evaluated through a function of times, so that the same code works for measures of the core and for
//! functions of the caller.

mod extreme;
mod instants;
mod integrals;
mod maxima;
mod norms;
mod settling;
mod singular_instants;

pub use extreme::{changes, extreme, Extreme, Samples, RIVAL};
pub use instants::instants;
pub use integrals::{in_blocks, Integrals};
pub use maxima::Maxima;
pub use norms::row_norms;
pub use settling::{settling, Settling, BAND};
pub use singular_instants::{SingularInstants, EXAMINED};

/// Returns a quantity at some times. None if it has no value at one of them.
pub type Read<'a> = &'a mut dyn FnMut(&[f64]) -> Option<Vec<f64>>;

/// The largest value. NaN if a value is NaN.
fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, x: f64| if x > most || x.is_nan() { x } else { most };
    values.into_iter().fold(f64::NEG_INFINITY, larger)
}

/// The index of the largest value; the first of equal values.
fn place_of_largest(values: &[f64]) -> usize {
    let most = largest(values.iter().copied());
    values.iter().position(|x| *x == most || x.is_nan()).unwrap_or(0)
}
