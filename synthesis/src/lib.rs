//! Numerics of the synthesis of linkages.
//!
//! | module | concept |
//! |---|---|
//! | `dyads` | all dyads that satisfy four linear conditions, by elimination |
//! | `least_squares` | unknowns of a linkage and of its positions by the method of Levenberg and Marquardt |
//! | `linkage` | the residuals of four-bars at a point, a pose or a pair of angles |

mod dyads;
mod least_squares;
mod linkage;

pub use dyads::{dyads, Dyad};
pub use least_squares::{least_squares, Fitted, Problem};
pub use linkage::{Coupler, Pairs};
