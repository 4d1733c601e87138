//! Cams: a cam as Python describes it in, lists of numbers out.

use crate::errors::{Failure, Kind, Problem};
use crate::guard::guard;
use kempe::math::Complex;
use kempe_synthesis::cam::{
    Cam, Closure, Drive, End, Follower, Law, Piece, Programme, Segment, Touch, Way, LAWS,
};
use kempe_synthesis::Refused;
use numpy::{Complex64, IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The named laws of a segment.
#[pyfunction]
pub fn cam_laws() -> PyResult<Vec<&'static str>> {
    guard("cam_laws", || Ok(LAWS.to_vec()))
}

/// A piece of a programme.
#[derive(FromPyObject)]
struct GivenPiece {
    start: f64,
    end: f64,
    powers: Vec<f64>,
    amplitude: f64,
    frequency: f64,
    phase: f64,
}

/// A programme.
#[derive(FromPyObject)]
struct GivenProgramme {
    pieces: Vec<GivenPiece>,
    unit: String,
    size: f64,
    least: f64,
    jumps: Vec<(f64, f64)>,
}

impl From<GivenProgramme> for Programme {
    fn from(given: GivenProgramme) -> Self {
        let piece = |of: GivenPiece| Piece {
            start: of.start,
            end: of.end,
            powers: of.powers,
            wave: [of.amplitude, of.frequency, of.phase],
        };
        let GivenProgramme { pieces, unit, size, least, jumps } = given;
        let pieces = pieces.into_iter().map(piece).collect();
        Self { pieces, angular: unit == "rad", size, least, jumps }
    }
}

/// A complex number.
#[derive(FromPyObject)]
struct GivenPlace {
    real: f64,
    imag: f64,
}

/// A follower.
#[derive(FromPyObject)]
struct GivenFollower {
    kind: String,
    base: f64,
    roller: f64,
    offset: f64,
    arm: Option<f64>,
    pivot: GivenPlace,
    face: f64,
}

/// What moves and presses a follower.
#[derive(FromPyObject)]
struct GivenDrive {
    speed: f64,
    mass: f64,
    spring: [f64; 2],
    gravity: f64,
}

/// A cam.
#[derive(FromPyObject)]
struct GivenCam {
    programme: GivenProgramme,
    follower: GivenFollower,
    clockwise: bool,
    closure: String,
    drive: GivenDrive,
}

/// A cam that Python describes.
fn read(cam: &Bound<'_, PyAny>) -> PyResult<Cam> {
    let GivenCam { programme, follower: of, clockwise, closure, drive } = cam.extract()?;
    let GivenDrive { speed, mass, spring, gravity } = drive;
    let unknown = |name: &str| PyValueError::new_err(format!("there is no '{name}'"));
    let follower = Follower {
        kind: End::named(&of.kind).ok_or_else(|| unknown(&of.kind))?,
        base: of.base,
        roller: of.roller,
        offset: of.offset,
        arm: of.arm,
        pivot: Complex::new(of.pivot.real, of.pivot.imag),
        face: of.face,
        opposite: false,
    };
    Ok(Cam {
        programme: programme.into(),
        follower,
        clockwise,
        closure: Closure::named(&closure).ok_or_else(|| unknown(&closure))?,
        drive: Drive { speed, mass, spring, gravity },
    })
}

/// A result, or the `ModelError` of a cam without one.
fn found<T>(of: Result<T, Refused>) -> PyResult<T> {
    of.map_err(refused)
}

/// The `ModelError` with the path of the argument at fault.
#[cold]
fn refused(Refused { message, hint }: Refused) -> PyErr {
    Python::attach(|py| {
        let Some((path, told)) = message.split_once(": ") else {
            return Failure::new(Kind::Model, message).hint(hint).raise(py);
        };
        let more = if hint.is_empty() { "" } else { "; " };
        let (path, told) = (path.to_string(), [told, more, &hint].concat());
        let message = [&path, ": ", &told].concat();
        let problem = Problem { message: told, path, position: None };
        Failure::new(Kind::Model, message).problems(vec![problem]).raise(py)
    })
}

/// Pairs of numbers: jumps, or intervals.
type Pairs = Vec<(f64, f64)>;
/// Start, end, powers, amplitude, frequency and phase of a piece.
type PieceParts = (f64, f64, Vec<f64>, f64, f64, f64);
/// What it does, its angle, the change of its lift, a name, derivatives at both ends, and points.
type GivenSegment =
    (String, f64, Option<f64>, Option<String>, [Vec<f64>; 2], Option<Vec<[f64; 2]>>);

/// Pieces of a programme, its largest and smallest lift, and the jumps of its acceleration.
#[pyfunction]
#[pyo3(signature = (segments, angular))]
pub fn cam_programme(
    segments: Vec<GivenSegment>,
    angular: bool,
) -> PyResult<(Vec<PieceParts>, f64, f64, Pairs)> {
    guard("cam_programme", || {
        let segment = |(way, angle, lift, name, ends, points): GivenSegment| -> Segment {
            let way = match way.as_str() {
                "rise" => Way::Rise,
                "return" => Way::Return,
                _ => Way::Dwell,
            };
            let law = match (name, points) {
                (Some(name), _) => Law::Named(name),
                (None, Some(points)) => Law::Spline(ends, points),
                (None, None) => Law::Polynomial(ends),
            };
            (way, angle, lift, law)
        };
        let segments: Vec<Segment> = segments.into_iter().map(segment).collect();
        let Programme { pieces, size, least, jumps, .. } =
            found(Programme::new(&segments, angular))?;
        let parts = |Piece { start, end, powers, wave: [amplitude, frequency, phase] }| {
            (start, end, powers, amplitude, frequency, phase)
        };
        Ok((pieces.into_iter().map(parts).collect(), size, least, jumps))
    })
}

/// The lift, or its derivative of an order, at angles.
#[pyfunction]
#[pyo3(signature = (programme, angles, order))]
pub fn cam_lift<'py>(
    programme: &Bound<'_, PyAny>,
    angles: PyReadonlyArray1<'py, f64>,
    order: usize,
) -> PyResult<Numbers<'py>> {
    guard("cam_lift", || {
        let of = Programme::from(programme.extract::<GivenProgramme>()?);
        let lifts: Vec<f64> = angles.as_array().iter().map(|angle| of.at(*angle, order)).collect();
        Ok(lifts.into_pyarray(angles.py()))
    })
}

/// Angles of all pieces, and lift and three derivatives at each of them.
#[pyfunction]
#[pyo3(signature = (programme, step))]
pub fn cam_sampled<'py>(
    programme: &Bound<'py, PyAny>,
    step: f64,
) -> PyResult<(Numbers<'py>, Numbers<'py>)> {
    guard("cam_sampled", || {
        let py = programme.py();
        let of = Programme::from(programme.extract::<GivenProgramme>()?);
        let (angles, rows): (Vec<f64>, Vec<[f64; 4]>) =
            of.sampled(step).into_iter().map(|(_, angle, rows)| (angle, rows)).unzip();
        Ok((angles.into_pyarray(py), rows.into_flattened().into_pyarray(py)))
    })
}

/// Refuse dimensions that are none, or do not assemble.
#[pyfunction]
#[pyo3(signature = (cam))]
pub fn cam_check(cam: &Bound<'_, PyAny>) -> PyResult<()> {
    guard("cam_check", || found(read(cam)?.check()))
}

/// Angles of the cam, dense where derivatives jump.
#[pyfunction]
#[pyo3(signature = (cam))]
pub fn cam_angles<'py>(cam: &Bound<'py, PyAny>) -> PyResult<Numbers<'py>> {
    guard("cam_angles", || Ok(read(cam)?.angles().into_pyarray(cam.py())))
}

/// A place at each angle.
type Places<'py> = Bound<'py, PyArray1<Complex64>>;
/// A number at each angle.
type Numbers<'py> = Bound<'py, PyArray1<f64>>;
/// Pitch, normal and profile; bend, room, radius, pressure angle and contact.
type Shape<'py> = ([Places<'py>; 3], [Numbers<'py>; 5]);

/// The cam, or its conjugate, at angles.
#[pyfunction]
#[pyo3(signature = (cam, angles, second))]
pub fn cam_shape<'py>(
    cam: &Bound<'_, PyAny>,
    angles: PyReadonlyArray1<'py, f64>,
    second: bool,
) -> PyResult<Shape<'py>> {
    guard("cam_shape", || {
        let py = angles.py();
        let all = found(read(cam)?.over(&angles.as_array().to_vec(), second))?;
        let curves: [fn(&Touch) -> Complex; 3] = [|of| of.pitch, |of| of.normal, |of| of.profile];
        let rows: [fn(&Touch) -> f64; 5] =
            [|of| of.bend, |of| of.room, |of| of.radius, |of| of.pressure, |of| of.contact];
        let row = |of: fn(&Touch) -> f64| all.iter().map(of).collect::<Vec<_>>().into_pyarray(py);
        let curve = |of| places(py, all.iter().map(of));
        Ok((curves.map(curve), rows.map(row)))
    })
}

fn places(py: Python<'_>, of: impl Iterator<Item = Complex>) -> Places<'_> {
    let found: Vec<Complex64> = of.map(|z| Complex64::new(z.re, z.im)).collect();
    found.into_pyarray(py)
}

/// Largest pressure angle, least radius of curvature, speed of lift-off and intervals of undercut.
#[pyfunction]
#[pyo3(signature = (cam))]
pub fn cam_limits(cam: &Bound<'_, PyAny>) -> PyResult<(f64, f64, f64, Pairs)> {
    guard("cam_limits", || {
        let of = read(cam)?;
        let (steep, _) = found(of.largest_pressure_angle())?;
        let (sharp, _) = found(of.least_radius_of_curvature())?;
        Ok((steep, sharp, of.lift_off_speed(), found(of.undercut())?))
    })
}

/// The least base radius within a pressure angle and a radius of curvature, or None.
#[pyfunction]
#[pyo3(signature = (cam, steep, sharp))]
pub fn cam_least_base(
    cam: &Bound<'_, PyAny>,
    steep: Option<f64>,
    sharp: f64,
) -> PyResult<Option<f64>> {
    guard("cam_least_base", || Ok(read(cam)?.least_base(steep, sharp)))
}

/// What is wrong or doubtful.
#[pyfunction]
#[pyo3(signature = (cam))]
pub fn cam_remarks(cam: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    guard("cam_remarks", || found(read(cam)?.remarks()))
}

/// The case, as TOML.
#[pyfunction]
#[pyo3(signature = (cam))]
pub fn cam_case(cam: &Bound<'_, PyAny>) -> PyResult<String> {
    guard("cam_case", || found(read(cam)?.case()))
}

/// The profiles at angles by name, and with a cutter the paths of its centre.
#[pyfunction]
#[pyo3(signature = (cam, angles, cutter))]
pub fn cam_walls<'py>(
    cam: &Bound<'_, PyAny>,
    angles: PyReadonlyArray1<'py, f64>,
    cutter: Option<f64>,
) -> PyResult<Vec<(&'static str, Places<'py>)>> {
    guard("cam_walls", || {
        let (py, angles, of) = (angles.py(), angles.as_array().to_vec(), read(cam)?);
        let mut walls = found(of.walls(&angles))?;
        if let Some(radius) = cutter {
            walls.extend(found(of.cutter(&angles, radius))?);
        }
        let wall = |(name, curve): (_, Vec<Complex>)| (name, places(py, curve.into_iter()));
        Ok(walls.into_iter().map(wall).collect())
    })
}
