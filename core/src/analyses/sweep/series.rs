//! The values of a measure over a run, and their statistics.

use super::fine::{Between, Fine};
use super::readings::{Missing, Readings};
use super::statistic::Statistic;
use crate::analyses::statistics::{
    changes, extreme, settling, Extreme, Integrals, Maxima, Samples, Settling, RIVAL,
};
use crate::math::Listed;
use std::cell::OnceCell;

/// A measure over a run.
pub struct Series<'a> {
    between: &'a Between<'a>,
    readings: &'a Readings<'a>,
    /// The index of the measure.
    place: usize,
    /// Whether the measure needs accelerations or multipliers.
    solves: bool,
    /// The values at the outputs.
    outputs: Vec<f64>,
    /// The largest and the least value, each with the times of other maxima that are as large.
    extremes: [OnceCell<(Extreme, Vec<f64>)>; 2],
    integrals: OnceCell<Integrals>,
}

impl<'a> Series<'a> {
    pub fn new(between: &'a Between<'a>, place: usize) -> Result<Self, Missing> {
        let readings = &between.readings;
        let (outputs, solves) = (readings.outputs(place)?, readings.solves(place));
        Ok(Self {
            between,
            readings,
            place,
            solves,
            outputs,
            extremes: Default::default(),
            integrals: OnceCell::new(),
        })
    }

    /// The values at other times. None if a value cannot be computed.
    fn read(&self, t: &[f64]) -> Option<Vec<f64>> {
        self.readings.at(t, self.solves, &[self.place])?.values.pop()
    }

    /// A statistic of the measure.
    pub fn statistic(&self, statistic: Statistic) -> Result<f64, Missing> {
        let outputs = &self.outputs;
        Ok(match statistic {
            Statistic::Max => self.most()?.value,
            Statistic::Min => self.least()?.value,
            Statistic::Peak => self.most()?.value.abs().max(self.least()?.value.abs()),
            Statistic::TimeOfMax => self.most()?.t,
            Statistic::TimeOfMin => self.least()?.t,
            Statistic::Integral | Statistic::Mean | Statistic::Rms => {
                statistic.of_integrals(self.integrals()?)
            }
            Statistic::Final => outputs[outputs.len() - 1],
            Statistic::Settling => self.settling()?,
        })
    }

    fn most(&self) -> Result<Extreme, Missing> {
        Ok(self.known(0)?.0)
    }

    fn least(&self) -> Result<Extreme, Missing> {
        Ok(self.known(1)?.0)
    }

    /// The largest value (0) or the least (1), and the times of other maxima that are as large.
    pub fn known(&self, place: usize) -> Result<&(Extreme, Vec<f64>), Missing> {
        if self.extremes[place].get().is_none() {
            let found = self.extreme([1.0, -1.0][place])?;
            return Ok(self.extremes[place].get_or_init(|| found));
        }
        self.extremes[place].get().ok_or(Missing::Single)
    }

    /// The values at points with weights, which give the integrals.
    pub fn integrals(&self) -> Result<&Integrals, Missing> {
        if let Some(known) = self.integrals.get() {
            return Ok(known);
        }
        let t = &self.readings.run.trajectory.t;
        let found = self.between.integrals(self.place)?;
        let found = found.unwrap_or_else(|| Integrals::of_outputs(t, &self.outputs));
        Ok(self.integrals.get_or_init(|| found))
    }

    /// The values at the outputs.
    pub fn outputs(&self) -> &[f64] {
        &self.outputs
    }

    fn extreme(&self, sign: f64) -> Result<(Extreme, Vec<f64>), Missing> {
        let signed = |values: &[f64]| -> Vec<f64> { values.iter().map(|x| sign * x).list() };
        let signed_outputs = signed(&self.outputs);
        let outputs = Samples { t: &self.readings.run.trajectory.t, values: &signed_outputs };
        let Some(Fine { t, values, near, resolved }) = self.between.fine()? else {
            return Ok((extreme(sign, outputs, None), Vec::new()));
        };
        let values = signed(&values[self.place]);
        if !changes(&values) {
            return Ok((extreme(sign, outputs, None), Vec::new()));
        }
        let mut read = |t: &[f64]| Some(signed(&self.read(t)?));
        let samples = Samples { t, values: &values };
        let known = (&near.near[..], &near.near_t[..]);
        let found = Maxima::search((t, &values), known, *resolved, &mut read);
        let beside: Vec<f64> = found.t.iter().flat_map(|t| self.readings.left_out(*t)).list();
        let values = self.read(&beside).ok_or(Missing::Single)?;
        let t = [outputs.t, &beside].concat();
        let values = [outputs.values, &signed(&values)].concat();
        let outputs = Samples { t: &t, values: &values };
        match found.near.is_empty() {
            true => {
                let most = extreme(sign, outputs, Some((samples, &found)));
                let level = sign * most.value - RIVAL * most.value.abs();
                let all = found.values.iter().zip(&found.t);
                let rivals = all.filter(|(x, t)| **x >= level && **t != most.t);
                Ok((most, rivals.map(|(_, t)| *t).list()))
            }
            // a single run of the case continues the quantity across the singular positions
            false => Err(Missing::Single),
        }
    }

    fn settling(&self) -> Result<f64, Missing> {
        let t = &self.readings.run.trajectory.t;
        let mut read = |t: &[f64]| self.read(t);
        let continuous = self.readings.run.dense.as_ref().is_some_and(|dense| dense.t.len() > 1);
        let found = match continuous {
            true => settling(t, &self.outputs, None, Some(&mut read)),
            false => settling(t, &self.outputs, None, None),
        };
        match found {
            Settling::At(t) => Ok(t),
            Settling::Constant => Ok(t[0]),
            Settling::Never => Ok(f64::NAN),
            Settling::Unknown => Err(Missing::Single),
        }
    }
}
