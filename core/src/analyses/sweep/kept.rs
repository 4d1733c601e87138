//! The output that a run stores for the requested statistics. The choice of the output does not change the steps.

use super::statistic::Statistic;
use crate::analyses::dynamics::Options;

/// The options of a run from `t0` that stores only the output that the statistics need.
///
/// The interpolant is stored for statistics that depend on values between the outputs. Final values need only the
/// end, which is reported for every output step, and so do extreme values and integrals on the interpolant if
/// `reads_grid`: the outputs beside extreme values are then read from it.
pub fn kept(options: &Options, wanted: &[Statistic], t0: f64, reads_grid: bool) -> Options {
    let dense_output = options.dense_output && wanted.iter().any(|one| one.looks_between_outputs());
    let span = (options.t_end - t0).abs();
    let on_interpolant =
        |one: &Statistic| reads_grid && dense_output && (one.is_extreme() || one.is_integral());
    let is_last = |one: &Statistic| *one == Statistic::Final || on_interpolant(one);
    let is_last = span > 0.0 && wanted.iter().all(is_last);
    let output_step = if is_last { Some(2.0 * span) } else { options.output_step };
    Options { dense_output, output_step, ..options.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_decide_what_is_kept() {
        let all = Options { output_step: Some(0.1), ..Options::new(1.0) };
        let at = |wanted: &[Statistic]| {
            let found = kept(&all, wanted, 0.25, false);
            (found.dense_output, found.output_step)
        };
        assert_eq!(at(&[Statistic::Final]), (false, Some(1.5)), "beyond the end");
        assert_eq!(at(&[Statistic::Final, Statistic::Mean]), (true, Some(0.1)));
        assert_eq!(at(&[Statistic::Final, Statistic::Max]), (true, Some(0.1)));
        let from_grid = kept(&all, &[Statistic::Rms, Statistic::Max], 0.25, true);
        assert_eq!((from_grid.dense_output, from_grid.output_step), (true, Some(1.5)));
        let nothing = Options { t_end: 0.25, ..all };
        assert_eq!(
            kept(&nothing, &[Statistic::Final], 0.25, true).output_step,
            Some(0.1),
            "no motion"
        );
    }
}
