//! The equations of planar multibody dynamics, one file for each concept, over any scalar.
//!
//! The equations are functions of a [`Model`](crate::model::Model) and slices. A [`Workspace`] contains their scratch
//! memory.

pub mod actions;
pub mod augmented;
pub mod balance;
mod compiled;
pub mod constraints;
mod coupling;
pub mod dense;
pub mod energy;
pub mod forces;
pub mod formulas;
mod gains;
mod grounded;
mod independent;
mod inertia;
pub mod iteration;
mod jumps;
pub mod kinematics;
mod laws;
pub mod leading;
mod light;
mod load_changes;
pub mod mass;
pub mod measured;
pub mod motion;
pub mod newton_euler;
mod plan;
mod powers;
pub mod reactions;
pub mod reactive;
pub mod refine;
mod residuals;
mod roles;
pub mod second;
pub mod sensitivity;
mod static_ratio;
pub mod switches;
pub mod tangent;

pub use compiled::Compiled;
pub use gains::Gains;
pub use inertia::Inertia;
pub use laws::{at, held, position, Laws};
pub use motion::Workspace;
pub use plan::Plan;
pub use powers::Powers;
pub use residuals::Residuals;
pub use static_ratio::static_ratio;
