//! Reported states of a run, and its interpolants.

use crate::integrate::{all_finite, Step};
use crate::model::StateLayout;

/// Largest number of values for which memory is reserved. Longer tables grow.
const MOST_ROOM: usize = 1 << 20;

/// States in rows, time first.
#[derive(Clone, Copy, Debug)]
pub struct States<'a> {
    /// Times, s.
    pub t: &'a [f64],
    /// Coordinates, rows of n_q.
    pub q: &'a [f64],
    /// Velocities, rows of n_q.
    pub v: &'a [f64],
    /// First-order states of elements, rows of n_z.
    pub z: &'a [f64],
}

/// Reported states, time first; row k of each table belongs to `t[k]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Times, s.
    pub t: Vec<f64>,
    /// Coordinates, rows of n_q.
    pub q: Vec<f64>,
    /// Velocities, rows of n_q.
    pub v: Vec<f64>,
    /// First-order states of elements, rows of n_z.
    pub z: Vec<f64>,
    /// Works from the start, J: dissipated energy, work of drivers, work of applied forces. Rows of n_works.
    pub works: Vec<f64>,
}

impl Trajectory {
    /// Empty, with memory for this number of rows. Growth would copy the rows repeatedly.
    pub(super) fn with_room(layout: &StateLayout, rows: usize) -> Self {
        let rows = rows.min(MOST_ROOM / (layout.n_y() + 1));
        let room = |width: usize| Vec::with_capacity(rows * width);
        let StateLayout { n_q, n_z, n_works, .. } = *layout;
        Self { t: room(1), q: room(n_q), v: room(n_q), z: room(n_z), works: room(n_works) }
    }

    /// The reported states.
    pub fn states(&self) -> States<'_> {
        States { t: &self.t, q: &self.q, v: &self.v, z: &self.z }
    }

    /// Adds y = (q, v, z, works).
    pub(in crate::analyses) fn add(&mut self, layout: &StateLayout, t: f64, y: &[f64]) {
        let [q, v, z, works] = layout.split(y);
        self.t.push(t);
        self.q.extend_from_slice(q);
        self.v.extend_from_slice(v);
        self.z.extend_from_slice(z);
        self.works.extend_from_slice(works);
    }
}

/// The interpolants of all steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PiecewiseInterpolant {
    /// Step boundaries, one more than steps.
    pub t: Vec<f64>,
    /// y at the start of each step, rows of n_y.
    pub y: Vec<f64>,
    /// Coefficients of θ … θᵈ: for each step, n_y rows of length d.
    pub c: Vec<f64>,
    /// The degree d.
    pub degree: usize,
}

impl PiecewiseInterpolant {
    /// The rows y at times within the run.
    pub fn at(&self, times: &[f64]) -> Vec<f64> {
        let steps = self.t.len().saturating_sub(1);
        let n_y = self.y.len() / steps.max(1);
        let parts = Steps { t: &self.t, y: &self.y, c: &self.c, n_y, degree: self.degree };
        parts.at(times)
    }
    /// Empty, starting at `t0`, with memory for this number of steps. Later steps may have a degree above `degree`.
    pub(super) fn with_room(
        n_y: usize,
        degree: usize,
        highest: usize,
        steps: usize,
        t0: f64,
    ) -> Self {
        let steps = steps.min(MOST_ROOM / (highest * n_y).max(1));
        let room = |width: usize| Vec::with_capacity(steps * width);
        let mut interpolant = Self { t: room(1), y: room(n_y), c: room(highest * n_y), degree };
        interpolant.t.push(t0);
        interpolant
    }

    /// Adds a step if all its numbers are finite; returns whether they are. `coefficients` is scratch memory.
    pub(super) fn add(&mut self, step: &Step<'_>, coefficients: &mut Vec<f64>) -> bool {
        let own = step.interpolant.degree();
        coefficients.resize(own * step.y.len(), 0.0);
        step.coefficients(coefficients);
        if !all_finite(coefficients) {
            return false;
        }
        if own > self.degree {
            self.raise(own);
        }
        if own == self.degree {
            self.c.extend_from_slice(coefficients);
        } else {
            // rows of a lower degree are padded with zeros
            for row in coefficients.chunks_exact(own) {
                self.c.extend_from_slice(row);
                self.c.resize(self.c.len() + self.degree - own, 0.0);
            }
        }
        self.t.push(step.t);
        self.y.extend_from_slice(step.y_old);
        true
    }

    /// Pads all rows for a higher degree.
    fn raise(&mut self, degree: usize) {
        if !self.c.is_empty() {
            let mut c = Vec::with_capacity(self.c.len() / self.degree * degree);
            for row in self.c.chunks_exact(self.degree) {
                c.extend_from_slice(row);
                c.resize(c.len() + degree - self.degree, 0.0);
            }
            self.c = c;
        }
        self.degree = degree;
    }
}

/// The data of an interpolant of some steps: y(t_old + θ h) = y_old + h Σ_k c_k θ^(k+1) in every step.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a> {
    /// Step boundaries, one more than steps; descending if the independent variable falls.
    pub t: &'a [f64],
    /// y at the start of each step, rows of n_y.
    pub y: &'a [f64],
    /// Coefficients of θ … θᵈ: for each step, n_y rows of length d.
    pub c: &'a [f64],
    /// Length of y.
    pub n_y: usize,
    /// The degree d.
    pub degree: usize,
}

impl Steps<'_> {
    /// The rows y at times. At the boundary of two steps the later step is used.
    ///
    /// # Panics
    /// If there is no step.
    pub fn at(&self, times: &[f64]) -> Vec<f64> {
        // with a constant degree, the loop over it unrolls
        match self.degree {
            4 => self.rows(times, 4),
            7 => self.rows(times, 7),
            degree => self.rows(times, degree),
        }
    }

    #[inline(always)]
    fn rows(&self, times: &[f64], degree: usize) -> Vec<f64> {
        let Self { t: bounds, n_y, .. } = *self;
        let steps = bounds.len() - 1;
        let falls = bounds[steps] < bounds[0];
        let mut found = vec![0.0; times.len() * n_y];
        for (&t, out) in times.iter().zip(found.chunks_exact_mut(n_y.max(1))) {
            let after =
                bounds.partition_point(|bound| if falls { *bound >= t } else { *bound <= t });
            let step = after.clamp(1, steps) - 1;
            let h = bounds[step + 1] - bounds[step];
            let theta = (t - bounds[step]) / if h == 0.0 { 1.0 } else { h };
            let c = self.c[step * n_y * degree..(step + 1) * n_y * degree].chunks_exact(degree);
            let y = &self.y[step * n_y..(step + 1) * n_y];
            let horner =
                |row: &[f64]| row.iter().rev().fold(0.0, |total: f64, c| (total + c) * theta);
            for ((out, y), row) in out.iter_mut().zip(y).zip(c) {
                *out = y + h * horner(&row[..degree]);
            }
        }
        found
    }
}
