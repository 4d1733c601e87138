//! The Python module `kempe._core`: a thin layer of arrays, errors and callbacks over the core.
//!
//! This layer contains no mechanics. Every entry point is one call of `guard("its name", || …)`, and every error is
//! raised by [`errors::Failure`], so that Python receives the classes of `kempe.errors` and never a Rust panic.
#![forbid(unsafe_code)]

mod active;
mod assemble;
mod attended;
mod cams;
mod case;
mod column_formulas;
mod compliance;
mod convert;
mod drawing;
mod dynamics;
mod errors;
mod exchange;
mod formulas;
mod functions;
mod guard;
mod matrices;
mod measures;
mod model;
mod names;
mod processor;
mod respond;
mod run_analysis;
mod states;
mod statistics;
mod stepped_run;
mod sweep;
mod synthesis;
mod tables;
mod transmission;
mod watch;

use guard::guard;
use mimalloc::MiMalloc;
use pyo3::prelude::*;

/// Keeps the memory of freed results for later results. Returning it to the system and requesting it again in every
/// run would cost a short run a quarter of its time.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Version of the compiled core, equal to `kempe.__version__`.
#[pyfunction]
fn version() -> PyResult<&'static str> {
    guard("version", || Ok(env!("CARGO_PKG_VERSION")))
}

/// The catalogue of the allowed content of a case, as JSON.
#[pyfunction]
fn catalogue() -> PyResult<String> {
    guard("catalogue", || Ok(tables::all()))
}

/// JSON Schema of a case.
#[pyfunction]
fn schema() -> PyResult<String> {
    guard("schema", || Ok(kempe::case::schema()))
}

/// Whether a name is reserved in expressions.
#[pyfunction]
fn is_reserved(name: &str) -> PyResult<bool> {
    guard("is_reserved", || Ok(kempe::case::RESERVED.contains(&name)))
}

/// Test hook: the next call of the named entry point panics. `None` cancels this.
#[pyfunction]
#[pyo3(signature = (entry))]
fn _inject_panic(entry: Option<&str>) {
    guard::arm(entry);
}

/// Test hook: raises the error class `kind` with all attributes set.
#[pyfunction]
#[pyo3(signature = (kind, message))]
fn _raise(py: Python<'_>, kind: &str, message: &str) -> PyResult<()> {
    guard("_raise", || Err(errors::sample(kind, message)?.raise(py)))
}

/// Adds the functions for drawings, sweeps and statistics.
fn add_drawing_and_sweeps(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(statistics::instants, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::interpolate, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::maxima, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::singular_instants, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::extreme, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::changes, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::integrals, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::row_norms, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::settling, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweeps, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::gradient, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::slopes_at, module)?)?;
    module.add_function(wrap_pyfunction!(column_formulas::formula_names, module)?)?;
    module.add_function(wrap_pyfunction!(column_formulas::formula_unit, module)?)?;
    module.add_function(wrap_pyfunction!(column_formulas::formula_value, module)?)?;
    module.add_function(wrap_pyfunction!(exchange::exchange_formats, module)?)?;
    module.add_function(wrap_pyfunction!(exchange::exchange_format, module)?)?;
    module.add_function(wrap_pyfunction!(exchange::exchange_read, module)?)?;
    module.add_function(wrap_pyfunction!(exchange::exchange_dxf, module)?)?;
    module.add_function(wrap_pyfunction!(drawing::scene, module)?)?;
    module.add_function(wrap_pyfunction!(drawing::display, module)?)?;
    module.add_function(wrap_pyfunction!(drawing::view_around, module)?)?;
    module.add_function(wrap_pyfunction!(drawing::place_texts, module)?)?;
    module.add_function(wrap_pyfunction!(drawing::text_width, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::dyad_conditions, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::all_dyads, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::dyads_with_end, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::pairs_of_dyads, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::four_bars, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::ranked_linkages, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::path_four_bars, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::nine_point_four_bars, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::near_poses, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::fit_pairs, module)?)?;
    Ok(())
}

/// Adds the functions for cams.
fn add_cams(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(cams::cam_laws, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_programme, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_lift, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_sampled, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_check, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_angles, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_shape, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_limits, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_least_base, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_remarks, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_case, module)?)?;
    module.add_function(wrap_pyfunction!(cams::cam_walls, module)?)?;
    Ok(())
}

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    guard::quiet_inside();
    add_drawing_and_sweeps(module)?;
    add_cams(module)?;
    module.add_class::<case::PyCase>()?;
    module.add_class::<model::PyModel>()?;
    module.add_class::<dynamics::PyRun>()?;
    module.add_class::<states::PyStates>()?;
    module.add_class::<run_analysis::PyRecord>()?;
    module.add_class::<stepped_run::PySteppedRun>()?;
    module.add_class::<stepped_run::PySavedRun>()?;
    module.add_function(wrap_pyfunction!(run_analysis::run_analysis, module)?)?;
    module.add_function(wrap_pyfunction!(run_analysis::driven_by, module)?)?;
    module.add_function(wrap_pyfunction!(version, module)?)?;
    module.add_function(wrap_pyfunction!(processor::instructions, module)?)?;
    module.add_function(wrap_pyfunction!(processor::supports_v3, module)?)?;
    module.add_function(wrap_pyfunction!(catalogue, module)?)?;
    module.add_function(wrap_pyfunction!(schema, module)?)?;
    module.add_function(wrap_pyfunction!(is_reserved, module)?)?;
    module.add_function(wrap_pyfunction!(assemble::assemble, module)?)?;
    module.add_function(wrap_pyfunction!(compliance::compliance, module)?)?;
    module.add_function(wrap_pyfunction!(run_analysis::rate_unit, module)?)?;
    module.add_function(wrap_pyfunction!(transmission::line_at, module)?)?;
    module.add_function(wrap_pyfunction!(transmission::transmitting, module)?)?;
    module.add_function(wrap_pyfunction!(matrices::matrices, module)?)?;
    module.add_function(wrap_pyfunction!(measures::measure, module)?)?;
    module.add_function(wrap_pyfunction!(measures::measure_values, module)?)?;
    module.add_function(wrap_pyfunction!(measures::measure_slopes, module)?)?;
    module.add_function(wrap_pyfunction!(formulas::formulas, module)?)?;
    module.add_function(wrap_pyfunction!(_inject_panic, module)?)?;
    module.add_function(wrap_pyfunction!(_raise, module)?)?;
    Ok(())
}
