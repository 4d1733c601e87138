//! Stable order of lists, compiled once for all comparisons.

use super::list::Listed;
use std::cmp::Ordering;

/// Lists that can be put in order.
pub(crate) trait Ordered<T> {
    /// Puts the items in the order of the comparison. Equal ones keep their order.
    fn order_by(&mut self, compare: impl Fn(&T, &T) -> Ordering);
    /// Puts the items in the order of their keys. Equal ones keep their order.
    fn order_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
}

impl<T> Ordered<T> for [T] {
    fn order_by(&mut self, compare: impl Fn(&T, &T) -> Ordering) {
        let from = permutation(self.len(), &|i, j| compare(&self[i], &self[j]));
        permute(self, from);
    }

    fn order_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K) {
        let keys = self.iter().map(key).list();
        permute(self, permutation(keys.len(), &|i, j| keys[i].cmp(&keys[j])));
    }
}

/// Moves each item to its place, from its former index.
fn permute<T>(list: &mut [T], mut from: Vec<usize>) {
    for k in 0..from.len() {
        // an item that has moved is at the place to which its former place points
        while from[k] < k {
            from[k] = from[from[k]];
        }
        list.swap(k, from[k]);
    }
}

/// The former index of each item of the ordered list.
fn permutation(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut from: Vec<usize> = (0..count).collect();
    from.sort_by(|i, j| compare(*i, *j));
    from
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_is_the_one_of_the_standard_library() {
        let mut state = 1_u32;
        for count in 0..40 {
            let mut list = Vec::new();
            for k in 0..count {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                list.push((state >> 29, k));
            }
            let mut expected = list.clone();
            expected.sort_by_key(|(key, _)| *key);
            list.order_by_key(|(key, _)| *key);
            assert_eq!(list, expected);
        }
    }
}
