//! What a run keeps for the wanted statistics. States are reported after the steps, so the steps stay the same.

use super::Statistic;
use crate::analyses::dynamics::{Options, Stabilization};

/// Outputs that differ by less than this share of their step are one, as for the run itself.
const ROUNDING: f64 = 1e-9;

/// The options of a run from `t0` that keeps no more than the statistics read.
///
/// An interpolant serves statistics that look between the outputs. Final values need the last outputs only. With
/// projection all outputs remain: the tolerance of a projected output depends on the outputs before it.
pub fn kept(options: &Options, wanted: &[Statistic], t0: f64) -> Options {
    let dense_output = options.dense_output && wanted.iter().any(|one| one.looks_between_outputs());
    let is_projected = matches!(options.stabilization, Stabilization::Projection(_));
    let is_last = !is_projected && wanted.iter().all(|one| *one == Statistic::Final);
    let output_step = match is_last {
        true => last_step(options.output_step, options.t_end - t0),
        false => options.output_step,
    };
    Options { dense_output, output_step, ..options.clone() }
}

/// The step of a grid that has the start and the last time of the grid with the step `h`. Where the steps of the solver
/// are reported, it has the start only: the end is always reported.
fn last_step(h: Option<f64>, span: f64) -> Option<f64> {
    match h {
        _ if span <= 0.0 => h,
        Some(h) => Some((span / h + ROUNDING).floor().max(1.0) * h),
        None => Some(2.0 * span),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::Gains;

    #[test]
    fn the_last_output_is_that_of_the_whole_grid() {
        assert_eq!(last_step(Some(0.25), 1.0), Some(1.0));
        assert_eq!(last_step(Some(0.25), 1.1), Some(1.0));
        assert_eq!(last_step(Some(3.0), 1.0), Some(3.0));
        assert_eq!(last_step(None, 1.5), Some(3.0));
        assert_eq!(last_step(None, 0.0), None);
    }

    #[test]
    fn statistics_decide_what_is_kept() {
        let stabilization = Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 });
        let all = Options { output_step: Some(0.1), stabilization, ..Options::new(1.0) };
        let at = |wanted: &[Statistic]| {
            let found = kept(&all, wanted, 0.0);
            (found.dense_output, found.output_step)
        };
        assert_eq!(at(&[Statistic::Final]), (false, Some(1.0)));
        assert_eq!(at(&[Statistic::Final, Statistic::Mean]), (false, Some(0.1)));
        assert_eq!(at(&[Statistic::Final, Statistic::Max]), (true, Some(0.1)));
        let projected = Options { stabilization: Stabilization::default(), ..all };
        assert_eq!(kept(&projected, &[Statistic::Final], 0.0).output_step, Some(0.1));
    }
}
