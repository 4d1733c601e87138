//! Numerics of the synthesis of linkages and cams, and the search for their best numbers.
//!
//! | module | concept |
//! |---|---|
//! | `cam` | profiles of cams from programmes of their followers |
//! | `conditions` | the linear conditions of poses on dyads, their solutions and samples |
//! | `defects` | circuits, branches, dead points and order of a linkage at the positions of its task |
//! | `descent` | the best point between bounds and within limits, with exact slopes |
//! | `dyads` | all dyads that satisfy four linear conditions, by elimination |
//! | `four_bar` | a candidate with names for its points |
//! | `least_squares` | unknowns of a linkage and of its positions by the method of Levenberg and Marquardt |
//! | `fit` | four-bars near a start that fit points, poses or crank angles |
//! | `motion` | four-bars through two to five poses |
//! | `nine` | all four-bars whose coupler point passes nine points, by continuation |
//! | `pairs` | the residuals of four-bars at a pair of angles |
//! | `path` | four-bars whose coupler point passes points |
//! | `plane` | points and vectors as complex numbers |
//! | `quadratic` | the least of a quadratic function within linear limits |
//! | `random` | samples that are the same on every machine |
//! | `ranked` | candidates, best first |
//! | `wanted` | positions of a coupler, and the four-bars near them |

pub mod cam;
mod conditions;
mod defects;
mod descent;
mod dyads;
mod fit;
mod four_bar;
mod least_squares;
mod motion;
mod nine;
mod pairs;
mod path;
mod plane;
mod quadratic;
mod random;
mod ranked;
mod wanted;

pub use conditions::{all_dyads, conditions, with_end, Choices, End, Refused};
pub use defects::{Judged, Linkage, Output, KINDS};
pub use descent::{Descent, Ending, Known};
pub use dyads::{dyads, Dyad};
pub use four_bar::FourBar;
pub use least_squares::{least_squares, Fitted, Problem};
pub use motion::{four_bars, pairs, FourBars, Poses};
pub use nine::{followed, settled, Care, Followed, NinePoints, Posture, Shifts, PATHS};
pub use pairs::Pairs;
pub use path::PathSearch;
pub use plane::{abs, angle};
pub use ranked::{ranked, Grashof, Limits, Ranked, Ranking, TYPES};
pub use wanted::{Traced, Wanted};
