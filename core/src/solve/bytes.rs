//! How much memory a [`Pattern`] and the numbers of a [`Saddle`] take.

use super::pattern::Pattern;
use super::saddle::Saddle;
use super::steps::{Steps, Touch};
use std::mem::{size_of, size_of_val};
use std::ops::Add;

/// Bytes of memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bytes {
    /// All.
    pub held: usize,
    /// What is read or written to factorise and solve once, where all row blocks of [`Pattern::armed`] are
    /// begun with their arms.
    pub touched: usize,
}

impl Bytes {
    /// Of a list that is read or written as a whole.
    pub fn touched<T>(list: &[T]) -> Self {
        let bytes = size_of_val(list);
        Self { held: bytes, touched: bytes }
    }

    /// Of a list that stays aside.
    pub fn aside<T>(list: &[T]) -> Self {
        Self { held: size_of_val(list), touched: 0 }
    }
}

impl Add for Bytes {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { held: self.held + o.held, touched: self.touched + o.touched }
    }
}

impl Pattern {
    /// Bytes of the plan.
    pub fn bytes(&self) -> Bytes {
        let places = &self.places;
        Bytes::touched(&self.coupled)
            + Bytes::touched(&self.loose)
            + Bytes::touched(&self.anchors)
            + Bytes::touched(&self.loads.units)
            + Bytes::touched(&self.loads.dense)
            + Bytes::aside(&self.units)
            + Bytes::touched(&places.general)
            + Bytes::aside(&places.arms)
            + Bytes::touched(&places.mixed)
            + Bytes::aside(&places.armed)
            + self.steps.bytes()
    }
}

impl Steps {
    fn bytes(&self) -> Bytes {
        let starts = &self.starts[..self.n_mixed];
        let touches: usize = starts.iter().map(|start| start.touches as usize).sum();
        let of_mixed = size_of_val(starts) + size_of::<Touch>() * touches;
        Bytes::aside(&self.starts)
            + Bytes::aside(&self.touches)
            + Bytes { held: 0, touched: of_mixed }
            + Bytes::touched(&self.rows)
            + Bytes::touched(&self.left)
            + Bytes::touched(&self.below)
            + Bytes::touched(&self.pairs)
            + Bytes::touched(&self.updates)
    }
}

impl<S> Saddle<S> {
    /// Bytes of the numbers.
    pub fn bytes(&self, pattern: &Pattern) -> Bytes {
        let of_general = size_of::<[S; 3]>() * pattern.places.general.len();
        Bytes::touched(&self.weights)
            + Bytes::touched(&self.anchors)
            + Bytes::aside(&self.entries)
            + Bytes { held: 0, touched: of_general }
            + Bytes::touched(&self.arms)
            + Bytes::touched(&self.damping)
            + Bytes::touched(&self.u)
            + Bytes::touched(&self.factors)
    }
}
