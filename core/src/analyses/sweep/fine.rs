//! The measures of a run at closely spaced instants.

use super::readings::{Missing, Readings};
use crate::analyses::statistics::{
    changes, in_blocks, instants, Integrals, Maxima, SingularInstants, EXAMINED,
};
use crate::math::{Listed, Ordered, ShortArray};
use std::cell::OnceCell;

/// Number of instants that are read together, so that their states, accelerations and multipliers fit into the
/// processor cache. It is a multiple of the number of lanes, so that the grouping of states does not depend on the
/// blocks.
const BLOCK: usize = 1024;

/// Number of instants in each step that are read first. The others are read where a first look is not enough.
const IN_A_STEP: usize = 2;
/// Largest change between two of them, as a multiple of the changes nearby.
const SLACK: f64 = 3.0;

/// The readings of a run at its outputs and at closely spaced instants.
pub struct Between<'a> {
    pub readings: Readings<'a>,
    /// None without an interpolant.
    fine: OnceCell<Option<Fine>>,
    /// The values of each measure whose integrals are required, at the points of Gauss's rule.
    at_points: OnceCell<AtPoints>,
}

/// Values at the points of Gauss's rule.
struct AtPoints {
    values: Vec<Vec<f64>>,
    /// Whether no position is close to a singular one, as far as accelerations were needed.
    is_regular: bool,
}

impl<'a> Between<'a> {
    pub fn new(readings: Readings<'a>) -> Self {
        Self { readings, fine: OnceCell::new(), at_points: OnceCell::new() }
    }

    /// The measures at closely spaced instants, computed at the first call. None without an interpolant.
    pub fn fine(&self) -> Result<Option<&Fine>, Missing> {
        if let Some(known) = self.fine.get() {
            return Ok(known.as_ref());
        }
        let found = Fine::read(&self.readings)?;
        Ok(self.fine.get_or_init(|| found).as_ref())
    }

    /// The integrals of a measure over the steps; None without an interpolant.
    pub fn integrals(&self, measure: usize) -> Result<Option<Integrals>, Missing> {
        let (run, solves) = (self.readings.run, self.readings.solves(measure));
        let dense = run.dense.as_ref().filter(|dense| dense.t.len() > 1);
        let Some(dense) = dense else { return Ok(None) };
        let steps = (&dense.t[..], dense.degree);
        let known = match self.at_points.get() {
            Some(known) => known,
            None => {
                let found = AtPoints::read(&self.readings, steps).ok_or(Missing::Single)?;
                self.at_points.get_or_init(|| found)
            }
        };
        let passes = || Ok(self.fine()?.is_some_and(|fine| !fine.near.near.is_empty()));
        if solves && !known.is_regular && passes()? {
            // a single run of the case finds out whether the measure has a bound there
            return Err(Missing::Single);
        }
        let mut read = |t: &[f64]| self.readings.at(t, solves, &[measure])?.values.pop();
        let found = Integrals::of_steps(steps, &known.values[measure], &[], &mut read);
        found.map(Some).ok_or(Missing::Single)
    }
}

impl AtPoints {
    /// None if a value cannot be computed.
    fn read(readings: &Readings<'_>, (bounds, degree): (&[f64], usize)) -> Option<Self> {
        let all = 0..readings.wanted.len();
        let wanted: Vec<usize> = all.filter(|k| readings.wanted[*k][2]).list();
        let solves = wanted.iter().any(|k| readings.solves(*k));
        let mut found = Self { values: vec![Vec::new(); readings.wanted.len()], is_regular: true };
        let mut read = |t: &[f64]| {
            let rows = readings.at(t, solves, &wanted)?;
            wanted.iter().zip(rows.values).for_each(|(k, of)| found.values[*k].extend(of));
            Some(rows.regularity)
        };
        let regularity = in_blocks(&Integrals::points(bounds, degree), &mut read)?;
        found.is_regular = regularity.iter().all(|s| *s >= EXAMINED);
        Some(found)
    }
}

/// The measures of a run at closely spaced instants, and its singular positions.
pub struct Fine {
    pub t: Vec<f64>,
    /// The values of each measure whose extreme values are required; empty for the other measures.
    pub values: Vec<Vec<f64>>,
    /// The maxima of the norm of all multipliers. They locate singular positions, near which values are meaningless.
    pub near: Maxima,
    /// Whether each step has an instant.
    pub resolved: bool,
}

impl Fine {
    fn read(readings: &Readings<'_>) -> Result<Option<Self>, Missing> {
        let outputs = &readings.run.trajectory.t;
        let dense = readings.run.dense.as_ref().filter(|_| outputs.len() > 1);
        let Some(dense) = dense else { return Ok(None) };
        let layout = &readings.model().layout;
        let t = instants(&dense.t, outputs, 4 * layout.n_q + layout.n_rows + 1);
        let wanted: Vec<usize> =
            (0..readings.wanted.len()).filter(|k| readings.wanted[*k][..2] != [false; 2]).list();
        let steps = dense.t.len().max(2) - 1;
        let every = if readings.is_smooth() { (t.len() / steps).div_ceil(IN_A_STEP) } else { 1 };
        let mut some = Sampled { places: Vec::new(), columns: vec![Vec::new(); 2 + wanted.len()] };
        let last = t.len() - 1;
        some.read(readings, (&t, &wanted), (0..last).step_by(every.max(1)).chain([last]).list())?;
        let between = some.between(wanted.iter().map(|k| readings.wanted[*k]));
        some.read(readings, (&t, &wanted), between)?;
        let t: Vec<f64> = some.places.iter().map(|k| t[*k]).list();
        let mut columns = some.columns.into_iter();
        let [sizes, regularity] = [(); 2].each(|()| columns.next().unwrap_or_default());
        let mut values = vec![Vec::new(); readings.wanted.len()];
        wanted.iter().zip(columns).for_each(|(measure, of)| values[*measure] = of);
        let mut read = |t: &[f64]| readings.at(t, true, &[]).map(|rows| rows.regularity);
        let found = SingularInstants::find(&t, &regularity, &mut read);
        let select = |values: Vec<f64>| match values.is_empty() {
            true => values,
            false => found.keep.iter().map(|k| values[*k]).list(),
        };
        let resolved = readings.resolved(&t);
        let (t, sizes) = (select(t), select(sizes));
        let values = values.into_iter().map(select).list();
        let near = singular(readings, (&t, &sizes), &found, resolved);
        Ok(Some(Self { t, values, near, resolved }))
    }
}

/// Rows at some instants: the norm of all multipliers, the regularity and the measures.
struct Sampled {
    /// The indices of the instants, ascending.
    places: Vec<usize>,
    columns: Vec<Vec<f64>>,
}

impl Sampled {
    /// Adds rows at other instants.
    fn read(
        &mut self,
        readings: &Readings<'_>,
        (t, wanted): (&[f64], &[usize]),
        places: Vec<usize>,
    ) -> Result<(), Missing> {
        let times: Vec<f64> = places.iter().map(|k| t[*k]).list();
        for block in blocks(&times, readings.run.projection.is_some()) {
            // if multipliers are missing at an instant, a single run uses its outputs only
            let rows = readings.at(block, true, wanted).ok_or(Missing::Single)?;
            let found = [rows.sizes, rows.regularity].into_iter().chain(rows.values);
            self.columns.iter_mut().zip(found).for_each(|(to, of)| to.extend(of));
        }
        self.places.extend(places);
        let mut order: Vec<usize> = (0..self.places.len()).list();
        order.order_by_key(|k| self.places[*k]);
        self.places = order.iter().map(|k| self.places[*k]).list();
        for column in &mut self.columns {
            *column = order.iter().map(|k| column[*k]).list();
        }
        Ok(())
    }

    /// The instants that were left out where a measure may exceed its extreme values, the multipliers their largest
    /// norm, or the position may be singular.
    fn between(&self, wanted: impl Iterator<Item = [bool; 3]>) -> Vec<usize> {
        let (sizes, regularity) = (&self.columns[0][..], &self.columns[1][..]);
        let mut searched = vec![(1.0, sizes, most(1.0, sizes)), (-1.0, regularity, -EXAMINED)];
        for (column, signs) in self.columns[2..].iter().zip(wanted) {
            for (sign, _) in [1.0, -1.0].into_iter().zip(signs).filter(|(_, is)| *is) {
                searched.push((sign, column, most(sign, column)));
            }
        }
        let looked = |k: &usize| {
            searched.iter().any(|(sign, column, level)| may_reach(*sign, column, *k, *level))
        };
        let ends = (1..self.places.len()).filter(looked);
        ends.flat_map(|k| self.places[k - 1] + 1..self.places[k]).list()
    }
}

/// The largest signed value.
fn most(sign: f64, column: &[f64]) -> f64 {
    column.iter().fold(f64::NEG_INFINITY, |most, x| most.max(sign * x))
}

/// Whether a signed column may reach a level between samples k - 1 and k: whether it does so if it changes there by
/// [`SLACK`] times its largest change from sample to sample nearby.
fn may_reach(sign: f64, column: &[f64], k: usize, level: f64) -> bool {
    let near = &column[k.saturating_sub(2)..(k + 2).min(column.len())];
    let changes = near.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let change = changes.fold(0.0, f64::max);
    (sign * column[k - 1]).max(sign * column[k]) + SLACK * change >= level
}

/// Splits the instants into blocks. Projected states stay in one block, because their tolerance depends on the
/// preceding states.
fn blocks(t: &[f64], projected: bool) -> impl Iterator<Item = &[f64]> {
    let mut rest = t;
    std::iter::from_fn(move || {
        // the last block contains up to twice as many instants, so that no block is small
        let whole = projected || rest.len() < 2 * BLOCK;
        let (block, others) = rest.split_at(if whole { rest.len() } else { BLOCK });
        rest = others;
        (!block.is_empty()).then_some(block)
    })
}

/// The maxima of the norm of all multipliers, which locate the singular positions of a run.
fn singular(
    readings: &Readings<'_>,
    (t, sizes): (&[f64], &[f64]),
    known: &SingularInstants,
    resolved: bool,
) -> Maxima {
    if !changes(sizes) {
        let (near, near_t) = (known.near.clone(), known.near_t.clone());
        return Maxima { near, near_t, ..Maxima::default() };
    }
    let mut read = |t: &[f64]| readings.at(t, true, &[]).map(|rows| rows.sizes);
    Maxima::search((t, sizes), (&known.near, &known.near_t), resolved, &mut read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_all_instants_and_none_is_small() {
        let t: Vec<f64> = (0..3 * BLOCK + 5).map(|k| k as f64).collect();
        let sizes: Vec<usize> = blocks(&t, false).map(<[f64]>::len).collect();
        assert_eq!(sizes, [BLOCK, BLOCK, BLOCK + 5]);
        assert_eq!(blocks(&t, false).flatten().copied().collect::<Vec<_>>(), t);
        assert_eq!(blocks(&t, true).count(), 1);
        assert_eq!(blocks(&[], false).count(), 0);
    }
}
