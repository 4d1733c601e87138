//! Stops and contacts with restitution at states outside of runs: what a run would decide there is refused.

use super::failure::{Failure, Reason};
use super::trajectory::States;
use crate::analyses::rigid::{unit, RigidContacts, TOUCHING};
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::math::{each, Jet, Lift, Listed};
use crate::model::{size, Model};

/// Rates and accelerations of a gap count as zero below this fraction of the largest ones of the state.
const STILL: f64 = 1e-9;

/// Refuses states beyond stops or contacts, and states whose accelerations were computed although they move or press
/// into one. `a` contains the accelerations.
///
/// # Errors
/// [`Failure`] with [`Reason::Start`].
pub(super) fn check(
    model: &Model,
    contacts: &RigidContacts,
    States { t, q, v, z }: States<'_>,
    a: &[f64],
) -> Result<(), Box<Failure>> {
    if contacts.forces().is_empty() {
        return Ok(());
    }
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    for (k, &t) in t.iter().enumerate() {
        let row = k * n..(k + 1) * n;
        let touched = contacts.touched(model, t, &q[row.clone()]);
        if touched.forces().is_empty() {
            continue;
        }
        let [q, v, a] = each([q, v, a], |x| &x[row.clone()]);
        look(model, &touched, t, [q, v, a, &z[k * n_z..(k + 1) * n_z]])?;
    }
    Ok(())
}

fn look(
    model: &Model,
    touched: &RigidContacts,
    t: f64,
    [q, v, a, z]: [&[f64]; 4],
) -> Result<(), Box<Failure>> {
    let lifted = model.lift::<Jet>();
    let place = q.iter().zip(v).zip(a).map(|((q, v), a)| Jet::new(*q, *v, *a));
    let rates: Vec<Jet> = v.iter().zip(a).map(|(v, a)| Jet::new(*v, *a, 0.0)).list();
    let motions = Motions::at(&lifted.layout, &place.list(), &rates);
    let z: Vec<Jet> = z.iter().map(|z| Jet::lift(*z)).list();
    let acting = Acting { z: &z, lam: None, t: Jet::new(t, 1.0, 0.0) };
    let largest = |x: &[f64]| x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let (fastest, strongest) = (STILL * largest(v), STILL * largest(a));
    for k in touched.forces() {
        let Jet { value, rate, second } = forces::threshold_of_state(&lifted, *k, &motions, acting);
        let name = model.forces[*k].name.clone();
        let into = rate < -fastest || rate <= fastest && second < -strongest;
        let message = match value < -TOUCHING * unit(model, size(model), *k) {
            true => format!("the state is beyond {name} at t = {t:.6} s: its gap is {value:.3e}"),
            false if into => {
                format!("{name} acts at t = {t:.6} s; only a run decides its reaction or impact")
            }
            false => continue,
        };
        let hint = "take the state from kp.dynamics, or give a stiffness in place of restitution";
        return Err(Reason::Start { t, name, message, hint }.into());
    }
    Ok(())
}
