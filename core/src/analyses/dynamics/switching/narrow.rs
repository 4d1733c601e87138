//! Pieces that a step enters at its beginning and leaves before its first sample: narrow pieces, left through their
//! other boundary, and pieces where the motion turns back at once, as in a short flight between two contacts.

use super::Switching;
use crate::integrate::Step;
use crate::model::Model;

/// Number of halvings of a step in the search for a short stay in a piece.
const HALVINGS: i32 = 20;

impl Switching {
    /// The functions of all switches at a time of a step.
    pub(super) fn evaluate_at(&mut self, model: &Model, step: &Step<'_>, t: f64) {
        let mut y = step.y.to_vec();
        if t != step.t {
            step.interpolate(t, &mut y);
        }
        self.evaluate(model, t, &y);
    }

    /// The first of the given switches that left its piece: its time, the switch, and the piece beyond.
    pub(super) fn first_through(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        indices: &[usize],
    ) -> Option<(f64, usize, f64)> {
        let sign = self.sign;
        let found = indices.iter().filter_map(|index| {
            let k = self.on_state[*index];
            self.through(model, step, k).or_else(|| self.back(model, step, k))
        });
        found.min_by(|a, b| (sign * a.0).total_cmp(&(sign * b.0)))
    }

    /// The time at which a switch left a narrow piece that it entered at the beginning of a step, and the next piece.
    fn through(&mut self, model: &Model, step: &Step<'_>, k: usize) -> Option<(f64, usize, f64)> {
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

    /// The time at which a switch left a piece in which it was only briefly, and the next piece.
    fn back(&mut self, model: &Model, step: &Step<'_>, k: usize) -> Option<(f64, usize, f64)> {
        let boundaries = &model.switches[k].boundaries;
        let piece = self.pieces[k];
        let mut is_within = |t: f64| {
            self.evaluate_at(model, step, t);
            boundaries.margin(self.sigma[k], piece) > 0.0
        };
        let after = |halvings: i32| step.t_old + 0.5_f64.powi(halvings) * (step.t - step.t_old);
        let halvings = (1..=HALVINGS).find(|halvings| is_within(after(*halvings)))?;
        let (mut a, mut b) = (after(halvings), after(halvings - 1));
        let spacing = 4.0 * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        while (b - a).abs() > spacing {
            let middle = a + 0.5 * (b - a);
            *(if is_within(middle) { &mut a } else { &mut b }) = middle;
        }
        self.evaluate_at(model, step, b);
        Some((b, k, boundaries.next(self.sigma[k], piece)))
    }
}
