//! The items of a model over any scalar: bodies, joints, drivers and forces.

use super::body_shape::{BodyShape, Weighed};
use super::curves::Curves;
use super::outline::Outline;
use crate::elements::{
    BodyId, Constraint, Equation, ForceElement, Group, JointId, Mode, OwnState, QuantityKind,
};
use crate::expression::Tape;
use crate::math::{Listed, Local, Real};
use serde::{Deserialize, Serialize};

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body<S = f64> {
    /// Its name.
    pub name: String,
    /// The `type` in the file.
    pub kind: &'static str,
    /// Mass, kg; zero for ground.
    pub mass: S,
    /// Moment of inertia about the mass centre, kg·m².
    pub inertia: S,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Named points in the body frame, m.
    pub points: Vec<(String, Local<S>)>,
    /// Named curves in the body frame.
    pub curves: Curves<S>,
    /// The homogeneous pieces that determine mass, mass centre and inertia; empty if these are given.
    pub shapes: Vec<BodyShape<S>>,
    /// Its outline. None if a link around its points or its shapes are drawn.
    pub outline: Option<Outline<S>>,
    /// Drawn position: x, y, angle. A guess for assembly.
    pub drawn: Option<[S; 3]>,
    /// Whether the angle is a coordinate. A point mass has no angle.
    pub turns: bool,
}

impl<S> Body<S> {
    /// Converts the body to another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Body<T> {
        let mut local = |s: &Local<S>| Local { x: f(&s.x), y: f(&s.y) };
        let center = local(&self.center);
        let points = self.points.iter().map(|(name, s)| (name.clone(), local(s))).list();
        let curves = self.curves.iter();
        let curves = curves.map(|(name, c)| (name.clone(), c.as_ref().map(|c| c.map(f)))).list();
        Body {
            curves,
            name: self.name.clone(),
            kind: self.kind,
            mass: f(&self.mass),
            inertia: f(&self.inertia),
            center,
            points,
            shapes: self.shapes.iter().map(|shape| shape.map(f)).list(),
            outline: self.outline.as_ref().map(|outline| outline.map(f)),
            drawn: self.drawn.as_ref().map(|[x, y, angle]| [f(x), f(y), f(angle)]),
            turns: self.turns,
        }
    }

    /// The body with the mass, mass centre and inertia of its shapes, if it has any.
    pub(super) fn weighed(self) -> Self
    where
        S: Real,
    {
        if self.shapes.is_empty() {
            return self;
        }
        let Weighed { mass, center, inertia } = BodyShape::together(&self.shapes);
        Self { mass, center, inertia, ..self }
    }

    /// Whether some of its points are unknown because a fault was reported for them.
    pub fn lacks_points(&self) -> bool {
        self.points.iter().any(|(name, _)| name.is_empty())
    }

    /// A named point.
    pub fn point(&self, name: &str) -> Option<&Local<S>> {
        self.points.iter().find(|(n, _)| n == name).map(|(_, s)| s)
    }
}

impl Body<Tape> {
    /// Whether the mass centre is the origin of the frame for all parameter values.
    pub fn is_centred(&self) -> bool {
        let zero = |tape: &Tape| tape.constant() == Some(0.0);
        match self.shapes.is_empty() {
            true => zero(&self.center.x) && zero(&self.center.y),
            false => self.shapes.iter().all(BodyShape::is_centred),
        }
    }
}

/// A joint or driver in a model.
#[derive(Clone, Debug)]
pub struct ConstraintItem<S = f64> {
    /// Its name.
    pub name: String,
    /// Joint or driver.
    pub group: Group,
    /// The bodies whose poses occur in Φ: i and j first.
    pub bodies: Vec<BodyId>,
    /// The element. If there is a `law`, the element has the values of its formulas at t = 0.
    pub element: Constraint<S>,
    /// The element over formulas, if one of them depends on time or state.
    pub law: Option<Box<Constraint<Tape>>>,
    /// Whether a law of the element uses a coordinate of a body, which is measured from ground.
    pub measures_from_ground: bool,
    /// Whether time or a driven motion does work through the constraint.
    pub driven: bool,
    /// Equations, in the order of the rows.
    pub equations: Vec<Equation>,
    /// The index of the force that belongs to it: the friction of a joint that may slip, or the limit of a driver.
    pub companion: Option<usize>,
    /// The switch of its curve. The function of this switch is the first internal coordinate.
    pub curve_switch: Option<usize>,
}

impl<S> ConstraintItem<S> {
    /// The opening as a length or as an angle: the root of the sum of squares of the residuals of this kind.
    pub fn opening(&self, kind: QuantityKind, residuals: &[f64]) -> f64 {
        let own = self.equations.iter().zip(residuals).filter(|(own, _)| own.kind == kind);
        own.map(|(_, x)| x * x).sum::<f64>().sqrt()
    }

    /// The largest residual and its kind.
    pub fn largest(&self, residuals: &[f64]) -> (f64, QuantityKind) {
        let own = self.equations.iter().zip(residuals).map(|(own, x)| (x.abs(), own.kind));
        own.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
    }
}

/// The mode of a force in a phase.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForceMode {
    /// Index of the force in the model.
    pub force: usize,
    /// Its mode.
    pub mode: Mode,
    /// The value of the coordinate that friction holds.
    pub value: f64,
    /// The rounding error of the gap or force of a contact. The mode changes only below minus this value.
    pub slack: f64,
    /// The drivers that hold the coordinate of friction. Where they stand still, it is at rest whatever the errors of
    /// its speed.
    pub held_by: DriverSet,
}

impl ForceMode {
    /// A force in a mode, without rounding errors.
    pub fn new(force: usize, mode: Mode) -> Self {
        Self { force, mode, value: 0.0, slack: 0.0, held_by: DriverSet::default() }
    }
}

/// Some of the constraints of a model, by their indices. Those from index 127 on are in a set together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DriverSet(u128);

impl DriverSet {
    /// The set of these constraints.
    pub fn of(indices: impl IntoIterator<Item = usize>) -> Self {
        Self(indices.into_iter().fold(0, |set, k| set | Self::bit(k)))
    }

    /// Whether it has no constraints.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether it contains a constraint.
    pub fn contains(self, index: usize) -> bool {
        self.0 & Self::bit(index) != 0
    }

    fn bit(index: usize) -> u128 {
        1 << index.min(127)
    }
}

/// A force in a model.
#[derive(Clone, Debug)]
pub struct ForceItem<S = f64> {
    /// Its name.
    pub name: String,
    /// The bodies on which it acts: i and j first.
    pub bodies: Vec<BodyId>,
    /// Its first-order states.
    pub states: &'static [OwnState],
    /// The joint whose reaction the force uses.
    pub reaction: Option<JointId>,
    /// The indices of its further parts.
    pub further: std::ops::Range<usize>,
    /// The index of the friction of a contact, or of the contact of a friction, see [`Force::companion`](crate::elements::Force::companion).
    pub partner: Option<usize>,
    /// Whether the force is the friction of a contact.
    pub is_companion: bool,
    /// The row of λ on which the force depends in place of the reaction of a joint.
    pub load_row: Option<usize>,
    /// The element. If there is a `law`, the element has the values of its formulas at t = 0.
    pub element: ForceElement<S>,
    /// The element over formulas, if one of them depends on time or state.
    pub law: Option<Box<ForceElement<Tape>>>,
    /// Index in [`Model::switches`](super::Model) of the first switch of the element itself, without switches of its
    /// laws.
    pub first_switch: usize,
    /// The mode of the force in this phase of a run.
    pub mode: Mode,
    /// The row of λ of the equation by which the force holds. If this equation is not in the model, the row follows
    /// all rows of the model, in the order of the forces with modes.
    pub held_row: Option<usize>,
}

impl<S> ForceItem<S> {
    /// Whether its results need multipliers.
    pub fn needs_multipliers(&self) -> bool {
        self.reaction.is_some() || self.held_row.is_some() || self.partner.is_some()
    }
}
