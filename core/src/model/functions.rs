//! Laws that the calling program computes: functions of time and state without a formula.

use crate::math::{ByArgument, ByValues, Real};
use std::cell::RefCell;
use std::fmt::Debug;
use std::sync::Arc;

/// The program that computes the laws.
pub trait Host: Debug + Send + Sync {
    /// The value of a law at x = (t, q, v, z). NaN if there is no value; this ends a run.
    fn value(&self, law: usize, x: &[f64]) -> f64;
    /// The derivatives of a law with [`slopes`](FunctionLaw::slopes) at x = (t, q, v, z), by t, q, v, z and the
    /// parameters. Empty if there are none; this ends a run.
    fn slopes(&self, law: usize, x: &[f64]) -> Vec<f64>;
}

/// The times at which a sampled law is computed: start + k period for k = 0, 1, 2, …
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Time between two samples, s.
    pub period: f64,
    /// Time of the first sample, s.
    pub start: f64,
}

/// Fraction of a period by which a time may differ from a sample because of rounding.
const ROUNDING: f64 = 1e-9;

impl Sampling {
    /// The time of sample `k`.
    pub fn time(&self, k: f64) -> f64 {
        self.start + k * self.period
    }

    /// The index of the first sample at or after `t`.
    pub fn next(&self, t: f64) -> f64 {
        ((t - self.start) / self.period - ROUNDING).ceil().max(0.0)
    }

    /// Whether a sample is at `t`.
    pub fn is_at(&self, t: f64) -> bool {
        (self.time(self.next(t)) - t).abs() <= ROUNDING * self.period
    }
}

/// A law that the host computes.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionLaw {
    /// The force element.
    pub element: String,
    /// The field, with the index of its entry if it has several: `torque`, `force_2`.
    pub field: String,
    /// Its unit.
    pub unit: String,
    /// None if the law is computed at each evaluation.
    pub sampling: Option<Sampling>,
    /// Whether the host has the derivatives.
    pub slopes: bool,
}

impl FunctionLaw {
    /// The name of the state that holds the value: `motor.torque_held`.
    pub fn held(&self) -> String {
        format!("{}.{}_held", self.element, self.field)
    }
}

/// The laws of a model that the host computes.
#[derive(Clone, Debug)]
pub struct Functions {
    /// The laws, in the order of their indices.
    pub laws: Vec<FunctionLaw>,
    /// The host.
    pub host: Arc<dyn Host>,
}

impl PartialEq for Functions {
    fn eq(&self, other: &Self) -> bool {
        self.laws == other.laws && Arc::ptr_eq(&self.host, &other.host)
    }
}

impl Functions {
    /// The sampled laws. The held value of each law is a first-order state.
    pub fn sampled(&self) -> impl Iterator<Item = (usize, &FunctionLaw, Sampling)> {
        let all = self.laws.iter().enumerate();
        all.filter_map(|(k, law)| Some((k, law, law.sampling?)))
    }

    /// Whether the derivatives of all laws are known.
    pub fn have_slopes(&self) -> bool {
        self.laws.iter().all(|law| law.slopes && law.sampling.is_none())
    }

    /// The value of a law at (t, q, v, z), whose length is `count`, and the parameters.
    pub fn value<S: Real>(&self, law: usize, x: &[S], count: usize) -> S {
        let value = |x: &[f64]| self.host.value(law, &x[..count]);
        if !self.laws[law].slopes {
            return S::of_values(&value, x);
        }
        let last: RefCell<(Vec<f64>, Vec<f64>)> = RefCell::default();
        let slope = |x: &[f64], k: usize| {
            let (at, slopes) = &mut *last.borrow_mut();
            if at[..] != x[..count] {
                (*at, *slopes) = (x[..count].to_vec(), self.host.slopes(law, &x[..count]));
            }
            // parameters that an analysis adds do not concern the law
            if slopes.is_empty() {
                f64::NAN
            } else {
                slopes.get(k).copied().unwrap_or(0.0)
            }
        };
        S::of_values(&LawWithSlopes { value, slope }, x)
    }
}

/// A law with its derivatives.
struct LawWithSlopes<V, D> {
    value: V,
    slope: D,
}

impl<V: Fn(&[f64]) -> f64, D: Fn(&[f64], usize) -> f64> ByValues for LawWithSlopes<V, D> {
    fn value(&self, x: &[f64]) -> f64 {
        (self.value)(x)
    }
    fn slopes(&self) -> Option<ByArgument<'_>> {
        Some(&self.slope)
    }
}
