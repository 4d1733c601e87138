//! The equations of planar mechanics, one file per concept, over any scalar.
//!
//! Functions of a [`Model`](crate::model::Model) and plain slices; scratch is a [`Workspace`].

mod anchors;
pub mod augmented;
pub mod balance;
pub mod constraints;
pub mod dense;
pub mod energy;
pub mod forces;
pub mod formulas;
pub mod iteration;
pub mod kinematics;
mod laws;
pub mod mass;
pub mod motion;
mod pins;
mod plan;
pub mod reactions;
mod refine;
mod residuals;
pub mod tangent;

pub use laws::{at, Laws};
pub use motion::{Gains, Singular, Workspace};
pub use plan::Plan;
pub use residuals::Residuals;
