//! Jumps of the law of a joint or driver, or of its rate, which a body with mass cannot follow.

use crate::equations::kinematics::Motions;
use crate::equations::switches::law_values;
use crate::expression::Tape;
use crate::math::Jet;
use crate::model::{row_scales, Model};

/// Largest jump of the law of a joint or driver, and of its rate, relative to the largest of both values (or both
/// rates) and the size of the mechanism (1 for angles).
const CONTINUOUS: f64 = 1e-8;

/// A jump of the law of a joint or driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LawJump {
    pub constraint: usize,
    /// Whether the value jumps; otherwise the rate jumps.
    pub position: bool,
    /// The value or rate before and after.
    pub values: [f64; 2],
}

impl LawJump {
    /// The jump of a law of constraint `k` from the pieces `before` to the pieces of `motions`, if the law or its
    /// rate is discontinuous. `which` selects formulas.
    pub fn of(
        model: &Model,
        k: usize,
        motions: &mut Motions,
        t: f64,
        before: &[f64],
        which: &dyn Fn(&Tape) -> bool,
    ) -> Option<Self> {
        let new = law_values(model, k, motions, t);
        let after = std::mem::replace(&mut motions.pieces, before.to_vec());
        let old = law_values(model, k, motions, t);
        motions.pieces = after;
        let mut selected = Vec::new();
        model.constraints[k].law.as_ref()?.visit(&mut |tape| selected.push(which(tape)));
        let scale = row_scales(model)[model.layout.constraints[k].rows.start];
        let pairs = old.into_iter().zip(new).zip(selected);
        pairs.filter(|(_, selected)| *selected).find_map(|((old, new), _)| {
            let Jet { value: a, rate: va, .. } = old;
            let Jet { value: b, rate: vb, .. } = new;
            let differ =
                |a: f64, b: f64| (b - a).abs() > CONTINUOUS * a.abs().max(b.abs()).max(scale);
            let (position, velocity) = (differ(a, b), differ(va, vb));
            let values = if position { [a, b] } else { [va, vb] };
            (position || velocity).then_some(Self { constraint: k, position, values })
        })
    }

    /// The message about this jump.
    pub fn describe(self, model: &Model, t: f64) -> String {
        let item = &model.constraints[self.constraint];
        let what = item.group.singular();
        let (of, per) = if self.position { ("", "") } else { ("rate of the ", "/s") };
        let unit = item.equations[0].kind.unit();
        let [before, after] = self.values;
        format!(
            "the {of}law of {what} {} jumps from {before:.6} to {after:.6} {unit}{per} at t = {t:.6} s; a body with \
             mass cannot follow",
            item.name
        )
    }
}

/// The remedy for a law that jumps.
pub(super) const SMOOTH: &str =
    "join the pieces with equal values and equal rates, for instance by step5 or another \
                                 motion law";
