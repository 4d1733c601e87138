//! The fields of bodies as data, for the reader of files, the schema, Python and the model.

use super::beam_fields::beam;
use crate::elements::{Default, Field, Shape, Table};

/// The `type` of a body without an angle.
pub(super) const POINT_MASS: &str = "point_mass";

/// The fields that shapes determine.
pub(crate) const INSTEAD_OF_SHAPES: [&str; 3] = ["mass", "inertia", "center"];

/// The types of bodies: `body` (the default), `bar`, `point_mass`, `beam`, and `ground`. `ground` is not written as a type;
/// it is the name of a body.
pub fn body_tables() -> Vec<Table> {
    vec![body(), bar(), point_mass(), beam(), ground()]
}

fn points() -> Field {
    let doc = "Named points, each [x, y] in the frame of the body.";
    Field::optional("points", Shape::Points, "m", Default::Absent, doc)
}

fn curves() -> Field {
    let doc = "Named curves in the frame of the body, for joints on curves: formulas x, y of u with range and \
    periodic; polar; points; circle; line; or, for contacts, polygon.";
    Field::optional("curves", Shape::Curves, "", Default::Absent, doc)
}

fn through() -> Field {
    let doc = "Global positions of named points of the body when assembly starts, each [x, y]. \
    A bar with two of them needs no length and no ends.";
    Field::optional("through", Shape::Points, "m", Default::Absent, doc)
}

fn mass() -> Field {
    Field::required(
        "mass",
        Shape::Number,
        "kg",
        "Mass; 0 where the mechanism determines the motion.",
    )
}

fn shapes() -> Field {
    let doc = "Homogeneous pieces; without them, mass and inertia are required: a list of tables, each with \
    a type (rod, plate, disc, ring or polygon), its sizes, at, angle, and mass or density with thickness.";
    Field::optional("shapes", Shape::Shapes, "", Default::Absent, doc)
}

fn outline() -> Field {
    let doc =
        "What drawings show instead of a link around the points: points, circle or SVG path. \
    It changes no number.";
    Field::optional("outline", Shape::Outline, "", Default::Absent, doc)
}

fn body() -> Table {
    Table {
        name: "body",
        doc: "A rigid body of any form.".to_string(),
        fields: vec![
            Field::optional(
                "mass",
                Shape::Number,
                "kg",
                Default::Absent,
                "Mass; 0 where the mechanism determines the motion.",
            ),
            Field::optional(
                "inertia",
                Shape::Number,
                "kg*m^2",
                Default::Absent,
                "Moment of inertia about the mass centre; may be 0.",
            ),
            Field::optional(
                "center",
                Shape::Pair,
                "m",
                Default::Pair([0.0, 0.0]),
                "Mass centre, [x, y] in the frame of the body.",
            ),
            shapes(),
            points(),
            curves(),
            through(),
            outline(),
        ],
    }
}

fn bar() -> Table {
    Table {
        name: "bar",
        doc: "A uniform slender bar: frame at its centre, x along it, inertia mass length^2/12."
            .to_string(),
        fields: vec![
            mass(),
            Field::optional(
                "length",
                Shape::Number,
                "m",
                Default::Absent,
                "Length; without it, the distance of the two points of `through`.",
            ),
            Field::optional(
                "ends",
                Shape::Names,
                "",
                Default::Absent,
                "Names of the points at (-length/2, 0) and (length/2, 0).",
            ),
            through(),
            points(),
            curves(),
            outline(),
        ],
    }
}

fn point_mass() -> Table {
    Table {
        name: POINT_MASS,
        doc: "A point with mass and one named point, P. It has no angle.".to_string(),
        fields: vec![
            mass(),
            Field::optional(
                "at",
                Shape::Pair,
                "m",
                Default::Absent,
                "Position in the global frame when assembly starts, [x, y].",
            ),
            outline(),
        ],
    }
}

fn ground() -> Table {
    Table {
        name: "ground",
        doc: "What does not move; its frame is the global frame.".to_string(),
        fields: vec![points(), curves(), outline()],
    }
}
