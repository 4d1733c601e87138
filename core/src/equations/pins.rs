//! γ̂ and Φ_q of pins, the constraints that mechanisms have most of: of [±I b] (Haug 3.3.12) b alone, and what
//! follows from it for the pin by itself while its numbers are at hand.

use super::constraints::{Stabilized, Terms};
use super::pin::Pin;
use super::plan::ArmedPin;
use crate::math::{Motion, Real};
use crate::solve::{Begun, Saddle};

/// The three unknowns of a group.
#[inline(always)]
fn of_group<S>(group: usize, x: &[S]) -> &[S; 3] {
    x[3 * group..3 * group + 3].first_chunk().expect("as long as the range")
}

/// Begins the rows of the `armed` pins: `x` is Dw⁻¹ Lw⁻¹ Q, `right` becomes their right side.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn begin<S: Real>(
    pins: &[Pin<S>],
    armed: &[ArmedPin],
    motions: &[Motion<S>],
    stabilized: Stabilized<S>,
    saddle: &mut Saddle<S>,
    (x, right): (&[S], &mut [S]),
) {
    for ArmedPin { pin, rows: armed } in armed {
        let pin = &pins[*pin as usize];
        let ([residual, rate, gamma], [b_i, b_j]) = pin.linearize(motions);
        let terms = Terms { residual: &residual, rate: &rate, gamma: &gamma };
        let mut gamma = [S::zero(); 2];
        stabilized.put(&terms, &mut gamma);
        let mut begun = Begun::new(gamma);
        let mut arm = armed.arm as usize;
        let [i, j] = pin.bodies.map(|body| (body as usize).checked_sub(1));
        if let Some(i) = i {
            saddle.arms[arm] = begun.add(-1.0, b_i, &saddle.weights[i], of_group(i, x));
            arm += 1;
        }
        if let Some(j) = j {
            saddle.arms[arm] = begun.add(1.0, b_j, &saddle.weights[j], of_group(j, x));
        }
        right[pin.row as usize..][..2].copy_from_slice(&begun.right);
        saddle.begin(armed, pin.row, &begun);
    }
}

/// Lessens γ̂ of the `armed` pins, which were begun, by `held`, shape (n_rows) or empty.
pub(super) fn hold<S: Real>(pins: &[Pin<S>], armed: &[ArmedPin], held: &[S], right: &mut [S]) {
    if held.is_empty() {
        return;
    }
    for ArmedPin { pin, .. } in armed {
        let row = pins[*pin as usize].row as usize;
        // begun, the right side has the opposite sign
        for (right, held) in right[row..row + 2].iter_mut().zip(&held[row..row + 2]) {
            *right += *held;
        }
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
