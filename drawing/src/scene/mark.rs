//! The marks that symbols use.

use kempe::elements;
use serde::{Deserialize, Serialize};

/// The mark of a symbol. [`elements::Mark`] describes the marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum Mark {
    Pin,
    Clamp,
    Slide,
    Rod,
    Cylinder,
    DriveCylinder,
    Sleeve,
    Spring,
    Dashpot,
    SpiralSpring,
    RotaryDashpot,
    RubbingPin,
    RubbingSlide,
    TorqueArrow,
    ForceArrow,
    DriveTurn,
    DriveShift,
    TurnStop,
    ShiftStop,
    Slot,
    ToothedLine,
    Track,
    OpenStrands,
    CrossedStrands,
    Circle,
    ToothedWheel,
    ToothedRing,
    Roller,
    Round,
    Touch,
    Face,
}

impl From<elements::Mark> for Mark {
    fn from(mark: elements::Mark) -> Self {
        use elements::Mark as From;
        match mark {
            From::Pin => Self::Pin,
            From::Clamp => Self::Clamp,
            From::Slide => Self::Slide,
            From::Rod => Self::Rod,
            From::Cylinder => Self::Cylinder,
            From::DriveCylinder => Self::DriveCylinder,
            From::Sleeve => Self::Sleeve,
            From::Spring => Self::Spring,
            From::Dashpot => Self::Dashpot,
            From::SpiralSpring => Self::SpiralSpring,
            From::RotaryDashpot => Self::RotaryDashpot,
            From::RubbingPin => Self::RubbingPin,
            From::RubbingSlide => Self::RubbingSlide,
            From::TorqueArrow => Self::TorqueArrow,
            From::ForceArrow => Self::ForceArrow,
            From::DriveTurn => Self::DriveTurn,
            From::DriveShift => Self::DriveShift,
            From::TurnStop => Self::TurnStop,
            From::ShiftStop => Self::ShiftStop,
            From::Slot => Self::Slot,
            From::ToothedLine(_) => Self::ToothedLine,
            From::Track(_) => Self::Track,
            From::Strands { crossed: false, .. } => Self::OpenStrands,
            From::Strands { crossed: true, .. } => Self::CrossedStrands,
            From::Circle(_) => Self::Circle,
            From::Toothed { ring: false, .. } => Self::ToothedWheel,
            From::Toothed { ring: true, .. } => Self::ToothedRing,
            From::Roller(_) => Self::Roller,
            From::Round(_) => Self::Round,
            From::Contact => Self::Touch,
            From::Face => Self::Face,
        }
    }
}

impl Mark {
    /// Whether the mark is drawn along the line between two points.
    pub fn is_along(self) -> bool {
        let of_line = [Self::Rod, Self::Spring, Self::Dashpot, Self::Cylinder, Self::DriveCylinder];
        of_line.contains(&self)
    }

    /// Whether the mark is drawn around a point, in rings.
    pub fn is_around(self) -> bool {
        matches!(
            self,
            Self::SpiralSpring
                | Self::RotaryDashpot
                | Self::RubbingPin
                | Self::TorqueArrow
                | Self::TurnStop
                | Self::DriveTurn
        )
    }

    /// Whether the mark turns on a pin if one of its ends is on ground.
    pub fn is_pinned(self) -> bool {
        self == Self::Pin || self.is_along()
    }

    /// Whether the mark is a wheel, drawn to scale around the point of body j.
    pub fn is_wheel(self) -> bool {
        self == Self::Circle || self.is_toothed_wheel()
    }

    /// Whether the mark is a wheel or ring with teeth.
    pub fn is_toothed_wheel(self) -> bool {
        matches!(self, Self::ToothedWheel | Self::ToothedRing)
    }

    /// Whether the mark is a guide along a line of body i, as long as the motion along it.
    pub fn is_guide(self) -> bool {
        matches!(self, Self::Slide | Self::Slot | Self::ToothedLine | Self::Track)
    }

    /// Whether the mark has the colour of drivers.
    pub fn is_drive(self) -> bool {
        matches!(self, Self::DriveTurn | Self::DriveShift | Self::DriveCylinder)
    }

    /// Number of its two points that the mark does not show, beginning with the point on body i.
    pub fn unmarked(self) -> usize {
        match self {
            Self::ShiftStop | Self::Round => 2,
            Self::RubbingSlide | Self::Face | Self::ForceArrow | Self::DriveShift => 1,
            _ => usize::from(self.is_wheel() || self.is_guide()),
        }
    }
}
