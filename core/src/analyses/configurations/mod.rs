//! All positions in which a mechanism closes, for given values of its drivers and of `set`.
//!
//! If dyads, rods and meshed wheels place all bodies, each has a known number of closures, and all combinations are
//! computed. The list is then complete. Otherwise Newton's method starts from many positions. From each position
//! found, the path of every driven value is followed through its limits until it returns. Other positions with the
//! same value lie on this path.
//!
//! | file | concept |
//! |---|---|
//! | `found` | positions without duplicates and without freedoms |
//! | `walk` | all closures of dyads, rods and meshed wheels |
//! | `search` | starts of Newton's method, and circuits |
//! | `turns` | whole turns that couplings distinguish |
//! | `record` | the analysis and its record |
//! | `options` | options of the analysis |

mod found;
mod options;
mod record;
mod search;
mod turns;
mod walk;

pub use options::Options;

use super::assemble::{assemble_until, holding, Failure as AssemblyFailure, Report, Request};
use super::State;
use crate::model::Model;
use found::Positions;

/// The positions in which a mechanism closes.
#[derive(Clone, Debug, Default)]
pub struct Configurations {
    /// The states, with the reports of their assembly.
    pub states: Vec<(State, Report)>,
    /// Whether the list is proven to be complete, because dyads, rods and meshed wheels place all bodies.
    pub complete: bool,
    /// Number of positions found in which a freedom is left. They are not in the list, because each is one of
    /// infinitely many.
    pub left_out: usize,
}

/// The reason that configurations cannot be listed.
#[derive(Clone, Debug)]
pub enum Failure {
    /// There is no configuration, or a rate contradicts the drivers.
    Assembly(Box<AssemblyFailure>),
    /// The mechanism has free coordinates in all positions found, so there are infinitely many configurations.
    Free {
        /// Number of degrees of freedom.
        degrees_of_freedom: usize,
    },
}

/// The configurations with the values of `request.set`, at most `limit`. Guesses are not used. Positions in which a
/// freedom is left are left out, such as a folded kite, two of whose links turn freely about one pin.
///
/// # Errors
/// [`Failure`]: the mechanism does not close, or has degrees of freedom left in all positions found.
pub fn configurations(
    model: &Model,
    request: &Request,
    limit: usize,
    stop: &dyn Fn() -> bool,
) -> Result<Configurations, Failure> {
    let held = holding(model, request);
    let mut found = Positions::new(&held, request.t, limit);
    let mut complete = walk::walk(&held, request.t, &mut found, stop);
    if !complete {
        search::search(&held, request.t, &mut found, stop);
        turns::turn(&held, request.t, &mut found, stop);
    }
    if let (true, Some((_, n))) = (found.positions.is_empty(), found.free.first()) {
        return Err(Failure::Free { degrees_of_freedom: *n });
    }
    complete &= found.dropped == 0;
    let mut states = Vec::new();
    for q in &found.positions {
        let v = vec![0.0; q.len()];
        let near = State { t: request.t, q: q.clone(), v, z: vec![0.0; model.layout.n_z] };
        let request = Request { state: Some(near), guess: Vec::new(), ..request.clone() };
        match assemble_until(model, &request, stop) {
            Ok(one) => states.push(one),
            Err(failure) if stop() => return Err(Failure::Assembly(failure)),
            // a position that violates a requirement of a joint, such as the end of a curve
            Err(failure) if states.is_empty() && found.positions.len() == 1 => {
                return Err(Failure::Assembly(failure));
            }
            Err(_) => {}
        }
    }
    if states.is_empty() {
        // use the failure of the assembly as the reason
        let one = assemble_until(model, request, stop);
        states.push(one.map_err(Failure::Assembly)?);
    }
    Ok(Configurations { states, complete, left_out: found.free.len() })
}
