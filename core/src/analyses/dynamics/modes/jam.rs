//! Impacts without collision: the sliding of a closed contact ends at once, where no reaction agrees with its friction.
//!
//! The rate of the gap is zero, so the contact does not collide. The forces grow without bound within no time and stop the
//! sliding (Génot and Brogliato, *New results on Painlevé paradoxes*, Eur. J. Mech. A/Solids 18 (1999) 653). The impulses
//! are those of the complementarity problem of an impact with the rates ε g̈, where g̈ are the accelerations of the gaps
//! without contact forces, in the limit ε → 0. This is the first step of Moreau's method, as the step tends to zero.
//!
//! The normal force of a contact that slides towards a paradox grows without bound. This contact is lost, and the impact
//! takes place at the end of the sliding; the contact cannot go on to slide.
//!
//! All combinations of apart, sticking and sliding contacts are tried. A combination is a solution where its numbers
//! agree at ε = 0, and in first order where they are zero there.

use super::super::failure::{Failure, Reason};
use super::super::options::RestitutionLaw;
use super::closed_contacts::Contacts;
use super::friction_impact::resolve;
use super::impact::{Impact, Restitutions};
use super::place::{largest, StateAt};
use super::sliding_contacts::HELD;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::solve_dense;

/// Largest number of contacts whose combinations are tried.
const MOST: usize = 6;
/// Numbers below this one count as zero. The numbers of a problem are about 1.
const ZERO: f64 = 1e-9;

/// A number at ε = 0, and its derivative by ε.
type Expansion = [f64; 2];

/// What a contact does in an impact.
#[derive(Clone, Copy, PartialEq)]
enum ContactWay {
    Apart,
    Sticks,
    Slides(f64),
}

impl ContactWay {
    const ALL: [Self; 4] = [Self::Apart, Self::Sticks, Self::Slides(1.0), Self::Slides(-1.0)];
}

/// The impact without collision of closed contacts, of which some are lost; None if nothing has to jump.
///
/// # Errors
/// [`Failure`] where it is not unique, or has no solution.
pub(super) fn strike(
    model: &Model,
    place: &StateAt<'_>,
    (contacts, lost): (&[usize], &[usize]),
    (own, law): (Restitutions<'_>, RestitutionLaw),
) -> Result<Option<Impact>, Box<Failure>> {
    let found = Contacts::new(model, place, contacts)?;
    let free = place.solved(model)?;
    let rubs = found.all[found.normals..].iter().map(|own| own.force);
    let directions = contacts.iter().copied().chain(rubs).list();
    let jets = place.gap_jets(model, &directions, free.a());
    let begins = |k: usize| if k < found.normals { jets[k].second } else { jets[k].rate };
    let onset = scaled((0..found.all.len()).map(|k| begins(k) * found.all[k].unit).list());
    let rates = scaled(found.all.iter().map(|own| own.rate * own.unit).list());
    // the rate of a gap that stays closed consists of rounding errors
    let still = |k: usize| k < found.normals && found.all[k].rate <= place.slow(model, contacts[k]);
    let start = |k: usize| [if still(k) { 0.0 } else { rates[k] }, onset[k]];
    let start: Vec<Expansion> = (0..rates.len()).map(start).list();
    let fails = |why: &str| {
        let names = contacts.iter().map(|k| model.forces[*k].name.as_str()).list();
        let (t, name) = (place.t, names[0].to_string());
        let message = format!(
            "friction paradox (Painlevé) at t = {t:.6} s: the impact without collision of the closed contacts {} {why}; \
             reduce their friction, or give one of them a stiffness in place of restitution",
            names.join(", ")
        );
        Err(Reason::Singular { t, name, message }.into())
    };
    if contacts.len() > MOST {
        return fails(&format!("was not examined, because they are more than {MOST}"));
    }
    let is_lost = |k: usize| lost.contains(&contacts[k]);
    match &solutions(&found, &start, &is_lost)[..] {
        [] => Ok(None),
        [only] if largest(&only.jump) <= ZERO => Ok(None),
        [only] => {
            let found = Contacts { compression: Some(only.impulses.clone()), ..found };
            resolve(model, place, found, (own, law)).map(Some)
        }
        _ => fails("is not unique, because several sets of impulses agree with the friction"),
    }
}

/// Numbers whose largest is 1.
fn scaled(x: Vec<f64>) -> Vec<f64> {
    let scale = largest(&x).max(f64::MIN_POSITIVE);
    x.iter().map(|x| x / scale).list()
}

/// Impulses that agree with the laws of contact and friction, and the jump of the rates, at ε = 0.
struct Solved {
    impulses: Vec<f64>,
    jump: Vec<f64>,
}

/// The solutions with distinct jumps. Contacts that are lost cannot go on to slide.
fn solutions(
    found: &Contacts,
    start: &[Expansion],
    is_lost: &dyn Fn(usize) -> bool,
) -> Vec<Solved> {
    let mut all: Vec<Solved> = Vec::new();
    let ways = |k: usize| if partner(found, k).is_some() { 4 } else { 2 };
    let count: usize = (0..found.normals).map(ways).product();
    for choice in 0..count {
        let mut left = choice;
        let of = |k: usize| {
            let way = ContactWay::ALL[left % ways(k)];
            left /= ways(k);
            way
        };
        let combination: Vec<ContactWay> = (0..found.normals).map(of).list();
        let goes_on = |(k, way): (usize, &ContactWay)| match (way, partner(found, k)) {
            (ContactWay::Slides(sign), Some((at, _))) => is_lost(k) && sign * start[at][0] > 0.0,
            _ => false,
        };
        if combination.iter().enumerate().any(goes_on) {
            continue;
        }
        let Some(solved) = solved(found, start, (&combination, is_lost)) else { continue };
        let near = |other: &Solved| {
            let apart = solved.jump.iter().zip(&other.jump).map(|(a, b)| a - b).list();
            largest(&apart) <= ZERO.sqrt()
        };
        if !all.iter().any(near) {
            all.push(solved);
        }
    }
    all
}

/// The friction of a contact: its direction and μ in units of the impulses.
fn partner(found: &Contacts, normal: usize) -> Option<(usize, f64)> {
    let of = |own: &super::closed_contacts::ImpactDirection| {
        let (contact, mu) = own.of.filter(|(contact, _)| *contact == normal)?;
        Some(mu * found.all[contact].unit / own.unit)
    };
    let mut rubs = found.all.iter().enumerate();
    rubs.find_map(|(k, own)| Some((k, of(own)?)))
}

/// What follows if the contacts do this; None if it contradicts the laws. At a contact that is lost, the friction that sticks
/// is just at its limit.
fn solved(
    found: &Contacts,
    start: &[Expansion],
    (ways, is_lost): (&[ContactWay], &dyn Fn(usize) -> bool),
) -> Option<Solved> {
    let n = found.all.len();
    let (mut matrix, mut right) = (vec![0.0; n * n], [vec![0.0; n], vec![0.0; n]]);
    let mut keep = |row: usize, of: usize| {
        matrix[row * n..(row + 1) * n].copy_from_slice(&found.compliance[of]);
        right.iter_mut().zip(start[of]).for_each(|(right, start)| right[row] = -start);
    };
    let closed = |k: usize| ways[k] != ContactWay::Apart;
    let rub = |k: usize| partner(found, k);
    (0..ways.len()).filter(|k| closed(*k)).for_each(|k| keep(k, k));
    let sticks = |k: &usize| ways[*k] == ContactWay::Sticks;
    (0..ways.len()).filter(sticks).filter_map(rub).for_each(|(at, _)| keep(at, at));
    for (k, way) in ways.iter().enumerate() {
        if *way == ContactWay::Apart {
            matrix[k * n + k] = 1.0;
        }
        match (rub(k), way) {
            (Some((at, mu)), ContactWay::Slides(sign)) => {
                (matrix[at * n + at], matrix[at * n + k]) = (1.0, sign * mu);
            }
            (Some((at, _)), ContactWay::Apart) => matrix[at * n + at] = 1.0,
            _ => {}
        }
    }
    for right in &mut right {
        if !solve_dense(&mut matrix.clone(), right) {
            return None;
        }
    }
    let impulse = |k: usize| -> Expansion { [right[0][k], right[1][k]] };
    let jump = |k: usize, order: usize| -> f64 {
        found.compliance[k].iter().zip(&right[order]).map(|(d, x)| d * x).sum()
    };
    let after = |k: usize| -> Expansion { [0, 1].map(|order| start[k][order] + jump(k, order)) };
    let fits = |(k, way): (usize, &ContactWay)| match (way, rub(k)) {
        (ContactWay::Apart, _) => positive(after(k), 1.0),
        (_, None) => positive(impulse(k), 1.0),
        (ContactWay::Sticks, Some((at, mu))) => [1.0, -1.0].iter().all(|sign| {
            let mu = if is_lost(k) { mu * (1.0 + HELD) } else { mu };
            let reserve = [0, 1].map(|order| mu * impulse(k)[order] - sign * impulse(at)[order]);
            positive(reserve, 1.0)
        }),
        (ContactWay::Slides(sign), Some((at, _))) => {
            positive(impulse(k), 1.0) && positive(after(at), *sign)
        }
    };
    let all = ways.iter().enumerate().all(fits);
    let jumps = (0..n).map(|k| jump(k, 0)).list();
    all.then(|| Solved { impulses: right[0].clone(), jump: jumps })
}

/// Whether a number of this sign is not negative for small ε.
fn positive([at, by]: Expansion, sign: f64) -> bool {
    match sign * at {
        x if x.abs() <= ZERO => sign * by >= -ZERO,
        x => x > 0.0,
    }
}
