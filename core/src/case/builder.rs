//! A model written in Rust, with the same checks as a file.

use super::body_builder::{Bar, Beam, BodyBuilder, General, Ground, PointMass};
use super::{read, write, Case, Format};
use crate::analyses::measures;
use crate::elements::{catalogue, Element, Group, Number, Pair, Value, Written};
use crate::math::Listed;
use crate::model::{build, Definition, Entry, Model, Problem, Problems};

/// Writes a model in Rust.
///
/// The builder collects a [`Definition`], as the reader of files does, and therefore reports the same faults. As in a
/// file, the order of the bodies is their order in q, and the order of the joints and drivers is their order in Φ.
///
/// ```
/// use kempe::{joints::Revolute, ModelBuilder};
///
/// let mut m = ModelBuilder::new("pendulum");
/// m.gravity(0.0, -9.81).parameter("L", 1.5);
/// m.ground().point("O", 0.0, 0.0);
/// m.bar("rod").mass(2.0).length("L").ends("A", "B");
/// m.add("O", Revolute::written().i("ground.O").j("rod.A"));
/// let model = m.build()?;
/// assert_eq!(model.bodies[1].inertia, 2.0 * 1.5 * 1.5 / 12.0);
/// # Ok::<(), kempe::Problems>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelBuilder {
    definition: Definition,
}

impl ModelBuilder {
    /// A model without bodies.
    pub fn new(title: &str) -> Self {
        let title = Some(title.to_string());
        Self { definition: Definition { title, ..Definition::default() } }
    }

    /// Acceleration of free fall, m/s²; zero if it is not given.
    pub fn gravity(&mut self, x: impl Into<Number>, y: impl Into<Number>) -> &mut Self {
        self.definition.gravity = Some(Pair::from((x, y)).into());
        self
    }

    /// A named parameter: a number, or a formula in other parameters.
    pub fn parameter(&mut self, name: &str, value: impl Into<Number>) -> &mut Self {
        self.definition.parameters.push((name.to_string(), value.into().into()));
        self
    }

    /// A measure: a named expression of quantities, such as `C.force`; see [`measures`](crate::analyses::measures).
    pub fn measure(&mut self, name: &str, expression: &str) -> &mut Self {
        let text = Value::Text(expression.to_string());
        self.definition.measures.push((name.to_string(), text));
        self
    }

    /// Accepts redundant constraints. Their multipliers are then those of least norm that balance the loads.
    pub fn allow_redundancy(&mut self) -> &mut Self {
        self.definition.redundancy = Some("allow".to_string());
        self
    }

    /// The points of ground.
    pub fn ground(&mut self) -> BodyBuilder<'_, Ground> {
        let bodies = &mut self.definition.bodies;
        let at = bodies.iter().position(|body| body.name == "ground").unwrap_or_else(|| {
            bodies.push(Entry { name: "ground".to_string(), fields: Vec::new() });
            bodies.len() - 1
        });
        BodyBuilder::new(&mut bodies[at])
    }

    /// A uniform slender bar: its frame is at its centre with x along it, its inertia is m L²/12.
    pub fn bar(&mut self, name: &str) -> BodyBuilder<'_, Bar> {
        BodyBuilder::new(self.body_of_type(name, "bar"))
    }

    /// A point with mass and the named point P; it has no angle.
    pub fn point_mass(&mut self, name: &str) -> BodyBuilder<'_, PointMass> {
        BodyBuilder::new(self.body_of_type(name, "point_mass"))
    }

    /// A link that bends.
    pub fn beam(&mut self, name: &str) -> BodyBuilder<'_, Beam> {
        BodyBuilder::new(self.body_of_type(name, "beam"))
    }

    /// A rigid body of any form.
    pub fn body(&mut self, name: &str) -> BodyBuilder<'_, General> {
        BodyBuilder::new(self.body_of_type(name, "body"))
    }

    fn body_of_type(&mut self, name: &str, kind: &str) -> &mut Entry {
        let fields = vec![("type".to_string(), kind.into())];
        let bodies = &mut self.definition.bodies;
        bodies.push(Entry { name: name.to_string(), fields });
        let last = bodies.len() - 1;
        &mut bodies[last]
    }

    /// A joint, a driver or a force.
    pub fn add<E: Element>(&mut self, name: &str, element: Written<E>) -> &mut Self {
        let kind = E::table().name;
        let mut fields = vec![("type".to_string(), Value::from(kind))];
        let given = element.into_fields();
        given.into_iter().map(|(field, value)| (field.to_string(), value)).append_to(&mut fields);
        let listed = catalogue().into_iter().find(|(_, table)| table.name == kind);
        let section = match listed.map_or(Group::Joints, |(group, _)| group) {
            Group::Joints => &mut self.definition.joints,
            Group::Drivers => &mut self.definition.drivers,
            Group::Forces => &mut self.definition.forces,
        };
        section.push(Entry { name: name.to_string(), fields });
        self
    }

    /// The model as written, for a [`Case`] or a file.
    pub fn definition(&self) -> &Definition {
        &self.definition
    }

    /// The model as numbers.
    ///
    /// # Errors
    /// Every fault of the definition.
    pub fn build(&self) -> Result<Model, Problems> {
        self.build_with::<Number>(&[])
    }

    /// The model as numbers, with other values of some parameters.
    ///
    /// # Errors
    /// As [`build`](Self::build); also parameters that the model does not have.
    pub fn build_with<N: Clone + Into<Number>>(
        &self,
        parameters: &[(&str, N)],
    ) -> Result<Model, Problems> {
        let case = Case { definition: self.definition.clone(), ..Case::default() };
        structure(&case)?;
        let value = |(name, value): &(&str, N)| (name.to_string(), value.clone().into().into());
        let parameters: Vec<(String, Value)> = parameters.iter().map(value).list();
        let model = build(&case.definition, &parameters)?;
        match measures::check(&model, &case.definition.measures) {
            found if found.is_empty() => Ok(model),
            found => Err(Problems(found)),
        }
    }
}

/// The faults that the reader of files finds, such as missing fields and names that are used twice or reserved.
fn structure(case: &Case) -> Result<(), Problems> {
    let mut problems = given_twice(&case.definition);
    if let Err(found) = read(&write(case, Format::Json), Format::Json) {
        // faults without a path are keys that occur twice; their line in the generated text has no meaning
        let placed = found.into_iter().filter(|fault| !fault.path.is_empty());
        problems.extend(
            placed.map(|fault| Problem::at(&fault.path, fault.message).maybe_hint(fault.hint)),
        );
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(Problems(problems)),
    }
}

/// The problems of names that are used twice. They are keys of one table, so that a file cannot contain them twice.
fn given_twice(definition: &Definition) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut report = |path: &[&str], names: Vec<&str>| {
        let mut seen = std::collections::HashSet::new();
        for name in names {
            if !seen.insert(name) {
                let message = format!("'{}' is given twice", super::shown(name));
                problems.push(Problem::at(&[path, &[name]].concat(), message));
            }
        }
    };
    report(&["parameters"], definition.parameters.iter().map(|(name, _)| name.as_str()).list());
    report(&["measures"], definition.measures.iter().map(|(name, _)| name.as_str()).list());
    for (section, entries) in [
        ("tables", &definition.tables),
        ("bodies", &definition.bodies),
        ("joints", &definition.joints),
        ("drivers", &definition.drivers),
        ("forces", &definition.forces),
    ] {
        report(&[section], entries.iter().map(|entry| entry.name.as_str()).list());
        for entry in entries {
            for (field, value) in &entry.fields {
                if let Value::Table(points) = value {
                    let names = points.iter().map(|(name, _)| name.as_str()).list();
                    report(&[section, &entry.name, field], names);
                }
            }
        }
    }
    problems
}
