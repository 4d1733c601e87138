//! Statistics of a quantity over a run, for Python functions.

use crate::convert::{refuse, Row, Rows};
use crate::guard::guard;
use kempe::analyses::dynamics::Steps;
use kempe::analyses::statistics::{
    self as core, Integrals, Maxima, Samples, Settling, SingularInstants,
};
use kempe::analyses::sweep::Statistic;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Values and times of maxima, indices and times of singular positions.
type Found<'py> = (Array<'py>, Array<'py>, Vec<usize>, Array<'py>);

/// Times and values of the samples, times and values of the maxima, and a flag whether singular positions were found.
type Between<'py> = (Row<'py>, Row<'py>, Row<'py>, Row<'py>, bool);

/// A Python function of times that the core calls.
struct Caller<'py> {
    py: Python<'py>,
    call: Bound<'py, PyAny>,
    /// An exception that is not an error of kempe.
    raised: Option<PyErr>,
}

impl<'py> Caller<'py> {
    fn new(call: Bound<'py, PyAny>) -> Self {
        Self { py: call.py(), call, raised: None }
    }

    /// The values. None after an error of kempe, which means that there are no values.
    fn read(&mut self, t: &[f64]) -> Option<Vec<f64>> {
        let values = self.call.call1((t.to_vec().into_pyarray(self.py),)).and_then(|values| {
            let values: Row<'_> = values.extract()?;
            Ok(values.as_array().to_vec())
        });
        match values {
            Ok(values) if values.len() == t.len() => Some(values),
            Ok(values) => {
                let message = format!("{} values for {} times", values.len(), t.len());
                self.raised = Some(refuse(self.py, "read", message));
                None
            }
            Err(error) => {
                let kempe = self.py.import("kempe.errors").and_then(|m| m.getattr("KempeError"));
                let known = kempe.is_ok_and(|class| error.is_instance(self.py, &class));
                if !known {
                    self.raised = Some(error);
                }
                None
            }
        }
    }
}

/// Values at times. They must not be empty.
fn series(py: Python<'_>, t: &Row<'_>, values: &Row<'_>) -> PyResult<(Vec<f64>, Vec<f64>)> {
    let (t, values) = (t.as_array().to_vec(), values.as_array().to_vec());
    match t.len() == values.len() && !t.is_empty() {
        true => Ok((t, values)),
        false => {
            let message = format!("{} numbers for {} times", values.len(), t.len());
            Err(refuse(py, "values", message))
        }
    }
}

/// Instants that are close enough for smooth curves on an interpolant.
#[pyfunction]
#[pyo3(signature = (bounds, outputs, numbers))]
pub fn instants<'py>(
    py: Python<'py>,
    bounds: Row<'py>,
    outputs: Row<'py>,
    numbers: usize,
) -> PyResult<Array<'py>> {
    guard("instants", || {
        let (bounds, outputs) = (bounds.as_array().to_vec(), outputs.as_array().to_vec());
        if bounds.len() < 2 {
            return Err(refuse(py, "bounds", format!("{} numbers; at least 2", bounds.len())));
        }
        Ok(core::instants(&bounds, &outputs, numbers).into_pyarray(py))
    })
}

/// The rows y of an interpolant at times.
#[pyfunction]
#[pyo3(signature = (t, y, c, times))]
pub fn interpolate<'py>(
    py: Python<'py>,
    t: Row<'py>,
    y: Rows<'py>,
    c: PyReadonlyArray3<'py, f64>,
    times: Row<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    guard("interpolate", || {
        let (steps, n_y) = y.as_array().dim();
        let (rows, width, degree) = c.as_array().dim();
        let t = t.as_array().to_vec();
        if (rows, width, t.len()) != (steps, n_y, steps + 1) || steps == 0 {
            let message = format!("{} times, {steps} rows, {rows} coefficients", t.len());
            return Err(refuse(py, "interpolant", message));
        }
        let (y, c) = (y.as_slice()?, c.as_slice()?);
        let times = times.as_array().to_vec();
        let found = Steps { t: &t, y, c, n_y, degree }.at(&times);
        crate::convert::table(py, found, (times.len(), n_y))
    })
}

/// The largest local maxima of a quantity. `read` returns its values at times.
#[pyfunction]
#[pyo3(signature = (t, sampled, near, near_t, resolved, read))]
pub fn maxima<'py>(
    py: Python<'py>,
    t: Row<'py>,
    sampled: Row<'py>,
    near: Vec<usize>,
    near_t: Row<'py>,
    resolved: bool,
    read: Bound<'py, PyAny>,
) -> PyResult<Found<'py>> {
    guard("maxima", || {
        let (t, sampled) = series(py, &t, &sampled)?;
        let near_t = near_t.as_array().to_vec();
        let mut caller = Caller::new(read);
        let found =
            Maxima::search((&t, &sampled), (&near, &near_t), resolved, &mut |t: &[f64]| {
                caller.read(t)
            });
        match caller.raised {
            Some(error) => Err(error),
            None => {
                let [values, t, near_t] =
                    [found.values, found.t, found.near_t].map(|x| x.into_pyarray(py));
                Ok((values, t, found.near, near_t))
            }
        }
    })
}

/// The singular positions at instants, from the regularity there. `read` returns the regularity at times. Returns the
/// indices of the instants that are kept, and the indices among them and the times of the positions.
#[pyfunction]
#[pyo3(signature = (t, regularity, read))]
pub fn singular_instants<'py>(
    py: Python<'py>,
    t: Row<'py>,
    regularity: Row<'py>,
    read: Bound<'py, PyAny>,
) -> PyResult<(Vec<usize>, Vec<usize>, Vec<f64>)> {
    guard("singular_instants", || {
        let (t, regularity) = series(py, &t, &regularity)?;
        let mut caller = Caller::new(read);
        let found = SingularInstants::find(&t, &regularity, &mut |t: &[f64]| caller.read(t));
        match caller.raised {
            Some(error) => Err(error),
            None => Ok((found.keep, found.near, found.near_t)),
        }
    })
}

/// The extreme value and its time, from the outputs and the maxima on the interpolant. The sign of the values makes
/// the extreme value a maximum.
#[pyfunction]
#[pyo3(signature = (sign, t, values, between=None))]
pub fn extreme<'py>(
    py: Python<'py>,
    sign: f64,
    t: Row<'py>,
    values: Row<'py>,
    between: Option<Between<'py>>,
) -> PyResult<(f64, f64)> {
    guard("extreme", || {
        let (t, values) = series(py, &t, &values)?;
        let outputs = Samples { t: &t, values: &values };
        let found = match between {
            None => core::extreme(sign, outputs, None),
            Some((t, values, best, at, near)) => {
                let (t, values) = series(py, &t, &values)?;
                let (values_of, t_of) = (best.as_array().to_vec(), at.as_array().to_vec());
                let near = if near { vec![0] } else { Vec::new() };
                let maxima = Maxima { values: values_of, t: t_of, near, near_t: Vec::new() };
                let samples = Samples { t: &t, values: &values };
                core::extreme(sign, outputs, Some((samples, &maxima)))
            }
        };
        Ok((found.value, found.t))
    })
}

/// Whether values differ by more than rounding errors.
#[pyfunction]
#[pyo3(signature = (values))]
pub fn changes(values: Row<'_>) -> PyResult<bool> {
    guard("changes", || Ok(core::changes(&values.as_array().to_vec())))
}

/// The integral, the mean and the root mean square of a quantity. `between` contains the ends of steps, the degree of their interpolant, times at which
/// steps are not halved, and a function that returns values at times; None if this function has no value. Without it, the
/// values at the outputs are used.
#[pyfunction]
#[pyo3(signature = (t, values, between=None))]
pub fn integrals<'py>(
    py: Python<'py>,
    t: Row<'py>,
    values: Row<'py>,
    between: Option<(Row<'py>, usize, Row<'py>, Bound<'py, PyAny>)>,
) -> PyResult<Option<[f64; 3]>> {
    guard("integrals", || {
        let (t, values) = series(py, &t, &values)?;
        let mut found = Some(Integrals::of_outputs(&t, &values));
        if let Some((bounds, degree, near, call)) = between {
            let (bounds, near) = (bounds.as_array().to_vec(), near.as_array().to_vec());
            if bounds.len() < 2 {
                return Err(refuse(py, "bounds", format!("{} numbers; at least 2", bounds.len())));
            }
            let mut caller = Caller::new(call);
            let read = &mut |t: &[f64]| caller.read(t);
            let at_points = core::in_blocks(&Integrals::points(&bounds, degree), read);
            found =
                at_points.and_then(|of| Integrals::of_steps((&bounds, degree), &of, &near, read));
            if let Some(error) = caller.raised {
                return Err(error);
            }
        }
        let all = [Statistic::Integral, Statistic::Mean, Statistic::Rms];
        Ok(found.map(|found| all.map(|statistic| statistic.of_integrals(&found))))
    })
}

/// The Euclidean norms of rows.
#[pyfunction]
#[pyo3(signature = (rows))]
pub fn row_norms<'py>(py: Python<'py>, rows: Rows<'py>) -> PyResult<Array<'py>> {
    guard("row_norms", || {
        let (count, width) = rows.as_array().dim();
        let all: Vec<f64> = rows.as_array().iter().copied().collect();
        Ok(core::row_norms(&all, width, count).into_pyarray(py))
    })
}

/// Whether a quantity changes, and its settling time or None. `between` returns its values at times.
#[pyfunction]
#[pyo3(signature = (t, values, noise=None, between=None))]
pub fn settling<'py>(
    py: Python<'py>,
    t: Row<'py>,
    values: Row<'py>,
    noise: Option<f64>,
    between: Option<Bound<'py, PyAny>>,
) -> PyResult<(bool, Option<f64>)> {
    guard("settling", || {
        let (t, values) = series(py, &t, &values)?;
        let mut last = None;
        let found = match between {
            None => core::settling(&t, &values, noise, None),
            Some(call) => {
                let mut read = |t: &[f64]| {
                    let values = call.call1((t.to_vec().into_pyarray(py),));
                    let values = values.and_then(|values| {
                        let values: Row<'_> = values.extract()?;
                        Ok(values.as_array().to_vec())
                    });
                    values.map_err(|error| last = Some(error)).ok()
                };
                core::settling(&t, &values, noise, Some(&mut read))
            }
        };
        match (found, last) {
            (_, Some(error)) => Err(error),
            (Settling::Constant, _) => Ok((false, None)),
            (Settling::At(t), _) => Ok((true, Some(t))),
            (Settling::Never | Settling::Unknown, _) => Ok((true, None)),
        }
    })
}
