//! Signals and progress during long runs.

use crate::attended::GLANCE;
use kempe::integrate::Flow;
use pyo3::prelude::*;
use std::time::{Duration, Instant};

/// Time between readings of the clock. It is so short that a step which takes hundreds of times as long as the
/// previous states causes no noticeable delay.
const PACE: Duration = Duration::from_micros(250);

/// Whether an attended computation is to end.
pub type ToEnd<'a> = &'a (dyn Fn() -> bool + Sync);

/// Checks for signals and reports progress, at intervals that make the cost negligible.
pub struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    /// Whether the run is to end, for a run on a thread of its own, to which no signals come.
    stop: Option<ToEnd<'a>>,
    /// The time of the last check for signals.
    told: Instant,
    /// The time of the last reading of the clock.
    looked: Instant,
    /// Number of steps and reported states between readings of the clock.
    every: u32,
    /// Number of steps and states until the next reading.
    left: u32,
    pub raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    pub fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        let now = Instant::now();
        Self { progress, stop: None, told: now, looked: now, every: 1, left: 1, raised: None }
    }

    /// The watch of an attended computation.
    pub fn until(progress: Option<&'a Py<PyAny>>, stop: ToEnd<'a>) -> Self {
        Self { stop: Some(stop), ..Self::new(progress) }
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
        // too early: at most double the number until the next reading; too late: reduce it in proportion
        let late = (now - self.looked).as_secs_f64() / PACE.as_secs_f64();
        self.every = (f64::from(self.every) / late.max(0.5)).max(1.0) as u32;
        (self.left, self.looked) = (self.every, now);
        if self.stop.is_some_and(|stop| stop()) {
            return Flow::Stop;
        }
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
