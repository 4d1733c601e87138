//! The Python module `kempe._core`: a thin layer of arrays, errors and callbacks over the core.
//!
//! Nothing here knows mechanics. Every entry point is one line, `guard("its name", || …)`, and
//! every error leaves through [`errors::Failure`], so that Python sees the classes of
//! `kempe.errors` and never a Rust panic.
#![forbid(unsafe_code)]

mod errors;
mod guard;

use guard::guard;
use pyo3::prelude::*;

/// Version of the compiled core; the same as `kempe.__version__`.
#[pyfunction]
fn version() -> PyResult<&'static str> {
    guard("version", || Ok(env!("CARGO_PKG_VERSION")))
}

/// Names of all guarded entry points, for the test that walks over them.
#[pyfunction]
fn _entries() -> Vec<&'static str> {
    guard::ENTRIES.to_vec()
}

/// Test hook: the next call of the named entry point panics; `None` takes that back.
#[pyfunction]
#[pyo3(signature = (entry))]
fn _inject_panic(entry: Option<&str>) -> PyResult<()> {
    guard::arm(entry)
}

/// Test hook: raise the error class `kind` with every attribute filled.
#[pyfunction]
#[pyo3(signature = (kind, message))]
fn _raise(py: Python<'_>, kind: &str, message: &str) -> PyResult<()> {
    guard("_raise", || Err(errors::sample(kind, message)?.raise(py)))
}

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    guard::quiet_inside();
    module.add_function(wrap_pyfunction!(version, module)?)?;
    module.add_function(wrap_pyfunction!(_entries, module)?)?;
    module.add_function(wrap_pyfunction!(_inject_panic, module)?)?;
    module.add_function(wrap_pyfunction!(_raise, module)?)?;
    Ok(())
}
