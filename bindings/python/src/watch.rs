//! Signals and progress during long runs.

use kempe::integrate::Flow;
use pyo3::prelude::*;
use std::time::{Duration, Instant};

/// Time between looks at signals and calls of `progress`.
const GLANCE: Duration = Duration::from_millis(40);
/// Time between looks at the clock: so short that a step which takes hundreds of times as long as the states
/// reported before it is not late.
const PACE: Duration = Duration::from_micros(250);

/// Looks at signals and reports progress, rarely enough to cost nothing.
pub struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    /// The last look at signals.
    told: Instant,
    /// The last look at the clock.
    looked: Instant,
    /// Steps and reported states from one look at the clock to the next.
    every: u32,
    /// And still to come.
    left: u32,
    pub raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    pub fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        let now = Instant::now();
        Self { progress, told: now, looked: now, every: 1, left: 1, raised: None }
    }

    pub fn look(&mut self, t: f64) -> Flow {
        self.left -= 1;
        if self.left > 0 {
            return Flow::Continue;
        }
        self.look_at_clock(t)
    }

    #[cold]
    fn look_at_clock(&mut self, t: f64) -> Flow {
        let now = Instant::now();
        // too early: twice as many until the next; too late: so many fewer
        let late = (now - self.looked).as_secs_f64() / PACE.as_secs_f64();
        self.every = (f64::from(self.every) / late.max(0.5)).max(1.0) as u32;
        (self.left, self.looked) = (self.every, now);
        if now - self.told < GLANCE {
            return Flow::Continue;
        }
        self.told = now;
        let outcome = Python::attach(|py| {
            py.check_signals()?;
            self.progress.map_or(Ok(()), |call| call.call1(py, (t,)).map(|_| ()))
        });
        match outcome {
            Ok(()) => Flow::Continue,
            Err(error) => {
                self.raised = Some(error);
                Flow::Stop
            }
        }
    }
}
