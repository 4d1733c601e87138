//! The bodies that may be placed next, so that each is looked at only after a neighbour was placed.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Bodies that wait, the first of the file first; each waits once.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    heap: BinaryHeap<Reverse<usize>>,
    waits: Vec<bool>,
}

impl Queue {
    fn new(n: usize) -> Self {
        Self { heap: BinaryHeap::new(), waits: vec![false; n] }
    }

    pub fn push(&mut self, b: usize) {
        if !std::mem::replace(&mut self.waits[b], true) {
            self.heap.push(Reverse(b));
        }
    }

    pub fn pop(&mut self) -> Option<usize> {
        let Reverse(b) = self.heap.pop()?;
        self.waits[b] = false;
        Some(b)
    }
}

/// The waiting bodies, by what may place them.
#[derive(Clone, Debug)]
pub(super) struct Worklist {
    /// By their joints to placed bodies.
    pub follow: Queue,
    /// As one of two bodies of a dyad: those with a pin on a placed body.
    pub dyads: Queue,
    /// With one freedom left, by an equation.
    pub equations: Queue,
    /// On a slide, by a link.
    pub slides: Queue,
    /// By assumption: with a pin and a known angle, with known coordinates, with a pin, any.
    pub assumed: [Queue; 4],
}

impl Worklist {
    /// For `n` bodies, of which index 0 is ground; nobody waits except for an assumption.
    pub fn new(n: usize, posed: impl Iterator<Item = usize>) -> Self {
        let none = Queue::new(n);
        let mut list = Self {
            follow: none.clone(),
            dyads: none.clone(),
            equations: none.clone(),
            slides: none.clone(),
            assumed: std::array::from_fn(|_| none.clone()),
        };
        posed.for_each(|b| list.assumed[1].push(b));
        for b in 1..n {
            list.follow.push(b);
            list.assumed[3].push(b);
        }
        list
    }
}
