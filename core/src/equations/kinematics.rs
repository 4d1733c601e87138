//! Poses and twists of all bodies, and internal coordinates of elements, from q and q̇.

use crate::elements::derive::ByThree;
use crate::math::{Lift, Listed, Motion, Pose, Real, Rotation, Twist};
use crate::model::{Columns, Model, StateLayout};
use std::ops::Deref;

/// The motion of every body, ground first, and the internal coordinates of elements.
///
/// Dereferences to the motions of the bodies.
#[derive(Clone, Debug)]
pub struct Motions<S = f64> {
    bodies: Vec<Motion<S>>,
    /// The first column of the internal coordinates.
    first_own: usize,
    own: Vec<S>,
    own_rates: Vec<S>,
    /// The held piece of each switch of the model during a step of an integrator; empty if no piece is held.
    pub pieces: Vec<f64>,
}

impl<S> Deref for Motions<S> {
    type Target = [Motion<S>];
    #[inline]
    fn deref(&self) -> &[Motion<S>] {
        &self.bodies
    }
}

impl<S: Real> Motions<S> {
    /// Memory for a model. All bodies are at rest at the origin.
    pub fn new(layout: &StateLayout) -> Self {
        let bodies = layout.bodies.len();
        let first_own = layout.bodies.iter().map(|columns| columns.range().end).max().unwrap_or(0);
        let none = vec![S::zero(); layout.n_q - first_own];
        Self {
            bodies: vec![Motion::ground(); bodies],
            first_own,
            own: none.clone(),
            own_rates: none,
            pieces: Vec::new(),
        }
    }

    /// The motions at coordinates `q` and rates `v`, both of shape (n_q).
    #[inline]
    pub fn at(layout: &StateLayout, q: &[S], v: &[S]) -> Self {
        let mut motions = Self::new(layout);
        motions.place(layout, q, v);
        motions
    }

    /// The motions at coordinates `q`, at rest.
    #[inline]
    pub fn at_rest(layout: &StateLayout, q: &[S]) -> Self {
        Self::at(layout, q, &vec![S::zero(); q.len()])
    }

    /// Sets coordinates and rates, both of shape (n_q).
    #[inline(always)] // part of every evaluation
    pub fn place(&mut self, layout: &StateLayout, q: &[S], v: &[S]) {
        for (motion, columns) in self.bodies[1..].iter_mut().zip(&layout.bodies[1..]) {
            let (pose, q) = (&mut motion.pose, &q[columns.range()]);
            (pose.r.x, pose.r.y) = (q[0], q[1]);
            if let Some(angle) = q.get(2) {
                (pose.angle, pose.rotation) = (*angle, Rotation::new(*angle));
            }
            put_rates(&v[columns.range()], &mut motion.twist);
        }
        if !self.own.is_empty() {
            self.own.copy_from_slice(&q[self.first_own..]);
            self.own_rates.copy_from_slice(&v[self.first_own..]);
        }
    }

    /// Sets the rates `v`, shape (n_q). Positions are unchanged.
    #[inline]
    pub fn set_rates(&mut self, layout: &StateLayout, v: &[S]) {
        for (motion, columns) in self.bodies[1..].iter_mut().zip(&layout.bodies[1..]) {
            put_rates(&v[columns.range()], &mut motion.twist);
        }
        self.own_rates.copy_from_slice(&v[self.first_own..]);
    }

    /// Appends t, q, v and z to `x`, in the order of the arguments of functions of the whole state.
    pub(super) fn collect(&self, layout: &StateLayout, t: S, z: &[S], x: &mut Vec<S>) {
        let moving = || self.bodies[1..].iter().zip(&layout.bodies[1..]);
        x.push(t);
        for (Motion { pose, .. }, columns) in moving() {
            x.extend(&[pose.r.x, pose.r.y, pose.angle][..columns.count]);
        }
        x.extend(&self.own);
        for (Motion { twist, .. }, columns) in moving() {
            x.extend(&[twist.velocity.x, twist.velocity.y, twist.omega][..columns.count]);
        }
        x.extend(&self.own_rates);
        x.extend(z);
    }

    /// The internal coordinates of all elements and their rates.
    #[inline]
    pub fn internals(&self) -> [&[S]; 2] {
        [&self.own, &self.own_rates]
    }

    /// The internal coordinates of all elements. Those of `columns` are seeds if they vary.
    pub(super) fn seeded_internals(&self, columns: Columns, vary: bool) -> Vec<ByThree<S>> {
        let seed = |(k, u): (usize, &S)| match (self.first_own + k).checked_sub(columns.first) {
            Some(c) if vary && c < columns.count => ByThree::variable(*u, c),
            _ => ByThree::lift(*u),
        };
        self.own.iter().enumerate().map(seed).list()
    }

    /// Internal coordinates of an element and their rates.
    #[inline]
    pub fn own(&self, columns: Columns) -> (&[S], &[S]) {
        let range = match columns.count {
            0 => 0..0,
            count => columns.first - self.first_own..columns.first - self.first_own + count,
        };
        (&self.own[range.clone()], &self.own_rates[range])
    }

    /// A copy over a scalar that contains this one, without derivatives.
    pub fn lift<T: crate::math::Lift<S>>(&self) -> Motions<T> {
        let lift = |x: &[S]| x.iter().map(|x| T::lift(*x)).list();
        Motions {
            bodies: self.bodies.iter().map(Motion::lift).list(),
            first_own: self.first_own,
            own: lift(&self.own),
            own_rates: lift(&self.own_rates),
            pieces: self.pieces.clone(),
        }
    }

    /// The motion of a body, mutable.
    #[inline]
    pub(super) fn body_mut(&mut self, body: usize) -> &mut Motion<S> {
        &mut self.bodies[body]
    }

    /// Internal coordinates of an element and their rates, mutable.
    #[inline]
    pub(super) fn own_mut(&mut self, columns: Columns) -> (&mut [S], &mut [S]) {
        let first = columns.first.saturating_sub(self.first_own);
        let range = first..first + columns.count;
        (&mut self.own[range.clone()], &mut self.own_rates[range])
    }
}

/// One number at a time: a twist that is assembled first would be copied twice.
#[inline(always)]
fn put_rates<S: Real>(v: &[S], twist: &mut Twist<S>) {
    (twist.velocity.x, twist.velocity.y) = (v[0], v[1]);
    if let Some(omega) = v.get(2) {
        twist.omega = *omega;
    }
}

/// The coordinates of given poses of all bodies, ground first, with the initial values of the internal coordinates of
/// elements at these poses. Shape (n_q).
pub fn coordinates(model: &Model, poses: &[Pose]) -> Vec<f64> {
    let layout = &model.layout;
    let mut q = vec![0.0; layout.n_q];
    for (pose, columns) in poses.iter().zip(&layout.bodies) {
        let three = [pose.r.x, pose.r.y, pose.angle];
        q[columns.range()].copy_from_slice(&three[..columns.count]);
    }
    for (item, slots) in model.constraints.iter().zip(&layout.constraints) {
        if slots.own.count > 0 {
            let bodies: Vec<Pose> = item.bodies.iter().map(|body| poses[body.0]).list();
            q[slots.own.range()].copy_from_slice(&item.element.own_start(&bodies));
        }
    }
    q
}
