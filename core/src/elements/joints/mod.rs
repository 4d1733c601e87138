//! Joints: holonomic constraints between two bodies, without time.

mod revolute;

pub use revolute::Revolute;
