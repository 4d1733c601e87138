//! The fields of a beam as data.

use super::beam_names::BEAM;
use crate::elements::{Default, Field, Shape, Table};

fn number(name: &'static str, unit: &str, doc: &str) -> Field {
    absent(name, Shape::Number, unit, doc)
}

fn absent(name: &'static str, shape: Shape, unit: &str, doc: &str) -> Field {
    Field::optional(name, shape, unit, Default::Absent, doc)
}

/// The declaration of a beam.
pub fn beam() -> Table {
    let doc = "A link that bends: a geometrically exact beam with stretch, shear and bending. Its ends and named \
    points are points for joints, forces and measures; its frame is that of its first end, with x along the tangent.";
    Table { name: BEAM, doc: doc.to_string(), fields: [line(), material(), more()].concat() }
}

/// Its ends and its centre line.
fn line() -> Vec<Field> {
    vec![
            absent("ends", Shape::Names, "", "Names of the first and the last end; A and B if absent."),
            number("length", "m", "Length of a straight beam."),
            absent(
                "through",
                Shape::Ranges,
                "m",
                "Global positions of points of the centre line when assembly starts, [[x, y], …]: a straight line \
                through two, a natural cubic spline through more.",
            ),
            absent(
                "arc",
                Shape::Laws,
                "m",
                "A circular centre line when assembly starts: [x, y of the centre, radius, first angle, last angle].",
            ),
    ]
}

/// Stiffness and mass.
fn material() -> Vec<Field> {
    vec![
            absent(
                "section",
                Shape::Section,
                "m",
                "Cross section: { rectangle = [height, width] }, { circle = diameter } or { tube = [outer, inner] } \
                with diameters. The height lies in the plane. Formulas may use the arc length s.",
            ),
            number("young", "Pa", "Young's modulus of a section."),
            number("poisson", "", "Poisson's ratio of a section; 0.3 if absent."),
            number("density", "kg/m^3", "Density of a section."),
            number("EA", "N", "Axial stiffness, in place of section and young."),
            number("EI", "N*m^2", "Bending stiffness, in place of section and young."),
            number("GA", "N", "Effective shear stiffness, in place of section and young."),
            number("mass_per_length", "kg/m", "Mass per length, in place of density."),
            number(
                "inertia_per_length",
                "kg*m",
                "Moment of inertia of the sections per length; mass_per_length × EI / EA if absent.",
            ),
    ]
}

fn more() -> Vec<Field> {
    vec![
            number("damping", "s", "Damping in proportion to stiffness: efforts per rate of strain / stiffness."),
            absent("elements", Shape::Count, "", "Number of elements of the third degree. If absent, 4, or 8 of a curved beam and at least one for each \
                part of 'through'; at least 2 for each part between named points."),
            absent(
                "points",
                Shape::Terms,
                "m",
                "Named points, each with its arc length from the first end in m, or \"50 %\" of the length.",
            ),
            Field::optional("shear", Shape::Flag, "", Default::Flag(true), "Whether sections may shear."),
            Field::optional(
                "inextensible",
                Shape::Flag,
                "",
                Default::Flag(false),
                "Whether the centre line keeps its length.",
            ),
    ]
}
