//! Measures of a motion and their derivatives at given times.

use super::gradient::{OF_BALANCE, OF_RUN};
use super::starts::with_interpolant;
use super::statistics::SlopeRows;
use super::variant::ReadyVariant;
use crate::analyses::measures::Measure;
use crate::analyses::record::Record;
use crate::analyses::sweep::{Outcome, Sweep, VariantRow};

/// Values and derivatives: a row of all measures for each time, and for each measure in it a row of all variables.
pub type AtTimes = (Vec<f64>, Vec<f64>);

impl Sweep {
    /// The measures of a variant at given times, and their derivatives by its variables: first the parameters, then
    /// the entries of `set`. The inner error is the reason for which there are no derivatives.
    ///
    /// # Errors
    /// The outcomes of [`variants`](Self::variants) other than values.
    pub fn slopes_at(
        &self,
        times: &[f64],
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Result<AtTimes, String>, Outcome> {
        let ready = &self.ready(row, stop)?;
        let variant = ReadyVariant { sweep: self, ready, row, stop };
        let record = variant.run(&with_interpolant(&ready.analysis))?;
        let Record { motion: Some(run), driven, .. } = record else {
            return Err(Outcome::Single);
        };
        let ends =
            [&run.trajectory.t[..1], &run.trajectory.t[run.trajectory.t.len() - 1..]].concat();
        let (first, last) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        if let Some(t) = times.iter().find(|t| !(first..=last).contains(*t)) {
            let text = format!("the motion has no value at {t}: it goes from {first} to {last}");
            return Err(Outcome::Failed(text));
        }
        let (whole, rests) = ready.whole(driven);
        let read = |text: &String| Measure::read(whole.model(), text);
        let measures: Result<Vec<Measure>, _> = self.measures.iter().map(read).collect();
        let measures = measures.map_err(|problem| Outcome::Failed(problem.to_string()))?;
        if measures.iter().any(Measure::is_of_balance) {
            return Ok(Err(OF_BALANCE.to_string()));
        }
        let count = measures.len();
        let wanted = (measures, times.to_vec());
        let rows = variant.rows((&whole, &run, rests), wanted);
        Ok(rows.and_then(|rows| match gathered(&rows, times, count)? {
            (values, _) if values.iter().any(|x| x.is_nan()) => Err(OF_RUN.to_string()),
            found => Ok(found),
        }))
    }
}

/// The rows at times. Where the motion changes, a time that is given twice has the rows before and after the change.
fn gathered(rows: &SlopeRows, times: &[f64], count: usize) -> Result<AtTimes, String> {
    let of = |(k, t): (usize, &f64)| match rows.corner(*t) {
        Some(corner) if times.get(k + 1) == Some(t) => Ok(&corner.sides[0]),
        _ => rows.at(*t),
    };
    let all: Vec<_> = times.iter().enumerate().map(of).collect::<Result<_, _>>()?;
    let values = all.iter().flat_map(|row| row.values[..count].iter().map(|of| of[0]));
    let slopes = all.iter().flat_map(|row| row.slopes[..count].iter().flatten().copied());
    Ok((values.collect(), slopes.collect()))
}
