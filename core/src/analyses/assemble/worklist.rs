//! The bodies that may be placed next. A body is examined only after a neighbour was placed.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A queue of bodies in the order of the file. Each body is in it at most once.
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

/// The queues, one for each way to place a body.
#[derive(Clone, Debug)]
pub(super) struct Worklist {
    /// Bodies that joints to placed bodies may place.
    pub follow: Queue,
    /// Bodies with a pin on a placed body, which may be one of two bodies of a dyad.
    pub dyads: Queue,
    /// Bodies with one freedom left, which an equation may place.
    pub equations: Queue,
    /// Bodies on a slide, which a link may place.
    pub slides: Queue,
    /// Bodies that may be placed by assumption, in four queues: with a pin and a known angle, with known coordinates,
    /// with a pin, and all others.
    pub assumed: [Queue; 4],
}

impl Worklist {
    /// The queues for `n` bodies, of which index 0 is ground. At first, all bodies are only in the queue of
    /// assumptions.
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
