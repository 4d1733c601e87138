//! Statistics of measures with derivatives.

use super::reader::{Corner, Reader, SlopeRow};
use super::run_ends::DOUBTFUL;
use crate::analyses::statistics::{Extreme, Integrals, BAND, RIVAL};
use crate::analyses::sweep::{Series, Statistic};
use crate::math::{Listed, Ordered, ShortArray};

/// Distance of the times that give the second derivative at an extreme value, in steps of the run.
const BESIDE: f64 = 1.0 / 32.0;
/// Accuracy of the time of an extreme value, in steps of the run.
const SEARCHED: f64 = 1e-4;

/// Error of a coordinate, relative to the size of the mechanism or to a radian, from which derivatives do not belong to the
/// motion.
const LOST: f64 = 1.0;

/// The derivatives of a number by each variable, or the reason for which there are none.
pub(super) type Found = Result<Vec<f64>, String>;

/// What a statistic needs.
pub(super) enum SlopePlan {
    /// The value at the last time.
    Final(f64),
    /// The largest or the least value, with the times of rivals.
    Extreme(Extreme, Vec<f64>),
    /// The time of the largest or the least value.
    TimeOf(Extreme, Vec<f64>),
    /// The largest value, the least value or the largest magnitude at the outputs.
    Outputs(Statistic),
    /// An integral, a mean or a root mean square, from values at points with weights.
    Integral(Statistic, Integrals),
    /// The settling time, the time of the largest deviation, and the last time.
    Settling([f64; 3]),
    /// The reason for which there is no derivative.
    None(String),
    Zero,
}

/// The length of the steps near a time, and the ends of the run.
#[derive(Clone, Copy)]
pub(super) struct RunTimes<'a> {
    pub outputs: &'a [f64],
    pub steps: &'a [f64],
    /// The times at which the motion changes.
    pub changes: &'a [f64],
}

impl RunTimes<'_> {
    pub(super) fn step(&self, t: f64) -> f64 {
        let ends = self.steps.len() - 1;
        let after = self.steps.partition_point(|end| *end <= t).clamp(1, ends.max(1));
        match ends {
            0 => 0.0,
            _ => self.steps[after] - self.steps[after - 1],
        }
    }

    /// The end of the run that is so near to a time that an extreme value may be at the end itself.
    pub(super) fn near_end(&self, t: f64) -> Option<f64> {
        let ends = [self.outputs[0], self.outputs[self.outputs.len() - 1]];
        ends.into_iter().find(|end| (end - t).abs() <= SEARCHED * self.step(t))
    }

    /// A time, or the time of a change of the motion if it is there up to the accuracy of the search.
    fn at_change(&self, t: f64) -> f64 {
        let next = self.changes.partition_point(|change| *change < t);
        let beside = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let near = |change: &f64| (change - t).abs() <= SEARCHED * self.step(*change);
        beside.filter_map(|k| self.changes.get(k).copied()).find(near).unwrap_or(t)
    }

    /// Times around an extreme value.
    pub(super) fn beside(&self, t: f64) -> [f64; 4] {
        let last = self.outputs.len() - 1;
        let next = self.changes.partition_point(|change| *change <= t);
        let before = next.checked_sub(1).map_or(self.outputs[0], |k| self.changes[k]);
        let after = self.changes.get(next).copied().unwrap_or(self.outputs[last]);
        let room = (t - before).min(after - t) / 2.0;
        let d = (BESIDE * self.step(t)).min(room);
        [t - 2.0 * d, t - d, t + d, t + 2.0 * d]
    }
}

impl SlopePlan {
    /// The plan of a statistic.
    pub fn of(series: &Series<'_>, statistic: Statistic, times: RunTimes<'_>) -> Self {
        let extreme = |place: usize| {
            let (mut most, mut rivals) = series.known(place).ok().cloned()?;
            most.t = times.at_change(most.t);
            rivals.iter_mut().for_each(|t| *t = times.at_change(*t));
            rivals.retain(|t| *t != most.t);
            Some((most, rivals))
        };
        let missing = || Self::None("the number itself is not known".to_string());
        let last = times.outputs[times.outputs.len() - 1];
        match statistic {
            Statistic::Final => Self::Final(last),
            Statistic::Integral | Statistic::Mean | Statistic::Rms => {
                Self::of_integral(series, statistic).unwrap_or_else(missing)
            }
            Statistic::Max | Statistic::Min => {
                let place = usize::from(statistic == Statistic::Min);
                extreme(place).map_or_else(missing, |(at, rivals)| Self::Extreme(at, rivals))
            }
            Statistic::TimeOfMax | Statistic::TimeOfMin => {
                let place = usize::from(statistic == Statistic::TimeOfMin);
                extreme(place).map_or_else(missing, |(at, rivals)| Self::TimeOf(at, rivals))
            }
            Statistic::Peak => match (extreme(0), extreme(1)) {
                (Some(most), Some(least)) => Self::of_peak(most, least),
                _ => missing(),
            },
            Statistic::Settling => match series.statistic(statistic) {
                Ok(t) if t.is_nan() => Self::None("the motion does not settle".to_string()),
                Ok(t) if t == times.outputs[0] => Self::Zero,
                Ok(t) => {
                    let values = series.outputs();
                    let end = values[values.len() - 1];
                    let away = |k: usize| (values[k] - end).abs();
                    let later = |best, k| if away(k) > away(best) { k } else { best };
                    Self::Settling([t, times.outputs[(0..values.len()).fold(0, later)], last])
                }
                Err(_) => missing(),
            },
        }
    }

    /// The plan of a statistic of a quantity of a whole run, which has values at the outputs. Its integrals are known if
    /// there is a series.
    pub fn of_run(series: Option<&Series<'_>>, statistic: Statistic, times: RunTimes<'_>) -> Self {
        match (statistic, series) {
            (Statistic::Final, _) => Self::Final(times.outputs[times.outputs.len() - 1]),
            (Statistic::Max | Statistic::Min | Statistic::Peak, _) => Self::Outputs(statistic),
            (one, Some(series)) if one.is_integral() => Self::of(series, one, times),
            (one, None) if one.is_integral() => {
                Self::None("it is a sum over the outputs, whose times may move".to_string())
            }
            _ => Self::None("it is the time of an output, which changes in steps".to_string()),
        }
    }

    /// The plan of the largest magnitude, from the largest and the least value.
    fn of_peak(most: (Extreme, Vec<f64>), least: (Extreme, Vec<f64>)) -> Self {
        let [high, low] = [most.0, least.0].each(|one| one.value.abs());
        let equal = (high - low).abs() <= RIVAL * high.max(low) && most.0.t != least.0.t;
        let larger = if high >= low { most } else { least };
        match equal {
            true => Self::None("the magnitude is reached with both signs".to_string()),
            false => Self::Extreme(larger.0, larger.1),
        }
    }

    /// The times at which the measure is needed.
    pub fn times(&self, times: RunTimes<'_>) -> Vec<f64> {
        match self {
            Self::Final(t) => vec![*t],
            Self::Extreme(at, rivals) | Self::TimeOf(at, rivals) => {
                let each = std::iter::once(at.t).chain(rivals.iter().copied());
                let near = |t: f64| times.near_end(t).unwrap_or(t);
                each.flat_map(|t| [&[t, near(t)], &times.beside(t)[..]].concat()).list()
            }
            Self::Integral(_, found) => found.t.clone(),
            Self::Outputs(_) => times.outputs.to_vec(),
            Self::Settling(all) => all.to_vec(),
            Self::None(_) | Self::Zero => Vec::new(),
        }
    }

    /// The derivatives of measure `k`, or of its magnitude if it is a peak, from its rows at all times.
    pub fn slopes(
        &self,
        rows: &SlopeRows,
        (k, is_peak): (usize, bool),
        times: RunTimes<'_>,
    ) -> Found {
        let at = |t: f64| rows.at(t);
        match self {
            Self::None(reason) => Err(reason.clone()),
            Self::Zero => Ok(vec![0.0; rows.variables]),
            Self::Final(_) => rows.final_slopes(k),
            Self::Extreme(found, rivals) => {
                let slopes = rows.agreed(k, (found, rivals), times)?.of_value;
                let sign = if is_peak && found.value < 0.0 { -1.0 } else { 1.0 };
                Ok(slopes.iter().map(|slope| sign * slope).list())
            }
            Self::TimeOf(found, rivals) => rows.agreed(k, (found, rivals), times)?.of_time,
            Self::Integral(of, found) => rows.slopes_of_integral(*of, k, found),
            Self::Outputs(of) => rows.slopes_of_extreme(times.outputs, k, *of),
            Self::Settling([t, most, last]) => {
                let [entry, peak, end] = [at(*t)?, at(*most)?, at(*last)?];
                let last = rows.final_slopes(k)?;
                let away = |row: &SlopeRow| (row.values[k][0] - end.values[k][0]).signum();
                let rate = away(entry) * entry.values[k][1];
                let of = |j: usize| {
                    let by = |row: &SlopeRow| away(row) * (row.slopes[k][j] - last[j]);
                    (BAND * by(peak) - by(entry)) / rate
                };
                Ok((0..rows.variables).map(of).list())
            }
        }
    }
}

/// The rows of all measures at all times.
pub(super) struct SlopeRows {
    rows: Vec<SlopeRow>,
    /// The index of the row at the end of the run.
    last: usize,
    pub variables: usize,
    /// The largest magnitude of each measure at the times read.
    pub(super) span: Vec<f64>,
    /// The derivatives of the time at which a condition ends the run; zero if its end is given.
    pub(super) end: Vec<f64>,
    /// The changes of the motion.
    pub(super) corners: Vec<Corner>,
    /// The variables whose change would end a rest at the start.
    pub(super) caught: Vec<bool>,
    /// Why there are no derivatives after the rows.
    failed: String,
}

impl Corner {
    pub(super) fn t(&self) -> f64 {
        self.sides[0].t
    }

    /// The derivatives of the value of measure `k` at the change, whose time may move, on the side with this value.
    pub(super) fn whole(&self, k: usize, value: f64) -> Vec<f64> {
        let away = |row: &SlopeRow| (row.values[k][0] - value).abs();
        let [before, after] = &self.sides;
        let row = if away(before) <= away(after) { before } else { after };
        let moves = |(slope, late): (&f64, &f64)| slope + row.values[k][1] * late;
        row.slopes[k].iter().zip(&self.late).map(moves).list()
    }
}

impl SlopeRow {
    /// The row, if the error of the run has not grown to the size of the mechanism.
    fn known(self) -> Result<Self, String> {
        match self.error >= LOST {
            false => Ok(self),
            true => Err(format!(
                "the motion is not known at t = {:.6} s: small errors have grown to the size of the mechanism, as in chaos; \
                 a shorter run or a smaller rtol helps",
                self.t
            )),
        }
    }
}

impl SlopeRows {
    /// Reads all measures at some times, the last of which is the end of the run.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn read(
        reader: &mut Reader<'_>,
        mut t: Vec<f64>,
        variables: usize,
    ) -> Result<Self, String> {
        let (end_of_run, caught) = (t.last().copied(), reader.caught());
        t.order_by(f64::total_cmp);
        t.dedup();
        let last = t.iter().position(|t| Some(*t) == end_of_run).unwrap_or(0);
        let (mut rows, mut failed) = (Vec::<SlopeRow>::with_capacity(t.len()), String::new());
        for t in t {
            match reader.at(t).and_then(SlopeRow::known) {
                Ok(row) => rows.push(row),
                Err(reason) if rows.is_empty() => return Err(reason),
                Err(reason) => {
                    failed = reason;
                    break;
                }
            }
        }
        let mut corners = std::mem::take(&mut reader.corners);
        let sides = corners.iter_mut().flat_map(|corner| &mut corner.sides);
        for row in rows.iter_mut().chain(sides) {
            row.slopes.iter_mut().for_each(|of| of.truncate(variables));
            row.late.truncate(variables);
        }
        corners.iter_mut().for_each(|corner| corner.late.truncate(variables));
        let span = (0..reader.measures.len())
            .map(|k| rows.iter().fold(0.0_f64, |most, row| most.max(row.values[k][0].abs())));
        let (span, end) = (span.list(), vec![0.0; variables]);
        Ok(Self { rows, last, variables, span, end, corners, caught, failed })
    }

    /// The rows of a run that ends where measure `k` becomes zero.
    ///
    /// # Errors
    /// The function of the condition is stationary there, so that its end has no derivative.
    pub fn ending_at_zero_of(self, k: usize) -> Result<Self, String> {
        let Ok(last) = self.end_row() else { return Ok(self) };
        let rate = last.values[k][1];
        let end: Vec<f64> = last.slopes[k].iter().map(|slope| -slope / rate).list();
        match end.iter().all(|x| x.is_finite()) {
            true => Ok(Self { end, ..self }),
            false => Err("the condition that ends the motion only touches zero".to_string()),
        }
    }

    /// The derivatives of the last value of measure `k`, whose time may move.
    pub(super) fn final_slopes(&self, k: usize) -> Found {
        let last = self.end_row()?;
        let moves = |(slope, end): (&f64, &f64)| slope + last.values[k][1] * end;
        Ok(last.slopes[k].iter().zip(&self.end).map(moves).list())
    }

    /// Whether measure `k` has one value at all times read.
    pub(super) fn is_constant(&self, k: usize) -> bool {
        let first = self.rows.first().map_or(0.0, |row| row.values[k][0]);
        self.rows.iter().all(|row| (row.values[k][0] - first).abs() <= RIVAL * self.span[k])
    }

    /// The change of the motion at a time.
    pub(super) fn corner(&self, t: f64) -> Option<&Corner> {
        let place = self.corners.partition_point(|corner| corner.t() < t);
        self.corners.get(place).filter(|corner| corner.t() == t)
    }

    /// The last change of the motion up to a time.
    pub(super) fn last_corner(&self, t: f64) -> Option<&Corner> {
        let after = self.corners.partition_point(|corner| corner.t() <= t);
        after.checked_sub(1).map(|k| &self.corners[k])
    }

    /// Why derivatives of a number that is read up to a time are inaccurate, if they are.
    pub(super) fn doubt(&self, until: f64) -> Option<String> {
        let rows = self.rows.iter().take_while(|row| row.t <= until);
        let error = rows.fold(0.0_f64, |most, row| most.max(row.error));
        (error > DOUBTFUL).then(|| {
            format!(
                "the motion is only known to {error:.1e} of the size of the mechanism or of a radian, and the derivative less well; a smaller rtol helps"
            )
        })
    }

    /// The row at the end of the run.
    ///
    /// # Errors
    /// The reason for which there are no derivatives there.
    pub(super) fn end_row(&self) -> Result<&SlopeRow, String> {
        match self.failed.is_empty() {
            true => Ok(&self.rows[self.last]),
            false => Err(self.failed.clone()),
        }
    }

    /// The row at a time that was read.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub(super) fn at(&self, t: f64) -> Result<&SlopeRow, String> {
        let place = self.rows.partition_point(|row| row.t < t);
        match self.rows.get(place) {
            Some(row) => Ok(row),
            None if self.failed.is_empty() => Ok(&self.rows[self.rows.len() - 1]),
            None => Err(self.failed.clone()),
        }
    }
}
