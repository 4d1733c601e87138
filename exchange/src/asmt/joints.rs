//! The joints of an assembly in the plane.

use super::parts::Frame;
use crate::space::{axis, dot, Lie, Plane, Vector};

/// What a joint does in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Flat {
    /// It restricts only what leaves the plane.
    Nothing,
    Revolute,
    /// Point j moves along a direction, at a distance from the line through point i; no relative rotation. The direction
    /// is fixed in both parts.
    Slide {
        along_i: Vector,
        along_j: Vector,
        aside: Vector,
    },
    Weld,
    /// Point j moves along a direction of part i, at a distance from the line through point i.
    Slot {
        along: Vector,
        aside: Vector,
    },
    /// No relative rotation.
    SameAngle,
    Distance,
    Gear,
    Rack {
        sense: f64,
    },
}

impl Flat {
    /// The number of equations in the plane.
    pub(super) const fn rows(self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::Revolute | Self::Slide { .. } => 2,
            Self::Weld => 3,
            _ => 1,
        }
    }
}

/// The classes of joints that are read.
pub(super) const KNOWN: [&str; 20] = [
    "RevoluteJoint",
    "CylindricalJoint",
    "TranslationalJoint",
    "FixedJoint",
    "SphericalJoint",
    "UniversalJoint",
    "PlanarJoint",
    "PointInPlaneJoint",
    "PointInLineJoint",
    "LineInPlaneJoint",
    "NoRotationJoint",
    "ParallelAxesJoint",
    "PerpendicularJoint",
    "AngleJoint",
    "RevRevJoint",
    "RevCylJoint",
    "CylSphJoint",
    "SphSphJoint",
    "GearJoint",
    "RackPinionJoint",
];

/// What a joint of this class between two frames does in the plane, and whether it keeps its parts from tilting out of
/// the plane. The error says why it leaves the plane.
pub(super) fn flat(
    class: &str,
    plane: &Plane,
    offset: f64,
    i: &Frame,
    j: &Frame,
) -> Result<(Flat, bool), String> {
    let (zi, zj) = (axis(&i.turn, 2), axis(&j.turn, 2));
    let (lie_i, lie_j) = (plane.lie(zi), plane.lie(zj));
    let both = |wanted: fn(&Lie) -> bool| wanted(&lie_i) && wanted(&lie_j);
    let normal = both(|lie| matches!(lie, Lie::Normal(_)));
    let inside = both(|lie| matches!(lie, Lie::Inside(_)));
    // the direction in the plane that is perpendicular to the axis of i
    let beside = |z: Vector| crate::space::cross(plane.normal, z);
    let aside = crate::space::times(offset, zi);
    let slide = |of: fn(&Plane, Vector) -> Vector, aside| Flat::Slide {
        along_i: of(plane, zi),
        along_j: toward(of(plane, zj), of(plane, zi)),
        aside,
    };
    let across = |plane: &Plane, z: Vector| crate::space::cross(plane.normal, z);
    let none = [0.0; 3];
    let found = match class {
        "RevoluteJoint" if normal => (Flat::Revolute, true),
        "CylindricalJoint" if normal => (Flat::Revolute, true),
        "CylindricalJoint" if inside => (slide(|_, z| z, none), false),
        "TranslationalJoint" if inside => (slide(|_, z| z, none), true),
        "FixedJoint" => (Flat::Weld, true),
        "SphericalJoint" => (Flat::Revolute, false),
        "UniversalJoint" if matches!((lie_i, lie_j), (Lie::Normal(_), _) | (_, Lie::Normal(_))) => {
            (Flat::Revolute, false)
        }
        "PlanarJoint" if normal => (Flat::Nothing, true),
        "PlanarJoint" if inside => (slide(across, aside), false),
        "PointInPlaneJoint" | "LineInPlaneJoint" if matches!(lie_i, Lie::Normal(_)) => {
            (Flat::Nothing, false)
        }
        "LineInPlaneJoint" if inside => {
            (Flat::Slide { along_i: beside(zi), along_j: toward(zj, beside(zi)), aside }, false)
        }
        "PointInPlaneJoint" | "LineInPlaneJoint" if matches!(lie_i, Lie::Inside(_)) => {
            (Flat::Slot { along: beside(zi), aside }, false)
        }
        "PointInLineJoint" if matches!(lie_i, Lie::Normal(_)) => (Flat::Revolute, false),
        "PointInLineJoint" if matches!(lie_i, Lie::Inside(_)) => {
            (Flat::Slot { along: zi, aside: none }, false)
        }
        _ => return rest(class, plane, i, j).ok_or_else(|| leaves(class)),
    };
    Ok(found)
}

/// The joints of angles, distances and wheels.
fn rest(class: &str, plane: &Plane, i: &Frame, j: &Frame) -> Option<(Flat, bool)> {
    let (lie_i, lie_j) = (plane.lie(axis(&i.turn, 2)), plane.lie(axis(&j.turn, 2)));
    let both = |wanted: fn(&Lie) -> bool| wanted(&lie_i) && wanted(&lie_j);
    let normal = both(|lie| matches!(lie, Lie::Normal(_)));
    let inside = both(|lie| matches!(lie, Lie::Inside(_)));
    Some(match class {
        "NoRotationJoint" => (Flat::SameAngle, true),
        "ParallelAxesJoint" | "AngleJoint" if normal => (Flat::Nothing, true),
        "ParallelAxesJoint" | "AngleJoint" | "PerpendicularJoint" if inside => {
            (Flat::SameAngle, false)
        }
        "PerpendicularJoint" if lie_i != Lie::Oblique && lie_j != Lie::Oblique => {
            (Flat::Nothing, false)
        }
        "RevRevJoint" | "RevCylJoint" if normal => (Flat::Distance, true),
        "CylSphJoint" if matches!(lie_i, Lie::Normal(_)) => (Flat::Distance, false),
        "SphSphJoint" => (Flat::Distance, false),
        "GearJoint" if normal => (Flat::Gear, false),
        "RackPinionJoint" if normal => (
            Flat::Rack {
                sense: if matches!(lie_i, Lie::Normal(s) if s < 0.0) { -1.0 } else { 1.0 },
            },
            false,
        ),
        _ => return None,
    })
}

/// The direction or its opposite, whichever is nearer to the other direction.
fn toward(direction: Vector, other: Vector) -> Vector {
    crate::space::times(if dot(direction, other) < 0.0 { -1.0 } else { 1.0 }, direction)
}

/// Why a joint of this class is not read.
pub(super) fn leaves(class: &str) -> String {
    let kind = class.trim_end_matches("Joint");
    if KNOWN.contains(&class) {
        format!("a joint of class {kind} whose axis does not fit the plane of the others moves parts out of the plane")
    } else if ["Screw", "ConstantVelocity"].contains(&kind) {
        format!("joints of class {kind} are spatial; kempe is planar")
    } else {
        format!("joints of class {kind} are not supported")
    }
}
