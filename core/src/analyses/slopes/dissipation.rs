//! The energies that force elements dissipate, with derivatives: their powers summed along a run.

use crate::analyses::measures::Measure;
use crate::analyses::so_far::{PLACES, WEIGHTS};
use crate::equations::sensitivity::{Slope, ABREAST};
use crate::math::{Dual, Listed, Real};
use crate::model::Model;

/// Energies up to a time.
pub(super) struct Dissipation {
    /// The force elements.
    pub forces: Vec<usize>,
    /// The index of the first measure of their powers, which follow the other measures.
    pub first: usize,
    /// The ends of the steps of the run.
    bounds: Vec<f64>,
    /// The time of the energies; NaN before the start.
    pub t: f64,
    pub values: Vec<f64>,
    /// The derivatives at a fixed time by each variable, and those at a time with derivatives `late`, which is that of the
    /// last change of the motion plus a given duration. Powers of motions that decay fast have large derivatives at a fixed
    /// time.
    slopes: [Vec<Vec<f64>>; 2],
    late: Vec<f64>,
}

impl Dissipation {
    /// The energies that measures and conditions use. Adds their powers to the measures.
    pub fn new(
        model: &Model,
        measures: &mut Vec<Measure>,
        conditions: &[Measure],
        bounds: Vec<f64>,
    ) -> Self {
        let mut forces: Vec<usize> =
            measures.iter().chain(conditions).flat_map(Measure::dissipating).list();
        forces.sort_unstable();
        forces.dedup();
        let first = measures.len();
        measures.extend(forces.iter().map(|k| Measure::of_dissipation(model, *k)));
        let (values, slopes) = (vec![0.0; forces.len()], vec![Vec::new(); forces.len()]);
        let slopes = [slopes.clone(), slopes];
        Self { forces, first, bounds, t: f64::NAN, values, slopes, late: Vec::new() }
    }

    /// Whether there are energies to sum up to a time.
    pub fn is_behind(&self, t: f64) -> bool {
        !self.forces.is_empty() && (self.t.is_nan() || self.t < t)
    }

    /// The first time of the run.
    pub fn start(&self) -> f64 {
        self.bounds[0]
    }

    /// Begins with energies of zero at a time with derivatives `late`.
    pub fn begin(&mut self, late: &[f64]) {
        (self.t, self.late) = (self.bounds[0], late.to_vec());
        self.slopes.iter_mut().for_each(|of| of.fill(vec![0.0; late.len()]));
    }

    /// The end of the present step, at most `t`, and the points in it with their weights.
    pub fn panel(&self, t: f64) -> (f64, [[f64; 2]; 5]) {
        let next = self.bounds.partition_point(|end| *end <= self.t);
        let end = self.bounds.get(next).map_or(t, |end| end.min(t));
        let (span, mut points) = (end - self.t, [[0.0; 2]; 5]);
        for (point, (place, weight)) in points.iter_mut().zip(PLACES.iter().zip(&WEIGHTS)) {
            *point = [self.t + span * place, span * weight];
        }
        (end, points)
    }

    /// Adds the powers, among the values of all measures with their derivatives, times a duration.
    pub fn add(&mut self, duration: f64, values: &[[f64; 2]], all: &[Vec<f64>]) {
        for (k, (sum_of_values, slopes)) in
            self.values.iter_mut().zip(&mut self.slopes[1]).enumerate()
        {
            *sum_of_values += duration * values[self.first + k][0];
            let (own, rate) = (&all[self.first + k], values[self.first + k][1]);
            for (sum, (slope, late)) in slopes.iter_mut().zip(own.iter().zip(&self.late)) {
                *sum += duration * (slope + rate * late);
            }
        }
    }

    /// Finds the derivatives at the present time, held fixed, from the powers among the values of all measures.
    pub fn hold_time(&mut self, values: &[[f64; 2]]) {
        let [fixed, moving] = &mut self.slopes;
        for (k, (fixed, moving)) in fixed.iter_mut().zip(moving).enumerate() {
            let power = values[self.first + k][0];
            let each = fixed.iter_mut().zip(moving.iter().zip(&self.late));
            each.for_each(|(fixed, (moving, late))| *fixed = moving - power * late);
        }
    }

    /// Goes beyond a change whose time has the derivatives `late`, with the powers before it.
    pub fn turn(&mut self, values: &[[f64; 2]], late: &[f64]) {
        for (k, moving) in self.slopes[1].iter_mut().enumerate() {
            let power = values[self.first + k][0];
            let each = moving.iter_mut().zip(late.iter().zip(&self.late));
            each.for_each(|(moving, (late, before))| *moving += power * (late - before));
        }
        self.late = late.to_vec();
    }

    /// Appends the energies of all forces of a model to works, in the variables of block `b`.
    pub fn append(&self, model: &Model, b: usize, works: &mut Vec<Slope>) {
        let energy = |place: usize| {
            let mut slope = [0.0; ABREAST];
            let own = self.slopes[0][place].iter().skip(ABREAST * b);
            slope.iter_mut().zip(own).for_each(|(to, from)| *to = *from);
            Dual { value: self.values[place], slope }
        };
        self.append_each(model, works, energy);
    }

    /// Appends the energies of all forces of a model to works.
    pub fn append_each(
        &self,
        model: &Model,
        works: &mut Vec<Slope>,
        energy: impl Fn(usize) -> Slope,
    ) {
        if !self.forces.is_empty() {
            let place = |k: usize| self.forces.iter().position(|force| *force == k);
            let of = |k: usize| place(k).map_or(Slope::constant(f64::NAN), &energy);
            works.extend((0..model.forces.len()).map(of));
        }
    }
}
