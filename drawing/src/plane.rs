//! Points in the plane, and positions of the points of a body.

/// x and y, in m or in points of print.
pub type At = [f64; 2];

/// x and y in m, and the angle in rad, of a body.
pub type Pose = [f64; 3];

/// The global position r + A(φ) s of the point s of a body.
pub fn placed([x, y, angle]: Pose, [along, aside]: At) -> At {
    let (sin, cos) = angle.sin_cos();
    [x + cos * along - sin * aside, y + sin * along + cos * aside]
}

/// The unit vector at an angle.
pub fn direction(angle: f64) -> At {
    let (sin, cos) = angle.sin_cos();
    [cos, sin]
}

/// A vector rotated by +90°.
pub fn left_of([x, y]: At) -> At {
    [-y, x]
}

/// a - b, componentwise.
pub fn minus(a: At, b: At) -> At {
    [a[0] - b[0], a[1] - b[1]]
}

/// a + factor b.
pub fn ahead(a: At, factor: f64, b: At) -> At {
    [a[0] + factor * b[0], a[1] + factor * b[1]]
}

/// The scalar product.
pub fn dot(a: At, b: At) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The length of a vector.
pub fn size([x, y]: At) -> f64 {
    x.hypot(y)
}

/// A box around points: smallest x and y, largest x and y.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Smallest x and y.
    pub low: At,
    /// Largest x and y.
    pub high: At,
}

impl Extent {
    /// The box around no points.
    pub const NOTHING: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    /// The box around some points.
    pub fn of(points: impl IntoIterator<Item = At>) -> Self {
        let mut found = Self::NOTHING;
        points.into_iter().for_each(|at| found.include(at, 0.0));
        found
    }

    /// Enlarges the box to contain a circle.
    pub fn include(&mut self, at: At, radius: f64) {
        for (k, x) in at.into_iter().enumerate() {
            self.low[k] = self.low[k].min(x - radius);
            self.high[k] = self.high[k].max(x + radius);
        }
    }

    /// The longer side; 0 for the box around no points.
    pub fn size(&self) -> f64 {
        let [x, y] = minus(self.high, self.low);
        x.max(y).max(0.0)
    }
}
