//! Which of the closed contacts press and which of their friction sticks, from all of them together.
//!
//! The accelerations g̈ of the gaps and τ of the sliding are linear in the forces of the contacts, and their laws are those of
//! an impact with accelerations in place of rates: a linear complementarity problem (Pfeiffer and Glocker, *Multibody
//! Dynamics with Unilateral Contacts*, 1996, chapter 5). Contacts that slide take part with their known friction.

use super::closed_contacts::Contacts;
use super::companions::contact_of;
use super::dependence::{begins, holders, well_led, with_held};
use super::place::{is_contact, largest, mode_of, StateAt};
use crate::elements::Mode;
use crate::math::{Listed, Ordered};
use crate::model::{ForceMode, Model};

/// Numbers below this one count as zero. The largest number of a problem is 1.
const ZERO: f64 = 1e-9;

/// Parts of the limits of friction. Friction at rest shares its forces so that it needs the least of them; what is left of
/// the limit keeps it at rest while forces change a little.
const PARTS: [f64; 6] = [0.25, 0.5, 0.75, 0.9, 0.99, 0.999];

/// Forces of contacts relative to the largest one. Where one is below the first, but not zero, all contacts press with the
/// second at least, if they can: a contact that hardly presses has little friction, and its share would have to be found again
/// at once.
const HARDLY: f64 = 1e-3;
const PRESSED: f64 = 0.02;

/// Modes that are tried: None if they contradict their laws.
pub(super) type Tried<'a> = dyn Fn(Vec<ForceMode>) -> Option<Vec<ForceMode>> + 'a;

/// The modes in which all candidates rest, if their forces can be shared so that all are within their limits.
pub(super) fn resting(
    (model, place): (&Model, &StateAt<'_>),
    free: &[ForceMode],
    all: &[(usize, f64)],
    tried: &Tried<'_>,
) -> Option<Vec<ForceMode>> {
    let sharing = |least: f64| {
        PARTS.iter().find_map(|part| {
            Together::of((model, place), free, all, (1, *part), (1.0, least))
                .filter(Together::rests)
        })
    };
    let found = sharing(0.0)?;
    let pressed = if found.hardly_presses() { sharing(PRESSED) } else { None };
    let all = pressed.into_iter().chain([found]);
    { all }.find_map(|found| tried(found.at_rest(model, place)?))
}

/// The modes of all closed contacts together, if they can be `tried`. Friction begins to slide where it exceeds the limit of
/// sticking. It then has the coefficient of sliding, with which other friction may have to hold or to slide.
pub(super) fn together(
    (model, place): (&Model, &StateAt<'_>),
    free: &[ForceMode],
    all: &[(usize, f64)],
    tried: &Tried<'_>,
) -> Option<Vec<ForceMode>> {
    for coefficient in [1, 0] {
        let (mut now, mut left) = (free.to_vec(), all.to_vec());
        while let Some(found) =
            Together::of((model, place), &now, &left, (coefficient, 1.0), (0.0, 0.0))
        {
            let weakened = found.weakened(model);
            if let Some(modes) = found.in_modes((model, place), tried) {
                return Some(modes);
            }
            if weakened.is_empty() {
                break;
            }
            for (force, sign) in weakened {
                left.retain(|(k, _)| *k != force);
                let own = now.iter_mut().find(|of| of.force == force).expect("it has modes");
                own.mode = Mode::Slides(sign);
            }
        }
    }
    None
}

/// A solution for the contacts among the candidates and their friction.
struct Together<'a> {
    free: &'a [ForceMode],
    candidates: &'a [(usize, f64)],
    found: Contacts,
    /// The forces of the contacts, and the accelerations with them.
    solved: Vec<f64>,
    after: Vec<f64>,
    /// The unit of the forces and accelerations, and the largest force, at least 1.
    scale: f64,
    most: f64,
    /// Contacts without force separate. They may have no acceleration but rounding errors, as between bodies that fall.
    only_pressing: bool,
}

impl<'a> Together<'a> {
    /// None if there is no solution, or no contact among the candidates. All other forces are in the modes `free`.
    /// Friction that may stick has a part of the coefficient at this place among its
    /// [own](crate::elements::ForceElement::coefficients).
    /// For `separates` see [`Contacts::solve_with`]. All contacts press at least with the force `least`.
    fn of(
        (model, place): (&Model, &StateAt<'_>),
        free: &'a [ForceMode],
        candidates: &'a [(usize, f64)],
        (coefficient, part): (usize, f64),
        (separates, least): (f64, f64),
    ) -> Option<Self> {
        let is_rigid = |k: &usize| is_contact(model, *k) && !model.forces[*k].is_companion;
        let contacts: Vec<usize> = candidates.iter().map(|(k, _)| *k).filter(is_rigid).list();
        let takes_part = |k: usize| contacts.contains(&contact_of(model, k).unwrap_or(k));
        let others = free.iter().filter(|of| !takes_part(of.force)).copied().list();
        let slides = |k: usize, rate: f64| match mode_of(free, k) {
            _ if candidates.iter().any(|(of, _)| *of == k) => None,
            Mode::Slides(sign) => Some(sign),
            _ => Some(rate.signum()),
        };
        let mut found =
            Contacts::within(model, &others, place, &contacts).ok()?.with_sliding(&slides);
        for own in &mut found.all {
            let coefficients = model.forces[own.force].element.coefficients();
            own.of = own.of.map(|(contact, _)| (contact, part * coefficients[coefficient]));
        }
        let forces: Vec<usize> = found.all.iter().map(|own| own.force).list();
        let apart = place.solved(&model.in_modes(&others)).ok()?;
        let jets = place.gap_jets(model, &forces, apart.a());
        let of = |k: usize| if k < found.normals { jets[k].second } else { jets[k].rate };
        let onset: Vec<f64> = (0..forces.len()).map(|k| of(k) * found.all[k].unit).list();
        let scale = largest(&onset).max(f64::MIN_POSITIVE);
        let onset: Vec<f64> = onset.iter().map(|x| x / scale).list();
        let none = vec![0.0; forces.len()];
        let given = (0..forces.len()).map(|k| if k < found.normals { least } else { 0.0 }).list();
        let more = found.solve_with(&found.after(&onset, &given), &given, &none, separates)?;
        let solved = given.iter().zip(&more).map(|(a, b)| a + b).list();
        let after = found.after(&onset, &solved);
        let most = largest(&solved).max(1.0);
        Some(Self { free, candidates, found, solved, after, scale, most, only_pressing: false })
    }

    fn at(&self, force: usize) -> Option<usize> {
        self.found.all.iter().position(|own| own.force == force)
    }

    /// Whether a contact stays closed, or friction sticks.
    fn stays(&self, at: usize) -> bool {
        let after = self.after[at].abs() / self.most;
        let presses = at >= self.found.normals || !self.only_pressing || self.solved[at] > 0.0;
        presses && after <= ZERO
    }

    /// Whether the force of a contact is small beside the largest one, but not zero.
    fn hardly_presses(&self) -> bool {
        let hardly = |x: &f64| *x > ZERO * self.most && *x < HARDLY * self.most;
        self.solved[..self.found.normals].iter().any(hardly)
    }

    /// Whether all contacts stay closed and all friction sticks.
    fn rests(&self) -> bool {
        (0..self.after.len()).all(|at| self.stays(at))
    }

    /// The modes in which all candidates rest with these forces. Friction without an equation of its own carries its share.
    /// None if a driver decides whether it slides.
    fn at_rest(&self, model: &Model, place: &StateAt<'_>) -> Option<Vec<ForceMode>> {
        let force = |k: usize| self.at(k).map_or(0.0, |at| self.solved[at]);
        let part = |k: usize| {
            let own = &self.found.all[self.at(k)?];
            let (contact, mu) = own.of?;
            let limit = mu * self.found.all[contact].unit * self.solved[contact];
            Some(if limit > 0.0 { (force(k) * own.unit / limit).abs() } else { 0.0 })
        };
        // contacts without force separate, and friction that needs most of its limit has an equation of its own
        let presses = |(k, _): &(usize, f64)| {
            let normal = self.at(*k).filter(|at| *at < self.found.normals);
            normal.is_none_or(|at| self.solved[at] > ZERO * self.most)
        };
        let mut left = self.candidates.iter().copied().filter(presses).list();
        left.order_by(|(a, _), (b, _)| match (part(*a), part(*b)) {
            (Some(a), Some(b)) => b.total_cmp(&a),
            (None, None) => force(*b).total_cmp(&force(*a)),
            (a, b) => a.is_some().cmp(&b.is_some()),
        });
        let mut modes = with_held(model, place, self.free, &left);
        let shares = |own: &&mut ForceMode| {
            matches!(own.mode, Mode::Follows { .. } | Mode::Idle) && part(own.force).is_some()
        };
        for own in modes.iter_mut().filter(shares) {
            if !holders(model, place, own.force).is_empty() {
                return None;
            }
            let at = self.at(own.force)?;
            own.mode = Mode::Carries(-self.scale * self.solved[at] * self.found.all[at].unit);
        }
        Some(modes)
    }

    /// The modes of this solution that can be `tried`.
    fn in_modes(
        mut self,
        (model, place): (&Model, &StateAt<'_>),
        tried: &Tried<'_>,
    ) -> Option<Vec<ForceMode>> {
        [false, true].into_iter().find_map(|only_pressing| {
            self.only_pressing = only_pressing;
            let ways = [self.sharing(), self.alone(model, place)];
            ways.iter().find_map(|(now, left)| tried(well_led(model, place, now, left)))
        })
    }

    /// The friction among the candidates that slides, with its direction, where sliding has another coefficient.
    fn weakened(&self, model: &Model) -> Vec<(usize, f64)> {
        let of = |at: usize| {
            let own = &self.found.all[at];
            let kinetic = model.forces[own.force].element.coefficients()[0];
            let differs = own.of.is_some_and(|(_, mu)| mu != kinetic);
            (differs && !self.stays(at)).then_some((own.force, self.after[at].signum()))
        };
        (self.found.normals..self.after.len()).filter_map(of).list()
    }

    /// The candidates that hold, those with the largest forces first, and the modes of the others. Friction that sticks
    /// shares its forces.
    fn sharing(&self) -> (Vec<ForceMode>, Vec<(usize, f64)>) {
        let mut modes = self.free.to_vec();
        for own in &mut modes {
            let Some(at) = self.at(own.force).filter(|at| *at >= self.found.normals) else {
                continue;
            };
            if !self.stays(at) {
                own.mode = Mode::Slides(self.after[at].signum());
            }
        }
        let holds = |(k, _): &(usize, f64)| self.at(*k).is_none_or(|at| self.stays(at));
        let mut left = self.candidates.iter().copied().filter(holds).list();
        let force = |(k, _): &(usize, f64)| self.at(*k).map_or(0.0, |at| self.solved[at].abs());
        left.order_by(|a, b| force(b).total_cmp(&force(a)));
        (modes, left)
    }

    /// The same, but only friction between its limits holds. Its equations are independent, because the solution is a vertex
    /// of all solutions. Other friction that sticks has no force, or that of its limit.
    fn alone(&self, model: &Model, place: &StateAt<'_>) -> (Vec<ForceMode>, Vec<(usize, f64)>) {
        let (mut modes, mut left) = self.sharing();
        let ends = |at: usize| -> Option<Mode> {
            let (contact, mu) = self.found.all[at].of?;
            let limit = mu * self.found.all[contact].unit / self.found.all[at].unit;
            let (own, most) = (self.solved[at], limit * self.solved[contact]);
            let zero = ZERO * self.most;
            match own.abs() {
                x if x <= zero => Some(Mode::Idle),
                x if x >= most - zero => Some(Mode::Slides(-own.signum())),
                _ => None,
            }
        };
        let held = left.iter().filter_map(|(k, _)| Some((*k, ends(self.at(*k)?)?))).list();
        for (force, mode) in held {
            let slack = begins(model, place, self.free, force);
            left.retain(|(k, _)| *k != force);
            if let Some(own) = modes.iter_mut().find(|of| of.force == force) {
                *own = ForceMode { slack, ..ForceMode::new(force, mode) };
            }
        }
        (modes, left)
    }
}
