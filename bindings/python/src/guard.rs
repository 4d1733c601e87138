//! The boundary between Rust and Python: a panic in Rust becomes an `InternalError` in Python.
//!
//! An entry point consists of one call:
//!
//! ```ignore
//! fn dynamics(…) -> PyResult<…> {
//!     guard("dynamics", || …)
//! }
//! ```
//!
//! A test makes each entry point panic, selected by its name.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, resume_unwind, set_hook, take_hook, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, Once, PoisonError};

use pyo3::prelude::*;

use crate::errors::{Failure, Kind};

/// The entry point that panics at its next call, and a flag that is fast to read.
static VICTIM: Mutex<Option<String>> = Mutex::new(None);
static ARMED: AtomicBool = AtomicBool::new(false);

thread_local! {
    /// Number of open guards on this thread. A panic is not printed while a guard is open.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
    /// Place of the last panic that was not printed, as `file:line`.
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Runs `body`. A panic in it becomes an `InternalError` with the panic's message.
///
/// State behind `&mut` that a panic left half-changed must not be used again. Entry points pass their scratch memory
/// by value or create it anew, so `AssertUnwindSafe` is valid here.
pub fn guard<T>(entry: &'static str, body: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    DEPTH.set(DEPTH.get() + 1);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        panic_if_armed(entry);
        body()
    }));
    DEPTH.set(DEPTH.get() - 1);
    match raised::take() {
        Some(error) => Err(error),
        None => outcome.unwrap_or_else(|payload| Err(internal_error(entry, payload.as_ref()))),
    }
}

/// The exception of a Python function that the core called on this thread.
pub mod raised {
    use pyo3::PyErr;
    use std::cell::{Cell, RefCell};

    thread_local! {
        static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
        static WAITS: Cell<bool> = const { Cell::new(false) };
    }

    /// Stores an exception until the entry point raises it.
    pub fn keep(error: PyErr) {
        WAITS.set(true);
        RAISED.set(Some(error));
    }

    /// Whether an exception is stored.
    pub fn waits() -> bool {
        WAITS.get()
    }

    /// Removes and returns the stored exception.
    pub fn take() -> Option<PyErr> {
        match WAITS.replace(false) {
            true => RAISED.take(),
            false => None,
        }
    }
}

/// A panic on another thread, with its place.
pub struct Caught {
    payload: Box<dyn Any + Send>,
    place: Option<String>,
}

impl Caught {
    /// Panics again, on this thread.
    pub fn resume(self) -> ! {
        PLACE.set(self.place);
        resume_unwind(self.payload)
    }
}

/// Runs `body` on a thread without a guard. A panic is caught and not printed.
pub fn caught<T>(body: impl FnOnce() -> T) -> Result<T, Caught> {
    DEPTH.set(DEPTH.get() + 1);
    let outcome = catch_unwind(AssertUnwindSafe(body));
    DEPTH.set(DEPTH.get() - 1);
    outcome.map_err(|payload| Caught { payload, place: PLACE.take() })
}

/// Makes the next guard of `entry` panic. `None` cancels this.
pub fn arm(entry: Option<&str>) {
    *VICTIM.lock().unwrap_or_else(PoisonError::into_inner) = entry.map(str::to_owned);
    ARMED.store(entry.is_some(), Ordering::Release);
}

/// Suppresses the output of panics inside a guard on the standard error stream. Other panics are printed as before.
///
/// The hook belongs to this extension's own copy of the Rust runtime, so other extensions in the process are not
/// affected.
pub fn quiet_inside() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let loud = take_hook();
        set_hook(Box::new(move |info| {
            if DEPTH.get() == 0 {
                return loud(info);
            }
            let place = info.location().map(|at| format!("{}:{}", at.file(), at.line()));
            PLACE.set(place);
        }));
    });
}

fn panic_if_armed(entry: &str) {
    if !ARMED.load(Ordering::Acquire) {
        return;
    }
    let mut victim = VICTIM.lock().unwrap_or_else(PoisonError::into_inner);
    if victim.as_deref() == Some(entry) {
        *victim = None;
        ARMED.store(false, Ordering::Release);
        drop(victim);
        panic!("injected panic in '{entry}'");
    }
}

fn internal_error(entry: &str, payload: &(dyn Any + Send)) -> PyErr {
    let text = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "panic without a message".to_owned());
    let place = PLACE.take().map(|at| format!(" ({at})")).unwrap_or_default();
    Python::attach(|py| {
        Failure::new(Kind::Internal, format!("{entry}: {text}{place}"))
            .hint("this is a fault in kempe, not in your model; please report it with the model")
            .raise(py)
    })
}
