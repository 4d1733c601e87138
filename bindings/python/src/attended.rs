//! Long computations without steps, such as an assembly, that can be interrupted.

use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::sync::Arc;
use std::time::Duration;

use crate::guard::caught;

/// Time between checks for signals.
const GLANCE: Duration = Duration::from_millis(40);
/// Stack size of the computation, equal to that of a main thread.
const STACK: usize = 8 << 20;

/// Runs the computation on its own thread and checks for signals meanwhile. After an interruption, `stop` returns
/// true and the thread ends by itself, so that the interruption takes effect at once.
///
/// # Errors
/// The exception of a signal handler, such as `KeyboardInterrupt`.
pub fn attended<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let (send, receive) = channel();
    let stopped = Arc::clone(&stop);
    let body = move || {
        let stop = || stopped.load(Ordering::Relaxed);
        // there is no receiver after an interruption
        _ = send.send(caught(|| work(&stop)));
    };
    std::thread::Builder::new().stack_size(STACK).spawn(body)?;
    let receive = std::sync::Mutex::new(receive); // shared with the closure below
    loop {
        let outcome = py.detach(|| match receive.lock() {
            Ok(receive) => receive.recv_timeout(GLANCE),
            Err(_) => Err(RecvTimeoutError::Disconnected),
        });
        match outcome {
            Ok(Ok(result)) => return Ok(result),
            Ok(Err(panic)) => panic.resume(),
            Err(RecvTimeoutError::Disconnected) => panic!("the work ended without a result"),
            Err(RecvTimeoutError::Timeout) => {
                py.check_signals().inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
            }
        }
    }
}
