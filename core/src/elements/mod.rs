//! Elements: joints, drivers and forces. Each element has one file, and this file contains the only list of elements.
//!
//! An element declares its fields once ([`element!`](crate::element)) and defines its physics once ([`Joint`] or
//! [`Force`]), generic in the scalar. The reader of files, the JSON schema, the Python class, the reference page and
//! all derivatives are obtained from these two definitions. To add an element, write its file, add it to the list
//! here, and write a test sample and a page. No other source file contains its name.

mod apart;
mod attachment;
pub mod beam_line;
mod clearance;

pub(crate) mod contact;
mod convex_parts;
mod corner;
mod curve_forms;
mod curve_formula;
mod curve_pair;
mod curve_points;
mod cylinders;
mod declare;
pub(crate) mod derive;
mod dispatch;
mod field;
mod followed;
mod foot;
mod force_dispatch;
mod force_trait;
mod group;
mod hertz;
mod joint_trait;
mod kinds;
mod line;
mod line_foot;
mod loose;
mod measure;
mod measured;
mod mode;
mod near;
mod nearest;
mod normal_fan;
mod own_state;
mod part;
mod plain_bearing;
mod plane_curve;
mod polygon;
mod polygon_foot;
mod pool;
mod pressing;
mod quantity_kind;
mod symbols;
mod touch;
mod value;
mod wheels;
mod written;

/// Joints: holonomic constraints between bodies, without time.
pub mod joints {
    mod beam_lock;
    mod belt;
    mod coupling;
    mod distance;
    mod flat_on_curve;
    mod gear;
    mod given_constraint;
    mod pin_in_slot;
    mod point_on_curve;
    mod rack;
    mod revolute;
    mod roller_on_curve;
    mod rolling;
    mod translational;
    mod weld;

    pub use beam_lock::BeamLock;
    pub use belt::Belt;
    pub use coupling::Coupling;
    pub use distance::Distance;
    pub use flat_on_curve::FlatOnCurve;
    pub use gear::Gear;
    pub use given_constraint::GivenConstraint;
    pub use pin_in_slot::PinInSlot;
    pub use point_on_curve::PointOnCurve;
    pub use rack::Rack;
    pub use revolute::Revolute;
    pub use roller_on_curve::RollerOnCurve;
    pub use rolling::Rolling;
    pub use translational::Translational;
    pub use weld::Weld;
}

/// Drivers: constraints that prescribe a motion in time.
pub mod drivers {
    mod coordinate_driver;

    pub use coordinate_driver::CoordinateDriver;
}

/// Forces that act on bodies in addition to joints and gravity.
pub mod forces {
    mod actuator;
    mod beam_piece;
    mod bushing;
    mod clearance_joint;
    mod clutch;
    mod contact;
    mod contact_friction;
    mod drive_limit;
    mod friction;
    mod generalized_force;
    mod loose_belt;
    mod motor;
    mod play;
    mod point_force;
    mod slip_friction;
    mod spring_damper;
    mod stop;
    mod torque;
    mod torsion_spring;

    pub use actuator::Actuator;
    pub use beam_piece::BeamPiece;
    pub use bushing::Bushing;
    pub use clearance_joint::ClearanceJoint;
    pub use clutch::Clutch;
    pub use contact::{Contact, Resting};
    pub use contact_friction::{ContactFriction, ContactSticking};
    pub use drive_limit::DriveLimit;
    pub use friction::Friction;
    pub use generalized_force::GeneralizedForce;
    pub use loose_belt::LooseBelt;
    pub use motor::Motor;
    pub use play::Play;
    pub use point_force::PointForce;
    pub use slip_friction::SlipFriction;
    pub use spring_damper::SpringDamper;
    pub use stop::Stop;
    pub use torque::Torque;
    pub use torsion_spring::TorsionSpring;
}

#[cfg(feature = "test-elements")]
#[path = "../../tests/elements/mod.rs"]
pub mod test_elements;

use crate::expression::Tape;
use crate::math::{Jet, Lift, Listed, Local, Pose, Real, ShortArray, Vec2, Wrench};
pub use apart::{Apart, Way};
pub use attachment::Attachment;
pub use clearance::Clearance;
pub use convex_parts::{convex_corners, convex_parts};

pub use curve_forms::{CurveForm, CURVE_FORMS};
pub use curve_formula::Formula as CurveFormula;
pub use curve_points::CurvePoints;
use declare::join;
#[doc(hidden)]
pub use declare::{declared_fields, next_field, plain, FieldRow};
pub use declare::{Element, Table};
use dispatch::{constraints, declared};
use drivers::*;
pub use field::{Default, Field, Shape, TOLERANCES, UNITS_OF_EQUATIONS};
pub use followed::{Acted, BodyId, Coordinate, CoordinateOf, Followed, JointId, QuantityOf, PLACE};
pub use foot::{rim, rim_or_curves, Rim};
use force_dispatch::forces;
pub use force_trait::{Force, Held, Situation, Wrenches};
use forces::*;
pub use group::Group;
pub use joint_trait::{At, Equation, Fixes, Joint, Linearized, Moving, Required, ResultQuantity};
use joints::*;
pub use kinds::{
    acted, bearing, body, condition, coordinate, curve, equation_unit, flag, frame, joint, law,
    law_pair, laws, normal_law, number, optional_condition, optional_law, optional_number,
    optional_only, optional_pair, optional_unit, pair, point, point_or_curves, side, terms, triple,
    two_texts, units, CurveOn, Frame, Kind, NormalLaw, Only, Optional, PointOn, Side, Source,
};
pub use loose::{Backlash, Slips, Strands};
pub use measured::Measured;
pub use mode::{Behaviour, Mode};
pub use own_state::{OwnPowers, OwnState};
pub use part::{Nature, Part};
pub use plain_bearing::Bearing;
pub use plane_curve::Curve;
pub use polygon::Polygon;
pub use pool::{Place, Pooled, VisitForces, VisitJoints};
pub use quantity_kind::QuantityKind;
pub use symbols::{Mark, SceneSymbol, SymbolEnd};
#[cfg(feature = "test-elements")]
use test_elements::*;
pub use value::{Number, Numbers, Pair, Terms, Value, Words};
pub use written::Written;
pub(crate) use written::{argument, declare as element};

constraints! {
    Joints {
        Revolute,
        Translational,
        Distance,
        Weld,
        PinInSlot,
        Gear,
        Belt,
        Rack,
        Rolling,
        PointOnCurve,
        RollerOnCurve,
        FlatOnCurve,
        Coupling,
        GivenConstraint,
        BeamLock,
        #[cfg(feature = "test-elements")] TurnedPin,
        #[cfg(feature = "test-elements")] Bead,
        #[cfg(feature = "test-elements")] Levels,
        #[cfg(feature = "test-elements")] Pulley,
    }
    Drivers { CoordinateDriver }
    Forces { Resting, ContactSticking }
}

forces! {
    TorsionSpring,
    SpringDamper,
    Torque,
    PointForce,
    Actuator,
    Bushing,
    GeneralizedForce,
    Motor,
    Friction,
    Clutch,
    Stop,
    Contact,
    ClearanceJoint,
    Play,
    LooseBelt,
    SlipFriction,
    DriveLimit,
    ContactFriction,
    BeamPiece,
    #[cfg(feature = "test-elements")] Lag,
    #[cfg(feature = "test-elements")] Rubbing,
    #[cfg(feature = "test-elements")] GapSpring,
    #[cfg(feature = "test-elements")] Overload,
    #[cfg(feature = "test-elements")] Blower,
}

/// The declarations of all elements, in the order of the list.
pub fn catalogue() -> Vec<(Group, Table)> {
    let mut tables = constraint_tables();
    // equations with which forces hold are not part of the format
    tables.retain(|(group, _)| *group != Group::Forces);
    tables.extend(force_tables());
    // neither are parts of other forces, and a joint with play is written as the joint
    tables.retain(|(_, table)| !table.name.contains(' '));
    tables
}

/// The equation that holds the angle of body j relative to body i at a value.
pub fn holding_angle(i: BodyId, j: BodyId, value: Tape) -> Constraint<Tape> {
    let turned = |body| Followed::from(CoordinateOf { body, coordinate: Coordinate::Angle });
    let moving = [(j, 1.0), (i, -1.0)].into_iter().filter(|(body, _)| !body.is_ground());
    let terms = moving.map(|(body, factor)| (turned(body), Tape::from(factor))).list();
    Constraint::Coupling(Coupling { terms, value, unit: Some(QuantityKind::Angle) })
}

/// The weld of two points, which assembly uses in place of elastic pieces.
pub fn welded(i: PointOn<Tape>, j: PointOn<Tape>, angle: Tape) -> Constraint<Tape> {
    Constraint::Weld(Weld { i, j, angle })
}

/// The numbers of an elastic piece of a beam; those of stiffness, strain and stress in its Gauss points.
#[derive(Clone, Debug)]
pub struct PieceNumbers {
    /// Arc length of the beam at the first node, m.
    pub start: Tape,
    /// Arc length of the piece, m.
    pub length: Tape,
    /// EA, GA and EI.
    pub stiffness: [[Tape; 3]; 3],
    /// The components of Aᵀ r′ and φ′ without stress.
    pub strains: [[Tape; 3]; 3],
    /// Ratio of damping to stiffness, s.
    pub damping: Option<Tape>,
    /// Stress for a normal force of 1 N, and at the faces for a bending moment of 1 N·m.
    pub stresses: [[Tape; 3]; 2],
}

/// The lock of the strain along an axis of the sections of a piece, 0 for stretch and 1 for shear.
pub fn beam_lock(nodes: [BodyId; 4], axis: usize, numbers: &PieceNumbers) -> Constraint<Tape> {
    let [i, second, third, j] = nodes;
    let PieceNumbers { length, stiffness, strains, stresses, .. } = numbers.clone();
    let [_, _, bending] = stiffness;
    let [stretch, slide, curvature] = strains;
    let [by_force, by_moment] = stresses;
    let along = [0, 1].each(|k| Tape::from(f64::from(u8::from(k == axis))));
    Constraint::BeamLock(BeamLock {
        i,
        j,
        second,
        third,
        length,
        along,
        stretch,
        slide,
        curvature,
        bending,
        by_force,
        by_moment,
    })
}

/// An elastic piece of a beam between four nodes in the order of the arc length.
pub fn elastic_piece(nodes: [BodyId; 4], numbers: PieceNumbers) -> ForceElement<Tape> {
    let [i, second, third, j] = nodes;
    let PieceNumbers { start, length, stiffness, strains, damping, stresses } = numbers;
    let [axial, shear, bending] = stiffness;
    let [stretch, slide, curvature] = strains;
    let [by_force, by_moment] = stresses;
    ForceElement::BeamPiece(BeamPiece {
        i,
        j,
        second,
        third,
        start,
        length,
        axial,
        shear,
        bending,
        stretch,
        slide,
        curvature,
        damping,
        by_force,
        by_moment,
    })
}

/// The driver that holds a position quantity at a value. Assembly uses it for the quantities in `set`.
pub fn holding(coordinate: Followed<Tape>, value: Tape) -> Constraint<Tape> {
    Constraint::CoordinateDriver(CoordinateDriver { coordinate, value, limit: None, release: None })
}
