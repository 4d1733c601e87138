//! The symbols of a drawing, as data, without the types of elements.
//!
//! An element returns its symbols from the method `symbols` of its trait. This method receives the numbers
//! of the model; a law that depends on time or state is NaN there. The test `x != 0.0` is therefore true
//! for every law that may differ from zero.

use super::followed::{BodyId, Coordinate, CoordinateOf, Followed};
use super::kinds::PointOn;
use crate::math::Local;

/// The vocabulary of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A pin that joins the points of i and j.
    Pin,
    /// A rigid connection of the points of i and j.
    Clamp,
    /// A block on j at its point, between rails on i along the axis of i.
    Slide,
    /// A massless rod with a pin at each point.
    Rod,
    /// A cylinder on i with a piston rod to j: a force along the line.
    Cylinder,
    /// The cylinder of a driver, which prescribes a length.
    DriveCylinder,
    /// A rubber sleeve around the point of j in the eye of i.
    Sleeve,
    /// A coil spring between the points.
    Spring,
    /// A dashpot between the points.
    Dashpot,
    /// A spiral spring between the bodies, around the joint that they share.
    SpiralSpring,
    /// A rotary dashpot between the bodies, around the joint that they share.
    RotaryDashpot,
    /// Friction between a pin on i and an eye on j around the point that they share.
    RubbingPin,
    /// Friction between a block on j at its point and a guide on i along its axis.
    RubbingSlide,
    /// A curved arrow: a torque on j.
    TorqueArrow,
    /// A straight arrow: a force on j at its point, along the axis of i.
    ForceArrow,
    /// A curved arrow: a prescribed angle of j.
    DriveTurn,
    /// A straight arrow: a prescribed position of the point of j along the axis of i.
    DriveShift,
    /// Stops on i for an angle of j, around the joint that they share.
    TurnStop,
    /// A stop on i for the point of j along the axis of i.
    ShiftStop,
    /// A slot on i along its axis, and a pin on j at its point.
    Slot,
    /// A rack on i along its axis for a wheel on j with this radius in m, < 0 on its right.
    ToothedLine(f64),
    /// A line on i along its axis for a wheel on j with this radius in m, < 0 on its right.
    Track(f64),
    /// The strands of a belt on wheels around the points, with these radii in m.
    Strands {
        /// Radius around the point of i and of j.
        radii: [f64; 2],
        /// Whether the strands cross.
        crossed: bool,
    },
    /// A plain wheel on j around its point, with this radius in m.
    Circle(f64),
    /// A toothed wheel on j around its point.
    Toothed {
        /// Radius of the pitch circle, m.
        radius: f64,
        /// Diameter of the pitch circle divided by the number of teeth, m; None if the number of teeth is not known.
        module: Option<f64>,
        /// Whether the teeth are on the inside of a ring.
        ring: bool,
    },
    /// A roller on i around its point, with this radius in m.
    Roller(f64),
    /// A round end of i around its point, with this radius in m, that touches a curve.
    Round(f64),
    /// A point of i that touches a curve.
    Contact,
    /// A flat face of i through its point, along the axis of i.
    Face,
}

impl Mark {
    /// The name of the symbol in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pin => "pin",
            Self::Clamp => "clamp",
            Self::Slide => "slide",
            Self::Rod => "rod",
            Self::Cylinder => "cylinder",
            Self::DriveCylinder => "drive_cylinder",
            Self::Sleeve => "sleeve",
            Self::Spring => "spring",
            Self::Dashpot => "dashpot",
            Self::SpiralSpring => "spiral_spring",
            Self::RotaryDashpot => "rotary_dashpot",
            Self::RubbingPin => "rubbing_pin",
            Self::RubbingSlide => "rubbing_slide",
            Self::TorqueArrow => "torque_arrow",
            Self::ForceArrow => "force_arrow",
            Self::DriveTurn => "drive_turn",
            Self::DriveShift => "drive_shift",
            Self::TurnStop => "turn_stop",
            Self::ShiftStop => "shift_stop",
            Self::Slot => "slot",
            Self::ToothedLine(_) => "toothed_line",
            Self::Track(_) => "track",
            Self::Strands { crossed: false, .. } => "open_strands",
            Self::Strands { crossed: true, .. } => "crossed_strands",
            Self::Circle(_) => "circle",
            Self::Toothed { ring: false, .. } => "toothed_wheel",
            Self::Toothed { ring: true, .. } => "toothed_ring",
            Self::Roller(_) => "roller",
            Self::Round(_) => "round",
            Self::Contact => "touch",
            Self::Face => "face",
        }
    }

    /// Radii in m, around the points of i and of j, of a symbol that has the size of the mechanism.
    pub fn radii(self) -> Option<[f64; 2]> {
        match self {
            Self::Circle(radius) | Self::Track(radius) | Self::ToothedLine(radius) => {
                Some([0.0, radius])
            }
            Self::Toothed { radius, .. } => Some([0.0, radius]),
            Self::Roller(radius) | Self::Round(radius) => Some([radius, 0.0]),
            Self::Strands { radii, .. } => Some(radii),
            _ => None,
        }
    }

    /// Diameter of the pitch circle divided by the number of teeth, m, if the model contains it.
    pub fn module(self) -> Option<f64> {
        match self {
            Self::Toothed { module, .. } => module,
            _ => None,
        }
    }
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
}

impl SceneSymbol {
    /// A symbol between two points.
    pub fn between_points(mark: Mark, i: &PointOn, j: &PointOn) -> Self {
        Self { mark, i: SymbolEnd::point(i), j: SymbolEnd::point(j) }
    }

    /// A symbol between two bodies, without points.
    pub fn between_bodies(mark: Mark, i: BodyId, j: BodyId) -> Self {
        Self { mark, i: SymbolEnd::body(i), j: SymbolEnd::body(j) }
    }

    /// Two wheels around points.
    pub fn wheels(marks: [Mark; 2], [i, j]: [&PointOn; 2]) -> Vec<Self> {
        vec![Self::between_points(marks[0], j, i), Self::between_points(marks[1], i, j)]
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
        match driven.label().1 {
            "rad" => Self::between_bodies(Mark::DriveTurn, i.body, j.body),
            _ => Self { mark: Mark::DriveShift, i, j },
        }
    }
}
