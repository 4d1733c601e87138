//! The outcomes of variants.

use super::fine::Between;
use super::readings::{Missing, Readings};
use super::request::{Outcome, Sweep, VariantRow, Wanted};
use super::series::Series;
use super::variant::Ready;
use crate::analyses::dynamics::{can_stick, side_by_side, RunOutcome, Variant};
use crate::analyses::measures::Measure;
use crate::analyses::record::{self, Record};
use crate::analyses::AnyAnalysis;
use crate::integrate::Flow;
use crate::math::{each, Listed};

impl Sweep {
    /// Runs variants, each with its own values of some parameters and of some entries of `set`. Where it is faster,
    /// several runs are integrated side by side, with the same results.
    ///
    /// `stop` is called from time to time and stops the work if it returns true.
    pub fn variants(&self, rows: &[VariantRow], stop: &(dyn Fn() -> bool + Sync)) -> Vec<Outcome> {
        let ready: Vec<_> = rows.iter().map(|row| self.ready(row, stop)).list();
        let mut outcomes: Vec<_> = ready.iter().map(|ready| ready.as_ref().err().cloned()).list();
        let (places, variants): (Vec<_>, Vec<_>) =
            ready.iter().enumerate().filter_map(beside).unzip();
        let watch = || if stop() { Flow::Stop } else { Flow::Continue };
        side_by_side(&variants, &watch, &mut |k, run| {
            let of = ready[places[k]].as_ref().ok();
            outcomes[places[k]] = of.map(|ready| self.outcome(ready, Some(run), stop));
        });
        let left =
            outcomes.into_iter().zip(&ready).map(|(outcome, ready)| match (outcome, ready) {
                (None, Ok(ready)) => self.outcome(ready, None, stop),
                (outcome, _) => outcome.unwrap_or(Outcome::Single),
            });
        left.list()
    }

    /// The outcome of a variant. The variant is run here if `run` is None.
    fn outcome(&self, ready: &Ready, run: Option<RunOutcome>, stop: &dyn Fn() -> bool) -> Outcome {
        let found = match run {
            Some(Ok(run)) => Ok(Record::of_motion(run, &ready.start, String::new())),
            Some(Err(failure)) => Err(failure.reason.into()),
            None => self.run(ready, &ready.kept, stop),
        };
        let found = match found {
            // the run is repeated with all outputs, because its failure may occur at one of them
            Err(_) if ready.kept != ready.analysis => self.run(ready, &ready.analysis, stop),
            found => found,
        };
        match found {
            _ if stop() => Outcome::Stopped,
            Ok(record) => self.numbers(ready, record).map_or_else(Outcome::from, Outcome::Values),
            Err(reason) => reason.into(),
        }
    }

    /// The numbers of a result.
    fn numbers(&self, ready: &Ready, record: Record) -> Result<Vec<f64>, Missing> {
        let is_dynamics = matches!(ready.analysis, AnyAnalysis::Dynamics(_));
        if !is_dynamics && self.reads_quantities() && can_stick(ready.prepared.model()) {
            return Err(Missing::Single);
        }
        let Record { motion: Some(run), driven, responses, .. } = record else {
            let subject = self.subject(ready);
            let number = |one: &Wanted| match one {
                Wanted::Number(text) => ready.analysis.number(&subject, &record, text),
                Wanted::Statistic(..) => Ok(f64::NAN),
            };
            let found: Result<_, record::Outcome> = self.wanted.iter().map(number).collect();
            return found.map_err(|reason| Missing::Failed(reason.message));
        };
        // with all outputs, the run needs no others
        let grid = ready.grid.filter(|_| run.trajectory.t.len() == 2);
        let (whole, rests) = ready.whole(driven);
        self.of_motion(Readings::new(&whole, &run, rests, grid)?.solved_by(responses))
    }

    /// The statistics of a motion.
    fn of_motion(&self, readings: Readings<'_>) -> Result<Vec<f64>, Missing> {
        let between = self.between(readings)?;
        let series = (0..self.measures.len()).map(|k| Series::new(&between, k));
        let series = series.collect::<Result<Vec<_>, _>>()?;
        self.statistics().map(|(of, statistic)| series[of].statistic(statistic)).collect()
    }

    /// The measures of a motion at its outputs and between them.
    pub fn between<'a>(&self, readings: Readings<'a>) -> Result<Between<'a>, Missing> {
        let measures = self.measures.iter().enumerate().map(|(k, text)| {
            // measures are read for each variant, because the position of a point may depend on a parameter
            let measure = Measure::read(readings.model(), text).map_err(|_| Missing::Single)?;
            let own = self.statistics().filter(|(of, _)| *of == k);
            let own = own.map(|(_, one)| {
                let [most, least] = one.extremes();
                [most, least, one.is_integral()]
            });
            let mut all = own.fold([false; 3], |all, own| each([0, 1, 2], |k| all[k] || own[k]));
            if measure.is_of_run() {
                all = [false, false, all[2] && !measure.is_at_outputs()];
            }
            Ok((measure, all))
        });
        let (measures, wanted) = measures.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
        Ok(Between::new(readings.of(measures, wanted)))
    }
}

/// A run that can be integrated beside others, with the index of its variant.
fn beside((place, ready): (usize, &Result<Ready, Outcome>)) -> Option<(usize, Variant<'_>)> {
    let Ready { prepared, start, kept: AnyAnalysis::Dynamics(options), after, .. } =
        ready.as_ref().ok()?
    else {
        return None;
    };
    let variant = Variant { prepared, start: &start.state, options };
    (!after && variant.serves()).then_some((place, variant))
}
