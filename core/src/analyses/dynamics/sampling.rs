//! Sampled laws. The host program computes them at known times, and first-order states hold their values between
//! these times.
//!
//! Steps end at the samples. No sample is taken at the end of a run. A run that continues from there begins with this
//! sample.

use super::failure::{Failure, Reason};
use crate::math::Listed;
use crate::model::{Functions, Model};

/// Largest number of samples of a run.
const MOST: f64 = 1e6;
/// A reported time within this distance of a sample has the values of the sample, relative to 1 s + |t|.
const SAME: f64 = 1e-12;

/// The values of all sampled laws, computed at a time.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub t: f64,
    values: Vec<f64>,
}

impl Sample {
    /// Computes the laws with a sample at `t`. Other laws keep their values. All laws are evaluated at the state
    /// before the sample.
    pub fn take(model: &Model, t: f64, y: &[f64]) -> Option<Self> {
        let functions = model.blueprint.functions.as_ref()?;
        let [q, v, z, _] = model.layout.split(y);
        let x = [&[t], q, v, z].concat();
        let mut values = held(model, y);
        let due = functions.sampled().zip(&mut values).filter(|((.., times), _)| times.is_at(t));
        let due: Vec<_> =
            due.map(|((law, ..), value)| *value = functions.value(law, &x, x.len())).list();
        (!due.is_empty()).then_some(Self { t, values })
    }

    /// Puts the values into y.
    pub fn put(&self, model: &Model, y: &mut [f64]) {
        let [_, _, z, _] = model.layout.split_mut(y);
        let held = model.layout.held.iter().zip(&self.values);
        held.for_each(|(place, value)| z[*place] = *value);
    }

    /// Whether a reported time is at or after the sample.
    pub fn reaches(&self, t: f64) -> bool {
        t >= self.t - SAME * (1.0 + t.abs())
    }
}

/// The present values of all sampled laws.
pub(super) fn held(model: &Model, y: &[f64]) -> Vec<f64> {
    let [_, _, z, _] = model.layout.split(y);
    model.layout.held.iter().map(|place| z[*place]).list()
}

/// The times of samples strictly between `t0` and `t_end`, ascending.
///
/// # Errors
/// More samples than a run can step to; a run backward in time.
pub(super) fn times(model: &Model, (t0, t_end): (f64, f64)) -> Result<Vec<f64>, Box<Failure>> {
    let mut times = Vec::new();
    for (_, law, sampling) in model.blueprint.functions.iter().flat_map(Functions::sampled) {
        let refuse = |what: &str, hint| {
            let message = format!("the sampled {} of {} {what}", law.field, law.element);
            Err(Reason::Law { t: t0, name: law.element.clone(), message, hint }.into())
        };
        if t_end < t0 {
            return refuse("cannot run backward in time", "let t_end be after the start");
        }
        let count = (t_end - sampling.start.max(t0)) / sampling.period;
        if count > MOST {
            return refuse("has more than a million samples", "let the period be longer");
        }
        let first = sampling.next(t0);
        let own = (0..=MOST as usize + 1).map(|k| sampling.time(first + k as f64));
        let own = own.skip_while(|t| sampling.is_at(t0) && *t <= sampling.time(first));
        times.extend(own.take_while(|t| *t < t_end && !near(&sampling, *t, t_end)));
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    Ok(times)
}

/// Whether the end is a sampling time, up to rounding, and `t` is this time.
fn near(sampling: &crate::model::Sampling, t: f64, t_end: f64) -> bool {
    sampling.is_at(t_end) && t_end - t < 0.5 * sampling.period
}
