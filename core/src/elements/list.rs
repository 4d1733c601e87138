//! The one list of elements.

use super::declare::{Element, Table};
use super::dispatch::{
    constraints, declared, forces, Group, Place, Pooled, VisitForces, VisitJoints,
};
use super::drivers::CoordinateDriver;
use super::force_trait::{Force, OwnPowers, OwnState, Part, Situation};
use super::forces::{SpringDamper, Torque, TorsionSpring};
use super::joint_trait::{At, Attachment, Equation, Fixes, Joint, Linearized, Moving};
use super::joints::{Distance, Revolute, Translational};
use super::kinds::{BodyId, CoordinateOf, JointId, Source};
use super::symbols::SceneSymbol;
#[cfg(feature = "test-elements")]
use super::test_elements::{Bead, Lag, Levels, Pulley, Rubbing, TurnedPin};
use crate::expression::Tape;
use crate::math::{Lift, Local, Pose, Real, Wrench};

constraints! {
    Joints {
        Revolute,
        Translational,
        Distance,
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
    #[cfg(feature = "test-elements")] Lag,
    #[cfg(feature = "test-elements")] Rubbing,
}

/// The declarations of all elements, in the order of the list.
pub fn catalogue() -> Vec<(Group, Table)> {
    let mut tables = constraint_tables();
    tables.extend(force_tables());
    tables
}

/// The driver that holds a coordinate at a value: assembly uses it for the coordinates in `set`.
pub fn holding(coordinate: CoordinateOf, value: Tape) -> Constraint<Tape> {
    Constraint::CoordinateDriver(CoordinateDriver { coordinate, value })
}
