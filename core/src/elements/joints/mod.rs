//! Joints: holonomic constraints between two bodies, without time.

mod distance;
mod revolute;
mod translational;

pub use distance::Distance;
pub use revolute::Revolute;
pub use translational::Translational;
