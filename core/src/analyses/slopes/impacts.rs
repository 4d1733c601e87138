//! The derivatives of impacts. The contacts that hit, and their restitutions, are those of the run.
//!
//! With v⁺ - v⁻ = Δ, an impact satisfies M Δ + Φ_qᵀ P = 0, and Φ_q v⁺ + Φ_t = -e (Φ_q v⁻ + Φ_t) for the rows of contacts
//! and with e = 0 for the others (see `dynamics::modes::impacts`). The derivatives of both equations give those of v⁺.

use super::ode::SlopeOde;
use crate::analyses::dynamics::Struck;
use crate::elements::{Behaviour, Mode};
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{constants, Sensitivity, Slope, ABREAST};
use crate::equations::Workspace;
use crate::math::{Listed, Real};
use crate::model::{ForceMode, Model};
use crate::solve::Breakdown;

/// The model with these contacts held.
pub(super) fn closed(open: &Model, struck: &[Struck]) -> Model {
    let held = |one: &Struck| ForceMode::new(one.force, Mode::Holds(one.side));
    let modes: Vec<ForceMode> = struck.iter().map(held).list();
    open.in_modes(&modes).allowing_redundancy()
}

/// The restitution of a contact.
fn restitution<S: Real>(model: &Model<S>, force: usize) -> S {
    match model.forces[force].element.behaviour() {
        Some(Behaviour::Impacts { restitution, .. }) => restitution,
        _ => S::zero(),
    }
}

/// Changes the velocities, works and their derivatives by an impact at a time with derivatives `late`. `closed` is the
/// model with the contacts held, and `blocks` are its equations.
///
/// # Errors
/// [`Breakdown`] if the impact is not unique.
pub(super) fn strike(
    ode: &SlopeOde,
    (closed, blocks): (&Model, &mut [Sensitivity]),
    struck: &[Struck],
    (t, late): (f64, &[f64]),
    y: &mut [f64],
) -> Result<(), Breakdown> {
    let layout = &closed.layout;
    let (n, n_z) = (layout.n_q, layout.n_z);
    let mut workspace = Workspace::new(closed);
    let (q, before) = (y[..n].to_vec(), y[n..2 * n].to_vec());
    let mut after = before.clone();
    let mut found: Vec<f64> = vec![0.0; layout.n_rows];
    for (b, block) in blocks.iter_mut().enumerate() {
        let at = SlopeOde::time(t, late, b);
        let mut state = ode.state(b, y);
        let (of_q, old) = (state[..n].to_vec(), state[n..2 * n].to_vec());
        // how fast the contacts approach, times 1 + e
        let mut rates = block.opening(at, &of_q, &old);
        let mut factors = vec![Slope::constant(0.0); rates.len()];
        for one in struck {
            let Some(row) = block.model.forces[one.force].held_row else { continue };
            factors[row] =
                one.restitution.map_or(Slope::constant(0.0), |k| restitution(&block.model, k));
        }
        if b == 0 {
            let values = rates.iter().zip(&factors).map(|(rate, e)| -rate.value * (1.0 + e.value));
            let held = |row: &usize| closed.forces.iter().any(|item| item.held_row == Some(*row));
            let rates = values.enumerate().map(|(row, x)| if held(&row) { x } else { 0.0 }).list();
            let [jump, impulses] = workspace.jump(closed, t, &q, &rates)?;
            after.iter_mut().zip(&jump).for_each(|(v, jump)| *v += jump);
            found = impulses;
        }
        let mut new = constants(&after);
        let mut pushes = constants(&found);
        let jump = new.iter().zip(&old).map(|(new, old)| *new - *old).list();
        let opening = block.opening(at, &of_q, &new);
        rates.iter_mut().zip(&factors).for_each(|(rate, e)| *rate = *rate * *e);
        let rows = opening.iter().zip(&rates).map(|(new, old)| *new + *old).list();
        let residual = [block.balance_of((at, &of_q, &old), &jump, &pushes), rows].concat();
        for place in 0..ABREAST {
            let mut change = residual.iter().map(|r| -r.slope[place]).list();
            workspace.solve(closed, &mut change)?;
            let all = new.iter_mut().chain(&mut pushes).zip(&change);
            all.for_each(|(to, change)| to.slope[place] += change);
        }
        let works = works(block, at, [&of_q, &old, &new], &pushes);
        state[n..2 * n].copy_from_slice(&new);
        state[2 * n + n_z] += works[0];
        state[2 * n + n_z + 1] += works[1];
        ode.put(b, &state, y);
        if b + 1 == ode.blocks.len() {
            y[n..2 * n].copy_from_slice(&after);
            y[2 * n + n_z] += works[0].value;
            y[2 * n + n_z + 1] += works[1].value;
        }
    }
    Ok(())
}

/// The energy that an impact takes, and the work of the impulses of drivers.
fn works(
    block: &Sensitivity,
    t: Slope,
    [q, old, new]: [&[Slope]; 3],
    pushes: &[Slope],
) -> [Slope; 2] {
    let model = &block.model;
    let kinetic = |v: &[Slope]| energy::kinetic(model, &Motions::at(&model.layout, q, v));
    let rest = vec![Slope::constant(0.0); q.len()];
    let by_time = block.opening(t, q, &rest);
    let mut driven = Slope::constant(0.0);
    for (k, _) in model.constraints.iter().enumerate().filter(|(_, item)| item.driven) {
        for row in model.layout.constraints[k].rows.clone() {
            driven += by_time[row] * pushes[row];
        }
    }
    [kinetic(old) - kinetic(new) + driven, driven]
}
