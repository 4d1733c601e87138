//! The measures of a run at closely spaced instants.

use super::readings::{Missing, Readings};
use crate::analyses::statistics::{changes, instants, Maxima, SingularInstants};
use crate::math::Listed;
use std::cell::OnceCell;

/// Number of instants that are read together, so that their states, accelerations and multipliers fit into the
/// processor cache. It is a multiple of the number of lanes, so that the grouping of states does not depend on the
/// blocks.
const BLOCK: usize = 1024;

/// The readings of a run at its outputs and at closely spaced instants.
pub struct Between<'a> {
    pub readings: Readings<'a>,
    /// None without an interpolant.
    fine: OnceCell<Option<Fine>>,
}

impl<'a> Between<'a> {
    pub fn new(readings: Readings<'a>) -> Self {
        Self { readings, fine: OnceCell::new() }
    }

    /// The measures at closely spaced instants, computed at the first call. None without an interpolant.
    pub fn fine(&self) -> Result<Option<&Fine>, Missing> {
        if let Some(known) = self.fine.get() {
            return Ok(known.as_ref());
        }
        let found = Fine::read(&self.readings)?;
        Ok(self.fine.get_or_init(|| found).as_ref())
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
        let mut values = vec![Vec::new(); readings.wanted.len()];
        let wanted: Vec<usize> =
            (0..readings.wanted.len()).filter(|measure| readings.wanted[*measure]).list();
        let [mut sizes, mut regularity] = [(); 2].map(|()| Vec::with_capacity(t.len()));
        for block in blocks(&t, readings.run.projection.is_some()) {
            // if multipliers are missing at an instant, a single run uses its outputs only
            let rows = readings.at(block, true, &wanted).ok_or(Missing::Single)?;
            sizes.extend(rows.sizes);
            regularity.extend(rows.regularity);
            wanted.iter().zip(rows.values).for_each(|(measure, of)| values[*measure].extend(of));
        }
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
