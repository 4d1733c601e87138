//! The measures of a run at close instants.

use super::readings::{Missing, ReadRows, Readings};
use crate::analyses::statistics::{changes, instants, row_norms, Maxima};
use std::cell::OnceCell;

/// Instants that are read together: their states, accelerations and multipliers stay in the cache of a processor. A
/// multiple of the lanes, so that the same states are solved together as in one block.
const BLOCK: usize = 1024;

/// A run that is read, also at close instants.
pub struct Between<'a> {
    pub readings: Readings<'a>,
    /// None without an interpolant.
    fine: OnceCell<Option<Fine>>,
}

impl<'a> Between<'a> {
    pub fn new(readings: Readings<'a>) -> Self {
        Self { readings, fine: OnceCell::new() }
    }

    /// The measures at close instants, read at the first call; None without an interpolant.
    pub fn fine(&self) -> Result<Option<&Fine>, Missing> {
        if let Some(known) = self.fine.get() {
            return Ok(known.as_ref());
        }
        let found = Fine::read(&self.readings)?;
        Ok(self.fine.get_or_init(|| found).as_ref())
    }
}

/// The motion of a run at close instants, and the singular positions in it.
pub struct Fine {
    pub t: Vec<f64>,
    /// The values of each measure whose extreme values are wanted; none of the others.
    pub values: Vec<Vec<f64>>,
    /// The maxima of all multipliers together, beside which values mean nothing.
    pub near: Maxima,
}

impl Fine {
    fn read(readings: &Readings<'_>) -> Result<Option<Self>, Missing> {
        let outputs = &readings.run.trajectory.t;
        let dense = readings.run.dense.as_ref().filter(|_| outputs.len() > 1);
        let Some(dense) = dense else { return Ok(None) };
        let layout = &readings.model().layout;
        let t = instants(&dense.t, outputs, 4 * layout.n_q + layout.n_rows + 1);
        let mut values = vec![Vec::new(); readings.measures.len()];
        let mut sizes = Vec::with_capacity(t.len());
        for block in blocks(&t, readings.run.projection.is_some()) {
            // without multipliers somewhere a single run uses its outputs
            let rows = readings.at(block, true).ok_or(Missing::Single)?;
            sizes.extend(norms(&rows));
            for ((measure, is_wanted), values) in readings.measures.iter().zip(&mut values) {
                if *is_wanted {
                    values.extend(readings.values(measure, &rows).ok_or(Missing::Single)?);
                }
            }
        }
        let near = singular(readings, &t, &sizes);
        Ok(Some(Self { t, values, near }))
    }
}

/// The instants in blocks. Projected states stay together, because their tolerance depends on the states before.
fn blocks(t: &[f64], projected: bool) -> impl Iterator<Item = &[f64]> {
    let mut rest = t;
    std::iter::from_fn(move || {
        // no block is small
        let whole = projected || rest.len() < 2 * BLOCK;
        let (block, others) = rest.split_at(if whole { rest.len() } else { BLOCK });
        rest = others;
        (!block.is_empty()).then_some(block)
    })
}

/// The maxima of all multipliers together, which find the singular positions of a run.
fn singular(readings: &Readings<'_>, t: &[f64], sizes: &[f64]) -> Maxima {
    if !changes(sizes) {
        return Maxima::default();
    }
    let mut read = |t: &[f64]| readings.at(t, true).map(|rows| norms(&rows));
    Maxima::search((t, sizes), (&[], &[]), readings.resolved(t), &mut read)
}

/// The length of the multipliers of each row.
fn norms(rows: &ReadRows) -> Vec<f64> {
    let count = rows.t.len();
    let lam = rows.multipliers();
    row_norms(lam, lam.len() / count.max(1), count)
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
