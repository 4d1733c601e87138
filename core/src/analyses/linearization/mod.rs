//! Linear equations of a mechanism in independent coordinates, at an equilibrium or any other state.
//!
//! | file | concept |
//! |---|---|
//! | `least_norm` | least-norm solutions with the constraints alone |
//! | `freedoms` | independent coordinates, and the motion of all coordinates with them |
//! | `variation` | derivatives of the equations of motion along a direction |
//! | `parameters` | derivatives of parameters that are formulas of other parameters |
//! | `response` | changes of accelerations and multipliers due to forces |
//! | `rotation` | a frame that rotates with the mechanism |
//! | `names` | inputs and outputs by name |
//! | `linearize` | reduced mass, damping and stiffness, and the state-space matrices |
//! | `eigenvalues` | eigenvalues of the equations |
//! | `record` | the analysis and its record |
//! | `options` | options of `modes` |
//! | `failure` | reasons for which a state cannot be linearized |

mod eigenvalues;
mod failure;
mod freedoms;
mod least_norm;
mod linearize;
mod names;
mod options;
mod parameters;
mod record;
mod response;
mod rotation;
mod variation;

pub use failure::{coordinate, Failure};
pub use freedoms::Freedoms;
pub(super) use least_norm::LeastNorm;
pub use linearize::{begins, linearize, Linearization};
pub use options::Options;
pub(super) use parameters::slopes_by_parameter;
pub(super) use variation::{StatePoint, Variation, D};
