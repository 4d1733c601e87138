//! The model that solves the equations in a phase, and the multipliers of the whole model.

use kempe::analyses::dynamics::{Prepared, Setting};
use kempe::analyses::meshed;
use kempe::elements::Group;
use kempe::model::Model;
use std::sync::Arc;

/// The model that solves the equations. Multipliers are reported in the rows of the whole model, followed by the
/// multipliers of forces with modes. The multipliers of released drivers are zero.
#[derive(Clone)]
pub struct Active {
    /// The model without released drivers, with an equation for each force that holds.
    pub prepared: Arc<Prepared<Arc<Model>>>,
    /// Index of each of its rows among the multipliers. None if the rows are identical.
    rows: Option<Vec<usize>>,
    /// The number of rows of the whole model.
    n_rows: usize,
    /// The number of multipliers.
    n_multipliers: usize,
}

impl Active {
    /// A model with all drivers.
    pub fn whole(prepared: &Arc<Prepared<Arc<Model>>>) -> Self {
        let model = prepared.model();
        let (n_rows, n_multipliers) = (model.layout.n_rows, model.n_multipliers());
        let rows = (n_multipliers > n_rows).then(|| (0..n_rows).collect());
        Self { prepared: Arc::clone(prepared), rows, n_rows, n_multipliers }
    }

    /// The model without the drivers that a setting releases, and with forces in the modes of the setting.
    pub fn of_phase(whole: &Arc<Prepared<Arc<Model>>>, setting: &Setting) -> Self {
        if setting.released.is_empty() && setting.modes.is_empty() {
            return Self::whole(whole);
        }
        let model = whole.model();
        let open = model.without(&setting.released);
        let active = if setting.modes.is_empty() { open } else { open.in_modes(&setting.modes) };
        let place = |item: &kempe::model::ConstraintItem, slots: &kempe::model::Slots| {
            let row = slots.rows.start;
            if item.group == Group::Forces {
                let of = active.forces.iter().position(|force| force.held_row == Some(row));
                let to = of.and_then(|force| model.forces[force].held_row).expect("a row");
                return to..to + 1;
            }
            let known = model.constraints.iter().position(|known| known.name == item.name);
            model.layout.constraints[known.expect("the same constraints")].rows.clone()
        };
        let items = active.constraints.iter().zip(&active.layout.constraints);
        let rows = items.flat_map(|(item, slots)| place(item, slots)).collect();
        Self {
            rows: Some(rows),
            n_rows: model.layout.n_rows,
            n_multipliers: model.n_multipliers(),
            prepared: Arc::new(Prepared::new(Arc::new(active))),
        }
    }

    /// The model in which wheels mesh as in the first of some states.
    pub fn meshed(&self, t: &[f64], q: &[f64]) -> Arc<Model> {
        let model = self.prepared.model();
        let first = t.first().and_then(|t| meshed(model, *t, &q[..model.layout.n_q]));
        first.map_or_else(|| Arc::clone(model), Arc::new)
    }

    /// The number of rows of the whole model.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// The number of multipliers.
    pub fn n_multipliers(&self) -> usize {
        self.n_multipliers
    }

    /// Converts rows of numbers, one for each equation, to multipliers of the whole model.
    pub fn expand(&self, found: Vec<f64>, count: usize) -> Vec<f64> {
        self.spread(found, count, self.n_multipliers)
    }

    /// Converts rows of numbers, one for each equation, to rows of the whole model.
    pub fn expand_rows(&self, found: Vec<f64>, count: usize) -> Vec<f64> {
        self.spread(found, count, self.n_rows)
    }

    /// The multipliers of its equations, from rows of those of the whole model.
    pub fn own(&self, lam: &[f64], count: usize) -> Vec<f64> {
        let Some(rows) = &self.rows else { return lam.to_vec() };
        let of = |k: usize| rows.iter().map(move |row| lam[k * self.n_multipliers + row]);
        (0..count).flat_map(of).collect()
    }

    fn spread(&self, found: Vec<f64>, count: usize, width: usize) -> Vec<f64> {
        let Some(rows) = &self.rows else { return found };
        let mut all = vec![0.0; count * width];
        for k in 0..count {
            let own = &found[k * rows.len()..(k + 1) * rows.len()];
            for (row, x) in rows.iter().zip(own).filter(|(row, _)| **row < width) {
                all[k * width + row] = *x;
            }
        }
        all
    }
}
