//! The symbols of a drawing, as data, without the types of elements.
//!
//! An element returns its symbols from the method `symbols` of its trait. This method receives the numbers
//! of the model; a law that depends on time or state is NaN there. The test `x != 0.0` is therefore true
//! for every law that may differ from zero.

use super::followed::{BodyId, Coordinate, CoordinateOf, Followed};
use super::kinds::PointOn;
use super::quantity_kind::QuantityKind;
use crate::math::Local;

/// Declares the marks, each with its name in a scene.
macro_rules! marks {
    ($($(#[$doc:meta])* $mark:ident = $name:literal,)*) => {
        /// The shape of a symbol: the vocabulary of the scene.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Mark {
            $($(#[$doc])* $mark,)*
        }

        impl Mark {
            /// All marks.
            pub const ALL: &'static [Self] = &[$(Self::$mark),*];

            /// The name of the mark in a scene.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$mark => $name,)*
                }
            }
        }
    };
}

marks! {
    /// A pin that joins the points of i and j.
    Pin = "pin",
    /// A rigid connection of the points of i and j.
    Clamp = "clamp",
    /// A block on j at its point, between rails on i along the axis of i.
    Slide = "slide",
    /// A part of a beam between two of its nodes, drawn as a link.
    Beam = "beam",
    /// A massless rod with a pin at each point.
    Rod = "rod",
    /// A cylinder on i with a piston rod to j: a force along the line.
    Cylinder = "cylinder",
    /// The cylinder of a driver, which prescribes a length.
    DriveCylinder = "drive_cylinder",
    /// A rubber sleeve around the point of j in the eye of i.
    Sleeve = "sleeve",
    /// A coil spring between the points.
    Spring = "spring",
    /// A dashpot between the points.
    Dashpot = "dashpot",
    /// A spiral spring between the bodies, around the joint that they share.
    SpiralSpring = "spiral_spring",
    /// A rotary dashpot between the bodies, around the joint that they share.
    RotaryDashpot = "rotary_dashpot",
    /// Friction between a pin on i and an eye on j around the point that they share.
    RubbingPin = "rubbing_pin",
    /// Friction between a block on j at its point and a guide on i along its axis.
    RubbingSlide = "rubbing_slide",
    /// A curved arrow: a torque on j.
    TorqueArrow = "torque_arrow",
    /// A straight arrow: a force on j at its point, along the axis of i.
    ForceArrow = "force_arrow",
    /// A curved arrow: a prescribed angle of j.
    DriveTurn = "drive_turn",
    /// A straight arrow: a prescribed position of the point of j along the axis of i.
    DriveShift = "drive_shift",
    /// Stops on i for an angle of j, around the joint that they share.
    TurnStop = "turn_stop",
    /// A stop on i for the point of j along the axis of i.
    ShiftStop = "shift_stop",
    /// A slot on i along its axis, and a pin on j at its point.
    Slot = "slot",
    /// A rack on i along its axis for a wheel on j, whose radius is < 0 on its right.
    ToothedLine = "toothed_line",
    /// A line on i along its axis for a wheel on j, whose radius is < 0 on its right.
    Track = "track",
    /// The strands of a belt on wheels around the points.
    OpenStrands = "open_strands",
    /// The same with strands that cross.
    CrossedStrands = "crossed_strands",
    /// A plain wheel on j around its point.
    Circle = "circle",
    /// A toothed wheel on j around its point; the radius is that of the pitch circle.
    ToothedWheel = "toothed_wheel",
    /// The same with the teeth on the inside of a ring.
    ToothedRing = "toothed_ring",
    /// A roller on i around its point.
    Roller = "roller",
    /// A round end of i around its point that touches a curve.
    Round = "round",
    /// A point of i that touches a curve.
    Touch = "touch",
    /// A flat face of i through its point, along the axis of i.
    Face = "face",
}

/// The attachment of a symbol to one body.
#[derive(Clone, Debug, PartialEq)]
pub struct SymbolEnd {
    /// The body.
    pub body: BodyId,
    /// s′ of a point, m; None if the symbol belongs to the body as a whole.
    pub point: Option<Local>,
    /// Angle of the symbol's axis in the body frame, rad.
    pub axis: f64,
}

impl SymbolEnd {
    /// A body as a whole.
    pub fn body(body: BodyId) -> Self {
        Self { body, point: None, axis: 0.0 }
    }

    /// A point of a body.
    pub fn point(on: &PointOn) -> Self {
        Self { body: on.body, point: Some(on.s), axis: 0.0 }
    }

    /// The same end with an axis at this angle.
    pub fn along(self, axis: f64) -> Self {
        Self { axis, ..self }
    }
}

/// A symbol of the scene between the bodies i and j.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSymbol {
    /// The shape that is drawn.
    pub mark: Mark,
    /// The attachment to body i.
    pub i: SymbolEnd,
    /// The attachment to body j.
    pub j: SymbolEnd,
    /// Radii in m, around the points of i and of j, of a symbol that has the size of the mechanism.
    pub radii: Option<[f64; 2]>,
    /// Diameter of the pitch circle of a toothed wheel divided by the number of teeth, m, if the model contains it.
    pub module: Option<f64>,
}

impl SceneSymbol {
    /// A symbol of the usual size.
    pub fn new(mark: Mark, i: SymbolEnd, j: SymbolEnd) -> Self {
        Self { mark, i, j, radii: None, module: None }
    }

    /// A symbol between two points.
    pub fn between_points(mark: Mark, i: &PointOn, j: &PointOn) -> Self {
        Self::new(mark, SymbolEnd::point(i), SymbolEnd::point(j))
    }

    /// A symbol between two bodies, without points.
    pub fn between_bodies(mark: Mark, i: BodyId, j: BodyId) -> Self {
        Self::new(mark, SymbolEnd::body(i), SymbolEnd::body(j))
    }

    /// Two wheels around points, with these radii in m.
    pub fn wheels(marks: [Mark; 2], radii: [f64; 2], [i, j]: [&PointOn; 2]) -> Vec<Self> {
        let wheel = |k: usize, other: &PointOn, own: &PointOn| {
            Self::between_points(marks[k], other, own).to_scale([0.0, radii[k]])
        };
        vec![wheel(0, j, i), wheel(1, i, j)]
    }

    /// The same symbol with these radii in m, around the points of i and of j.
    pub fn to_scale(self, radii: [f64; 2]) -> Self {
        Self { radii: Some(radii), ..self }
    }

    /// The arrow of a prescribed quantity.
    pub fn drive(driven: &Followed) -> Self {
        let (i, j) = match driven {
            Followed::Coordinate(CoordinateOf { body, coordinate }) => {
                let axis = match coordinate {
                    Coordinate::Y | Coordinate::Vy => std::f64::consts::FRAC_PI_2,
                    _ => 0.0,
                };
                let origin = SymbolEnd { point: Some(Local::zero()), ..SymbolEnd::body(*body) };
                (SymbolEnd::body(BodyId::GROUND).along(axis), origin)
            }
            Followed::Quantity(of) => {
                let end = |k: usize| SymbolEnd {
                    body: of.bodies[k],
                    point: Some(of.ends[k].s),
                    axis: of.ends[k].axis,
                };
                (end(0), end(1))
            }
        };
        match driven.kind() {
            QuantityKind::Angle => Self::between_bodies(Mark::DriveTurn, i.body, j.body),
            _ => Self::new(Mark::DriveShift, i, j),
        }
    }
}
