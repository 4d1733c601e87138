//! Impacts of several contacts at once, with friction: a linear complementarity problem.
//!
//! The rates of the gaps ġ and the sliding velocities σ of the contacts depend on their impulses, (ġ, σ)⁺ = (ġ, σ)⁻ +
//! D (Λ_N, Λ_T), with D = G M̂⁻¹ Gᵀ and the inverse mass M̂⁻¹ of the mechanism with its joints and drivers. In the plane
//! Coulomb's law has two edges,
//!
//! ```text
//! 0 ≤ Λ_N ⟂ ġ ≥ 0     |Λ_T| ≤ μ Λ_N     Λ_T = -μ Λ_N sign σ where σ ≠ 0
//! ```
//!
//! which is a linear complementarity problem (Stewart and Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673). Poisson's
//! law takes two of them: compression ends with ġ ≥ 0; in expansion, Λ_N is at least e times that of compression
//! (Glocker and Pfeiffer, *Multiple impacts with friction in rigid multibody systems*, Nonlinear Dynamics 7 (1995) 471).
//! Newton's law takes one, with ġ⁺ + e ġ⁻ in place of ġ. μ is the coefficient of sliding friction.
//!
//! Where the sliding velocity ends together with the approach, as at a lever, every friction within its limits would solve
//! the problem. The wanted one acted against the sliding until then. It is the limit of the solutions with a small rest of
//! the approach.

use super::super::failure::{Failure, Reason};
use super::super::options::RestitutionLaw;
use super::closed_contacts::Contacts;
use super::impact::{driver_work, Impact, Restitutions};
use super::place::{largest, StateAt, STILL};
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::complementarity;

/// Growth of the kinetic energy that counts as a rounding error.
const GROWS: f64 = 1e-12;

/// Computes the impact of these contacts, each with its restitution.
///
/// # Errors
/// [`Failure`] where there is no solution, or where the law gains energy.
pub(super) fn strike(
    model: &Model,
    place: &StateAt<'_>,
    contacts: &[usize],
    (own, law): (Restitutions<'_>, RestitutionLaw),
) -> Result<Impact, Box<Failure>> {
    resolve(model, place, Contacts::new(model, place, contacts)?, (own, law))
}

/// Computes the impact of closed contacts.
///
/// # Errors
/// As for [`strike`].
pub(super) fn resolve(
    model: &Model,
    place: &StateAt<'_>,
    found: Contacts,
    (own, law): (Restitutions<'_>, RestitutionLaw),
) -> Result<Impact, Box<Failure>> {
    let contacts: Vec<usize> = found.all[..found.normals].iter().map(|of| of.force).list();
    let [q, v, _] = place.state(model);
    let kinetic = |v: &[f64]| energy::kinetic(model, &Motions::at(&model.layout, q, v));
    let before = kinetic(v);
    let least = contacts.iter().copied().min_by(|a, b| own(*a).total_cmp(&own(*b)));
    let name = |k: usize| model.forces[k].name.clone();
    let first = name(least.unwrap_or_default());
    let fails = |name: String, message: String| {
        let t = place.t;
        Reason::Singular { t, name, message: format!("{message} at t = {t:.6} s") }.into()
    };
    // first with the individual restitutions
    for common in [None, least] {
        let e = |at: usize| own(common.unwrap_or(found.all[at].force));
        let Some(impulses) = found.impulses(&e, law) else {
            let message = format!("no impulses agree with the friction of {first} in an impact");
            return Err(fails(first, message));
        };
        let mut after = v.to_vec();
        for (own, x) in found.all.iter().zip(&impulses) {
            after.iter_mut().zip(&own.jump).for_each(|(v, jump)| *v += x * jump);
        }
        let energy = kinetic(&after);
        let loss = before - energy;
        // drivers may add energy
        let taken = loss + driver_work(model, place.t, q, &found.rows(&impulses));
        if taken >= -GROWS * before.max(energy) {
            return Ok(found.impact(&contacts, &impulses, (after, loss, common)));
        }
        if law == RestitutionLaw::Newton {
            break;
        }
    }
    let message = format!(
        "restitution and friction of {first} would gain energy in an impact; use \
         restitution_law = \"poisson\", the same restitution for all contacts, or a smaller one"
    );
    Err(fails(first, message))
}

impl Contacts {
    /// The impulses of all directions. `e` is the restitution of a normal direction.
    fn impulses(&self, e: &dyn Fn(usize) -> f64, law: RestitutionLaw) -> Option<Vec<f64>> {
        let rates: Vec<f64> = self.all.iter().map(|own| own.rate * own.unit).list();
        let scale = largest(&rates).max(f64::MIN_POSITIVE);
        let rates: Vec<f64> = rates.iter().map(|rate| rate / scale).list();
        let none = vec![0.0; self.all.len()];
        let part = |(k, rate): (usize, &f64)| if k < self.normals { -rate.min(0.0) } else { 0.0 };
        let rest = |rates: &[f64]| -> Vec<f64> { rates.iter().enumerate().map(part).list() };
        let compress = |rates: &[f64]| match &self.compression {
            Some(known) => Some(known.clone()),
            None => self.solve(rates, &none, &rest(rates)),
        };
        let mut sum = match law {
            RestitutionLaw::Newton => {
                let mut wanted = rates;
                for (k, rate) in wanted[..self.normals].iter_mut().enumerate() {
                    *rate *= if *rate < 0.0 { 1.0 + e(k) } else { 1.0 };
                }
                compress(&wanted)?
            }
            RestitutionLaw::Poisson => {
                let compression = compress(&rates)?;
                let least = |k: usize| if k < self.normals { e(k) * compression[k] } else { 0.0 };
                let given: Vec<f64> = (0..self.all.len()).map(least).list();
                let start = compression.iter().zip(&given).map(|(a, b)| a + b).list();
                let more = match given.iter().all(|x| *x == 0.0) {
                    true => none.clone(),
                    false => self.solve(&self.after(&rates, &start), &given, &none)?,
                };
                start.iter().zip(&more).map(|(a, b)| a + b).list()
            }
        };
        sum.iter_mut().zip(&self.all).for_each(|(x, own)| *x *= scale * own.unit);
        Some(sum)
    }

    /// The impulses that complement these rates, as the limit for rates with a small part of `rest`. Friction may also use
    /// the normal impulses that are `given`.
    pub(super) fn solve(&self, rates: &[f64], given: &[f64], rest: &[f64]) -> Option<Vec<f64>> {
        self.solve_with(rates, given, rest, 0.0)
    }

    /// The same, where contacts that slide also separate, with this part of their friction times the sliding. With a part
    /// of 1 the problem is convex, so that its solution is found (Anitescu, *Optimization-based simulation of nonsmooth rigid
    /// multibody dynamics*, Math. Program. 105 (2006) 113). It is also one of the law of friction if nothing slides.
    pub(super) fn solve_with(
        &self,
        rates: &[f64],
        given: &[f64],
        rest: &[f64],
        separates: f64,
    ) -> Option<Vec<f64>> {
        let (n, m) = (self.normals, self.all.len() - self.normals);
        // Λ_N, the two directions of friction, and the slack of each friction
        let column = |k: usize| if k < n + m { (k, 1.0) } else { (k - m, -1.0) };
        let size = n + 3 * m;
        let (mut a, mut b) = (vec![vec![0.0; size]; size], vec![0.0; size]);
        for (i, (entries, rate)) in a.iter_mut().zip(&mut b).take(n + 2 * m).enumerate() {
            let (row, sign) = column(i);
            *rate = sign * rates[row];
            for (k, x) in entries.iter_mut().take(n + 2 * m).enumerate() {
                let (other, direction) = column(k);
                *x = sign * direction * self.compliance[row][other];
            }
        }
        for k in 0..m {
            let own = &self.all[n + k];
            let (normal, mu) = own.of.expect("a friction has a contact");
            let mu = mu * self.all[normal].unit / own.unit;
            let slack = n + 2 * m + k;
            (a[n + k][slack], a[n + m + k][slack]) = (1.0, 1.0);
            (a[slack][normal], b[slack]) = (mu, mu * given[normal]);
            (a[slack][n + k], a[slack][n + m + k]) = (-1.0, -1.0);
            a[normal][slack] = -mu * separates;
        }
        let mut limit = vec![0.0; size];
        limit[..n].copy_from_slice(&rest[..n]);
        let z = complementarity::solve(&a, &b, &limit)?;
        let of = |k: usize| if k < n { z[k] } else { z[k] - z[k + m] };
        Some((0..n + m).map(of).list())
    }

    fn impact(
        self,
        contacts: &[usize],
        impulses: &[f64],
        (after, loss, common): (Vec<f64>, f64, Option<usize>),
    ) -> Impact {
        let found = self.rows(impulses);
        let Self { closed, all, .. } = self;
        // a contact that rests has a rate and an impulse that are rounding errors while others hit
        let pushed = all.iter().zip(impulses).map(|(own, x)| x / own.unit).list();
        let least = STILL * largest(&pushed);
        let pushes = |k: &&usize| {
            let own = all.iter().position(|own| own.force == **k);
            own.is_some_and(|at| pushed[at].max(-all[at].rate * all[at].unit) > least)
        };
        let contacts = contacts.iter().filter(pushes).copied().list();
        Impact { contacts, closed, found, after, loss, common }
    }
}
