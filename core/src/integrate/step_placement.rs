//! Steps that avoid a time near which noise dominates the derivative.
//!
//! A step passes such an obstacle within its widest gap between stages, with the obstacle in the middle of the gap.
//! If the obstacle is too far ahead, a shorter step comes first and ends where the passing step must begin.
//!
//! Stages near the obstacle contain noise. In stages far from it, a deviation from the constraints has a larger
//! effect. Therefore a passing step has an optimal length. If its error is still too large, shorter steps only
//! contain more noise, and the step is accepted.

use super::step_size::Control;

/// Largest distance of an obstacle from the middle of the gap, as a fraction of the half-width of the gap.
const OFF: f64 = 0.8;
/// A step is unchanged if the obstacle lies beyond its end by at least this fraction of the distance from its start
/// to the middle of the gap.
const BEFORE: f64 = 0.7;
/// Largest factor by which a step may grow to pass an obstacle.
const LONGER: f64 = 1.1;
/// A step is unchanged if the obstacle lies behind its start, or beyond it by at most this fraction of the step.
const BEHIND: f64 = 0.04;
/// Shortest placed or resumed step, as a fraction of the proposed step.
const LEAST: f64 = 0.05;
/// Largest number of placements of a step.
const MOST: usize = 3;
/// Factor on error norms after an obstacle was met. Near an obstacle only the tangential part of an error counts, and
/// this part is determined at one state for all stages.
const STRICT: f64 = 2.5;

/// A shorter passing step is tried only if the last one was better than the best earlier one by this factor.
const BETTER: f64 = 4.0;
/// Largest relative error of a step that is accepted because shorter steps are not better.
const AT_BEST: f64 = 1e-6;

/// The widest gap between the stages of a step and its extension, in fractions of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub middle: f64,
    pub half: f64,
}

/// The obstacles of an integration, and the placement of the current step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct StepPlacement {
    met: bool,
    tried: usize,
    /// The step size to resume with; 0 if the step was not placed.
    resumed: f64,
    /// Whether the current trial is placed to pass the obstacle.
    passing: bool,
    /// Smallest error norm of the rejected trials that pass the obstacle. None if there was no such trial.
    least: Option<f64>,
}

impl StepPlacement {
    /// Whether no obstacle was met and none is being passed.
    #[inline]
    pub fn is_idle(&self) -> bool {
        *self == Self::default()
    }

    /// Prepares the placement before the first trial of a step.
    #[inline]
    pub fn begin(&mut self) {
        let least = self.least.filter(|_| self.tried > 0);
        *self = Self { met: self.met, least, ..Self::default() };
    }

    /// Whether the current trial is accepted although its error norm is too large. It is accepted if it passes the
    /// obstacle and similar trials were not much worse.
    pub fn at_best(&mut self, norm: f64, rtol: f64) -> bool {
        if !std::mem::take(&mut self.passing) || !norm.is_finite() {
            return false;
        }
        let best = self.least.is_some_and(|least| BETTER * norm > least);
        self.least = Some(self.least.map_or(norm, |least| least.min(norm)));
        best && norm * rtol < AT_BEST
    }

    /// The step to try instead of a step of magnitude `h`. The obstacle is `ahead` of the start of the step (negative
    /// if it lies behind), and `left` is the distance to the end of the integration.
    pub fn instead(&mut self, gap: Gap, h: f64, ahead: f64, left: f64) -> Option<f64> {
        self.met |= ahead > 0.0 && ahead < h;
        let Gap { middle, half } = gap;
        let free = ahead <= BEHIND * h
            || (ahead - middle * h).abs() <= OFF * half * h
            || ahead >= (1.0 + BEFORE * middle) * h;
        if free || self.tried == MOST {
            return None;
        }
        let passing = h.min((left - ahead) / (1.0 - middle));
        let passes = ahead < LONGER * middle * h;
        let placed = match passes {
            true => (ahead / middle).min(left),
            false => ahead - middle * passing,
        };
        if passing < LEAST * h || placed < LEAST * h || (placed - h).abs() < LEAST * LEAST * h {
            return None;
        }
        self.tried += 1;
        self.passing = passes;
        self.resumed = self.resumed.max(passing);
        Some(placed)
    }

    /// The step-size controller. After an obstacle was met it is the elementary one, since noise near an obstacle
    /// defeats a low safety factor.
    #[inline]
    pub fn control(&self, otherwise: Control) -> Control {
        if self.met {
            Control::ELEMENTARY
        } else {
            otherwise
        }
    }

    /// Factor on error norms.
    #[inline]
    pub fn strictness(&self) -> f64 {
        if self.met {
            STRICT
        } else {
            1.0
        }
    }

    /// The size of the step after an accepted step whose error allows `next`.
    #[inline]
    pub fn resume(&self, next: f64) -> f64 {
        next.max(self.resumed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAP: Gap = Gap { middle: 0.5, half: 0.1 };

    #[test]
    fn what_lies_in_the_gap_or_out_of_reach_is_passed_as_it_is() {
        for ahead in [-1.0, 0.01, 0.43, 0.5, 0.57, 1.4, 9.0] {
            assert_eq!(StepPlacement::default().instead(GAP, 1.0, ahead, 10.0), None, "{ahead}");
        }
    }

    #[test]
    fn a_shorter_step_passes_what_lies_near() {
        let mut placement = StepPlacement::default();
        assert_eq!(placement.instead(GAP, 1.0, 0.25, 10.0), Some(0.5));
        assert_eq!(placement.resume(0.6), 1.0);
    }

    #[test]
    fn a_step_before_is_as_long_as_leaves_room_for_the_one_that_passes() {
        for ahead in [0.8, 1.0, 1.2] {
            let placed = StepPlacement::default().instead(GAP, 1.0, ahead, 10.0).expect("placed");
            assert!((ahead - placed - 0.5).abs() < 1e-15, "{ahead}");
        }
    }

    #[test]
    fn at_the_end_of_the_run_the_step_that_passes_fits() {
        let mut placement = StepPlacement::default();
        let placed = placement.instead(GAP, 1.0, 0.8, 1.0).expect("placed");
        assert!((placed + placement.resume(0.0) - 1.0).abs() < 1e-15);
        assert_eq!(StepPlacement::default().instead(GAP, 1.0, 1.0, 1.0), None);
    }

    #[test]
    fn a_step_that_passes_is_taken_once_its_like_does_not_get_better() {
        let mut placement = StepPlacement::default();
        let mut at_best = |norm: f64| {
            placement.begin();
            placement.instead(GAP, 1.0, 0.25, 10.0).expect("placed to pass");
            placement.at_best(norm, 1e-10)
        };
        assert!(!at_best(900.0)); // the first
        assert!(!at_best(90.0)); // better by ten
        assert!(!at_best(f64::NAN));
        assert!(at_best(30.0));
        assert!(!at_best(1e5)); // no better, but too bad
    }

    #[test]
    fn of_other_steps_none_is_taken_with_too_large_an_error() {
        let mut placement = StepPlacement::default();
        placement.instead(GAP, 1.0, 1.0, 10.0).expect("a step before");
        assert!(!placement.at_best(9.0, 1e-10) && !placement.at_best(9.0, 1e-10));
        // nor if the earlier trials belong to another obstacle
        placement.instead(GAP, 1.0, 0.25, 10.0).expect("placed to pass");
        assert!(!placement.at_best(9.0, 1e-10));
        placement.begin();
        placement.begin();
        placement.instead(GAP, 1.0, 0.25, 10.0).expect("placed to pass");
        assert!(!placement.at_best(9.0, 1e-10));
    }

    #[test]
    fn it_ends_after_a_few_trials() {
        let mut placement = StepPlacement::default();
        let trials = (0..10).filter(|_| placement.instead(GAP, 1.0, 1.0, 10.0).is_some());
        assert_eq!(trials.count(), MOST);
    }
}
