//! Named quantities of a motion as numbers at one state: positions, rates, accelerations and results.

use super::balances::{total, Energies};
use super::so_far::SoFar;
use super::step_part::StepPart;
use crate::elements::{BodyId, Followed};
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::measured::{self, ElementId};
use crate::equations::reactions::Frame;
use crate::equations::{actions, constraints, energy};
use crate::expression::Tape;
use crate::integrate::Bounds;
use crate::math::{each, Local, Real, Vec2, Wrench};
use crate::model::{Model, WORKS};

/// A state at which signals are evaluated.
pub(super) struct Seen<'a, S = f64> {
    /// Time, s.
    pub t: S,
    /// Coordinates, rates and first-order states.
    pub state: [&'a [S]; 3],
    /// Works up to the state, J; those of the whole mechanism, and the energies that forces have dissipated, if they
    /// are summed.
    pub works: &'a [S],
    /// The positions and rates of the state as poses and twists.
    pub motions: &'a Motions<S>,
    /// Accelerations and multipliers; NaN where they are not unique.
    pub solved: [&'a [S]; 2],
    /// The run up to the state, if it is known.
    pub so_far: Option<&'a SoFar>,
}

impl<S: Real> Seen<'_, S> {
    /// The quantities on which forces depend in addition to the motion.
    pub fn acting(&self) -> Acting<'_, S> {
        Acting { z: self.state[2], lam: Some(self.solved[1]), t: self.t }
    }
}

/// Energies and works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Energy {
    Kinetic,
    Potential,
    Dissipated,
    Work,
    Total,
    /// Change of the total, relative to the energies of the run so far.
    Balance,
}

/// A component of a force or of a reaction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ForcePart {
    X,
    Y,
    Size,
    Torque,
}

impl ForcePart {
    fn of<S: Real>(self, w: &Wrench<S>) -> S {
        match self {
            Self::X => w.force.x,
            Self::Y => w.force.y,
            Self::Size => w.force.norm(),
            Self::Torque => w.torque,
        }
    }
}

/// A quantity of a motion. An order is the number of time derivatives.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Signal {
    /// A constant quantity.
    Constant(f64),
    /// A coordinate by its column.
    Column { order: usize, column: usize },
    /// A first-order state by its index.
    State(usize),
    /// A component, 0 or 1, of a point of a body by its index.
    Point { body: BodyId, point: usize, axis: usize, order: usize },
    /// A position quantity of an element.
    Measured { id: ElementId, k: usize, order: usize },
    /// The reaction of a joint on its body j.
    Reaction { k: usize, part: ForcePart },
    /// A result of a joint other than its reaction.
    Result { k: usize, place: usize },
    /// The effort of a driver.
    Effort(usize),
    /// The effort of a driver times the rate of its coordinate.
    Power(usize, Box<Signal>),
    /// The force or torque of a force element on its body j.
    Force { k: usize, part: ForcePart },
    /// A force along the line between two points, positive if it pushes. For a force element, the force on j; for a
    /// joint, with the opposite sign.
    Line { id: ElementId },
    /// A result of a force element other than its wrenches.
    ForceResult { k: usize, place: usize },
    /// A result of the pieces of a beam: the largest, or the sum.
    OfBeam { pieces: Vec<ElementId>, place: usize, sum: bool },
    /// Power of a force element on its bodies.
    ForcePower(usize),
    /// Energy that a force element stores.
    ForceEnergy(usize),
    /// Energy that a force element has dissipated since the start of the run.
    ForceDissipated(usize),
    /// Power that a force element dissipates. Formulas cannot use it.
    ForceDissipating(usize),
    /// An energy of the whole mechanism.
    Energy(Energy),
    /// Largest violation of the constraints, or of their rates.
    Drift { order: usize },
    /// Largest Newton–Euler residual, relative to the forces of the run so far.
    Balance,
}

impl Signal {
    /// Whether the quantity needs accelerations or multipliers.
    pub fn needs_solution(&self, model: &Model) -> bool {
        match self {
            Self::Column { order, .. }
            | Self::Point { order, .. }
            | Self::Measured { order, .. } => *order == 2,
            Self::Reaction { .. } | Self::Result { .. } | Self::Effort(_) | Self::Power(..) => true,
            Self::Balance => true,
            Self::Line { id: ElementId::Constraint(_) } => true,
            Self::Line { id: ElementId::Force(k) } | Self::Force { k, .. } => {
                model.forces[*k].needs_multipliers()
            }
            Self::ForceEnergy(k) => {
                model.forces[*k].reaction.is_some() || model.forces[*k].partner.is_some()
            }
            Self::ForceResult { k, .. }
            | Self::ForcePower(k)
            | Self::ForceDissipated(k)
            | Self::ForceDissipating(k) => model.forces[*k].needs_multipliers(),
            Self::Constant(_) | Self::State(_) | Self::Energy(_) => false,
            Self::OfBeam { pieces, .. } => matches!(pieces[..], [ElementId::Constraint(_), ..]),
            Self::Drift { .. } => false,
        }
    }

    /// Bounds of the quantity in a part of a step. `formula` is the formula of a position quantity or of its integral.
    /// None if they are not known.
    pub fn bounds(&self, part: &StepPart<'_>, formula: Option<&Followed<Tape>>) -> Option<Bounds> {
        Some(match self {
            Self::Constant(x) => Bounds::constant(*x),
            Self::Column { order: order @ (0 | 1), column } => part.column(*column, *order == 1),
            Self::State(k) => part.state(*k),
            Self::Point { body, point, axis, order: order @ (0 | 1) } => {
                part.point(*body, *point, *axis, *order == 1)
            }
            Self::Measured { id, order: order @ (0 | 1), .. } => {
                let of = |part: &StepPart<'_>| match id {
                    ElementId::Force(k) if part.is_contact(*k) => part.gap(*k),
                    _ => formula.map(|of| part.followed(of)),
                };
                return if *order == 0 { of(part) } else { part.rate(of) };
            }
            Self::Energy(Energy::Dissipated) => part.work(0),
            Self::Energy(Energy::Work) => part.work(1) + part.work(2),
            _ => return None,
        })
    }

    /// The value of the quantity at a state.
    pub fn value<S: Real>(&self, model: &Model<S>, seen: &Seen<'_, S>) -> S {
        let [a, lam] = seen.solved;
        match self {
            Self::Constant(x) => S::constant(*x),
            Self::Column { order: 2, column } => a[*column],
            Self::Column { order, column } => seen.state[*order][*column],
            Self::State(k) => seen.state[2][*k],
            Self::Point { body, point, axis, order } => {
                let s = model.bodies[body.0].points[*point].1;
                let jet = measured::point(model, *body, s, seen.motions, a)[*axis];
                [jet.value, jet.rate, jet.second][*order]
            }
            Self::Measured { id, k, order } => {
                let jet = measured::measured(model, *id, seen.motions, a)[*k];
                [jet.value, jet.rate, jet.second][*order]
            }
            Self::Reaction { k, part } => part.of(&reaction(model, *k, seen)),
            Self::Result { k, place } => result(model, *k, *place, seen),
            Self::Effort(k) => -own(model, *k, lam)[0],
            Self::Power(k, rate) => -own(model, *k, lam)[0] * rate.value(model, seen),
            Self::Force { k, part } => part.of(&force_on_j(model, *k, seen)),
            Self::Line { id } => line(model, *id, seen),
            Self::ForceResult { k, place } => force_result(model, *k, *place, seen),
            Self::OfBeam { pieces, place, sum } => {
                let of = |id: &ElementId| match id {
                    ElementId::Constraint(k) => result(model, *k, *place, seen),
                    ElementId::Force(k) => force_result(model, *k, *place, seen),
                };
                pieces
                    .iter()
                    .map(of)
                    .fold(S::zero(), |all, x| if *sum { all + x } else { all.max(x) })
            }
            Self::ForcePower(k) => power(model, *k, seen),
            Self::ForceEnergy(k) => actions::stored(model, *k, seen.motions, seen.acting()),
            Self::Energy(of) => energy_of(model, *of, seen),
            Self::Drift { order } => drift(model, *order, seen),
            Self::ForceDissipated(k) => match seen.works.get(WORKS + k) {
                Some(energy) => *energy,
                None => of_run(seen, |so_far| so_far.of(*k)),
            },
            Self::ForceDissipating(k) => {
                actions::dissipated(model, *k, seen.motions, seen.acting())
            }
            Self::Balance => of_run(seen, SoFar::reaction_balance),
        }
    }
}

/// A value of the run up to the state. NaN if the run is not known.
fn of_run<S: Real>(seen: &Seen<'_, S>, value: impl Fn(&SoFar) -> Option<f64>) -> S {
    S::constant(seen.so_far.and_then(value).unwrap_or(f64::NAN))
}

fn own<'l, S>(model: &Model<S>, k: usize, lam: &'l [S]) -> &'l [S] {
    &lam[model.layout.constraints[k].rows.clone()]
}

/// Body j of an element, or the only body.
fn body_j(bodies: &[BodyId]) -> BodyId {
    bodies[bodies.len().min(2) - 1]
}

fn reaction<S: Real>(model: &Model<S>, k: usize, seen: &Seen<'_, S>) -> Wrench<S> {
    let on = body_j(&model.constraints[k].bodies);
    let found = actions::reaction(model, k, on, Frame::Global, seen.motions, seen.acting());
    found.unwrap_or_else(Wrench::zero)
}

/// A result of a joint or driver.
fn result<S: Real>(model: &Model<S>, k: usize, place: usize, seen: &Seen<'_, S>) -> S {
    let mut out = vec![S::zero(); model.constraints[k].element.result_quantities().len()];
    actions::results_of_joint(model, k, seen.motions, seen.acting(), &mut out);
    out[place]
}

fn force_result<S: Real>(model: &Model<S>, k: usize, place: usize, seen: &Seen<'_, S>) -> S {
    let mut out = vec![S::zero(); model.forces[k].element.result_quantities().len()];
    actions::results(model, k, seen.motions, seen.acting(), &mut out);
    out[place]
}

fn force_on_j<S: Real>(model: &Model<S>, k: usize, seen: &Seen<'_, S>) -> Wrench<S> {
    let (on, mut sum) = (body_j(&model.forces[k].bodies), Wrench::zero());
    actions::each_action(model, k, seen.motions, seen.acting(), |_, body, wrench| {
        if body == on {
            sum = sum + wrench;
        }
    });
    sum
}

fn power<S: Real>(model: &Model<S>, k: usize, seen: &Seen<'_, S>) -> S {
    let mut sum = S::zero();
    for k in model.whole(k) {
        forces::each_wrench(model, k, seen.motions, seen.acting(), |_, body, wrench| {
            sum += wrench.power(seen.motions[body.0].twist);
        });
    }
    sum
}

/// The force along the line from point i to point j; zero if the points coincide.
fn line<S: Real>(model: &Model<S>, id: ElementId, seen: &Seen<'_, S>) -> S {
    let (bodies, points, force) = match id {
        ElementId::Constraint(k) => {
            let item = &model.constraints[k];
            let points = each([0, 1], |end| item.element.attachment(end).s);
            // a tension on i points towards j
            let force = reaction(model, k, seen).force;
            (&item.bodies, points, Vec2::new(-force.x, -force.y))
        }
        ElementId::Force(k) => {
            let item = &model.forces[k];
            let points = item.element.points().unwrap_or([Local::zero(); 2]);
            (&item.bodies, points, force_on_j(model, k, seen).force)
        }
    };
    let at = |end: usize| seen.motions[bodies[end.min(bodies.len() - 1)].0].pose.point(points[end]);
    let d = at(1) - at(0);
    let length = d.norm();
    S::select(length, d.dot(force) / length, S::zero())
}

fn energy_of<S: Real>(model: &Model<S>, of: Energy, seen: &Seen<'_, S>) -> S {
    let works = |k: usize| seen.works.get(k).copied().unwrap_or(S::zero());
    match of {
        Energy::Kinetic => energy::kinetic(model, seen.motions),
        Energy::Potential => energy::potential(model, seen.motions, seen.state[2], seen.t),
        Energy::Dissipated => works(0),
        Energy::Work => works(1) + works(2),
        Energy::Total => total(energies(model, seen)),
        Energy::Balance => of_run(seen, SoFar::energy_balance),
    }
}

/// The energies at a state, J.
pub(super) fn energies<S: Real>(model: &Model<S>, seen: &Seen<'_, S>) -> Energies<S> {
    let works = each([0, 1, 2], |k| seen.works.get(k).copied().unwrap_or(S::zero()));
    let kinetic = energy::kinetic(model, seen.motions);
    let potential = energy::potential(model, seen.motions, seen.state[2], seen.t);
    [kinetic, potential, works[0], works[1], works[2]]
}

fn drift<S: Real>(model: &Model<S>, order: usize, seen: &Seen<'_, S>) -> S {
    let terms = constraints::terms_at(model, seen.motions, seen.t);
    terms[order].iter().fold(S::zero(), |most, x| most.max(x.abs()))
}
