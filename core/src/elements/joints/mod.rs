//! Joints: holonomic constraints between two bodies, without time.

mod revolute;
mod translational;

pub use revolute::Revolute;
pub use translational::Translational;
