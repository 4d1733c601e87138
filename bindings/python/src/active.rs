//! A model without its released drivers, and the rows of all drivers.

use kempe::analyses::dynamics::Prepared;
use kempe::model::Model;
use std::sync::Arc;

/// The model that solves the equations. Released drivers have multipliers of zero in the rows of the whole model.
#[derive(Clone)]
pub struct Active {
    /// The model without released drivers.
    pub prepared: Arc<Prepared<Arc<Model>>>,
    /// The rows of the whole model that it has; None for all.
    rows: Option<Vec<usize>>,
    /// The number of rows of the whole model.
    n_rows: usize,
}

impl Active {
    /// All of a model.
    pub fn whole(prepared: &Arc<Prepared<Arc<Model>>>) -> Self {
        let n_rows = prepared.model().layout.n_rows;
        Self { prepared: Arc::clone(prepared), rows: None, n_rows }
    }

    /// A model without some drivers.
    pub fn without(whole: &Arc<Prepared<Arc<Model>>>, released: &[String]) -> Self {
        if released.is_empty() {
            return Self::whole(whole);
        }
        let model = whole.model();
        let kept = model.constraints.iter().zip(&model.layout.constraints);
        let kept = kept.filter(|(item, _)| !released.contains(&item.name));
        Self {
            prepared: Arc::new(Prepared::new(Arc::new(model.without(released)))),
            rows: Some(kept.flat_map(|(_, slots)| slots.rows.clone()).collect()),
            n_rows: model.layout.n_rows,
        }
    }

    /// The number of rows of the whole model.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Rows of numbers, one for each of its equations, as rows of the whole model.
    pub fn expand(&self, found: Vec<f64>, count: usize) -> Vec<f64> {
        let Some(rows) = &self.rows else { return found };
        let mut all = vec![0.0; count * self.n_rows];
        for k in 0..count {
            let own = &found[k * rows.len()..(k + 1) * rows.len()];
            for (row, x) in rows.iter().zip(own) {
                all[k * self.n_rows + row] = *x;
            }
        }
        all
    }
}
