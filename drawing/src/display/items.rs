//! The items of a display list: lines, fills and texts that follow the bodies.
//!
//! An item is plain data. Its frame defines its motion. Each of its points is a row `[x, y, px, py]`: x and y are
//! lengths of the mechanism in m, and px and py are lengths of print in points, which do not depend on the scale.

use super::text::Role;
use crate::plane::At;
use serde::{Deserialize, Serialize};

/// A point with lengths of the mechanism and of print.
pub type Row = [f64; 4];

/// Layers. An item on a higher layer is painted later.
pub mod layer {
    /// Items behind the bodies.
    pub const GROUND: u8 = 0;
    /// Bodies.
    pub const BODY: u8 = 1;
    /// Symbols.
    pub const SYMBOL: u8 = 2;
    /// Pins.
    pub const PIN: u8 = 3;
    /// Numbers of bodies.
    pub const NUMBER: u8 = 4;
    /// Names.
    pub const NAME: u8 = 5;
}

/// The frame that an item follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Frame {
    /// Origin at the point `at` of `body`, turned by the angle of the body `turns_with` and by `turn`.
    Body {
        /// The body with the point.
        body: usize,
        /// The point in the frame of the body, m.
        at: At,
        /// The body with the angle.
        turns_with: usize,
        /// Additional angle, rad.
        turn: f64,
    },
    /// From a point of one body to a point of another. x is the fraction of the distance, y is in m to the left of
    /// the line, px is along the line and py to its left. For distances below `room`, px shrinks in proportion.
    Line {
        /// The bodies of the two ends.
        bodies: [usize; 2],
        /// The ends in the frames of the bodies, m.
        ends: [At; 2],
        /// Points of print; 0 if px never shrinks.
        room: f64,
    },
    /// From a point of one body towards a point of another. x is in m from the first point; otherwise like
    /// [`Frame::Line`].
    Ray {
        /// The bodies of the two ends.
        bodies: [usize; 2],
        /// The ends in the frames of the bodies, m.
        ends: [At; 2],
    },
    /// Around the point `at` of body j. x is the fraction of the angle from body i to body j plus `turn`; px is the
    /// radius.
    Twist {
        /// Bodies i and j.
        bodies: [usize; 2],
        /// The point in the frame of body j, m.
        at: At,
        /// Additional angle, rad.
        turn: f64,
    },
}

/// An item.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Item {
    /// The kind of item.
    #[serde(flatten)]
    pub kind: Kind,
    /// The name of the body or element to which it belongs.
    pub of: String,
    /// Items of a higher layer are painted later.
    pub layer: u8,
    /// The frame that the item follows.
    pub frame: Frame,
    /// Points in the frame. A text is centred at its only row.
    pub points: Vec<Row>,
    /// A name in the palette, such as `ink` or `body 2`.
    pub colour: String,
    /// Fraction of white in the colour.
    pub tint: f64,
    /// Whether it belongs to the number of a body.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub numbered: bool,
}

/// Line, area or text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Kind {
    /// A line.
    Line {
        /// Width, points of print.
        width: f64,
        /// Whether the last point is connected to the first.
        closed: bool,
        /// The side that is hatched for ground: ±1, or 0 for none.
        hatch: i8,
    },
    /// An area.
    Fill {},
    /// A text.
    Text {
        /// The text.
        text: String,
        /// The kind of object that the text names.
        role: Role,
        /// Size, points of print.
        size: f64,
        /// `normal` or `bold`.
        weight: String,
        /// Whether it is in italics.
        slanted: bool,
        /// Whether the text is written along the x axis of its frame, but never upside down.
        turned: bool,
        /// Offset of the centre from the row, points of print. It does not rotate.
        offset: At,
    },
}

impl Frame {
    /// The frame at a point of a body that rotates with it.
    pub fn on(body: usize, at: At) -> Self {
        Self::Body { body, at, turns_with: body, turn: 0.0 }
    }

    /// The frame at a point of a body that remains upright.
    pub fn upright(body: usize, at: At) -> Self {
        Self::Body { body, at, turns_with: 0, turn: 0.0 }
    }

    /// The frame at a point of a body, rotated by the angle of another body and by `turn`.
    pub fn turned(body: usize, at: At, turns_with: usize, turn: f64) -> Self {
        Self::Body { body, at, turns_with, turn }
    }

    /// The frame along the line between two points.
    pub fn between(bodies: [usize; 2], ends: [At; 2]) -> Self {
        Self::Line { bodies, ends, room: 0.0 }
    }
}

impl Item {
    /// A line.
    pub fn line(of: &str, frame: &Frame, points: Vec<Row>, colour: &str, width: f64) -> Self {
        Self::new(Kind::Line { width, closed: false, hatch: 0 }, of, frame, points, colour)
    }

    /// An area.
    pub fn fill(of: &str, frame: &Frame, points: Vec<Row>, colour: &str) -> Self {
        Self::new(Kind::Fill {}, of, frame, points, colour)
    }

    /// A text at a row.
    pub fn text(of: &str, frame: &Frame, row: Row, words: &str, role: Role) -> Self {
        let look = role.look();
        let kind = Kind::Text {
            text: words.to_string(),
            role,
            size: look.size,
            weight: if look.bold { "bold" } else { "normal" }.to_string(),
            slanted: look.slanted,
            turned: false,
            offset: [0.0; 2],
        };
        let above = if role == Role::Number { layer::NUMBER } else { layer::NAME };
        Self::new(kind, of, frame, vec![row], look.colour).on(above)
    }

    fn new(kind: Kind, of: &str, frame: &Frame, points: Vec<Row>, colour: &str) -> Self {
        let (of, colour, frame) = (of.to_string(), colour.to_string(), frame.clone());
        Self { kind, of, layer: layer::SYMBOL, frame, points, colour, tint: 0.0, numbered: false }
    }

    /// Moves the item to another layer.
    pub fn on(self, layer: u8) -> Self {
        Self { layer, ..self }
    }

    /// Mixes the colour with a fraction of white.
    pub fn tinted(self, tint: f64) -> Self {
        Self { tint, ..self }
    }

    /// Connects the last point of a line to the first.
    pub fn closed(mut self) -> Self {
        if let Kind::Line { closed, .. } = &mut self.kind {
            *closed = true;
        }
        self
    }

    /// Hatches one side of a line as ground.
    pub fn hatched(mut self, side: i8) -> Self {
        if let Kind::Line { hatch, .. } = &mut self.kind {
            *hatch = side;
        }
        self
    }

    /// Writes a text along the x axis of its frame.
    pub fn along(mut self) -> Self {
        if let Kind::Text { turned, .. } = &mut self.kind {
            *turned = true;
        }
        self
    }

    /// Moves the centre of a text.
    pub fn moved(mut self, by: At) -> Self {
        if let Kind::Text { offset, .. } = &mut self.kind {
            *offset = by;
        }
        self
    }
}

/// The colour of a body.
pub fn colour_of(body: usize) -> String {
    format!("body {body}")
}

/// Rows from points in lengths of the mechanism.
pub fn metres(points: impl IntoIterator<Item = At>) -> Vec<Row> {
    points.into_iter().map(|[x, y]| [x, y, 0.0, 0.0]).collect()
}

/// Rows from points in lengths of print.
pub fn printed(points: impl IntoIterator<Item = At>) -> Vec<Row> {
    points.into_iter().map(|[x, y]| [0.0, 0.0, x, y]).collect()
}
