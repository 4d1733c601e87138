//! γ̂ and Φ_q of pins, the constraints that mechanisms have most of: of [±I b] (Haug 3.3.12) b alone.

use super::augmented::Armed;
use super::constraints::Stabilized;
use crate::elements::joints::Revolute;
use crate::elements::Joint;
use crate::math::{Motion, Real};
use crate::model::Pin;

/// γ̂ of the `armed` pins into `right`, shape (m), and b at their moving bodies into `arms`.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn linearize<S: Real>(
    pins: &[Pin<S>],
    armed: &[Armed],
    motions: &[Motion<S>],
    stabilized: Stabilized<S>,
    right: &mut [S],
    arms: &mut [[S; 2]],
) {
    for &Armed { pin, first } in armed {
        let pin = &pins[pin as usize];
        let [i, j] = pin.bodies.map(|body| &motions[body as usize]);
        let (terms, rows) = <Revolute as Joint<2>>::linearize(&pin.joint(), i, j, S::zero());
        stabilized.put(&terms, &mut right[pin.row as usize..][..2]);
        let [b_i, b_j] = [2, 5].map(|angle| [rows[0][angle], rows[1][angle]]);
        let first = first as usize;
        match pin.bodies {
            [0, _] => arms[first] = b_j,
            [_, 0] => arms[first] = b_i,
            _ => arms[first..first + 2].copy_from_slice(&[b_i, b_j]),
        }
    }
}
