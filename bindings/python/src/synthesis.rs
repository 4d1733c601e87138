//! Synthesis of linkages: lists of numbers in, lists of numbers out.

use crate::guard::guard;
use kempe_synthesis::{least_squares, Coupler, Fitted, Pairs, Problem};
use pyo3::prelude::*;

/// Linkage, positions and sum of squares.
type Found = (Vec<f64>, Vec<[f64; 2]>, f64);

/// All dyads with four linear conditions; None if these are dependent.
#[pyfunction]
#[pyo3(signature = (conditions))]
pub fn dyads(conditions: Vec<[f64; 7]>) -> PyResult<Option<Vec<[f64; 7]>>> {
    guard("dyads", || Ok(conditions.first_chunk::<4>().and_then(kempe_synthesis::dyads)))
}

/// A four-bar near a start whose coupler fits points, poses or crank angles.
#[pyfunction]
#[pyo3(signature = (targets, weights, linkage, positions, free, steps))]
pub fn fit_coupler(
    targets: Vec<[f64; 4]>,
    weights: [f64; 2],
    linkage: Vec<f64>,
    positions: Vec<[f64; 2]>,
    free: Vec<bool>,
    steps: usize,
) -> PyResult<Found> {
    guard("fit_coupler", || {
        let problem = Coupler { targets, weights };
        Ok(fitted(&problem, linkage, positions, &free, steps))
    })
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
        Ok(fitted(&problem, linkage, positions, &free, steps))
    })
}

fn fitted<P: Problem>(
    problem: &P,
    linkage: Vec<f64>,
    positions: Vec<[f64; 2]>,
    free: &[bool],
    steps: usize,
) -> Found {
    let start = Fitted { linkage, positions, sum: f64::INFINITY };
    let found = least_squares(problem, start, free, steps);
    (found.linkage, found.positions, found.sum)
}
