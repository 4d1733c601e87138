//! Whether the motion with contacts that slide is unique.
//!
//! The friction of a sliding contact is known from its normal force, so the accelerations g̈ of the gaps of the closed
//! contacts are linear in the normal forces N, and
//!
//! ```text
//! g̈ = A N + b,   0 ≤ N ⟂ g̈ ≥ 0,   A = G M̂⁻¹ (G - μ sign(σ) T)ᵀ
//! ```
//!
//! with the inverse mass M̂⁻¹ of the mechanism with its joints, its drivers and all that sticks. The motion is unique if the
//! symmetric part of A is positive definite. Otherwise all sets of contacts that press are tried (Cottle, Pang and
//! Stone, *The Linear Complementarity SlidingProblem*, 1992, chapter 3).

use super::super::failure::Failure;
use super::closed_contacts::Contacts;
use super::companions::contact_of;
use super::place::{is_contact, largest, StateAt, STILL};
use crate::elements::Mode;
use crate::math::{Jet, Listed};
use crate::model::{ForceMode, Model};
use crate::solve::solve_dense;

/// Largest number of contacts whose sets are tried.
pub const MOST: usize = 12;
/// Numbers below this one count as zero. The numbers of a problem are about 1.
const ZERO: f64 = 1e-9;

/// Acceleration of a gap for a unit of its normal force with its friction, over that without friction, below which the
/// contact is lost: at a paradox it passes zero, as fast as the normal force grows.
pub const HELD: f64 = 1e-3;

/// What is known about the motion that begins at a state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Uniqueness {
    /// It is the only one.
    #[default]
    Unique,
    /// There are others, in which this contact does not do the same.
    Several(usize),
    /// It was not examined.
    Unknown,
}

/// Examines the motion that begins in these modes.
///
/// # Errors
/// [`Failure`] where the equations have no solution.
pub(super) fn examine(
    model: &Model,
    place: &StateAt<'_>,
    touching: &[usize],
    modes: &[ForceMode],
) -> Result<Uniqueness, Box<Failure>> {
    let mode = |force: usize| modes.iter().find(|of| of.force == force).map(|of| of.mode);
    let rub = |k: &usize| model.forces[*k].partner;
    let sticks = |k: &usize| rub(k).and_then(mode).is_some_and(Mode::holds);
    let rates = place.gap_rates(model, touching);
    let rests = |(k, rate): (&usize, f64)| rate <= place.slow(model, *k) && !sticks(k);
    let closed: Vec<usize> =
        touching.iter().zip(rates).filter(|(k, rate)| rests((*k, *rate))).map(|(k, _)| *k).list();
    let rough =
        |k: &usize| rub(k).is_some_and(|of| model.forces[of].element.coefficients()[0] > 0.0);
    if !closed.iter().any(rough) {
        return Ok(Uniqueness::Unique);
    }
    let own = |force: usize| closed.contains(&contact_of(model, force).unwrap_or(force));
    let others = modes.iter().filter(|of| !own(of.force)).copied().list();
    let base = model.in_modes(&others);
    // the friction of a joint that slides depends on its reaction, and so on the contacts
    let reacts = |k: usize| {
        let item = &base.forces[k];
        item.reaction.is_some() && !item.is_companion && !item.mode.holds()
    };
    let follows = |of: &ForceMode| matches!(of.mode, Mode::Follows { .. });
    // where sliding begins, its direction belongs to the motion
    let slides = |k: &usize| rough(k).then_some(rub(k)).flatten();
    let rubbing: Vec<usize> = closed.iter().filter_map(slides).list();
    let speeds = place.thresholds(model, &rubbing);
    let still = STILL * place.rate_scale(&place.phase(model, modes));
    let begins =
        rubbing.iter().zip(&speeds).any(|(k, speed)| speed.abs() <= still * place.unit(model, *k));
    if closed.len() > MOST
        || begins
        || others.iter().any(follows)
        || (0..base.forces.len()).any(reacts)
    {
        return Ok(Uniqueness::Unknown);
    }
    let found = Contacts::within(model, &others, place, &closed)?;
    let free = place.solved(&base)?;
    let gaps = place.gap_jets(model, &closed, free.a());
    let direction = |force: usize, rate: f64| match mode(force) {
        Some(Mode::Slides(sign)) => Some(sign),
        _ => Some(rate.signum()),
    };
    let problem = SlidingProblem::new(&found.with_sliding(&direction), &gaps);
    let pressing = |k: usize| match mode(closed[k]) {
        Some(mode) => mode.holds(),
        None => is_contact(model, closed[k]),
    };
    Ok(match problem.other(&pressing) {
        None => Uniqueness::Unique,
        Some(k) => Uniqueness::Several(closed[k]),
    })
}

/// The contact whose sliding friction this is, if its normal force grows without bound: it hardly holds its gap against its
/// own friction.
///
/// # Errors
/// [`Failure`] where the equations have no solution.
pub fn lost(
    model: &Model,
    place: &StateAt<'_>,
    modes: &[ForceMode],
    friction: &ForceMode,
) -> Result<Option<usize>, Box<Failure>> {
    let (Mode::Slides(sign), Some(contact)) = (friction.mode, contact_of(model, friction.force))
    else {
        return Ok(None);
    };
    if !is_contact(model, contact) {
        return Ok(None);
    }
    let others = modes.iter().filter(|of| of.force != friction.force && of.force != contact);
    let found = Contacts::within(model, &others.copied().list(), place, &[contact])?;
    let compliance = found.with_sliding(&|_, _| Some(sign)).compliance;
    Ok((compliance[0][0] < HELD).then_some(contact))
}

/// The complementarity problem, in units in which its numbers are about 1.
struct SlidingProblem {
    a: Vec<Vec<f64>>,
    b: Vec<f64>,
}

impl SlidingProblem {
    /// `gaps` move without contact forces, and all friction slides.
    fn new(found: &Contacts, gaps: &[Jet]) -> Self {
        let a = found.compliance.clone();
        let b: Vec<f64> =
            gaps.iter().zip(&found.all).map(|(gap, own)| gap.second * own.unit).list();
        let scale = largest(&b).max(f64::MIN_POSITIVE);
        Self { a, b: b.iter().map(|b| b / scale).list() }
    }

    /// A contact that does something else in another solution. The solution in which the `pressing` contacts press is
    /// known.
    fn other(&self, pressing: &dyn Fn(usize) -> bool) -> Option<usize> {
        let n = self.b.len();
        if self.is_positive() {
            return None;
        }
        let own = (0..n).filter(|k| pressing(*k)).fold(0, |set, k| set | 1 << k);
        let known = self.gaps(own)?;
        (0..1_usize << n).find_map(|set| {
            let gaps = self.gaps(set)?;
            let apart = gaps.iter().zip(&known).map(|(a, b)| (a - b).abs());
            let far = apart.enumerate().filter(|(_, apart)| *apart > ZERO.sqrt());
            far.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
        })
    }

    /// The accelerations of the gaps if the contacts of a set press; None if this contradicts the law of contact.
    fn gaps(&self, set: usize) -> Option<Vec<f64>> {
        let held: Vec<usize> = (0..self.b.len()).filter(|k| set >> k & 1 == 1).list();
        let mut matrix = held.iter().flat_map(|i| held.iter().map(|k| self.a[*i][*k])).list();
        let mut force = held.iter().map(|i| -self.b[*i]).list();
        if !held.is_empty() && !solve_dense(&mut matrix, &mut force) {
            return None;
        }
        let gap = |(row, b): (&Vec<f64>, &f64)| {
            b + held.iter().zip(&force).map(|(k, x)| row[*k] * x).sum::<f64>()
        };
        let gaps: Vec<f64> = self.a.iter().zip(&self.b).map(gap).list();
        let most = 1.0 + largest(&force);
        let fits = force.iter().chain(&gaps).all(|x| *x >= -ZERO * most);
        fits.then_some(gaps)
    }

    /// Whether the symmetric part of A is positive definite: its Cholesky factors exist.
    fn is_positive(&self) -> bool {
        let n = self.b.len();
        let mut l = vec![vec![0.0; n]; n];
        for i in 0..n {
            for k in 0..=i {
                let sum: f64 = (0..k).map(|m| l[i][m] * l[k][m]).sum();
                let left = 0.5 * (self.a[i][k] + self.a[k][i]) - sum;
                if i > k {
                    l[i][k] = left / l[k][k];
                } else if left > ZERO {
                    l[i][i] = f64::sqrt(left);
                } else {
                    return false;
                }
            }
        }
        true
    }
}
