//! Kinematics: the motion of a mechanism whose drivers determine it, without integration.
//!
//! At each time, the positions satisfy Φ(q, t) = 0, the velocities Φ_q v = ν and the accelerations Φ_q a = γ (Haug
//! 3.6). The motion is followed from the start in short steps, so that it stays on its branch. If it cannot continue
//! because the driven value has reached an extreme, this limit is located to high accuracy.
//!
//! | file | concept |
//! |---|---|
//! | `solution` | positions, velocities and accelerations at a time |
//! | `barriers` | stops, contacts and ends of curves, and whether a step passes them |
//! | `continuation` | steps along a branch |
//! | `dead_point` | limits in terms of the mechanism |
//! | `passage`, `path`, `limit` | change points and limits; the branch by arc length, and the extreme of t on it |
//! | `circuit` | the path through a position, followed until it closes |
//! | `motion` | the result |
//! | `over` | the value of a quantity as a replacement of the time |
//! | `quintic` | polynomials between two points |
//! | `works` | the work done over a motion, by quadrature, and the record of the motion |
//! | `options` | options of kinematics and of inverse dynamics |
//! | `record` | both analyses, and their record |
//! | `failure` | reasons for which a motion ends early, in terms of the mechanism |

mod barriers;
mod circuit;
mod continuation;
mod dead_point;
mod failure;
mod limit;
mod motion;
mod options;
mod over;
mod passage;
mod path;
mod quintic;
mod record;
mod solution;
mod works;

pub(in crate::analyses) use circuit::{circuit, same, ALIKE};
pub(in crate::analyses) use continuation::Continuation;
pub use dead_point::Limit;
pub(in crate::analyses) use dead_point::{driven, in_line, written};
pub use failure::{Failure, Reason};
pub use motion::Motion;
pub(in crate::analyses) use options::driven_value;
pub use options::{InverseOptions, Options};
pub use over::{driving, over, DrivenQuantity, Over};
pub(in crate::analyses) use record::without_driver;
pub use solution::Point;
pub use works::{recorded, MotionRecorder, Recorded};

use super::State;
use crate::integrate::Flow;
use crate::model::Model;

/// The motion from `start` through the `times`, in ascending or descending order. The first time may be the start
/// time.
///
/// `watch` is called with the motion so far after each step and may stop the analysis.
///
/// # Errors
/// [`Failure`] if the drivers do not determine the motion, the start does not satisfy the constraints, or the motion
/// cannot be followed to the last time. It contains the motion up to the failure.
pub fn kinematics(
    model: &Model,
    start: &State,
    times: &[f64],
    mut watch: impl FnMut(&Motion) -> Flow,
) -> Result<Motion, Box<Failure>> {
    let mut continuation = Continuation::begin(model, start)?;
    let mut motion = Motion { points: vec![continuation.point().clone()], ..Motion::default() };
    for &t in times {
        while continuation.point().t != t {
            let outcome = continuation.step(t);
            motion.rejected = continuation.rejected();
            if let Err(reason) = outcome {
                return Err(Box::new(Failure { reason, motion }));
            }
            motion.points.push(continuation.point().clone());
            if watch(&motion) == Flow::Stop {
                return Ok(motion);
            }
        }
        motion.outputs.push(motion.points.len() - 1);
    }
    motion.reached = true;
    Ok(motion)
}
