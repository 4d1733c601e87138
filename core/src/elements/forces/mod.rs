//! Forces: springs, dampers and loads, which act on bodies in addition to joints and gravity.

mod spring_damper;
mod torque;
mod torsion_spring;

pub use spring_damper::SpringDamper;
pub use torque::Torque;
pub use torsion_spring::TorsionSpring;
