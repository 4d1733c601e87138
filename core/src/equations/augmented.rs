//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a pattern found once.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18); with W = I it
//! gives the smallest step of Newton's method, with μ > 0 a damped one.

use super::{anchors, mass};
use crate::math::{Motion, Real};
use crate::model::{Anchor, Block, Layout, Model, Slots};
pub use crate::solve::Dependent;
use crate::solve::{Armed, Bytes, Pattern, RowBlock, Saddle, Weight};

/// ε² of near singular positions: between the noise of positions over ε and the load over a time in
/// proportion to ε; `docs/performance.md` has the errors for others.
pub const RIDGE: f64 = 1e-10;

/// Matrix, factors and pattern.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    pattern: Pattern,
    saddle: Saddle<S>,
    /// Whether near singular positions are to be passed.
    passing: bool,
    /// Whether they are refused instead.
    refusing: bool,
    /// Whether the factor at hand has it.
    ridged: bool,
    /// The pins whose rows of Φ_q [`armed`](Self::armed) gives by their arms.
    armed: Vec<ArmedPin>,
    /// The other constraints, but for anchors.
    others: Vec<u32>,
    /// Whether bodies that are pinned to ground are anchored there.
    anchored: bool,
    /// Whether the entries of Φ_q are those of all constraints.
    whole: bool,
}

/// A pin all of whose rows have arms.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmedPin {
    /// Its place among the pins.
    pub pin: u32,
    /// Its place in the matrix.
    pub rows: Armed,
}

/// What an evaluation puts into the matrix piece by piece.
pub(super) struct Parts<'a, S> {
    pub pattern: &'a Pattern,
    pub saddle: &'a mut Saddle<S>,
    /// The pins given by arms, in the order of elimination.
    pub armed: &'a [ArmedPin],
    /// The constraints given by entries.
    pub others: &'a [u32],
}

impl<S: Real> Augmented<S> {
    /// Memory and elimination order for a model: bodies first, then the constraints by minimum
    /// degree, so that every pivot is safe while Φ_q has full rank.
    pub fn new<P>(model: &Model<P>) -> Self {
        Self::with(model, &[])
    }

    /// The same for W = M without damping: pins to ground are eliminated with the bodies that they hold.
    pub fn anchored<P>(model: &Model<P>) -> Self {
        let constraint = |anchor: &Anchor<P>| model.pins[anchor.pin as usize].constraint as usize;
        let anchors: Vec<usize> = model.anchors.iter().map(constraint).collect();
        Self { anchored: true, ..Self::with(model, &anchors) }
    }

    fn with<P>(model: &Model<P>, anchors: &[usize]) -> Self {
        let coupled = model.inertias.iter().map(|inertia| inertia.coupled);
        let pattern = Pattern::new(coupled.collect(), &row_blocks(&model.layout), anchors);
        let (armed, others) = split(model, &pattern);
        Self::on(pattern, armed, others, false)
    }

    /// On the pattern of the same model over other numbers, which is not sought again.
    pub fn like<P>(other: &Augmented<P>) -> Self {
        let Augmented { pattern, armed, others, anchored, .. } = other;
        Self::on(pattern.clone(), armed.clone(), others.clone(), *anchored)
    }

    fn on(pattern: Pattern, armed: Vec<ArmedPin>, others: Vec<u32>, anchored: bool) -> Self {
        Self {
            saddle: Saddle::new(&pattern),
            pattern,
            passing: false,
            refusing: false,
            ridged: false,
            armed,
            others,
            anchored,
            whole: true,
        }
    }

    /// The pieces; inertia, which no state changes, must stand there already. The factor is then without ridge.
    #[inline(always)]
    pub(super) fn parts_mut(&mut self) -> Parts<'_, S> {
        self.whole = self.armed.is_empty() && self.pattern.anchors().is_empty();
        self.ridged = false;
        let Self { pattern, saddle, armed, others, .. } = self;
        Parts { pattern, saddle, armed, others }
    }

    /// W = M at the given motions, with the inertia that the model adds to bodies without their own.
    pub fn set_mass(&mut self, model: &Model<S>, motions: &[Motion<S>]) {
        self.set_inertia(model);
        let bodies = model.inertias.iter().zip(&motions[1..]);
        for (weight, (inertia, motion)) in self.saddle.weights.iter_mut().zip(bodies) {
            mass::turn(inertia, motion, weight);
        }
        for (anchor, held) in model.anchors.iter().zip(&mut self.saddle.anchors) {
            let body = anchor.body as usize;
            anchors::turn(anchor, &motions[body + 1], &mut self.saddle.weights[body], held);
        }
    }

    /// What no state changes of W = M.
    pub(super) fn set_inertia(&mut self, model: &Model<S>) {
        for (weight, inertia) in self.saddle.weights.iter_mut().zip(&model.inertias) {
            let [m, j] = inertia.inverse;
            weight.inverse = [m, m, j];
        }
        for (anchor, held) in model.anchors.iter().zip(&mut self.saddle.anchors) {
            let weight = &mut self.saddle.weights[anchor.body as usize];
            weight.inverse = [S::zero(), S::zero(), anchor.inverse];
            weight.held = S::one() / anchor.mass;
            (held.mass, held.inverse) = (anchor.mass, anchor.inverse);
        }
    }

    /// W diagonal, shape (n_q).
    ///
    /// # Panics
    /// If bodies are anchored.
    pub fn set_weights(&mut self, weights: &[S]) {
        assert!(!self.anchored, "anchored bodies weigh what they do");
        for (weight, d) in self.saddle.weights.iter_mut().zip(weights.chunks_exact(3)) {
            let inverse = [d[0], d[1], d[2]].map(|d| S::one() / d);
            *weight = Weight { inverse, shift: [S::zero(); 2], held: S::zero() };
        }
    }

    /// The entries of Φ_q, to be filled.
    pub fn jacobian_mut(&mut self) -> &mut [S] {
        self.whole = true;
        self.saddle.entries.as_flattened_mut()
    }

    /// The entries of Φ_q.
    ///
    /// # Panics
    /// After an evaluation, before [`restore_jacobian`](Self::restore_jacobian): that gives pins by their arms.
    pub fn jacobian(&self) -> &[S] {
        assert!(self.whole, "entries of Φ_q that an evaluation left out: restore_jacobian()");
        self.saddle.entries.as_flattened()
    }

    /// The entries of Φ_q, of which those of pins may be of an earlier state.
    pub(super) fn jacobian_of_others(&self) -> &[S] {
        self.saddle.entries.as_flattened()
    }

    /// Fills in the entries of Φ_q that the last evaluation left out.
    pub fn restore_jacobian(&mut self) {
        if !self.whole {
            self.saddle.restore_entries(&self.pattern);
            self.whole = true;
        }
    }

    /// Sets the damping μ, one for each row.
    ///
    /// # Panics
    /// If bodies are anchored.
    pub fn set_damping(&mut self, mu: impl IntoIterator<Item = S>) {
        assert!(!self.anchored, "anchors are not damped");
        self.saddle.damping.clear();
        self.saddle.damping.extend(mu);
    }

    /// From now on near singular positions are factorised with the ridge ε² = [`RIDGE`].
    pub fn pass_singular(&mut self) {
        self.saddle.refuse_near();
        self.passing = true;
    }

    /// From now on near singular positions are refused.
    pub fn refuse_singular(&mut self) {
        self.pass_singular();
        self.refusing = true;
    }

    /// Whether the factor at hand is that of a near singular position, with the ridge.
    pub fn ridged(&self) -> bool {
        self.ridged
    }

    /// Factorises.
    ///
    /// # Errors
    /// The row of Φ_q that depends on the others, or a coordinate without mass.
    pub fn factor(&mut self) -> Result<(), Dependent> {
        self.ridged = false;
        match self.saddle.factor(&self.pattern) {
            Err(Dependent::Row(row)) if self.passing => {
                self.ridged = self.saddle.factor_near(&self.pattern, RIDGE)?;
                match self.ridged && self.refusing {
                    true => Err(Dependent::Row(row)),
                    false => Ok(()),
                }
            }
            outcome => outcome,
        }
    }

    /// Solves in place; (q part, multiplier part), shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [S]) {
        self.saddle.solve(&self.pattern, x);
    }

    /// Bytes of the plan and of the numbers.
    pub fn bytes(&self) -> Bytes {
        self.pattern.bytes()
            + self.saddle.bytes(&self.pattern)
            + Bytes::touched(&self.armed)
            + Bytes::touched(&self.others)
    }

    /// The work of finding the elimination order and the plan, see [`Pattern::effort`].
    pub fn effort(&self) -> usize {
        self.pattern.effort()
    }

    /// How many digits the worst pivot lost: the constraint row and the pivot over what it was
    /// cancelled from.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        self.saddle.cancellation(&self.pattern)
    }
}

/// The pins that arms can give, and the other constraints.
fn split<P>(model: &Model<P>, pattern: &Pattern) -> (Vec<ArmedPin>, Vec<u32>) {
    let mut pin: Vec<Option<u32>> = vec![None; model.constraints.len()];
    (0..).zip(&model.pins).for_each(|(k, p)| pin[p.constraint as usize] = Some(k));
    let mut others = vec![true; model.constraints.len()];
    pattern.anchors().iter().for_each(|anchor| others[anchor.block as usize] = false);
    let mut armed = Vec::with_capacity(pattern.armed().len());
    for &rows in pattern.armed() {
        let block = rows.block as usize;
        armed.push(ArmedPin { pin: pin[block].expect("unit blocks are those of pins"), rows });
        others[block] = false;
    }
    (armed, (0..).zip(others).filter(|(_, other)| *other).map(|(k, _)| k).collect())
}

/// The constraints as blocks of rows.
fn row_blocks(layout: &Layout) -> Vec<RowBlock> {
    let touches =
        |blocks: &[Block]| blocks.iter().map(|block| (block.body.0 - 1, block.first)).collect();
    let block = |slots: &Slots| RowBlock {
        size: slots.rows.len(),
        touches: touches(&slots.blocks),
        signs: slots.blocks.iter().map(|block| block.sign).filter(|sign| *sign != 0.0).collect(),
    };
    layout.constraints.iter().map(block).collect()
}
