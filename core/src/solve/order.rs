//! Elimination order by minimum degree, with one set of unknowns eliminated before the rest.
//!
//! In the augmented matrix [M Φᵀ; Φ 0] every coordinate is eliminated before any constraint row. The pivots of the
//! rows are then those of the Schur complement -Φ M⁻¹ Φᵀ, which is definite if Φ has full rank, so that no pivot can
//! vanish. An order that mixes the two sets would lose digits.
//!
//! Within a set, the order is that of approximate external minimum degree on the quotient graph (Amestoy, Davis and
//! Duff, *An approximate minimum degree ordering algorithm*, SIAM J. Matrix Anal. Appl. 17 (1996) 886).
//! Supervariables are not detected, since the caller defines the blocks.

use crate::math::Listed;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Order in which the `n` unknowns are eliminated, the first `n_first` before the others.
///
/// `entries` are the structural positions of one triangle, as for [`Pattern`]. `blocks` contains the first index of
/// each block of unknowns that stay together and in order (the coordinates of a body, the rows of a joint). The
/// indices ascend and begin with 0, and `n_first` is a block boundary. With `None`, every unknown is a block. Of
/// equal degrees, the lowest index comes first. A chain is thus eliminated from one end. Otherwise a pivot would join
/// two long parts of the chain, and it would be small because of their inertia alone.
///
/// Returns `order`, length `n`: `order[k]` is eliminated k-th. Near-linear in time for chains.
///
/// # Panics
/// If an index is not in `0..n`, or `blocks` is not as described.
///
/// [`Pattern`]: super::Pattern
#[inline]
pub fn groups_first(
    n_first: usize,
    n: usize,
    entries: &[(usize, usize)],
    blocks: Option<&[usize]>,
) -> Vec<usize> {
    let single: Vec<usize>;
    let starts = match blocks {
        Some(starts) => starts,
        None => {
            single = (0..n).list();
            &single
        }
    };
    check_blocks(starts, n_first, n);
    let end = |b: usize| starts.get(b + 1).copied().unwrap_or(n);
    let mut graph = Graph::new(starts, n_first, n, entries);
    let mut order = Vec::with_capacity(n);
    while let Some(block) = graph.next() {
        order.extend(starts[block]..end(block));
        graph.eliminate(block);
    }
    order
}

/// Order in which `n` blocks are eliminated. Each block from `n_first` on comes after all those of the first
/// `n_first` blocks with which it shares an entry, but need not come after the others.
///
/// For [S Gᵀ; G 0] with a definite S this is as safe as [`groups_first`]. The pivot of a row of G is a Schur
/// complement of only those unknowns that its constraint touches. If the unknowns are coupled along a chain, the cost
/// remains linear. With all unknowns first, G S⁻¹ Gᵀ would be dense.
///
/// `entries` are structural positions (block, block) of one triangle.
///
/// # Panics
/// If an index is not in `0..n`.
pub fn touched_first(n_first: usize, n: usize, entries: &[(usize, usize)]) -> Vec<usize> {
    let starts: Vec<usize> = (0..n).list();
    let mut graph = Graph::new(&starts, n_first, n, entries);
    graph.release(n_first);
    let mut order = Vec::with_capacity(n);
    while let Some(block) = graph.next() {
        order.push(block);
        graph.eliminate(block);
    }
    order
}

fn check_blocks(starts: &[usize], n_first: usize, n: usize) {
    assert!(n_first <= n, "n_first = {n_first} exceeds n = {n}");
    assert!(n == 0 || starts.first() == Some(&0), "the first block begins at 0");
    assert!(starts.windows(2).all(|w| w[0] < w[1]), "blocks ascend");
    assert!(starts.last().is_none_or(|&last| last < n), "a block begins at or after n = {n}");
    let boundary = n_first == n || starts.binary_search(&n_first).is_ok();
    assert!(boundary, "n_first = {n_first} cuts a block");
}

/// (turn, approximate degree, block). The block with the smallest key is eliminated next. Blocks of the second set have
/// a later turn, or those that wait for others.
type Key = (u8, usize, usize);

/// The quotient graph: blocks not yet eliminated, and elements (cliques left by eliminated blocks).
struct Graph {
    weight: Vec<usize>,
    /// Blocks adjacent through original entries that no element covers yet.
    neighbours: Vec<Vec<usize>>,
    /// The elements to which a block belongs.
    elements: Vec<Vec<usize>>,
    /// The blocks of an element; empty once the element is absorbed into a newer element.
    members: Vec<Vec<usize>>,
    member_weight: Vec<usize>,
    absorbed: Vec<bool>,
    key: Vec<Key>,
    done: Vec<bool>,
    queue: BinaryHeap<Reverse<Key>>,
    mark: Vec<usize>,
    /// Weight of an element outside the newest element. Valid if `outside_of` is the newest element.
    outside: Vec<usize>,
    outside_of: Vec<usize>,
    /// For each block of the first set, the blocks that wait for it; and for how many blocks each block waits. Empty
    /// if every block of the second set waits for the whole first set.
    waiters: Vec<Vec<usize>>,
    waits_for: Vec<usize>,
}

const NOBODY: usize = usize::MAX;

impl Graph {
    fn new(starts: &[usize], n_first: usize, n: usize, entries: &[(usize, usize)]) -> Self {
        let count = starts.len();
        let mut block_of = vec![0; n];
        let mut weight = vec![0; count];
        for (b, &start) in starts.iter().enumerate() {
            let end = starts.get(b + 1).copied().unwrap_or(n);
            block_of[start..end].fill(b);
            weight[b] = end - start;
        }
        let neighbours = adjacency(count, entries, &block_of);
        let key: Vec<Key> = (0..count)
            .map(|b| {
                let degree = neighbours[b].iter().map(|&v| weight[v]).sum();
                (u8::from(starts[b] >= n_first), degree, b)
            })
            .list();
        let queue = key.iter().copied().map(Reverse).collect();
        Self {
            weight,
            neighbours,
            elements: vec![Vec::new(); count],
            members: vec![Vec::new(); count],
            member_weight: vec![0; count],
            absorbed: vec![false; count],
            key,
            done: vec![false; count],
            queue,
            mark: vec![NOBODY; count],
            outside: vec![0; count],
            outside_of: vec![NOBODY; count],
            waiters: Vec::new(),
            waits_for: Vec::new(),
        }
    }

    /// Lets each block from `n_first` on wait only for its own neighbours in the first set.
    fn release(&mut self, n_first: usize) {
        self.waits_for = vec![0; self.weight.len()];
        self.waiters = vec![Vec::new(); n_first];
        for (b, waits_for) in self.waits_for.iter_mut().enumerate().skip(n_first) {
            for &first in self.neighbours[b].iter().filter(|&&v| v < n_first) {
                self.waiters[first].push(b);
                *waits_for += 1;
            }
            self.key[b].0 = u8::from(*waits_for > 0);
        }
        self.queue = self.key.iter().copied().map(Reverse).collect();
    }

    /// The block to eliminate next. Outdated keys in the queue are skipped.
    fn next(&mut self) -> Option<usize> {
        while let Some(Reverse(key)) = self.queue.pop() {
            let block = key.2;
            if !self.done[block] && self.key[block] == key {
                return Some(block);
            }
        }
        None
    }

    fn eliminate(&mut self, p: usize) {
        self.done[p] = true;
        let members = self.gather(p);
        let total: usize = members.iter().map(|&i| self.weight[i]).sum();
        if let Some(waiters) = self.waiters.get_mut(p) {
            for b in std::mem::take(waiters) {
                self.waits_for[b] -= 1;
                self.key[b].0 = u8::from(self.waits_for[b] > 0);
                self.queue.push(Reverse(self.key[b]));
            }
        }
        for &i in &members {
            self.detach(i, p);
        }
        for &i in &members {
            self.update_key(i, total);
            self.elements[i].push(p);
        }
        self.member_weight[p] = total;
        self.members[p] = members;
    }

    /// The blocks adjacent to p, directly or through an element. These elements are absorbed.
    fn gather(&mut self, p: usize) -> Vec<usize> {
        self.mark[p] = p;
        let mut found = std::mem::take(&mut self.neighbours[p]);
        for &i in &found {
            self.mark[i] = p;
        }
        for e in std::mem::take(&mut self.elements[p]) {
            self.absorbed[e] = true;
            for i in std::mem::take(&mut self.members[e]) {
                if self.mark[i] != p {
                    self.mark[i] = p;
                    found.push(i);
                }
            }
        }
        found
    }

    /// Removes the entries of i that the new element p covers, and subtracts i from the outside weights of the other
    /// elements.
    fn detach(&mut self, i: usize, p: usize) {
        let (absorbed, mark) = (&self.absorbed, &self.mark);
        self.elements[i].retain(|&e| !absorbed[e]);
        self.neighbours[i].retain(|&v| mark[v] != p);
        for &e in &self.elements[i] {
            if self.outside_of[e] != p {
                self.outside_of[e] = p;
                self.outside[e] = self.member_weight[e];
            }
            self.outside[e] -= self.weight[i];
        }
    }

    /// Approximate external degree (eq. 4.3 of the paper).
    fn update_key(&mut self, i: usize, total: usize) {
        let (second, old, _) = self.key[i];
        let clique = total - self.weight[i];
        let direct: usize = self.neighbours[i].iter().map(|&v| self.weight[v]).sum();
        let through: usize = self.elements[i].iter().map(|&e| self.outside[e]).sum();
        let degree = (direct + clique + through).min(old + clique);
        self.key[i] = (second, degree, i);
        self.queue.push(Reverse(self.key[i]));
    }
}

/// Sorted neighbours of each block, without the block itself.
fn adjacency(count: usize, entries: &[(usize, usize)], block_of: &[usize]) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); count];
    for &(row, column) in entries {
        let (a, b) = (block_of[row], block_of[column]);
        if a != b {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}
