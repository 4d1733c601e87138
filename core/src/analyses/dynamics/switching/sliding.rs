//! Motions that are held at a switch: both pieces return them to the boundary.

use super::{History, Switching, ROUNDING};
use crate::analyses::dynamics::motion_ode::MotionOde;
use crate::equations::switches;
use crate::integrate::{Cause, Ode};
use crate::solve::Breakdown;

/// Smallest jump of rates at which a motion can slide, relative to the largest rates.
const JUMPS: f64 = 1e-6;

impl Switching {
    /// Whether the motion returns at once to the piece that the switch of a law has just left: the rates of its
    /// function before and after the change have opposite signs.
    pub(super) fn returns(
        &mut self,
        ode: &mut MotionOde<'_>,
        at: (f64, &[f64]),
        switch: usize,
        before: &[f64],
    ) -> bool {
        if !ode.model.switches[switch].law {
            return false;
        }
        let before = self.growth(ode, at, switch, before);
        let after = self.growth(ode, at, switch, &self.pieces.clone());
        let (Some(before), Some(after)) = (before, after) else { return false };
        before * after < 0.0 && after.abs() > JUMPS * before.abs()
    }

    /// The rate of the function of a switch with the given pieces.
    fn growth(
        &self,
        ode: &mut MotionOde<'_>,
        (t, y): (f64, &[f64]),
        switch: usize,
        pieces: &[f64],
    ) -> Option<f64> {
        let mut rates = vec![0.0; y.len()];
        let held = std::mem::replace(&mut ode.workspace.motions.pieces, pieces.to_vec());
        let solved = ode.rate(t, y, &mut rates);
        ode.workspace.motions.pieces = held;
        solved.ok()?;
        let layout = &ode.model.layout;
        let ([q, v, z, _], [_, a, dz, _]) = (layout.split(y), layout.split(&rates));
        let moving = switches::functions_in_time(ode.model, t, [q, v, z], [a, dz]);
        Some(moving[switch].rate)
    }

    /// Releases a switch that changes back at once, if the motion is continuous there.
    pub(super) fn release(
        &mut self,
        ode: &mut MotionOde<'_>,
        t: f64,
        y: &[f64],
        switch: usize,
    ) -> Result<(), Cause<Breakdown>> {
        let boundaries = &ode.model.switches[switch].boundaries;
        self.evaluate(ode.model, t, y);
        let other = boundaries.next(self.sigma[switch], self.pieces[switch]);
        let mut rates = [vec![0.0; y.len()], vec![0.0; y.len()]];
        let held = std::mem::take(&mut ode.workspace.motions.pieces);
        for (piece, rates) in [self.pieces[switch], other].into_iter().zip(&mut rates) {
            ode.workspace.motions.pieces.clone_from(&self.pieces);
            ode.workspace.motions.pieces[switch] = piece;
            ode.rate(t, y, rates).map_err(|error| Cause::Equations { t, error })?;
        }
        ode.workspace.motions.pieces = held;
        // an element has states whose rates bend where they are zero, and only noise remains
        let compared = match ode.model.switches[switch].law {
            true => ode.structure().controlled(),
            false => 2 * ode.model.layout.n_q,
        };
        let [one, other] = &rates;
        let kinds = &ode.model.layout.kinds;
        // coordinates that are held have rates of rounding errors only, relative to those of the others
        let noise = |i: usize| {
            let (n, at) = (kinds.len(), 0..kinds.len());
            let alike = at.filter(|k| i < 2 * n && kinds[*k] == kinds[i % n]);
            ROUNDING * alike.map(|k| one[i / n * n + k].abs()).fold(0.0, f64::max)
        };
        let jumps = (0..compared).any(|i| {
            let scale = self.largest[i].max(one[i].abs()).max(other[i].abs());
            (one[i] - other[i]).abs() > (JUMPS * scale).max(noise(i)) && scale > 0.0
        });
        if jumps {
            return Err(Cause::Equations { t, error: Breakdown::Sliding(switch) });
        }
        self.pieces[switch] = f64::NAN;
        self.history[switch] = History { last: t, quick: 0, calm: (f64::NAN, 0), noisy: 0 };
        Ok(())
    }
}
