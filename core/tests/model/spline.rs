//! Splines against what defines them: the points, the smoothness, the ends, and polynomials that they reproduce.

use kempe::math::{Dual, Interpolation, Lanes, Real, Spline};

const X: [f64; 6] = [-0.4, 0.1, 0.9, 1.2, 2.3, 2.9];
const Y: [f64; 6] = [0.3, -0.8, 0.5, 0.9, 0.2, 0.3];

fn of(kind: Interpolation, periodic: bool) -> Spline {
    Spline::new(kind, periodic, &X, &Y)
}

fn at<const N: usize>(spline: &Spline, x: f64) -> [f64; N] {
    spline.derivatives(x, |c| c)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * (1.0 + a.abs().max(b.abs())), "{a} {b}");
}

#[test]
fn all_pass_through_their_points() {
    for kind in Interpolation::ALL {
        for periodic in [false, true] {
            let spline = of(kind, periodic);
            X.iter().zip(Y).for_each(|(x, y)| close(spline.value(*x, |c| c), y, 1e-14));
        }
    }
}

/// Derivatives on both sides of each inner knot, and of the seam of a periodic spline.
#[test]
fn smoothness_and_ends_are_as_declared() {
    let h = 1e-9;
    for (kind, smooth) in [
        (Interpolation::Linear, 0),
        (Interpolation::Monotone, 1),
        (Interpolation::Cubic, 2),
        (Interpolation::Quintic, 4),
    ] {
        for periodic in [false, true] {
            let spline = of(kind, periodic);
            for x in &X[1..5] {
                let (a, b) = (at::<6>(&spline, x - h), at::<6>(&spline, x + h));
                (0..=smooth).for_each(|n| close(a[n], b[n], 1e-5));
                assert!((a[smooth + 1] - b[smooth + 1]).abs() > 1e-2, "{kind:?}");
            }
            let (first, last) = (at::<6>(&spline, X[0] + h), at::<6>(&spline, X[5] - h));
            if periodic {
                (0..=smooth).for_each(|n| close(first[n], last[n], 1e-5));
                close(spline.value(X[0] + 0.7, |c| c), spline.value(X[5] + 0.7, |c| c), 1e-13);
            } else if kind == Interpolation::Cubic {
                close(first[2], 0.0, 1e-6);
                close(last[2], 0.0, 1e-6);
            } else if kind == Interpolation::Quintic {
                [first, last].iter().for_each(|d| close(d[3], 0.0, 1e-5));
                [first, last].iter().for_each(|d| close(d[4], 0.0, 1e-5));
            }
        }
    }
}

/// A quintic spline with natural ends reproduces parabolas, a cubic one straight lines.
#[test]
fn polynomials_are_reproduced() {
    let parabola = X.map(|x| 0.7 - 1.3 * x + 0.4 * x * x);
    let spline = Spline::new(Interpolation::Quintic, false, &X, &parabola);
    let line = X.map(|x| 0.7 - 1.3 * x);
    let cubic = Spline::new(Interpolation::Cubic, false, &X, &line);
    for x in [-0.3, 0.5, 1.0, 2.0, 2.8] {
        let [y, dy, ddy] = at(&spline, x);
        close(y, 0.7 - 1.3 * x + 0.4 * x * x, 1e-13);
        close(dy, -1.3 + 0.8 * x, 1e-12);
        close(ddy, 0.8, 1e-11);
        close(cubic.value(x, |c| c), 0.7 - 1.3 * x, 1e-14);
    }
}

/// The error of a periodic quintic spline of a sine falls with the sixth power of the width, of a cubic one
/// with the fourth.
#[test]
fn the_order_is_that_of_the_degree() {
    let error = |kind, n: usize| {
        let x: Vec<f64> = (0..=n).map(|k| std::f64::consts::TAU * k as f64 / n as f64).collect();
        let y: Vec<f64> = (0..=n).map(|k| x[k % n].sin()).collect();
        let spline = Spline::new(kind, true, &x, &y);
        (0..500)
            .map(|k| 0.0123 * f64::from(k))
            .fold(0.0_f64, |most, x| most.max((spline.value(x, |c| c) - x.sin()).abs()))
    };
    for (kind, order) in [(Interpolation::Cubic, 4.0), (Interpolation::Quintic, 6.0)] {
        let slope = (error(kind, 16) / error(kind, 32)).log2();
        assert!((slope - order).abs() < 0.3, "{kind:?}: {slope}");
    }
}

/// A monotone spline has no value beyond those of its neighbours.
#[test]
fn the_monotone_spline_does_not_overshoot() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0, 5.0], [0.0, 0.0, 1.0, 1.0, 4.0]);
    let spline = Spline::new(Interpolation::Monotone, false, &x, &y);
    for k in 0..=200 {
        let x = 0.025 * f64::from(k);
        let y = spline.value(x, |c| c);
        let range = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 4.0), (1.0, 4.0)][x as usize % 5];
        assert!(x >= 5.0 || (range.0 - 1e-15..=range.1 + 1e-15).contains(&y), "{x} {y}");
    }
}

#[test]
fn lanes_on_different_pieces_are_scalars() {
    for kind in Interpolation::ALL {
        for periodic in [false, true] {
            let spline = of(kind, periodic);
            let xs = [2.8, -0.9, 1.0, 0.1];
            let wide: [Lanes; 4] = spline.derivatives(Lanes::new(xs), Lanes::constant);
            for (lane, x) in xs.into_iter().enumerate() {
                let one = at::<4>(&spline, x);
                for n in 0..4 {
                    assert_eq!(wide[n].to_array()[lane].to_bits(), one[n].to_bits());
                }
            }
        }
    }
}

/// Derivatives to a point: the spline is solved over dual numbers.
#[test]
fn derivatives_to_a_point_are_differences() {
    for kind in Interpolation::ALL {
        let moved = |h: f64| {
            let mut y = Y;
            y[2] += h;
            Spline::new(kind, false, &X, &y).value(1.7, |c| c)
        };
        let x = X.map(Dual::<3>::constant);
        let mut y = Y.map(Dual::<3>::constant);
        y[2] = Dual::variable(Y[2], 0);
        let value = Spline::new(kind, false, &x, &y).value(Dual::constant(1.7), |c| c);
        close(value.slope[0], (moved(1e-6) - moved(-1e-6)) / 2e-6, 1e-8);
    }
}

/// The spline over numbers that is already solved must not replace points that have derivatives, at any size.
#[test]
fn a_solved_curve_keeps_the_derivatives_by_its_points() {
    use kempe::elements::{Curve, CurvePoints};
    use kempe::math::{Interpolation, Local};
    for size in [1e-3, 1.0, 1e3] {
        let points = |x: f64| {
            let all = [(0.0, 0.0), (1.0, 0.4), (x, 0.9), (3.1, 0.2), (4.0, 1.0)];
            all.map(|(x, y)| Local::new(size * x, size * y)).to_vec()
        };
        let curve =
            |x: f64| Curve::Points(CurvePoints::new(points(x), Interpolation::Cubic, false));
        let (plain, u) = (curve(2.2), 1.7 * size);
        let known = plain.point(u).x; // solves the spline
        let mut at = 0;
        let by_third = plain.map(&mut |x: &f64| {
            at += 1; // x and y of each point, in order
            match at {
                5 => Dual::<3> { value: *x, slope: [size, 0.0, 0.0] },
                _ => Dual::constant(*x),
            }
        });
        let found = by_third.point(Dual::constant(u)).x;
        let h = 1e-6;
        let difference = (curve(2.2 + h).point(u).x - curve(2.2 - h).point(u).x) / (2.0 * h);
        assert!((found.value - known).abs() < 1e-13 * size);
        assert!(difference.abs() > 0.1 * size);
        close(found.slope[0] / size, difference / size, 1e-7);
    }
}
