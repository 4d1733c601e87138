//! Vectors and rotations in space, and the plane of a mechanism.

/// A vector in space.
pub(crate) type Vector = [f64; 3];
/// A rotation, by rows; its columns are the axes of the turned frame.
pub(crate) type Rotation = [Vector; 3];

/// The frame that is not turned.
pub(crate) const UNTURNED: Rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    plus(a, times(-1.0, b))
}

pub(crate) fn times(factor: f64, a: Vector) -> Vector {
    a.map(|x| factor * x)
}

/// The vector with length 1; `None` for the zero vector.
pub(crate) fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    (length > 1e-12).then(|| times(1.0 / length, a))
}

/// The vector `a` of the turned frame in the fixed frame.
pub(crate) fn turned(by: &Rotation, a: Vector) -> Vector {
    [dot(by[0], a), dot(by[1], a), dot(by[2], a)]
}

/// The axis of a turned frame: 0 for x, 1 for y, 2 for z.
pub(crate) fn axis(of: &Rotation, k: usize) -> Vector {
    [of[0][k], of[1][k], of[2][k]]
}

/// First the rotation `b`, then `a`.
pub(crate) fn product(a: &Rotation, b: &Rotation) -> Rotation {
    let columns = [0, 1, 2].map(|k| turned(a, axis(b, k)));
    [0, 1, 2].map(|row| [columns[0][row], columns[1][row], columns[2][row]])
}

/// The rotation of Bryant's angles: about x, then about the new y, then about the new z.
pub(crate) fn bryant(angles: Vector) -> Rotation {
    let [(sx, cx), (sy, cy), (sz, cz)] = angles.map(f64::sin_cos);
    let x = [[1.0, 0.0, 0.0], [0.0, cx, -sx], [0.0, sx, cx]];
    let y = [[cy, 0.0, sy], [0.0, 1.0, 0.0], [-sy, 0.0, cy]];
    let z = [[cz, -sz, 0.0], [sz, cz, 0.0], [0.0, 0.0, 1.0]];
    product(&product(&x, &y), &z)
}

/// Largest sine of the angle between directions that count as parallel.
const PARALLEL: f64 = 1e-5;

/// A direction beside the normal of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lie {
    /// Along the normal (1) or against it (-1).
    Normal(f64),
    /// In the plane, at this angle from the x axis.
    Inside(f64),
    /// Neither.
    Oblique,
}

/// A plane in space with its axes; x and y become those of kempe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub(crate) x: Vector,
    pub(crate) y: Vector,
    pub(crate) normal: Vector,
}

impl Plane {
    /// The plane with this normal, or the opposite one. The xy plane keeps its axes. In all others, y is the direction
    /// nearest to the z axis of the file, and x the one that has its largest component positive.
    pub(crate) fn across(normal: Vector) -> Self {
        let up = [0.0, 0.0, 1.0];
        let Some(y) = unit(minus(up, times(dot(up, normal), normal)))
            .filter(|_| dot(cross(up, normal), cross(up, normal)) > PARALLEL * PARALLEL)
        else {
            return Self { x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0], normal: up };
        };
        let x = cross(y, normal);
        let largest = x.iter().fold(0.0_f64, |a, b| if b.abs() > a.abs() + 1e-9 { *b } else { a });
        let sign = if largest < 0.0 { -1.0 } else { 1.0 };
        Self { x: times(sign, x), y, normal: times(sign, normal) }
    }

    /// The two components of a vector.
    pub(crate) fn flat(&self, a: Vector) -> [f64; 2] {
        [dot(self.x, a), dot(self.y, a)]
    }

    /// The component across the plane.
    pub(crate) fn across_of(&self, a: Vector) -> f64 {
        dot(self.normal, a)
    }

    /// How a unit vector lies.
    pub(crate) fn lie(&self, a: Vector) -> Lie {
        let (across, [x, y]) = (self.across_of(a), self.flat(a));
        if x.hypot(y) < PARALLEL {
            Lie::Normal(across.signum())
        } else if across.abs() < PARALLEL {
            Lie::Inside(y.atan2(x))
        } else {
            Lie::Oblique
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_right_handed_and_show_what_is_up() {
        for normal in [
            [0.0, 0.0, -1.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.6, -0.8, 0.0],
            [0.36, 0.48, 0.8],
        ] {
            let plane = Plane::across(normal);
            let error = minus(cross(plane.x, plane.y), plane.normal);
            assert!(dot(error, error).sqrt() < 1e-14, "{plane:?}");
            assert!((dot(plane.normal, normal).abs() - 1.0).abs() < 1e-14);
            assert!(plane.y[2] > 0.0 || plane.y == [0.0, 1.0, 0.0]);
        }
    }

    #[test]
    fn bryant_angles_turn_about_x_then_y_then_z() {
        let turn = bryant([-std::f64::consts::FRAC_PI_2, 0.0, 0.0]);
        assert!((turn[1][2] - 1.0).abs() < 1e-15 && (turn[2][1] + 1.0).abs() < 1e-15);
    }
}
