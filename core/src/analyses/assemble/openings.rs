//! How far joints stay open that do not close.

use crate::elements::QuantityKind;
use crate::model::{size, Model};

/// The openings of some joints and drivers, as lengths or as angles.
pub(super) struct Openings {
    /// Lengths, or angles if they are larger relative to the size of the mechanism.
    pub kind: QuantityKind,
    /// Their sum: the openings of the joints of a loop add up to the missing length or angle.
    pub total: f64,
    /// The joint or driver with the largest opening, and this opening.
    pub worst: (usize, f64),
}

impl Openings {
    /// The openings of these constraints. None if there are no constraints.
    pub fn of(
        model: &Model,
        phi: &[f64],
        constraints: impl Iterator<Item = usize> + Clone,
    ) -> Option<Self> {
        let of = |kind| {
            let opening = |k: usize| {
                let rows = model.layout.constraints[k].rows.clone();
                (k, model.constraints[k].opening(kind, &phi[rows]))
            };
            let all = constraints.clone().map(opening);
            let total = all.clone().map(|(_, gap)| gap).sum();
            Some(Self { kind, total, worst: all.max_by(|a, b| a.1.total_cmp(&b.1))? })
        };
        let (lengths, angles) = (of(QuantityKind::Length)?, of(QuantityKind::Angle)?);
        Some(if lengths.total < angles.total * size(model) { angles } else { lengths })
    }

    /// The largest opening, m; zero for an angle.
    pub fn gap(&self) -> f64 {
        if self.kind == QuantityKind::Length {
            self.worst.1
        } else {
            0.0
        }
    }
}
