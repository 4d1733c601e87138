//! γ̂ and Φ_q of pins, the constraints that mechanisms have most of: of [±I b] (Haug 3.3.12) b alone, and what
//! follows from it for the pin by itself while its numbers are at hand.

use super::augmented::ArmedPin;
use super::constraints::Stabilized;
use crate::elements::joints::Revolute;
use crate::elements::Joint;
use crate::math::{Motion, Real};
use crate::model::Pin;
use crate::solve::{Begin, Begun, Saddle};
use std::slice::Iter;

/// The three unknowns of a group.
#[inline(always)]
fn of_group<S>(group: usize, x: &[S]) -> &[S; 3] {
    x[3 * group..3 * group + 3].first_chunk().expect("as long as the range")
}

/// The rows of pins, one after the other.
pub(super) struct Rows<'a, S> {
    pub pins: &'a [Pin<S>],
    /// Those still to be begun.
    pub armed: Iter<'a, ArmedPin>,
    /// Motion of every body, ground first.
    pub motions: &'a [Motion<S>],
    pub stabilized: Stabilized<S>,
    /// What γ̂ is lessened by, shape (n_rows), or empty.
    pub held: &'a [S],
}

impl<S: Real> Begin<S> for Rows<'_, S> {
    #[inline(always)] // once in an evaluation: a call saves and restores more than it shares
    fn begin(&mut self, saddle: &mut Saddle<S>, x: &[S]) -> Begun<S> {
        let armed = self.armed.next().expect("a pin for each armed row block");
        let pin = &self.pins[armed.pin as usize];
        let [i, j] = pin.bodies.map(|body| &self.motions[body as usize]);
        let (terms, rows) = <Revolute as Joint<2>>::linearize(&pin.joint(), i, j, S::zero());
        let mut gamma = [S::zero(); 2];
        self.stabilized.put(&terms, &mut gamma);
        let mut begun = Begun::new(gamma);
        let mut arm = armed.rows.arm as usize;
        for (end, sign) in [(0, -1.0), (1, 1.0)] {
            let group = (pin.bodies[end] as usize).wrapping_sub(1);
            // none for ground
            let Some(weight) = saddle.weights.get(group) else { continue };
            let b = [0, 1].map(|row| S::constant(sign) * rows[row][3 * end + 2]);
            saddle.arms[arm] = begun.add(sign, b, weight, of_group(group, x));
            arm += 1;
        }
        if let Some(held) = self.held.get(pin.row as usize..pin.row as usize + 2) {
            // begun, the right side has the opposite sign
            begun.right.iter_mut().zip(held).for_each(|(right, held)| *right += *held);
        }
        begun
    }
}

/// x -= Dw⁻¹ Uᵀ λ over the rows of the `armed` pins.
#[inline(always)] // as above
pub(super) fn spread<S: Real>(
    pins: &[Pin<S>],
    armed: &[ArmedPin],
    saddle: &Saddle<S>,
    (x, lam): (&mut [S], &[S]),
) {
    for ArmedPin { pin, rows: armed } in armed.iter().rev() {
        let pin = &pins[*pin as usize];
        let row = pin.row as usize;
        let lam = [lam[row], lam[row + 1]];
        let [i, j] = pin.bodies.map(|body| body.checked_sub(1));
        let mut arm = armed.arm;
        if let Some(i) = i {
            saddle.spread(arm, i, -1.0, &lam, x);
            arm += 1;
        }
        if let Some(j) = j {
            saddle.spread(arm, j, 1.0, &lam, x);
        }
    }
}
