//! First-order states of an element, and its powers beside those of its wrenches.

/// A first-order state of an element, such as the current of a motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnState {
    /// Name within the element: `motor.current`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
}

/// Powers of an element in addition to those of its wrenches, W; for example, those of a circuit.
#[derive(Clone, Copy, Debug)]
pub struct OwnPowers<S> {
    /// Dissipated.
    pub dissipated: S,
    /// Supplied from outside.
    pub applied: S,
}
