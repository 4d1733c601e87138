//! A state of a model: plain data.

/// Time, coordinates, velocities, and the first-order states of elements.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Time, s.
    pub t: f64,
    /// Coordinates x, y, angle of each moving body, shape (n_q).
    pub q: Vec<f64>,
    /// Rates of the coordinates, shape (n_q).
    pub v: Vec<f64>,
    /// First-order states of elements; empty for most models.
    pub z: Vec<f64>,
}
