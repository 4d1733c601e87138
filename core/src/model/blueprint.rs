//! A model over formulas: the definition with all names linked, before numbers are inserted.

use super::beam_names::is_weld;
use super::companions;
use super::definition::{Definition, Entry, Value};
use super::doubt::Doubt;
use super::functions::Functions;
use super::items::{Body, ForceMode};
use super::link::Linker;
use super::pairs;
use super::play;
use super::problem::Problem;
use super::quantities::Quantities;
use super::scope::{states, Scope};
use super::variable::Variable;
use crate::elements::{
    holding, BodyId, Constraint, CoordinateOf, Fixes, Followed, ForceElement, Group, JointId,
    OwnState,
};
use crate::expression::{Expression, Inferred, Symbol, Table, Tape};
use crate::math::Listed;
use std::sync::Arc;

/// A joint or driver over formulas: its name, section and element.
pub type LinkedConstraint = (String, Group, Constraint<Tape>);

/// A force over formulas: its name, first-order states and element.
pub type LinkedForce = (String, &'static [OwnState], ForceElement<Tape>);

/// The linked content of a file: elements over [`Tape`]. A clone shares its lists until they change.
#[derive(Clone, Debug)]
pub struct Blueprint {
    /// Title.
    pub title: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Their formulas.
    pub formulas: Vec<(String, Expression)>,
    /// Their dimensions, if they are written with units.
    pub inferred: Vec<Inferred>,
    /// The tables that formulas may call.
    pub tables: Vec<Arc<Table>>,
    /// Whether redundant constraints are accepted.
    pub allow_redundancy: bool,
    /// Acceleration of free fall.
    pub gravity: [Tape; 2],
    /// Bodies; index 0 is ground.
    pub bodies: Arc<Vec<Body<Tape>>>,
    /// Joints, then drivers.
    pub constraints: Arc<Vec<LinkedConstraint>>,
    /// Forces, with their first-order states.
    pub forces: Arc<Vec<LinkedForce>>,
    /// The forces before the companions are further parts of these forces, a contact of two curves for example. They
    /// follow each other.
    pub further: Arc<Vec<usize>>,
    /// The last forces are companions: of these forces, see [`Force::companion`](crate::elements::Force::companion), or
    /// the friction of joints that may slip, and the limits of drivers.
    pub companions: Arc<Vec<Option<usize>>>,
    /// The modes of forces in a phase of a run. Forces that hold have the last constraints, in this order.
    pub modes: Vec<ForceMode>,
    /// Number of the last constraints that equations of second order imply.
    pub implied: usize,
    /// Changes of the phases of meshed wheels, by the names of the joints, m.
    pub phases: Vec<(String, f64)>,
    /// Laws that the host computes.
    pub functions: Option<Functions>,
    /// Angles that look like degrees.
    pub doubts: Vec<Doubt>,
    /// The mechanism with rigid beams, in which assembly closes it. It has the same bodies.
    pub rigid: Option<Arc<Blueprint>>,
}

impl Blueprint {
    /// Links all joints, drivers and forces of a definition. Returns the further parts of forces with their indices.
    pub(super) fn link_all(
        &mut self,
        definition: &Definition,
        scope: &Scope,
        quantities: &dyn Quantities,
        problems: &mut Vec<Problem>,
    ) -> Vec<(usize, LinkedForce)> {
        let mut further = Vec::new();
        for (group, entries) in [
            (Group::Joints, &definition.joints),
            (Group::Drivers, &definition.drivers),
            (Group::Forces, &definition.forces),
        ] {
            for entry in entries {
                let group = if play::is_written(entry) { Group::Joints } else { group };
                self.link((group, entry), scope, quantities, problems, &mut further);
            }
        }
        further
    }

    fn link(
        &mut self,
        (group, entry): (Group, &Entry),
        scope: &Scope,
        quantities: &dyn Quantities,
        problems: &mut Vec<Problem>,
        further: &mut Vec<(usize, LinkedForce)>,
    ) {
        let Some(Value::Text(kind)) = entry.get("type") else {
            let message = format!("this {} has no type", group.singular());
            problems.push(Problem::at(&[group.section(), &entry.name], message));
            return;
        };
        let linked = (self.bodies.as_slice(), self.constraints.as_slice());
        let mut linker = Linker::new(group, entry, scope, linked, quantities, problems);
        let force = match group {
            Group::Forces => Some(pairs::read(kind, &mut linker)),
            _ if play::is_written(entry) => {
                Some(play::read(entry, kind, &mut linker).map(|e| e.map(|e| vec![e])))
            }
            _ => None,
        };
        let known = if let Some(force) = force {
            force.map(|all| {
                let all = all.unwrap_or_default();
                if all.first().is_some_and(|e| self.two_bodies(group, entry, &e.bodies(), problems))
                {
                    let k = self.forces.len();
                    let linked = |e| (entry.name.clone(), states(entry), e);
                    let mut all = all.into_iter().map(linked);
                    Arc::make_mut(&mut self.forces).extend(all.next());
                    further.extend(all.map(|e| (k, e)));
                }
            })
        } else {
            Constraint::read(group, kind, &mut linker).map(|e| {
                let e = e.filter(|e| {
                    self.two_bodies(group, entry, &e.bodies(), problems)
                        && self.not_circular(entry, e, problems)
                        && has_velocity(group, entry, e, problems)
                });
                let linked = e.map(|e| (entry.name.clone(), group, e));
                Arc::make_mut(&mut self.constraints).extend(linked);
            })
        };
        if known.is_none() {
            let path = [group.section(), &entry.name, "type"];
            let message = format!("there is no {} of type '{kind}'", group.singular());
            problems.push(Problem::at(&path, message));
        }
    }

    /// Reports an element between a body and itself, which would be empty or impossible.
    fn two_bodies(
        &self,
        group: Group,
        entry: &Entry,
        bodies: &[BodyId],
        problems: &mut Vec<Problem>,
    ) -> bool {
        let [i, j, ..] = bodies else { return true };
        if i != j {
            return true;
        }
        let body = &self.bodies[i.0].name;
        let message = format!("both ends of this {} are on '{body}'", group.singular());
        let hint = "it must connect two different bodies";
        problems.push(Problem::at(&[group.section(), &entry.name], message).hint(hint));
        false
    }

    /// Reports a driver whose law uses the coordinate that it drives.
    fn not_circular(
        &self,
        entry: &Entry,
        constraint: &Constraint<Tape>,
        problems: &mut Vec<Problem>,
    ) -> bool {
        for fixed in constraint.fixes() {
            let Fixes::Coordinate(CoordinateOf { body, coordinate }, value) = fixed else {
                continue;
            };
            let own = Symbol::Variable(Variable::Coordinate(body, coordinate).index());
            if value.symbols().contains(&own) {
                let name = format!("{}.{}", self.bodies[body.0].name, coordinate.name());
                let message = format!("the law uses {name}, the coordinate that it drives");
                problems.push(Problem::at(&["drivers", &entry.name, "value"], message));
                return false;
            }
        }
        true
    }

    /// Adds the further parts of forces.
    pub(super) fn add_further(&mut self, further: Vec<(usize, LinkedForce)>) {
        let (of, forces): (Vec<usize>, Vec<LinkedForce>) = further.into_iter().unzip();
        self.further = of.into();
        Arc::make_mut(&mut self.forces).extend(forces);
    }

    /// Lets all drivers have any effort. Their limits are forces.
    pub(super) fn lift_limits(&mut self) {
        if self.constraints.iter().any(|(.., element)| element.limit().is_some()) {
            let all = Arc::make_mut(&mut self.constraints).iter_mut();
            all.for_each(|(.., element)| element.lift_limit());
        }
    }

    /// Adds the companions of all forces, of all joints that may slip, and of all drivers with a limit.
    pub(super) fn add_companions(
        &mut self,
        quantities: &dyn Quantities,
        problems: &mut Vec<Problem>,
    ) {
        let of_force = |(k, (name, _, force)): (usize, &LinkedForce)| {
            Some((Some(k), (name.clone(), &[][..], force.companion()?)))
        };
        let of_joint = |(k, (name, _, joint)): (usize, &LinkedConstraint)| {
            let own = companions::companion_of((JointId(k), name, joint), quantities, problems)?;
            Some((None, (name.clone(), &[][..], own)))
        };
        let forces = self.forces.iter().enumerate().filter_map(of_force);
        let joints = self.constraints.iter().enumerate().filter_map(of_joint);
        let found: (Vec<Option<usize>>, Vec<LinkedForce>) = forces.chain(joints).unzip();
        self.companions = found.0.into();
        Arc::make_mut(&mut self.forces).extend(found.1);
        self.lift_limits();
    }

    /// The mechanism with additional drivers that hold coordinates at given laws. Assembly solves this model.
    pub fn holding(&self, held: &[(String, Followed<Tape>, Tape)]) -> Self {
        let drivers = held.iter().map(|(name, coordinate, value)| {
            (name.clone(), Group::Drivers, holding(coordinate.clone(), value.clone()))
        });
        let constraints = self.constraints.iter().cloned().chain(drivers).list();
        Self { constraints: constraints.into(), ..self.clone() }
    }

    /// The mechanism with only some of its constraints, and without forces.
    pub fn keeping(&self, kept: &[usize]) -> Self {
        let constraints = kept.iter().map(|k| self.constraints[*k].clone()).list();
        Self {
            constraints: constraints.into(),
            forces: Arc::default(),
            further: Arc::default(),
            companions: Arc::default(),
            ..self.clone()
        }
    }

    /// The mechanism in which beams are rigid, with the drivers, phases and further constraints of this one. None
    /// without beams.
    pub fn rigid(&self) -> Option<Self> {
        let rigid = self.rigid.as_ref()?;
        let own = |name: &str| self.constraints.iter().any(|(known, ..)| known == name);
        let kept = rigid.constraints.iter().filter(|(name, ..)| own(name) || is_weld(name));
        let known = |name: &str| rigid.constraints.iter().any(|(known, ..)| known == name);
        let further = self.constraints.iter();
        let further = further.filter(|(name, _, of)| !known(name) && of.in_files());
        let constraints = kept.chain(further).cloned().list();
        Some(Self {
            constraints: constraints.into(),
            phases: self.phases.clone(),
            formulas: self.formulas.clone(),
            ..Self::clone(rigid)
        })
    }

    /// A body by name.
    pub fn body(&self, name: &str) -> Option<BodyId> {
        self.bodies.iter().position(|b| b.name == name).map(BodyId)
    }
}

/// Reports a joint or driver whose law uses a table whose slope jumps between its points.
fn has_velocity(
    group: Group,
    entry: &Entry,
    constraint: &Constraint<Tape>,
    problems: &mut Vec<Problem>,
) -> bool {
    let mut broken = None;
    constraint.visit(&mut |tape| {
        broken = broken.take().or_else(|| {
            let found = tape.tables().into_iter().find(|table| table.is_broken());
            found.map(|table| table.name().to_string())
        });
    });
    let Some(name) = broken else { return true };
    let call = format!("{name}(");
    let reads = |value: &Value| matches!(value, Value::Text(text) if text.contains(&call));
    let field = entry.fields.iter().find(|(_, value)| reads(value));
    let place: Vec<&str> = [group.section(), entry.name.as_str()]
        .into_iter()
        .chain(field.map(|(field, _)| field.as_str()))
        .list();
    let message = format!(
        "the law reads table '{name}', whose linear interpolation makes the velocity jump at its points"
    );
    let hint = format!("write interpolation = \"cubic\" in tables.{name}");
    problems.push(Problem::at(&place, message).hint(hint));
    false
}
