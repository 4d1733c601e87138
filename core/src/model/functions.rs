//! Laws that the calling program computes: functions of time and state without a formula.

use crate::math::Real;
use std::fmt::Debug;
use std::sync::Arc;

/// The program that computes the laws.
pub trait Host: Debug + Send + Sync {
    /// The value of a law at x = (t, q, v, z). NaN if there is no value; this ends a run.
    fn value(&self, law: usize, x: &[f64]) -> f64;
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

    /// The value of a law at x = (t, q, v, z).
    pub fn value<S: Real>(&self, law: usize, x: &[S]) -> S {
        S::of_values(&|x| self.host.value(law, x), x)
    }
}
