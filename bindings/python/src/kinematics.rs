//! Kinematics for Python: without the interpreter's lock, interruptible, with progress.

use crate::attended::{attend, Attended, ENDING};
use crate::convert::{row, state, Row};
use crate::dynamics::PyRun;
use crate::errors::{raise_plain, Failure, Kind};
use crate::guard::guard;
use crate::model::PyModel;
use crate::options;
use crate::watch::{ToEnd, Watch};
use kempe::analyses::dynamics::{Run, Statistics};
use kempe::analyses::kinematics as driven;
use kempe::analyses::options::Declared;
use kempe::analyses::State;
use kempe::integrate::Flow;
use kempe::model::Model;
use kempe::stabilize::Projection;
use pyo3::prelude::*;
use serde_json::json;
use std::sync::Arc;

/// The checked options of `kinematics` or `inverse_dynamics`, as JSON with numbers in place of formulas.
#[pyfunction]
#[pyo3(signature = (model, text, inverse))]
pub fn kinematics_options(
    py: Python<'_>,
    model: &PyModel,
    text: &str,
    inverse: bool,
) -> PyResult<String> {
    guard("kinematics_options", || {
        let fields = options::fields(py, text)?;
        let found = match inverse {
            true => driven::InverseOptions::checked(&model.model, &fields, &[])
                .map(|found| (found.r#static, found.into())),
            false => driven::Options::checked(&model.model, &fields, &[]).map(|all| (false, all)),
        };
        let (resting, all) = found.map_err(|found| raise_plain(py, Kind::Model, &found))?;
        let driven::Options { t_end, output_step, over, range, n, .. } = all;
        let json = json!({
            "t_end": t_end, "output_step": output_step, "over": over, "range": range, "n": n,
            "static": resting
        });
        Ok(json.to_string())
    })
}

/// The SI unit of a rate in a motion over a quantity.
#[pyfunction]
pub fn rate_unit(unit: &str, by: &str) -> PyResult<String> {
    guard("rate_unit", || Ok(kempe::analyses::record::rate_unit(unit, by)))
}

/// The motion that the drivers determine, at the given times.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, times, progress, resting=false))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn kinematics(
    py: Python<'_>,
    model: &Bound<'_, PyModel>,
    t: f64,
    q: Row<'_>,
    v: Row<'_>,
    z: Row<'_>,
    times: Row<'_>,
    progress: Option<Py<PyAny>>,
    resting: bool,
) -> PyResult<PyRun> {
    guard("kinematics", || {
        let core = Arc::clone(&model.get().model);
        let start = state(py, &core, t, [&q, &v, &z])?;
        let times = row(py, "times", &times, times.as_array().len())?;
        let work = move |stop: ToEnd<'_>| {
            let mut watch = Watch::until(progress.as_ref(), stop);
            let (run, reason) = followed(&core, (&start, resting), &times, |t| watch.look(t));
            (run, reason, watch.raised)
        };
        let ((run, reason), error) = match attend(py, ENDING, work)? {
            Attended::Done((run, reason, error)) => ((run, reason), error),
            Attended::Interrupted(error, Some((run, reason, _))) => ((run, reason), Some(error)),
            Attended::Interrupted(error, None) => return Err(error),
        };
        let (message, error) = match (error, reason) {
            (None, None) => return PyRun::new(py, model, run, "the last value was reached"),
            (Some(error), _) => ("interrupted".to_string(), error),
            (None, Some(reason)) => (reason.to_string(), because(&reason).raise(py)),
        };
        error.value(py).setattr("run", PyRun::new(py, model, run, &message)?)?;
        Err(error)
    })
}

/// The run through the given times, and the reason for which it ended early.
fn followed(
    model: &Model,
    (start, resting): (&State, bool),
    times: &[f64],
    mut look: impl FnMut(f64) -> Flow,
) -> (Run, Option<driven::Reason>) {
    let began = std::time::Instant::now();
    let mut recorder = driven::MotionRecorder::new(model, start, resting);
    let outcome = driven::kinematics(model, start, times, |motion| {
        recorder.follow(motion);
        motion.points.last().map_or(Flow::Continue, |point| look(point.t))
    });
    let (motion, reason) = match outcome {
        Ok(motion) => (motion, None),
        Err(failure) => (failure.motion, Some(failure.reason)),
    };
    recorder.follow(&motion);
    (run(&motion, recorder.recorded, began.elapsed().as_secs_f64()), reason)
}

fn run(motion: &driven::Motion, recorded: driven::Recorded, seconds: f64) -> Run {
    let driven::Recorded { trajectory, dense } = recorded;
    let (steps, rejected) = (motion.steps(), motion.rejected);
    Run {
        trajectory,
        phases: vec![0],
        dense: (!dense.t.is_empty()).then_some(dense),
        statistics: Statistics { steps, rejected, seconds, ..Statistics::default() },
        reached: motion.reached,
        passing: true,
        projection: Some(Projection::default()),
        ..Run::default()
    }
}

/// Converts the failure of a motion to an exception.
pub fn because(reason: &driven::Reason) -> Failure {
    let message = reason.to_string();
    match reason {
        driven::Reason::Free { .. } => {
            let hint = "add a coordinate_driver for each, or use dynamics";
            Failure::new(Kind::Model, message).hint(hint)
        }
        driven::Reason::Open { t, name, .. } => Failure::new(Kind::Assembly, message)
            .name(name)
            .at(*t)
            .hint("kp.assemble(model, from_state=state) assembles the mechanism anew"),
        driven::Reason::Beyond { t, name, .. } => {
            Failure::new(Kind::Assembly, message).name(name).at(*t).hint(
                "start where the gap is not negative, or give a stiffness in place of restitution",
            )
        }
        driven::Reason::Singular { t, name, .. } => Failure::new(Kind::Singularity, message)
            .name(name)
            .at(*t)
            .hint("start at another position, or drive another coordinate"),
        driven::Reason::Limit(limit) => Failure::new(Kind::Singularity, message)
            .name(&limit.driver)
            .at(limit.t)
            .hint("end the motion before, or drive another coordinate"),
    }
}
