//! Pools of elements of one type, and the visitors that loop over them.

use super::force_trait::Force;
use super::joint_trait::Joint;

/// An element of a pool, with all data that the loop reads.
#[derive(Clone, Debug)]
pub struct Pooled<E> {
    /// The element.
    pub element: E,
    /// Its place in the model.
    pub place: Place,
}

/// The place of an element of a pool in the model.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its index among the constraints or forces.
    pub item: u32,
    /// Bodies i and j; ground where there are fewer.
    pub bodies: [u32; 2],
    /// Its first row of Φ; 0 for a force.
    pub row: u32,
    /// Its index in a list of the module that uses the pool.
    pub slot: u32,
}

impl Place {
    /// The place of an element among the constraints or forces, with its bodies and its first row.
    ///
    /// # Panics
    /// If a number exceeds 32 bits.
    pub fn new(item: usize, bodies: &[super::followed::BodyId], row: usize) -> Self {
        let index = |i: usize| u32::try_from(i).expect("fewer than 2^32 items");
        let body = |k: usize| bodies.get(k).map_or(0, |body| index(body.0));
        Self { item: index(item), bodies: [body(0), body(1)], row: index(row), slot: 0 }
    }

    /// The same place, with the index in the list of the module that uses the pool.
    pub fn with_slot(self, slot: usize) -> Self {
        Self { slot: u32::try_from(slot).expect("fewer than 2^32 items"), ..self }
    }
}

/// Visits the joints and drivers of a model, type by type.
pub trait VisitJoints<S> {
    /// Visits all elements of one type.
    fn visit<E: Joint>(&mut self, pool: &[Pooled<E::Over<S>>]);
}

/// Visits the forces of a model, type by type.
pub trait VisitForces<S> {
    /// Visits all elements of one type.
    fn visit<E: Force>(&mut self, pool: &[Pooled<E::Over<S>>]);
}
