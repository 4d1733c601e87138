//! Narrow pieces, which a step enters at its beginning and leaves before its first sample.

use super::Switching;
use crate::integrate::Step;
use crate::model::Model;

impl Switching {
    /// The functions of all switches at a time of a step.
    pub(super) fn evaluate_at(&mut self, model: &Model, step: &Step<'_>, t: f64) {
        let mut y = step.y.to_vec();
        if t != step.t {
            step.interpolate(t, &mut y);
        }
        self.evaluate(model, t, &y);
    }

    /// The first of the given switches that left a narrow piece: its time, the switch, and the piece beyond.
    pub(super) fn first_through(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        indices: &[usize],
    ) -> Option<(f64, usize, f64)> {
        let sign = self.sign;
        let found = indices.iter().filter_map(|index| self.through(model, step, *index));
        found.min_by(|a, b| (sign * a.0).total_cmp(&(sign * b.0)))
    }

    /// The time at which a switch left a narrow piece that it entered at the beginning of a step, and the piece beyond.
    fn through(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        index: usize,
    ) -> Option<(f64, usize, f64)> {
        let k = self.on_state[index];
        let boundaries = &model.switches[k].boundaries;
        let [low, high] = boundaries.of(self.pieces[k]);
        self.evaluate_at(model, step, step.t_old);
        let above = self.sigma[k] - low < high - self.sigma[k];
        let far = if above { high } else { low };
        let mut is_beyond = |t: f64| {
            self.evaluate_at(model, step, t);
            if above {
                self.sigma[k] > far
            } else {
                self.sigma[k] < far
            }
        };
        let (mut a, mut b) = (step.t_old, step.t_old + 0.5 * (step.t - step.t_old));
        if is_beyond(a) || !is_beyond(b) {
            return None;
        }
        let spacing = 4.0 * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        while (b - a).abs() > spacing {
            let middle = a + 0.5 * (b - a);
            *(if is_beyond(middle) { &mut b } else { &mut a }) = middle;
        }
        // the far boundary of a half line is infinite, and never passed
        Some((b, k, boundaries.beside(far, above)))
    }
}
