//! The closed contacts of a mechanism at an instant, and the rates that impulses in their directions cause.

use super::super::failure::Failure;
use super::super::model_cache::ModelCache;
use super::super::redundant_rows::workspace_at;
use super::companions;
use super::place::StateAt;
use crate::elements::Mode;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{ForceMode, Model};

/// The impulses of one direction of a contact.
pub(super) struct ImpactDirection {
    pub force: usize,
    /// Its row in the closed model, and the sign of its coordinate.
    pub row: usize,
    pub sign: f64,
    /// The rate before the impact.
    pub rate: f64,
    /// The jump of the velocities and the impulses of the joints for a unit impulse.
    pub jump: Vec<f64>,
    pub joints: Vec<f64>,
    /// The unit of its impulse.
    pub unit: f64,
    /// For friction: the place of its contact among the normal directions, and μ.
    pub of: Option<(usize, f64)>,
}

/// The closed contacts of a mechanism at an instant.
pub(super) struct Contacts {
    pub closed: Model,
    pub all: Vec<ImpactDirection>,
    pub normals: usize,
    /// D in units of the impulses.
    pub compliance: Vec<Vec<f64>>,
    /// The impulses of compression in these units for rates whose largest is 1, where they are known.
    pub compression: Option<Vec<f64>>,
}

impl Contacts {
    /// Contacts of a mechanism in which nothing else is closed or sticks.
    ///
    /// # Errors
    /// [`Failure`] where the equations of the mechanism depend on each other.
    pub fn new(
        model: &Model,
        place: &StateAt<'_>,
        contacts: &[usize],
    ) -> Result<Self, Box<Failure>> {
        Self::within(model, &[], place, contacts)
    }

    /// Contacts of a mechanism whose other forces are in these modes.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn within(
        model: &Model,
        others: &[ForceMode],
        place: &StateAt<'_>,
        contacts: &[usize],
    ) -> Result<Self, Box<Failure>> {
        let rubs: Vec<usize> = contacts.iter().filter_map(|k| model.forces[*k].partner).list();
        let sides = place.sides(model, contacts);
        let held = contacts.iter().zip(&sides).map(|(k, side)| (*k, *side));
        let held = held.chain(rubs.iter().map(|k| (*k, 0.0)));
        let modes = held.map(|(k, side)| ForceMode::new(k, Mode::Holds(side)));
        let modes = others.iter().copied().chain(modes).list();
        let closed = model.in_modes(&modes).allowing_redundancy();
        let around;
        let model = if others.is_empty() {
            model
        } else {
            around = model.in_modes(others);
            &around
        };
        let (t, [q, v, z]) = (place.t, place.state(model));
        let motions = Motions::at(&closed.layout, q, v);
        let mut entries = vec![0.0; closed.layout.n_entries];
        constraints::jacobian(&closed, &motions, t, &mut entries);
        let mut workspace = workspace_at((model, &ModelCache::default()), t, [q, v, z]);
        let rates = [place.gap_rates(model, contacts), place.thresholds(model, &rubs)].concat();
        let (mut all, mut gradients) = (Vec::new(), Vec::new());
        let forces = contacts.iter().copied().zip(sides.iter().map(|side| -side.signum()));
        let forces = forces.chain(rubs.iter().map(|k| (*k, 1.0)));
        for ((force, sign), rate) in forces.zip(rates) {
            let row = closed.forces[force].held_row.expect("it holds");
            let (mut unit, mut gradient) =
                (vec![0.0; closed.layout.n_rows], vec![0.0; model.layout.n_q]);
            unit[row] = sign;
            constraints::add_transposed(&closed, &entries, &unit, &mut gradient);
            let still = vec![0.0; model.layout.n_rows];
            let jump = workspace.jump_by(model, t, q, (&gradient, &still));
            let [jump, joints] =
                jump.map_err(|breakdown| Failure::at_state(model, t, q, breakdown))?;
            let of = companions::contact_of(model, force).map(|contact| {
                let at = contacts.iter().position(|k| *k == contact).expect("its contact");
                (at, model.forces[force].element.coefficients()[0])
            });
            all.push(ImpactDirection { force, row, sign, rate, jump, joints, unit: 1.0, of });
            gradients.push(gradient);
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut compliance: Vec<Vec<f64>> =
            gradients.iter().map(|w| all.iter().map(|own| dot(w, &own.jump)).list()).list();
        // the units make the diagonal 1, except where a driver holds the direction
        let most = (0..all.len()).map(|k| compliance[k][k]).fold(0.0, f64::max);
        for (k, own) in all.iter_mut().enumerate() {
            own.unit = 1.0 / compliance[k][k].max(1e-24 * most).sqrt();
        }
        for (i, row) in compliance.iter_mut().enumerate() {
            row.iter_mut().zip(&all).for_each(|(x, own)| *x *= own.unit * all[i].unit);
        }
        Ok(Self { closed, all, normals: contacts.len(), compliance, compression: None })
    }

    /// The same contacts, where the friction of some slides in known directions: it is then a part of their normal
    /// forces, and has no direction of its own.
    pub fn with_sliding(mut self, direction: &dyn Fn(usize, f64) -> Option<f64>) -> Self {
        let mut at = self.normals;
        while at < self.all.len() {
            let own = &self.all[at];
            let (contact, mu) = own.of.expect("a friction has a contact");
            let Some(sign) = direction(own.force, own.rate) else {
                at += 1;
                continue;
            };
            let factor = mu * sign * self.all[contact].unit / own.unit;
            for row in &mut self.compliance {
                row[contact] -= factor * row.remove(at);
            }
            self.compliance.remove(at);
            self.all.remove(at);
        }
        self
    }

    /// The rates after impulses.
    pub fn after(&self, rates: &[f64], impulses: &[f64]) -> Vec<f64> {
        let of = |row: &Vec<f64>| row.iter().zip(impulses).map(|(d, x)| d * x).sum::<f64>();
        rates.iter().zip(&self.compliance).map(|(rate, row)| rate + of(row)).list()
    }

    /// The impulses of all rows of the closed model.
    pub fn rows(&self, impulses: &[f64]) -> Vec<f64> {
        let mut found = vec![0.0; self.closed.layout.n_rows];
        for (own, x) in self.all.iter().zip(impulses) {
            found.iter_mut().zip(&own.joints).for_each(|(sum, joint)| *sum += x * joint);
        }
        for (own, x) in self.all.iter().zip(impulses) {
            found[own.row] = -own.sign * x;
        }
        found
    }
}
