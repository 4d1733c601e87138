//! A state of an instance, in memory and as bytes.

use crate::instance::Phase;
use kempe::analyses::dynamics::SavedRun;
use serde::{Deserialize, Serialize};

/// All that an instance needs to continue.
#[derive(Clone, Serialize, Deserialize)]
pub struct Snapshot {
    /// The token of the FMU to which it belongs.
    pub token: String,
    pub phase: Phase,
    /// The values of parameters with which the mechanism was assembled, by their places.
    pub chosen: Vec<(usize, f64)>,
    /// Inputs that the next step will have.
    pub pending: Vec<(usize, f64)>,
    pub tolerance: Option<f64>,
    /// Whether the log contains a doubt about the accuracy already.
    pub doubted: bool,
    pub run: Option<SavedRun>,
    /// Whether it was read from bytes.
    #[serde(skip, default = "yes")]
    pub was_read: bool,
}

fn yes() -> bool {
    true
}

impl Snapshot {
    /// The state as bytes.
    pub fn bytes(&self) -> Result<Vec<u8>, String> {
        postcard::to_extend(self, Vec::new()).map_err(|error| error.to_string())
    }

    /// The state from bytes.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|_| "the bytes are not a state of this FMU".to_string())
    }
}
