//! The steps of a run that has paused.

use serde::{Deserialize, Serialize};

/// How the steps of a phase continue those of the phase before, after a pause.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Continued {
    /// The size of the next trial step, if the error control has chosen one.
    pub size: Option<f64>,
    /// Whether the automatic choice of the method is the implicit one.
    pub implicit: bool,
}
