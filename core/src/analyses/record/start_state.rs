//! The start of an analysis.

use super::fact::Fact;
use crate::analyses::dynamics::Run;
use crate::analyses::State;
use serde_json::Value;

/// The state in which an analysis starts.
#[derive(Clone, Debug, PartialEq)]
pub struct StartState {
    /// The state.
    pub state: State,
    /// The drivers that were released before. They do not act.
    pub released: Vec<String>,
}

impl StartState {
    /// A start at which all drivers act.
    pub const fn new(state: State) -> Self {
        Self { state, released: Vec::new() }
    }

    /// The same drivers in another state.
    pub fn at(&self, state: State) -> Self {
        Self { state, released: self.released.clone() }
    }

    /// The position, for readers of an analysis that examines it.
    pub fn examined(&self) -> (Fact, State) {
        (Fact::new("examined position", Value::Null), self.state.clone())
    }

    /// The end of a motion that begins here.
    pub fn after(&self, run: &Run) -> Self {
        let track = &run.trajectory;
        let Some(last) = track.t.len().checked_sub(1) else { return self.clone() };
        let row = |table: &[f64], width: usize| table[width * last..].to_vec();
        let State { q, z, .. } = &self.state;
        let state = State {
            t: track.t[last],
            q: row(&track.q, q.len()),
            v: row(&track.v, q.len()),
            z: row(&track.z, z.len()),
        };
        let released = run.settings.last().map(|setting| setting.released.clone());
        Self { state, released: released.unwrap_or_else(|| self.released.clone()) }
    }
}
