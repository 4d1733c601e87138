//! Pins: constraints that only hold a point of one body at a point of another, as numbers side by side.
//!
//! Names, equations and formulas of a constraint take a thousand bytes; the equations of motion ask for 48 of
//! them, and for the same ones whatever the element.

use crate::elements::joints::Revolute;
use crate::elements::{BodyId, Joint, Linearized, Moving, PointOn};
use crate::math::{Local, Motion, Real};
use crate::model::{ConstraintItem, Slots, StateLayout};

/// A constraint of two equations Φ = point_j - point_i without laws (Haug 3.3.10).
#[derive(Clone, Copy, Debug)]
pub struct Pin<S = f64> {
    /// Points of bodies i and j, m.
    pub points: [Local<S>; 2],
    /// Bodies i and j.
    pub bodies: [u32; 2],
    /// The first of its rows.
    pub row: u32,
    /// Its place among the constraints.
    pub constraint: u32,
}

impl<S: Real> Pin<S> {
    /// The element that states its equations.
    #[inline(always)]
    pub fn joint(&self) -> Revolute<S> {
        let [i, j] = [0, 1]
            .map(|end| PointOn { body: BodyId(self.bodies[end] as usize), s: self.points[end] });
        Revolute { i, j, axes: [S::zero(); 2] }
    }

    /// Φ, Φ̇, γ, and b of both bodies.
    #[inline(always)]
    pub fn linearize(&self, motions: &[Motion<S>]) -> ([[S; 2]; 3], [[S; 2]; 2]) {
        let bodies = self.bodies.map(|body| motions[body as usize]);
        let [mut residual, mut rate, mut gamma] = [[S::zero(); 2]; 3];
        let mut columns = [[S::zero(); 3]; 4];
        let at = Moving { bodies: &bodies, own: &[], own_rates: &[], t: S::zero() };
        let out = Linearized {
            residual: &mut residual,
            rate: &mut rate,
            gamma: &mut gamma,
            columns: &mut columns,
        };
        Revolute::linearize(&self.joint(), &at, out);
        let b = [[columns[0][2], columns[1][2]], [columns[2][2], columns[3][2]]];
        ([residual, rate, gamma], b)
    }
}

/// All pins of a model that touch a moving body, in the order of the constraints.
pub(super) fn pins<S: Real>(
    constraints: &[ConstraintItem<S>],
    layout: &StateLayout,
) -> Vec<Pin<S>> {
    let index = |i: usize| u32::try_from(i).expect("fewer than 2^32 rows");
    let items = constraints.iter().zip(&layout.constraints).enumerate();
    let pins = items.filter(|(_, (_, slots))| slots.blocks.iter().any(|block| block.sign != 0.0));
    let pin = |(k, (item, slots)): (usize, (&ConstraintItem<S>, &Slots))| Pin {
        points: [0, 1].map(|body| item.element.attachment(body).s),
        bodies: [0, 1].map(|k| index(item.bodies[k].0)),
        row: index(slots.rows.start),
        constraint: index(k),
    };
    pins.map(pin).collect()
}
