//! Cams: programmes of the follower, profiles, limits and cases.
//!
//! | module | concept |
//! |---|---|
//! | `case` | the case of a cam with its follower |
//! | `curves` | a cam at angles: laws, profiles, paths of cutters |
//! | `follower` | a follower and its dimensions |
//! | `law` | motion laws as pieces, each the sum of a polynomial and a sine |
//! | `limits` | pressure angle, radius of curvature, undercut, lift-off |
//! | `programme` | the lift over a turn, from segments |
//! | `remarks` | what is wrong or doubtful |
//! | `shape` | the envelope of a follower at an angle |
//! | `sizes` | the least base circle, and the remedies of an undercut |
//! | `words` | numbers in messages |

mod case;
mod curves;
mod follower;
mod law;
mod limits;
mod programme;
mod remarks;
mod shape;
mod sizes;
mod words;

pub use curves::{Cam, Closure, Drive};
pub use follower::{End, Follower};
pub use law::{Law, Piece, LAWS};
pub use programme::{Programme, Segment, Way};
pub use shape::Touch;
pub use sizes::Remedies;
