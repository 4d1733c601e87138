//! How the marks of symbols are drawn, and their names in a scene.

use kempe::elements::Mark;

/// Whether the mark is drawn along the line between two points.
pub fn is_along(mark: Mark) -> bool {
    let of_line = [Mark::Rod, Mark::Spring, Mark::Dashpot, Mark::Cylinder, Mark::DriveCylinder];
    of_line.contains(&mark)
}

/// Whether the mark is drawn around a point, in rings.
pub fn is_around(mark: Mark) -> bool {
    matches!(
        mark,
        Mark::SpiralSpring
            | Mark::RotaryDashpot
            | Mark::RubbingPin
            | Mark::TorqueArrow
            | Mark::TurnStop
            | Mark::DriveTurn
    )
}

/// Whether the mark turns on a pin if one of its ends is on ground.
pub fn is_pinned(mark: Mark) -> bool {
    mark == Mark::Pin || is_along(mark)
}

/// Whether the mark is a wheel, drawn to scale around the point of body j.
pub fn is_wheel(mark: Mark) -> bool {
    mark == Mark::Circle || is_toothed_wheel(mark)
}

/// Whether the mark is a wheel or ring with teeth.
pub fn is_toothed_wheel(mark: Mark) -> bool {
    matches!(mark, Mark::ToothedWheel | Mark::ToothedRing)
}

/// Whether the mark is a guide along a line of body i, as long as the motion along it.
pub fn is_guide(mark: Mark) -> bool {
    matches!(mark, Mark::Slide | Mark::Slot | Mark::ToothedLine | Mark::Track)
}

/// Whether the mark has the colour of drivers.
pub fn is_drive(mark: Mark) -> bool {
    matches!(mark, Mark::DriveTurn | Mark::DriveShift | Mark::DriveCylinder)
}

/// Number of its two points that the mark does not show, beginning with the point on body i.
pub fn unmarked(mark: Mark) -> usize {
    match mark {
        Mark::ShiftStop | Mark::Round => 2,
        Mark::Beam => 2,
        Mark::RubbingSlide | Mark::Face | Mark::ForceArrow | Mark::DriveShift => 1,
        _ => usize::from(is_wheel(mark) || is_guide(mark)),
    }
}

/// A mark as its name, for serde.
pub mod named {
    use kempe::elements::Mark;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(mark: &Mark, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(mark.name())
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Mark, D::Error> {
        let name = String::deserialize(from)?;
        let found = Mark::ALL.iter().copied().find(|mark| mark.name() == name);
        found.ok_or_else(|| D::Error::custom(format!("there is no mark '{name}'")))
    }
}
