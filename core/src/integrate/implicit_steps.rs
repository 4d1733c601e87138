//! The last accepted step of an implicit method, and the state at its end.

use super::interpolant::Interpolant;
use super::step::Step;

/// Both ends of the last accepted step, with the rows of its interpolant.
pub(super) struct ImplicitSteps {
    /// The beginning of the step.
    pub t: f64,
    pub t_end: f64,
    /// The end of the step. None until the step is accepted.
    accepted: Option<f64>,
    pub y: Vec<f64>,
    pub y_new: Vec<f64>,
    /// Derivatives at both ends.
    pub dy: Vec<f64>,
    /// Rows of the interpolant, each of the length of y.
    pub rows: Vec<f64>,
}

impl ImplicitSteps {
    /// Begins with `y` at `t0`. `rows` is the number of rows of the interpolant.
    pub fn new((t0, t_end): (f64, f64), y: &[f64], rows: usize) -> Self {
        let len = y.len();
        Self {
            t: t0,
            t_end,
            accepted: None,
            y: y.to_vec(),
            y_new: vec![0.0; len],
            dy: vec![0.0; 2 * len],
            rows: vec![0.0; rows * len],
        }
    }

    pub fn direction(&self) -> f64 {
        (self.t_end - self.t).signum()
    }

    /// Marks the step to `t` as accepted. All other data of the step are already set.
    pub fn accept(&mut self, t: f64) {
        self.accepted = Some(t);
    }

    /// Advances to the beginning of the next step.
    pub fn move_on(&mut self) {
        if let Some(t) = self.accepted.take() {
            self.t = t;
            std::mem::swap(&mut self.y, &mut self.y_new);
        }
        assert!(self.t != self.t_end, "a step beyond t_end");
    }

    /// Continues from another state.
    pub fn restart(&mut self, t: f64, y: &[f64]) {
        (self.t, self.accepted) = (t, None);
        self.y.copy_from_slice(y);
    }

    /// Time reached.
    pub fn t(&self) -> f64 {
        self.accepted.unwrap_or(self.t)
    }

    /// State reached.
    pub fn y(&self) -> &[f64] {
        match self.accepted {
            Some(_) => &self.y_new,
            None => &self.y,
        }
    }

    /// The last step, with the interpolant of the given table and degree.
    pub fn view(&self, table: &'static [f64], degree: usize) -> Option<Step<'_>> {
        let (dy_old, dy) = self.dy.split_at(self.y.len());
        self.accepted.map(|t| Step {
            t_old: self.t,
            t,
            y_old: &self.y,
            y: &self.y_new,
            dy_old,
            dy,
            interpolant: Interpolant::new(&self.rows, self.y.len(), table, degree),
        })
    }
}
