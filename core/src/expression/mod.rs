//! stub
use crate::math::Real;
#[derive(Clone, Debug)]
pub struct Tape;
pub trait Values<S> {
    fn parameter(&self, k: usize) -> S;
    fn time(&self) -> S;
    fn variable(&self, k: usize) -> S;
}
impl Tape {
    pub fn evaluate<S: Real>(&self, _v: &impl Values<S>) -> S {
        S::zero()
    }
    pub fn symbols(&self) -> &[Symbol] {
        &[]
    }
}
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Symbol {
    Parameter(usize),
    Time,
    Variable(usize),
}
