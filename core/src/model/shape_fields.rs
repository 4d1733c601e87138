//! The fields of the shapes of a body as data, for the reader of files, the schema and the model.

use crate::elements::{Default, Field, Shape, Table};

/// The types of shapes, each a homogeneous piece of a body.
pub fn shape_tables() -> Vec<Table> {
    let length = |name, doc| Field::required(name, Shape::Number, "m", doc);
    vec![
        shape(
            "rod",
            "A thin straight rod: its middle is the origin of its frame, its length is along x.",
            vec![length("length", "Length.")],
        ),
        shape(
            "plate",
            "A rectangle: its middle is the origin of its frame.",
            vec![length("width", "Extent along x."), length("height", "Extent along y.")],
        ),
        shape(
            "disc",
            "A disc: its centre is the origin of its frame.",
            vec![length("radius", "Radius.")],
        ),
        shape(
            "ring",
            "A disc with a round hole: its centre is the origin of its frame.",
            vec![length("inner", "Radius of the hole."), length("outer", "Radius of the outside.")],
        ),
        shape(
            "polygon",
            "A polygon whose sides do not cross.",
            vec![Field::required(
                "points",
                Shape::Corners,
                "m",
                "Corners [x, y], one after the other, in either sense; at least three.",
            )],
        ),
    ]
}

/// The key of the extent that accompanies `density`: the thickness of an area, or the cross-section of a rod.
pub(super) fn section(kind: &str) -> &'static str {
    if kind == "rod" {
        "area"
    } else {
        "thickness"
    }
}

fn shape(name: &'static str, doc: &str, mut fields: Vec<Field>) -> Table {
    let optional =
        |name, unit, doc| Field::optional(name, Shape::Number, unit, Default::Absent, doc);
    let place = "Origin of its frame in the frame of the body.";
    let section = match section(name) {
        "area" => optional("area", "m^2", "Cross-section, beside density."),
        thickness => optional(thickness, "m", "Thickness, beside density."),
    };
    fields.extend([
        Field::optional("at", Shape::Pair, "m", Default::Pair([0.0, 0.0]), place),
        Field::optional(
            "angle",
            Shape::Number,
            "rad",
            Default::Number(0.0),
            "Angle of its x axis in the frame of the body.",
        ),
        optional("mass", "kg", "Mass; negative for a hole."),
        optional("density", "kg/m^3", "Mass by volume, instead of mass; negative for a hole."),
        section,
    ]);
    Table { name, doc: doc.to_string(), fields }
}
