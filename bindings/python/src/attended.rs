//! Long computations that can be interrupted.

use pyo3::prelude::*;
use std::any::Any;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::sync::Arc;
use std::time::Duration;

use crate::guard::{caught, raised};
use crate::watch::ToEnd;

/// Time between checks for signals and calls of `progress`.
pub const GLANCE: Duration = Duration::from_millis(40);
/// Longest time for a computation to end with its result so far, after an interruption.
pub const ENDING: Duration = Duration::from_millis(80);
/// Stack size of the computation, equal to that of a main thread.
const STACK: usize = 8 << 20;

/// The outcome of an attended computation.
pub enum Attended<T> {
    /// The result.
    Done(T),
    /// The exception of a signal handler, such as `KeyboardInterrupt`, and the result so far if it came soon enough.
    Interrupted(PyErr, Option<T>),
}

/// Runs the computation on its own thread and checks for signals meanwhile. After an interruption, `stop` returns
/// true and the thread ends by itself, so that the interruption takes effect at once.
///
/// # Errors
/// The exception of a signal handler, such as `KeyboardInterrupt`.
pub fn attended<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(ToEnd<'_>) -> T + Send + 'static,
) -> PyResult<T> {
    match attend(py, Duration::ZERO, work)? {
        Attended::Done(result) => Ok(result),
        Attended::Interrupted(error, _) => Err(error),
    }
}

/// As [`attended`]. After an interruption, waits up to `ending` for the result so far, with which `work` ends then.
///
/// # Errors
/// The thread cannot be started.
pub fn attend<T: Send + 'static>(
    py: Python<'_>,
    ending: Duration,
    work: impl FnOnce(ToEnd<'_>) -> T + Send + 'static,
) -> PyResult<Attended<T>> {
    let known = |found: Found| *found.downcast().expect("a result of the type of the work");
    Ok(match attend_any(py, ending, Box::new(|stop| Box::new(work(stop))))? {
        Attended::Done(found) => Attended::Done(known(found)),
        Attended::Interrupted(error, so_far) => Attended::Interrupted(error, so_far.map(known)),
    })
}

/// A result of any type: the channel is compiled once for all of them.
type Found = Box<dyn Any + Send>;

fn attend_any(
    py: Python<'_>,
    ending: Duration,
    work: Box<dyn FnOnce(ToEnd<'_>) -> Found + Send>,
) -> PyResult<Attended<Found>> {
    let stop = Arc::new(AtomicBool::new(false));
    let (send, receive) = channel();
    let stopped = Arc::clone(&stop);
    let body = move || {
        let stop = || stopped.load(Ordering::Relaxed);
        // there is no receiver after an interruption
        _ = send.send((caught(|| work(&stop)), raised::take()));
    };
    std::thread::Builder::new().stack_size(STACK).spawn(body)?;
    let receive = std::sync::Mutex::new(receive); // shared with the closure below
    let wait = |time: Duration| {
        py.detach(|| match receive.lock() {
            Ok(receive) => receive.recv_timeout(time),
            Err(_) => Err(RecvTimeoutError::Disconnected),
        })
    };
    loop {
        match wait(GLANCE) {
            Ok((found, error)) => {
                error.into_iter().for_each(raised::keep); // the guard of this thread raises it
                return match found {
                    Ok(result) => Ok(Attended::Done(result)),
                    Err(panic) => panic.resume(),
                };
            }
            Err(RecvTimeoutError::Disconnected) => panic!("the work ended without a result"),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals() {
                    stop.store(true, Ordering::Relaxed);
                    let so_far = wait(ending).ok().and_then(|(found, _)| found.ok());
                    return Ok(Attended::Interrupted(error, so_far));
                }
            }
        }
    }
}
