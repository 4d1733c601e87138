//! Synthesis of linkages: lists of numbers in, lists of numbers out.

use crate::attended::GLANCE;
use crate::errors::{Failure, Kind};
use crate::guard::guard;
use kempe::math::Complex;
use kempe_synthesis::{
    conditions, least_squares, ranked, with_end, Choices, Dyad, End, Fitted, Grashof, Judged,
    Limits, Linkage, NinePoints, Output, Pairs, PathSearch, Poses, Ranked, Refused, Traced, Wanted,
    TYPES,
};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::time::Instant;

/// Linkage, positions and sum of squares.
type Found = (Vec<f64>, Vec<[f64; 2]>, f64);

/// The conditions of poses on dyads: one for each pose after the first.
#[pyfunction]
#[pyo3(signature = (places, angles))]
pub fn dyad_conditions(places: Vec<[f64; 2]>, angles: Vec<f64>) -> PyResult<Vec<Dyad>> {
    guard("dyad_conditions", || {
        if places.is_empty() || places.len() != angles.len() {
            return Err(PyValueError::new_err("places and angles of at least one pose"));
        }
        Ok(conditions(&complexes(&places), &angles))
    })
}

/// All dyads with linear conditions, or samples of them, and whether these are all.
#[pyfunction]
#[pyo3(signature = (rows, poses, pivot, samples, seed, ends, what))]
pub fn all_dyads(
    rows: Vec<Dyad>,
    poses: usize,
    pivot: Option<[f64; 2]>,
    samples: usize,
    seed: u64,
    ends: Vec<String>,
    what: String,
) -> PyResult<(Vec<Dyad>, bool)> {
    guard("all_dyads", || {
        let ends = ends.iter().map(|end| end_of(end)).collect();
        let pivot = pivot.map(complex);
        let choices = Choices { samples, seed, ends, pivot, what };
        found(kempe_synthesis::all_dyads(&rows, poses.min(rows.len()), &choices))
    })
}

/// The dyads with given ends; the shortest one for each end that has any.
#[pyfunction]
#[pyo3(signature = (rows, end, at))]
pub fn dyads_with_end(rows: Vec<Dyad>, end: String, at: Vec<[f64; 2]>) -> PyResult<Vec<Dyad>> {
    guard("dyads_with_end", || {
        let one = |at: &[f64; 2]| with_end(&rows, end_of(&end), complex(*at), None);
        Ok(at.iter().filter_map(one).collect())
    })
}

/// Pairs of places in two lists; in one list without a second.
#[pyfunction]
#[pyo3(signature = (first, second, seed))]
pub fn pairs_of_dyads(
    first: usize,
    second: Option<usize>,
    seed: u64,
) -> PyResult<Vec<(usize, usize)>> {
    guard("pairs_of_dyads", || Ok(kempe_synthesis::pairs(first, second, seed)))
}

/// Four-bars through two to five poses: (o, a, b, d) of each as pairs of numbers, the errors, and whether these are all.
#[pyfunction]
#[pyo3(signature = (places, angles, pivots, samples, seed))]
pub fn four_bars(
    py: Python<'_>,
    places: Vec<[f64; 2]>,
    angles: Vec<f64>,
    pivots: [Option<[f64; 2]>; 2],
    samples: usize,
    seed: u64,
) -> PyResult<(Py<PyArray1<f64>>, Vec<f64>, bool)> {
    guard("four_bars", || {
        if !(2..=5).contains(&places.len()) || places.len() != angles.len() {
            return Err(PyValueError::new_err("places and angles of two to five poses"));
        }
        let (places, pivots) = (complexes(&places), pivots.map(|at| at.map(complex)));
        let task = Poses { places, angles, pivots, samples, seed };
        let (linkages, complete) = found(kempe_synthesis::four_bars(&task))?;
        let places = linkages.iter().flat_map(|(one, _)| numbers(one));
        let flat: Vec<f64> = places.flat_map(|z| [z.re, z.im]).collect();
        let errors = linkages.iter().map(|(_, error)| *error).collect();
        Ok((flat.into_pyarray(py).unbind(), errors, complete))
    })
}

/// A candidate: its number, whether its rocker is the crank, whether its crank turns fully, Grashof's condition, the
/// least transmission angles over a turn and at the positions, what is wrong, and the angles of the crank.
type Candidate = (usize, bool, bool, bool, f64, f64, Vec<String>, Vec<f64>);

/// Candidates, best first, and numbers of linkages by defect or limit.
type RankedCandidates = (Vec<Candidate>, Vec<(String, usize)>);

/// Candidates, best first, and the numbers of linkages that each defect or limit excludes.
///
/// `linkages` has (o, a, b, end) of each as pairs of numbers; the end is the ground pivot of the rocker, or the
/// direction of the slide.
#[pyfunction]
#[pyo3(signature = (linkages, errors, slides, limits, either, complete))]
pub fn ranked_linkages(
    linkages: PyReadonlyArray2<'_, f64>,
    errors: Vec<f64>,
    slides: bool,
    limits: GivenLimits,
    either: bool,
    complete: bool,
) -> PyResult<RankedCandidates> {
    guard("ranked_linkages", || {
        let (tell, transmission_angle, grashof, within, way) = limits;
        let grashof = match grashof.as_deref() {
            None => Grashof::Any,
            Some(kind) => {
                TYPES.iter().position(|one| *one == kind).map_or(Grashof::Holds, Grashof::Is)
            }
        };
        let limits = Limits { tell, transmission_angle, grashof, within, way };
        let rows = linkages.as_array();
        let width = rows.ncols() / 2;
        if rows.nrows() != errors.len() || width < 4 || width % 2 != 0 {
            return Err(PyValueError::new_err("o, a, b, end and an error of each linkage"));
        }
        let of = |row: usize| linkage(&rows.row(row).to_vec(), slides);
        let all: Vec<_> = errors.iter().enumerate().map(|(k, error)| (of(k), *error)).collect();
        let (kept, excluded) = ranked(&all, &limits, either, complete);
        Ok((kept.into_iter().map(candidate).collect(), excluded))
    })
}

/// Whether candidates with defects are kept, the least transmission angle, what Grashof's condition must be, the limits
/// of the pivots, and the direction of the crank.
type GivenLimits = (bool, Option<f64>, Option<String>, Option<[[f64; 2]; 2]>, i32);

fn candidate(of: Ranked) -> Candidate {
    let Ranked { index, reversed, judged, defects, crank_angles } = of;
    let Judged { turns, grashof, least, here, .. } = judged;
    (index, reversed, turns, grashof, least, here, defects, crank_angles)
}

fn end_of(name: &str) -> End {
    if name == "pin" {
        End::Pin
    } else {
        End::Pivot
    }
}

fn complex([re, im]: [f64; 2]) -> Complex {
    Complex::new(re, im)
}

fn complexes(all: &[[f64; 2]]) -> Vec<Complex> {
    all.iter().copied().map(complex).collect()
}

/// A result, or the `ModelError` of a task without one.
fn found<T>(of: Result<T, Refused>) -> PyResult<T> {
    of.map_err(|Refused { message, hint }| {
        Python::attach(|py| Failure::new(Kind::Model, message).hint(hint).raise(py))
    })
}

/// Four-bars as (o, a, b, d) and the coupler point at all positions as pairs of numbers, the angles of the moving frame
/// at the first position, and the errors.
type Traces = (Py<PyArray1<f64>>, Vec<f64>, Vec<f64>);

/// Advances a search until `step` returns no more numbers of starts, tried and in all, or until a signal such as that of
/// Ctrl-C raises an exception. It is returned, because the caller keeps the linkages found so far.
fn searched(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    mut step: impl FnMut() -> PyResult<Option<(usize, usize)>>,
) -> PyResult<Option<Py<PyAny>>> {
    let mut told = Instant::now();
    while let Some(tried) = step()? {
        if told.elapsed() < GLANCE {
            continue;
        }
        told = Instant::now();
        let outcome = py.check_signals().and_then(|()| {
            progress.as_ref().map_or(Ok(()), |call| call.call1(py, tried).map(|_| ()))
        });
        if let Err(error) = outcome {
            return Ok(Some(error.into_value(py).into_any()));
        }
    }
    Ok(None)
}

/// Four-bars whose coupler point passes points, whether these are all, and the exception that ended the search.
///
/// `cranks` are angles of the crank or none, `offset` says whether their origin is free.
#[pyfunction]
#[pyo3(signature = (places, cranks, offset, pivots, starts, seed, progress))]
#[allow(clippy::too_many_arguments)] // those of Python
pub fn path_four_bars(
    py: Python<'_>,
    places: Vec<[f64; 2]>,
    cranks: Vec<f64>,
    offset: bool,
    pivots: [Option<[f64; 2]>; 2],
    starts: Option<usize>,
    seed: u64,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Traces, bool, Option<Py<PyAny>>)> {
    guard("path_four_bars", || {
        if !cranks.is_empty() && cranks.len() != places.len() {
            return Err(PyValueError::new_err("a crank angle for each of the places, or none"));
        }
        let (places, pivots) = (complexes(&places), pivots.map(|at| at.map(complex)));
        let wanted = Wanted { places, cranks, offset, pivots, ..Wanted::default() };
        let mut search = found(PathSearch::new(wanted, starts, seed))?;
        let stopped = searched(py, progress, || {
            if search.ended() {
                return Ok(None);
            }
            found(search.advance(1))?;
            Ok(Some((search.tried(), search.most())))
        })?;
        let (all, whole) = (search.found(), stopped.is_none());
        found(if whole && all.is_empty() { Err(search.none()) } else { Ok(()) })?;
        Ok((traces(py, &all), whole && search.complete(), stopped))
    })
}

/// All four-bars whose coupler point passes nine points, from a stored start, and the exception that ended the search. The
/// numbers are those of the four-bars that start, of different ends, of those that were followed again, and of real ends.
#[pyfunction]
#[pyo3(signature = (places, stored, progress))]
pub fn nine_point_four_bars(
    py: Python<'_>,
    places: Vec<[f64; 2]>,
    stored: &[u8],
    progress: Option<Py<PyAny>>,
) -> PyResult<(Traces, [usize; 4], Option<Py<PyAny>>)> {
    guard("nine_point_four_bars", || {
        let search = NinePoints::new(&complexes(&places), stored);
        let wrong = "nine places, and a start that examples/nine_points.rs makes";
        let mut search = search.ok_or_else(|| PyValueError::new_err(wrong))?;
        let stopped = searched(py, progress, || {
            search.advance(1);
            Ok((!search.ended()).then(|| search.tried()))
        })?;
        let (all, count) = search.found();
        Ok((traces(py, &all), [count.paths, count.found, count.again, count.real], stopped))
    })
}

/// The four-bars near given ones whose coupler fits poses best. `linkages` has (o, a, b, d) of each.
#[pyfunction]
#[pyo3(signature = (places, angles, pivots, linkages))]
pub fn near_poses(
    py: Python<'_>,
    places: Vec<[f64; 2]>,
    angles: Vec<f64>,
    pivots: [Option<[f64; 2]>; 2],
    linkages: PyReadonlyArray2<'_, f64>,
) -> PyResult<Traces> {
    guard("near_poses", || {
        let rows = linkages.as_array();
        let width = rows.ncols() / 2;
        if places.is_empty() || places.len() != angles.len() || width != 2 * places.len() + 2 {
            return Err(PyValueError::new_err(
                "an angle of each place; o, a, b and d of a linkage",
            ));
        }
        let (points, pivots) = (complexes(&places), pivots.map(|at| at.map(complex)));
        let frame = angles[0];
        let wanted = Wanted { places: points.clone(), frames: angles, pivots, ..Wanted::default() };
        let starts: Vec<Traced> = (0..rows.nrows())
            .map(|row| Traced {
                linkage: linkage(&rows.row(row).to_vec(), false),
                points: points.clone(),
                frame,
                error: 0.0,
            })
            .collect();
        Ok(traces(py, &wanted.best(&starts)))
    })
}

/// A linkage of (o, a, b, end) as pairs of numbers.
fn linkage(row: &[f64], slides: bool) -> Linkage {
    let at: Vec<Complex> = row.chunks_exact(2).map(|z| Complex::new(z[0], z[1])).collect();
    let (middle, last) = (at.len() / 2, at.len() - 1);
    let output = if slides { Output::Slide(at[last]) } else { Output::Rocker(at[last]) };
    Linkage { o: at[0], a: at[1..middle].to_vec(), b: at[middle..last].to_vec(), output }
}

fn numbers(of: &Linkage) -> impl Iterator<Item = Complex> + '_ {
    let (Output::Rocker(end) | Output::Slide(end)) = of.output;
    let pins = of.a.iter().chain(&of.b).copied();
    [of.o].into_iter().chain(pins).chain([end])
}

fn traces(py: Python<'_>, all: &[Traced]) -> Traces {
    let places = all.iter().flat_map(|one| numbers(&one.linkage).chain(one.points.iter().copied()));
    let flat: Vec<f64> = places.flat_map(|z| [z.re, z.im]).collect();
    let frames = all.iter().map(|one| one.frame).collect();
    (flat.into_pyarray(py).unbind(), frames, all.iter().map(|one| one.error).collect())
}

/// A four-bar near a start whose rocker fits pairs of angles.
#[pyfunction]
#[pyo3(signature = (targets, closing, linkage, positions, free, steps))]
pub fn fit_pairs(
    targets: Vec<[f64; 2]>,
    closing: f64,
    linkage: Vec<f64>,
    positions: Vec<[f64; 2]>,
    free: Vec<bool>,
    steps: usize,
) -> PyResult<Found> {
    guard("fit_pairs", || {
        let problem = Pairs { targets, closing };
        let start = Fitted { linkage, positions, sum: f64::INFINITY };
        let found = least_squares(&problem, start, &free, steps);
        Ok((found.linkage, found.positions, found.sum))
    })
}
