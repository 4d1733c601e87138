//! Lists from iterators, in little code.
//!
//! `Iterator::collect` and `Vec::extend` compile about three hundred instructions for every place that uses them: they
//! choose between several ways to reserve memory and to fill it. The loop here is compiled once for every type. It is
//! too slow for kernels.

/// Iterators whose items become a list.
pub(crate) trait Listed: Iterator + Sized {
    /// All items.
    fn list(mut self) -> Vec<Self::Item> {
        list_of(&mut self)
    }

    /// Appends all items to a list.
    fn append_to(mut self, all: &mut Vec<Self::Item>) {
        append(all, &mut self);
    }
}

impl<I: Iterator> Listed for I {}

/// The function `next` of an iterator. With `dyn Iterator`, its other functions would be compiled too.
trait Successor<T> {
    fn next_item(&mut self) -> Option<T>;
}

impl<I: Iterator> Successor<I::Item> for I {
    fn next_item(&mut self) -> Option<I::Item> {
        self.next()
    }
}

fn list_of<T>(items: &mut dyn Successor<T>) -> Vec<T> {
    let mut all = Vec::new();
    append(&mut all, items);
    all
}

fn append<T>(all: &mut Vec<T>, items: &mut dyn Successor<T>) {
    while let Some(item) = items.next_item() {
        all.push(item);
    }
}
