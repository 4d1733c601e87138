//! Elements: joints, drivers and forces. Each element has one file, and this file is the one list of them.
//!
//! An element declares its fields once ([`element!`](crate::element)) and states its physics once ([`Joint`] or
//! [`Force`]), generic in the scalar. The reader of files, the JSON schema, the Python class, the
//! reference page and all derivatives follow from these two. To add an element, write its file, name it
//! here, and give it a test sample and a page. No other source file names it.

mod attachment;
mod declare;
pub(crate) mod derive;
mod dispatch;
mod field;
mod followed;
mod force_trait;
mod joint_trait;
mod kinds;
mod measure;
mod measured;
mod symbols;
mod value;
mod wheels;
mod written;

/// Joints: holonomic constraints between bodies, without time.
pub mod joints {
    mod belt;
    mod coupling;
    mod distance;
    mod gear;
    mod given_constraint;
    mod pin_in_slot;
    mod rack;
    mod revolute;
    mod rolling;
    mod translational;
    mod weld;

    pub use belt::Belt;
    pub use coupling::Coupling;
    pub use distance::Distance;
    pub use gear::Gear;
    pub use given_constraint::GivenConstraint;
    pub use pin_in_slot::PinInSlot;
    pub use rack::Rack;
    pub use revolute::Revolute;
    pub use rolling::Rolling;
    pub use translational::Translational;
    pub use weld::Weld;
}

/// Drivers: constraints that prescribe a motion in time.
pub mod drivers {
    mod coordinate_driver;

    pub use coordinate_driver::CoordinateDriver;
}

/// Forces: what acts on bodies beside joints and gravity.
pub mod forces {
    mod motor;
    mod spring_damper;
    mod torque;
    mod torsion_spring;

    pub use motor::Motor;
    pub use spring_damper::SpringDamper;
    pub use torque::Torque;
    pub use torsion_spring::TorsionSpring;
}

#[cfg(feature = "test-elements")]
#[path = "../../tests/elements/mod.rs"]
pub mod test_elements;

use crate::expression::Tape;
use crate::math::{Lift, Local, Pose, Real};
pub use attachment::Attachment;
use declare::join;
pub use declare::{Element, Table};
use dispatch::{constraints, declared, forces};
pub use dispatch::{Group, Place, Pooled, VisitForces, VisitJoints};
use drivers::*;
pub use field::{Default, Field, Shape, TOLERANCES, UNITS_OF_EQUATIONS};
pub use followed::{BodyId, Coordinate, CoordinateOf, Followed, QuantityOf};
pub use force_trait::{Force, Nature, OwnPowers, OwnState, Part, Situation, Wrenches};
use forces::*;
pub use joint_trait::{At, Equation, Fixes, Joint, Linearized, Moving, Required, ResultOf};
use joints::*;
pub use kinds::{
    body, coordinate, equation_unit, flag, joint, law, law_pair, laws, number, optional_law,
    optional_number, optional_pair, optional_unit, pair, point, side, terms, units, EquationUnit,
    JointId, Kind, Optional, PointOn, Side, Source,
};
pub use measured::Measured;
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
        Coupling,
        GivenConstraint,
        #[cfg(feature = "test-elements")] TurnedPin,
        #[cfg(feature = "test-elements")] Bead,
        #[cfg(feature = "test-elements")] Levels,
        #[cfg(feature = "test-elements")] Pulley,
    }
    Drivers { CoordinateDriver }
}

forces! {
    TorsionSpring,
    SpringDamper,
    Torque,
    Motor,
    #[cfg(feature = "test-elements")] Lag,
    #[cfg(feature = "test-elements")] Rubbing,
    #[cfg(feature = "test-elements")] Blower,
}

/// The declarations of all elements, in the order of the list.
pub fn catalogue() -> Vec<(Group, Table)> {
    let mut tables = constraint_tables();
    tables.extend(force_tables());
    tables
}

/// The driver that holds a coordinate at a value: assembly holds by it what is `set`.
pub fn holding(coordinate: CoordinateOf, value: Tape) -> Constraint<Tape> {
    Constraint::CoordinateDriver(CoordinateDriver { coordinate: coordinate.into(), value })
}
