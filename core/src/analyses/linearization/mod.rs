//! Linear equations of a mechanism on independent coordinates, at an equilibrium or any other state.
//!
//! | file | concept |
//! |---|---|
//! | `least_norm` | solutions with the constraints alone |
//! | `freedoms` | independent coordinates, and the motion of all coordinates with them |
//! | `variation` | derivatives of the equations of motion along a direction |
//! | `stiffness` | the reduced stiffness at rest |
//! | `failure` | states without linear equations |

mod failure;
mod freedoms;
mod least_norm;
mod stiffness;
mod variation;

pub use failure::Failure;
pub use freedoms::Freedoms;
pub(super) use least_norm::LeastNorm;
pub use stiffness::reduced_stiffness;
pub(super) use variation::{Point as StatePoint, Variation};
