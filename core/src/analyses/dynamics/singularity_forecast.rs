//! Forecast of the time of a singular position, from the least pivot so far.
//!
//! If Φ_q loses rank at t_s, a pivot of Φ_q M⁻¹ Φ_qᵀ tends to zero as (t - t_s)². Its square root falls linearly to
//! zero, and the pivot itself is a parabola with its vertex at t_s. Both give t_s well before a step reaches it.

use crate::math::Ordered;

/// Largest pivot at the vertex of the parabola, as a fraction of the pivots beside it. A position with a larger pivot
/// is regular.
const DEEP: f64 = 0.05;
/// Samples closer to each other than this fraction of a step add no information.
const APART: f64 = 0.01;

/// Smallest reduction of the pivot on the way to a singular position within two steps: the square of two.
const NEARER: f64 = 4.0;

/// Distance from a passed singular position, in steps, within which a step is still close to it.
const LEFT: f64 = 4.0;

/// Largest number of stages of a trial; constant steps have no forecast.
const MOST: usize = 64;

/// A time, and the least ratio of a pivot to its largest summand, or another number that vanishes as its square does.
type Sample = (f64, f64);

/// The samples since the start of the step.
#[derive(Clone, Debug, Default)]
pub(super) struct SingularityForecast {
    /// At the start of the current step.
    start: Option<Sample>,
    /// At stages of the current trial.
    stages: Vec<Sample>,
    /// At, or near, the end of the last trial.
    end: Option<Sample>,
    /// The singular position within two steps from the start of the last trial.
    position: Option<f64>,
    /// The last singular position that was foreseen, until it lies [`LEFT`] steps behind.
    close: Option<f64>,
}

impl SingularityForecast {
    /// Begins a forecast at the start of the run.
    pub fn begin(&mut self, start: Option<Sample>) {
        *self = Self { start, ..Self::default() };
    }

    /// Whether a singular position is in reach, so that stages must be sampled.
    pub fn in_reach(&self) -> bool {
        self.position.is_some() || !self.stages.is_empty()
    }

    /// Whether a singular position was foreseen, or passed a few steps ago.
    pub fn is_close(&self) -> bool {
        self.in_reach() || self.close.is_some()
    }

    /// Whether a forecast singular position lies between the start of the current trial and `t`.
    pub fn is_behind(&self, t: f64) -> bool {
        let from = self.start.map_or(f64::NAN, |(from, _)| from);
        self.position.is_some_and(|position| (position - t) * (position - from) <= 0.0)
    }

    /// Adds a stage of the current trial.
    pub fn pass(&mut self, stage: Sample) {
        if self.stages.len() == MOST {
            self.stages.clear();
        }
        self.stages.push(stage);
    }

    /// Whether the end of a trial shows that no singular position lies within two steps of its start.
    pub fn is_clear(&self, end: Sample) -> bool {
        self.stages.is_empty() && self.start.is_none_or(|start| NEARER * end.1 > start.1)
    }

    /// Ends a trial. Returns the time of a singular position within two steps of its start.
    pub fn foresee(&mut self, end: Sample) -> Option<f64> {
        let stages = std::mem::take(&mut self.stages);
        self.end = Some(end);
        let start = self.start?;
        if stages.is_empty() && NEARER * end.1 > start.1 {
            self.position = None; // further than two steps, or behind
            return None;
        }
        let step = end.0 - start.0;
        let mut samples = vec![start];
        samples.extend(stages);
        samples.push(end);
        samples.order_by(|a, b| ((a.0 - b.0) * step).total_cmp(&0.0));
        samples.dedup_by(|a, b| (a.0 - b.0).abs() < APART * step.abs());
        let reached = |t: &f64| (0.0..2.0).contains(&((t - start.0) / step));
        self.position = vanishing(&samples).filter(reached);
        self.close = self.position.or(self.close);
        self.position
    }

    /// Accepts the last trial, with the sample at its end; the trial evaluated only a nearby state. Returns the time
    /// of a singular position that the trial passed.
    pub fn accept(&mut self, end: Option<Sample>) -> Option<f64> {
        self.end = end.or(self.end);
        let mut passed = None;
        if let (Some(start), Some(end)) = (self.start, self.end) {
            let step = end.0 - start.0;
            let ahead = self.position.filter(|t| (t - end.0) * step > 0.0);
            let behind = self.position.filter(|t| (t - end.0) * step <= 0.0);
            passed = behind.filter(|t| (t - start.0) * step >= 0.0);
            self.position = ahead;
            self.close = self.close.filter(|t| (end.0 - t) * step <= LEFT * step * step);
        }
        self.start = self.end;
        passed
    }
}

/// The time at which the pivot vanishes. The samples are in the order of the motion.
fn vanishing(samples: &[Sample]) -> Option<f64> {
    let least = (1..samples.len()).min_by(|a, b| samples[*a].1.total_cmp(&samples[*b].1))?;
    let (t, ratio) = samples[least];
    let (t_before, before) = samples[least - 1];
    if before <= ratio {
        return None;
    }
    let Some((t_after, after)) = samples.get(least + 1) else {
        let (mut root, root_before) = (ratio.sqrt(), before.sqrt());
        // the last sample lies behind the singular position if the line through the two before ends below zero
        if let Some((t_first, first)) = least.checked_sub(2).map(|k| samples[k]) {
            let slope = (root_before - first.sqrt()) / (t_before - t_first);
            root = root.copysign(root_before + slope * (t - t_before));
        }
        return Some(t + root * (t - t_before) / (root_before - root));
    };
    // Newton's form of the interpolation through three points
    let (left, right) = ((before - ratio) / (t_before - t), (after - ratio) / (t_after - t));
    let curvature = (right - left) / (t_after - t_before);
    let slope = right - curvature * (t_after - t);
    let bottom = ratio - 0.25 * slope * slope / curvature;
    (bottom <= DEEP * before.max(*after)).then(|| t - 0.5 * slope / curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pivot that vanishes at 0.3.
    fn pivot(t: f64) -> Sample {
        (t, 2.0 * (t - 0.3_f64).sin().powi(2))
    }

    fn foreseen(times: &[f64], from: f64, to: f64) -> Option<f64> {
        let mut approach = SingularityForecast::default();
        approach.begin(Some(pivot(from)));
        times.iter().for_each(|t| approach.pass(pivot(*t)));
        approach.foresee(pivot(to))
    }

    #[test]
    fn it_is_found_before_within_and_backward() {
        for (times, from, to, error) in [
            (vec![], 0.0, 0.2, 5e-3),
            (vec![0.12, 0.28], 0.0, 0.6, 5e-3),
            (vec![0.5, 0.32, 0.33], 0.6, 0.0, 5e-3),
            (vec![], 0.5, 0.38, 5e-3),
        ] {
            let t = foreseen(&times, from, to).expect("it lies ahead");
            assert!((t - 0.3).abs() < error, "{times:?}: {t}");
        }
    }

    #[test]
    fn what_is_behind_far_or_shallow_is_none() {
        assert_eq!(foreseen(&[0.5], 0.4, 0.6), None);
        assert_eq!(foreseen(&[], -1.0, -0.9), None);
        let mut approach = SingularityForecast::default();
        approach.begin(Some((0.0, 0.5)));
        approach.pass((0.1, 0.2));
        assert_eq!(approach.foresee((0.2, 0.5)), None);
    }

    #[test]
    fn it_stays_in_reach_until_it_is_passed() {
        let mut approach = SingularityForecast::default();
        approach.begin(Some(pivot(0.0)));
        assert!(approach.foresee(pivot(0.2)).is_some());
        approach.accept(Some(pivot(0.2)));
        assert!(approach.in_reach());
        assert!(!approach.is_behind(0.29) && approach.is_behind(0.31));
        approach.pass(pivot(0.29));
        assert!(approach.foresee(pivot(0.4)).is_some());
        approach.accept(Some(pivot(0.4)));
        assert!(!approach.in_reach());
    }
}
