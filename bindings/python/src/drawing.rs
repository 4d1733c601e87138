//! Scenes and display lists as JSON, and texts of figures.

use crate::attended::attended;
use crate::convert::{refuse, rows, table, Row, Rows};
use crate::guard::guard;
use crate::model::PyModel;
use crate::watch::ToEnd;
use kempe_drawing::display::{place_labels, width, Taken};
use kempe_drawing::{At, Effort, Pose, Request, Scene, View};
use numpy::{PyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use serde_json::{from_str, to_string};
use std::sync::Arc;

/// Poses of the moving bodies: time, body, and x, y and angle.
type Poses<'py> = PyReadonlyArray3<'py, f64>;

/// The static part of a scene as JSON. `efforts` are the elements with the forces and torques that
/// give their arrows directions.
#[pyfunction]
#[pyo3(signature = (model, poses, efforts))]
pub fn scene<'py>(
    py: Python<'py>,
    model: &PyModel,
    poses: Poses<'py>,
    efforts: Vec<(String, Rows<'py>, Row<'py>)>,
) -> PyResult<String> {
    guard("scene", || {
        let poses = read_poses(py, &poses)?;
        let read = |(element, force, torque): &(String, Rows<'py>, Row<'py>)| {
            let force = force.as_array();
            let force = force.rows().into_iter().map(|row| [row[0], row[1]]).collect();
            Effort { element: element.clone(), force, torque: torque.as_array().to_vec() }
        };
        let efforts: Vec<Effort> = efforts.iter().map(read).collect();
        let core = Arc::clone(&model.model);
        let found =
            attended(py, move |_| to_string(&kempe_drawing::scene(&core, &poses, &efforts)))?;
        found.map_err(|e| refuse(py, "scene", e.to_string()))
    })
}

/// The display list of a scene as JSON. `view` contains the lower left corner, points per metre, and the size in
/// points.
#[pyfunction]
#[pyo3(signature = (scene, poses, view, request))]
pub fn display<'py>(
    py: Python<'py>,
    scene: &str,
    poses: Poses<'py>,
    view: (At, f64, At),
    request: &str,
) -> PyResult<String> {
    guard("display", || {
        let scene: Scene = from_str(scene).map_err(|e| refuse(py, "scene", e.to_string()))?;
        let asked: Request = from_str(request).map_err(|e| refuse(py, "request", e.to_string()))?;
        let poses = read_poses(py, &poses)?;
        let (low, scale, size) = view;
        let view = View { low, scale, size };
        let work =
            move |_: ToEnd<'_>| to_string(&kempe_drawing::display(&scene, &poses, &view, &asked));
        attended(py, work)?.map_err(|e| refuse(py, "display", e.to_string()))
    })
}

/// The view of bounds with a margin on an area in points: lower left corner, points per metre, size.
#[pyfunction]
#[pyo3(signature = (bounds, size))]
pub fn view_around(bounds: [f64; 4], size: At) -> PyResult<(At, f64, At)> {
    guard("view_around", || {
        let View { low, scale, size } = View::around(bounds, size);
        Ok((low, scale, size))
    })
}

/// Offsets in points from anchors to the centres of texts, such that the texts do not cover lines, boxes or each
/// other.
#[pyfunction]
#[pyo3(signature = (anchors, sizes, lines, boxes, area))]
pub fn place_texts<'py>(
    py: Python<'py>,
    anchors: Rows<'py>,
    sizes: Rows<'py>,
    lines: Rows<'py>,
    boxes: Rows<'py>,
    area: At,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    guard("place_texts", || {
        let count = anchors.as_array().nrows();
        let four = |name: &str, given: &Rows<'py>| -> PyResult<Vec<[f64; 4]>> {
            let values = rows(py, name, given, (given.as_array().nrows(), 4))?;
            Ok(values.chunks_exact(4).map(|v| [v[0], v[1], v[2], v[3]]).collect())
        };
        let two = |name: &str, given: &Rows<'py>| -> PyResult<Vec<At>> {
            let values = rows(py, name, given, (count, 2))?;
            Ok(values.chunks_exact(2).map(|v| [v[0], v[1]]).collect())
        };
        let lines = four("lines", &lines)?;
        let taken = Taken {
            reach: vec![0.0; lines.len()],
            segments: vec![lines.iter().map(|[a, b, c, d]| [[*a, *b], [*c, *d]]).collect()],
            boxes: vec![four("boxes", &boxes)?],
            inside: [[0.0; 2], area],
        };
        let found = place_labels(&[two("anchors", &anchors)?], &two("sizes", &sizes)?, taken);
        table(py, found.concat(), (count, 2))
    })
}

/// Width of a text with a font size, in the unit of the size.
#[pyfunction]
#[pyo3(signature = (words, size, bold))]
pub fn text_width(words: &str, size: f64, bold: bool) -> PyResult<f64> {
    guard("text_width", || Ok(width(words, size, bold)))
}

fn read_poses(py: Python<'_>, given: &Poses<'_>) -> PyResult<Vec<Vec<Pose>>> {
    let poses = given.as_array();
    let (times, bodies, numbers) = poses.dim();
    if times == 0 || numbers != 3 {
        let message = format!("shape ({times}, {bodies}, {numbers}); must be (n_t > 0, n, 3)");
        return Err(refuse(py, "poses", message));
    }
    let one = |t: usize| (0..bodies).map(|k| [0, 1, 2].map(|c| poses[[t, k, c]])).collect();
    Ok((0..times).map(one).collect())
}
