//! The phases of meshed wheels at a position.
//!
//! Wheels without teeth, and pulleys, may be mounted at any angle. A tooth of a wheel fits into every gap of the other
//! wheel. A position at which all other joints are closed therefore determines the phase of each pair.

use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{row_scales, Model};

/// Largest relative residual of wheels in mesh.
pub(super) const MESHED: f64 = 1e-9;

/// A constraint with a phase: its last row, and the pitch if it has teeth, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mesh {
    pub constraint: usize,
    pub row: usize,
    pub pitch: Option<f64>,
}

/// The constraints with a phase.
pub(super) fn meshes(model: &Model) -> Vec<Mesh> {
    let all = model.constraints.iter().enumerate();
    let with_phase = all.filter(|(_, item)| item.element.clone().phase_mut().is_some());
    let of = |(constraint, item): (usize, &crate::model::ConstraintItem)| {
        let row = model.layout.constraints[constraint].rows.end - 1;
        Mesh { constraint, row, pitch: item.element.pitch() }
    };
    with_phase.map(of).list()
}

/// The model with the phases of a position. None if the wheels already mesh there, or if they cannot.
pub fn meshed(model: &Model, t: f64, q: &[f64]) -> Option<Model> {
    let meshes = meshes(model);
    if meshes.is_empty() || q.len() != model.layout.n_q {
        return None;
    }
    let mut phi = vec![0.0; model.layout.n_rows];
    constraints::residual(model, &Motions::at_rest(&model.layout, q), t, &mut phi);
    let scales = row_scales(model);
    let changed = |mesh: &Mesh| {
        let (phi, near) = (phi[mesh.row], MESHED * scales[mesh.row]);
        let phase = mesh.pitch.map_or(phi, |pitch| pitch * (phi / pitch).round());
        let name = &model.constraints[mesh.constraint].name;
        (phase.abs() > near && (phi - phase).abs() <= near).then(|| (name.clone(), phase))
    };
    let changes = meshes.iter().filter_map(changed).list();
    (!changes.is_empty()).then(|| model.with_phases(changes))
}
