//! The search for an equilibrium position.
//!
//! Newton's method in the degrees of freedom, with the exact stiffness. Where the stiffness is not positive definite,
//! the step uses the magnitudes of its eigenvalues (Gill, Murray and Wright, *Practical Optimization*, 1981, 4.4), so
//! that it descends the potential and leaves maxima and saddle points. Steps are bounded, and shortened until the
//! energy falls. If this fails, for example because a force has a kink, dynamic relaxation continues.

use super::failure::Reason;
use super::relaxation;
use super::statics::{LocalForces, StaticState, Statics};
use crate::integrate::Flow;
use crate::math::Listed;
use crate::solve::{is_positive, solve_dense, Eigen};

/// Residual force that counts as zero, relative to the largest single force.
const NONE: f64 = 1e-14;
/// Residual force below which Newton steps only reduce rounding errors.
const SMALL: f64 = 1e-9;
/// Largest scaled step of Newton's method that may be left at rest.
const REST: f64 = 1e-6;
/// Force along an eigenvector of the stiffness that counts as rounding error, relative to the largest single force.
const NOISE: f64 = 1e-13;
/// Scaled displacement whose force counts as a single force, so that [`SMALL`] is above the rounding errors of the
/// coordinates.
const DISPLACEMENT: f64 = 1e-5;
/// Longest and first step of a scaled coordinate.
const LONGEST: f64 = 0.5;
const FIRST: f64 = 0.2;
/// Shortest step.
const SHORTEST: f64 = 1e-12;
/// Largest number of steps in a round, and of rounds. Relaxation takes place between rounds.
const STEPS: usize = 500;
const ROUNDS: usize = 4;
/// Fraction of the predicted change of energy that a step must achieve.
const ENOUGH: f64 = 1e-4;
/// An eigenvalue of the stiffness below this part of the largest counts as zero.
pub(super) const ZERO: f64 = 1e-11;
/// Scaled displacement from an unstable position, and the largest number of such displacements.
const PUSH: f64 = 1e-2;
const PUSHES: usize = 12;
/// Scaled motion beyond which no equilibrium counts as within reach.
const FAR: f64 = 40.0;

/// An equilibrium position.
pub(super) struct RestPosition {
    pub place: StaticState,
    /// Number of steps of Newton's method.
    pub steps: usize,
    /// Number of steps of dynamic relaxation.
    pub relaxed: usize,
}

/// The search from one start.
pub(super) struct RestSearch<'s, 'a> {
    pub statics: &'s mut Statics<'a>,
    /// Whether the nearest equilibrium is sought, stable or not.
    pub nearest: bool,
    pub watch: &'s mut dyn FnMut(usize) -> Flow,
    steps: usize,
    relaxed: usize,
}

impl<'s, 'a> RestSearch<'s, 'a> {
    pub fn new(
        statics: &'s mut Statics<'a>,
        nearest: bool,
        watch: &'s mut dyn FnMut(usize) -> Flow,
    ) -> Self {
        Self { statics, nearest, watch, steps: 0, relaxed: 0 }
    }

    /// The equilibrium position that is reached from `start`.
    pub fn run(mut self, start: StaticState) -> Result<RestPosition, Reason> {
        let first = start.clone();
        let mut place = start;
        for round in 0..ROUNDS {
            let (reached, rests) = self.descend(place)?;
            place = reached;
            if rests {
                return Ok(RestPosition { place, steps: self.steps, relaxed: self.relaxed });
            }
            if self.nearest || round + 1 == ROUNDS || self.far(&first, &place) {
                break;
            }
            let (reached, count) = relaxation::relax(self.statics, place, self.watch)?;
            place = reached;
            self.relaxed += count;
        }
        if let Some(name) = self.statics.near_singular(&place) {
            let message = format!(
                "the search ends at a singular position, near which {name} depends on other joints: the mechanism has \
                 other freedoms there, so that no stiffness decides where it rests"
            );
            return Err(Reason::Singular { name, message });
        }
        let own = self.statics.freedoms(&place)?;
        let moved: Vec<f64> = place.q.iter().zip(&first.q).map(|(b, a)| b - a).list();
        let left = (place.missing.as_slice(), place.scale);
        let way = (moved.as_slice(), self.far(&first, &place));
        Err(Reason::of_search(self.statics.model, way, left, &own))
    }

    fn far(&self, first: &StaticState, place: &StaticState) -> bool {
        let way: Vec<f64> = place.q.iter().zip(&first.q).map(|(b, a)| b - a).list();
        self.statics.largest(&way) > FAR
    }

    /// Descends until the forces vanish. Returns the last position, and whether the forces vanish there.
    fn descend(&mut self, mut place: StaticState) -> Result<(StaticState, bool), Reason> {
        let (mut radius, mut pushes, begin) = (FIRST, 0, self.steps);
        let mut local = self.statics.local(&place)?;
        let mut at_start = self.steps == 0 && self.relaxed == 0;
        while self.steps < begin + STEPS {
            if (self.watch)(self.steps) == Flow::Stop {
                return Err(Reason::Stopped);
            }
            let size = relative(&local, &place);
            if size <= SMALL {
                (place, local) = self.polished(place, local)?;
            }
            // a light body may be far from rest while its forces are small beside those of others
            if size <= SMALL && self.left(&place, &local) <= REST {
                let down = down(&local, &place).filter(|_| !self.nearest && !at_start);
                let Some(direction) = down.filter(|_| pushes < PUSHES) else {
                    return Ok((place, true));
                };
                pushes += 1;
                match self.pushed(&place, &local, &direction)? {
                    Some(next) => (place, local, radius) = (next.0, next.1, FIRST),
                    None => return Ok((place, true)),
                }
                continue;
            }
            at_start = false;
            self.steps += 1;
            match self.step(&place, &local, &mut radius)? {
                Some(next) => (place, local) = next,
                None => return Ok((place, false)),
            }
        }
        Ok((place, false))
    }

    /// A step that lowers the energy. None if no such step is found.
    fn step(
        &mut self,
        place: &StaticState,
        local: &LocalForces,
        radius: &mut f64,
    ) -> Result<Option<(StaticState, LocalForces)>, Reason> {
        let newton = solved(&local.stiffness, &local.gradient);
        let full = match &newton {
            Some(p) if self.nearest || self.good(local, p) => p.clone(),
            _ => modified(local, place.scale),
        };
        let length = self.statics.largest(&local.basis.extend(&full));
        let mut part = (*radius / length).min(1.0);
        while part * length > SHORTEST {
            let p: Vec<f64> = full.iter().map(|x| part * x).list();
            if let Some(next) = self.tried(place, local, &p)? {
                let bounded = part < 1.0;
                *radius =
                    if bounded { (2.0 * part * length).min(LONGEST) } else { radius.max(FIRST) };
                return Ok(Some(next));
            }
            part *= 0.3;
            *radius = (part * length).max(SHORTEST);
        }
        Ok(None)
    }

    /// Whether the Newton step `p` descends towards a minimum.
    fn good(&self, local: &LocalForces, p: &[f64]) -> bool {
        let f = p.len();
        let transposed = |k: usize| local.stiffness[(k % f) * f + k / f];
        let symmetric: Vec<f64> =
            (0..f * f).map(|k| 0.5 * (local.stiffness[k] + transposed(k))).list();
        dot(&local.gradient, p) < 0.0 && is_positive(&symmetric, f)
    }

    /// The position after a step. None if the energy does not fall enough, or, in a search for the nearest
    /// equilibrium, if the residual force does not decrease.
    fn tried(
        &mut self,
        place: &StaticState,
        local: &LocalForces,
        p: &[f64],
    ) -> Result<Option<(StaticState, LocalForces)>, Reason> {
        let dq = local.basis.extend(p);
        let Some(next) = self.moved(place, &dq) else { return Ok(None) };
        let Ok(there) = self.statics.local(&next) else { return Ok(None) };
        let (before, after) = (relative(local, place), relative(&there, &next));
        let better = match self.nearest {
            true => after < before,
            false => {
                let predicted = dot(&local.gradient, p);
                let change = self.statics.energy_change(place, &next);
                let rounding = predicted.abs() < 1e-13 * place.scale;
                change <= ENOUGH * predicted || (rounding && after < before)
            }
        };
        Ok(better.then_some((next, there)))
    }

    /// The closed position near q + dq. None if closing moves it too far.
    fn moved(&mut self, place: &StaticState, dq: &[f64]) -> Option<StaticState> {
        let q: Vec<f64> = place.q.iter().zip(dq).map(|(q, dq)| q + dq).list();
        let next = self.statics.place(&q, &place.z).ok()?;
        let closing: Vec<f64> = next.q.iter().zip(&q).map(|(b, a)| b - a).list();
        let near = self.statics.largest(&closing) <= 0.5 * self.statics.largest(dq) + 1e-9;
        near.then_some(next)
    }

    /// The equilibrium after Newton steps that reduce the forces to rounding errors.
    fn polished(
        &mut self,
        mut place: StaticState,
        mut local: LocalForces,
    ) -> Result<(StaticState, LocalForces), Reason> {
        for _ in 0..8 {
            let before = relative(&local, &place);
            let dq = local.basis.extend(&self.newton(&place, &local));
            let step = self.statics.largest(&dq);
            if step > FIRST || before <= NONE && step < 1e-15 {
                break;
            }
            let Some(next) = self.moved(&place, &dq) else { break };
            let Ok(there) = self.statics.local(&next) else { break };
            let after = relative(&there, &next);
            if after >= before {
                break;
            }
            (place, local) = (next, there);
            self.steps += 1;
        }
        Ok((place, local))
    }

    /// The step of Newton's method. Where the stiffness is almost singular, it is the step along its eigenvectors with
    /// forces above rounding errors.
    fn newton(&self, place: &StaticState, local: &LocalForces) -> Vec<f64> {
        let near = |p: &Vec<f64>| self.statics.largest(&local.basis.extend(p)) <= FIRST;
        let step = solved(&local.stiffness, &local.gradient).filter(near);
        step.unwrap_or_else(|| resolved(local, place.scale))
    }

    /// The largest scaled coordinate of the step of Newton's method.
    fn left(&self, place: &StaticState, local: &LocalForces) -> f64 {
        self.statics.largest(&local.basis.extend(&self.newton(place, local)))
    }

    /// A position of lower energy beside an unstable equilibrium, if there is one.
    fn pushed(
        &mut self,
        place: &StaticState,
        local: &LocalForces,
        direction: &[f64],
    ) -> Result<Option<(StaticState, LocalForces)>, Reason> {
        let dq = local.basis.extend(direction);
        let length = self.statics.largest(&dq);
        for way in [PUSH, -PUSH] {
            let dq: Vec<f64> = dq.iter().map(|x| x * way / length).list();
            if let Some(next) = self.moved(place, &dq) {
                if self.statics.energy_change(place, &next) < 0.0 {
                    let there = self.statics.local(&next)?;
                    return Ok(Some((next, there)));
                }
            }
        }
        Ok(None)
    }
}

/// The force along the freedoms, relative to the largest single force. Without loads, all forces are rounding errors of
/// the coordinates; the force is then relative to that of a small displacement.
pub(super) fn relative(local: &LocalForces, place: &StaticState) -> f64 {
    let size = dot(&local.gradient, &local.gradient).sqrt();
    let stiffest = local.stiffness.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if size == 0.0 {
        0.0
    } else {
        size / place.scale.max(DISPLACEMENT * stiffest).max(f64::MIN_POSITIVE)
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The largest magnitude of an eigenvalue of the stiffness that counts as zero.
pub(super) fn zero(stiffness: &[f64], scale: f64) -> f64 {
    ZERO * stiffness.iter().fold(scale, |most, x| most.max(x.abs()))
}

/// The direction in which the potential falls most from an equilibrium. None if there is no such direction, or if the
/// forces have no potential.
fn down(local: &LocalForces, place: &StaticState) -> Option<Vec<f64>> {
    let eigen = Eigen::of(&local.stiffness, local.gradient.len());
    let least = *eigen.values.first()?;
    (least < -zero(&local.stiffness, place.scale) && is_symmetric(&local.stiffness))
        .then(|| eigen.vectors[0].clone())
}

/// Whether a stiffness is symmetric, as that of a potential is.
fn is_symmetric(stiffness: &[f64]) -> bool {
    let f = stiffness.len().isqrt();
    let largest = stiffness.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let skew = |k: usize| (stiffness[k] - stiffness[(k % f) * f + k / f]).abs();
    (0..f * f).all(|k| skew(k) <= 1e-9 * largest)
}

/// -K⁻¹ g.
fn solved(stiffness: &[f64], gradient: &[f64]) -> Option<Vec<f64>> {
    let mut p: Vec<f64> = gradient.iter().map(|g| -g).list();
    let solved = solve_dense(&mut stiffness.to_vec(), &mut p);
    (solved && p.iter().all(|x| x.is_finite())).then_some(p)
}

/// The Newton step along the eigenvectors of the stiffness whose forces are above rounding errors.
fn resolved(local: &LocalForces, scale: f64) -> Vec<f64> {
    let f = local.gradient.len();
    let eigen = Eigen::of(&local.stiffness, f);
    let stiffest = eigen.values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut p = vec![0.0; f];
    for (value, vector) in eigen.values.iter().zip(&eigen.vectors) {
        let force = dot(vector, &local.gradient);
        if force.abs() > NOISE * scale.max(DISPLACEMENT * stiffest) {
            let least = f64::EPSILON * stiffest;
            let part = -force / value.abs().max(least).copysign(*value);
            p.iter_mut().zip(vector).for_each(|(p, v)| *p += part * v);
        }
    }
    p
}

/// The Newton step with the eigenvalues of the stiffness replaced by their magnitudes.
fn modified(local: &LocalForces, scale: f64) -> Vec<f64> {
    let f = local.gradient.len();
    let eigen = Eigen::of(&local.stiffness, f);
    let largest = eigen.values.iter().fold(scale, |most, x| most.max(x.abs()));
    let mut p = vec![0.0; f];
    for (value, vector) in eigen.values.iter().zip(&eigen.vectors) {
        let part = -dot(vector, &local.gradient) / value.abs().max(1e-6 * largest);
        p.iter_mut().zip(vector).for_each(|(p, v)| *p += part * v);
    }
    p
}
