//! Forces: what acts on bodies beside joints and gravity.

mod torsion_spring;

pub use torsion_spring::TorsionSpring;
