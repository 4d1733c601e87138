//! Bodies that a pin holds to ground, as rotation about the pin: what the equations of motion ask of them.
//!
//! Such a body has one degree of freedom, whatever else is joined to it. The rows of its pin are eliminated
//! together with its translation (`solve/anchor.rs`).

use super::pin::Pin;
use crate::math::{Lever, Real, Vec2};
use crate::model::Body;

/// A body with the pin that holds it.
#[derive(Clone, Copy, Debug)]
pub struct Anchor<S = f64> {
    /// Its place among the moving bodies.
    pub body: u32,
    /// The pin's place among the pins.
    pub pin: u32,
    /// Of the body, kg.
    pub mass: S,
    /// The first row of the pin.
    pub row: u32,
    /// 1 where the pin's equations are point of the body minus point of ground, else -1.
    pub sign: S,
    /// The pin on ground, m.
    pub ground: Vec2<S>,
    /// The pin in the body frame, m.
    pub point: Lever<S>,
    /// m (c - s), s the pin and c the mass centre: kg·m.
    pub moment: Lever<S>,
    /// 1/(J + m |c - s|²), 1/(kg·m²).
    pub inverse: S,
}

/// The first pin to ground of each body that has one, and an inertia of its own.
pub(super) fn anchors<S: Real>(pins: &[Pin<S>], bodies: &[Body<S>], added: &[S]) -> Vec<Anchor<S>> {
    let mut held = vec![false; bodies.len()];
    let anchor = |(k, pin): (u32, &Pin<S>)| {
        let end = match pin.bodies {
            [body, 0] if body > 0 => 0,
            [0, body] if body > 0 => 1,
            _ => return None,
        };
        let number = pin.bodies[end] as usize;
        let body = &bodies[number];
        if std::mem::replace(&mut held[number], true) || added[number].largest_magnitude() > 0.0 {
            return None;
        }
        let point = pin.points[end];
        let off = body.center - point;
        let about = body.inertia + body.mass * off.dot(off);
        Some(Anchor {
            body: pin.bodies[end] - 1,
            pin: k,
            mass: body.mass,
            row: pin.row,
            sign: S::constant(if end == 1 { 1.0 } else { -1.0 }),
            ground: Vec2::new(pin.points[1 - end].x, pin.points[1 - end].y),
            point: point.into(),
            moment: off.scale(body.mass).into(),
            inverse: S::one() / about,
        })
    };
    (0..).zip(pins).filter_map(anchor).collect()
}
