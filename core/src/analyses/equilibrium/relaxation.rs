//! Dynamic relaxation with kinetic damping (Barnes, *Form Finding and Analysis of Tension Structures by Dynamic
//! Relaxation*, 1999): fictitious masses are accelerated by the unbalanced forces and stopped whenever their kinetic
//! energy has passed a peak. The steps do not use the stiffness, so that the method also works for forces with kinks
//! and jumps.

use super::failure::Reason;
use super::statics::{StaticState, Statics};
use crate::integrate::Flow;
use crate::math::Listed;

/// Largest number of steps.
const STEPS: usize = 4000;
/// Longest step of a scaled coordinate.
const LONGEST: f64 = 0.05;
/// Residual force, relative to the largest single force, below which Newton's method takes over.
const ENOUGH: f64 = 1e-5;
/// Smallest number of steps, because relaxation begins where Newton's method has just failed.
const LEAST: usize = 60;

/// Moves a position towards rest. Returns the new position and the number of steps.
pub(super) fn relax(
    statics: &mut Statics<'_>,
    mut place: StaticState,
    watch: &mut dyn FnMut(usize) -> Flow,
) -> Result<(StaticState, usize), Reason> {
    let mut mass = mass(statics, &place);
    let mut v = vec![0.0; place.q.len()];
    let mut last = 0.0;
    for step in 0..STEPS {
        if watch(step) == Flow::Stop {
            return Err(Reason::Stopped);
        }
        let force = scaled(statics, &place.missing).iter().map(|x| x * x).sum::<f64>().sqrt();
        if step >= LEAST && force <= ENOUGH * place.scale {
            return Ok((place, step));
        }
        for ((v, missing), scale) in v.iter_mut().zip(&place.missing).zip(&statics.columns) {
            *v -= scale * scale * missing / mass;
        }
        let size = statics.largest(&v);
        if size > LONGEST {
            v.iter_mut().for_each(|v| *v *= LONGEST / size);
        }
        let kinetic: f64 =
            v.iter().zip(&statics.columns).map(|(v, scale)| (v / scale) * (v / scale)).sum();
        if kinetic < last {
            (last, v) = (0.0, vec![0.0; v.len()]);
            continue;
        }
        last = kinetic;
        let q: Vec<f64> = place.q.iter().zip(&v).map(|(q, v)| q + v).list();
        match statics.place(&q, &place.z) {
            Ok(next) if statics.energy_change(&place, &next) <= 0.0 => place = next,
            // the step was too long: it is repeated from rest with twice the mass
            _ => (mass, last, v) = (2.0 * mass, 0.0, vec![0.0; v.len()]),
        }
        if mass > 1e30 * place.scale.max(1e-300) {
            return Ok((place, step));
        }
    }
    Ok((place, STEPS))
}

/// The fictitious mass for which a time step of unit length is stable, J.
fn mass(statics: &Statics<'_>, place: &StaticState) -> f64 {
    let stiffness = statics.local(place).map(|local| local.stiffness).unwrap_or_default();
    let largest = stiffness.iter().fold(place.scale, |most, x| most.max(x.abs()));
    largest.max(f64::MIN_POSITIVE)
}

/// The forces multiplied by the scales of their coordinates, J.
fn scaled(statics: &Statics<'_>, force: &[f64]) -> Vec<f64> {
    force.iter().zip(&statics.columns).map(|(f, scale)| f * scale).list()
}
