//! A motion by every method, and scalar equations that are integrated here.

use kempe::analyses::dynamics::{dynamics, Auto, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau, Rk4, Rk45};
use kempe::model::Model;
use kempe::stabilize::Projection;

/// Every method with its accuracy here.
pub fn all() -> Vec<(Scheme, Stabilization, f64)> {
    let projection = Stabilization::Projection(Projection::default());
    let baumgarte = Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 10.0 });
    let mut alpha = GeneralizedAlpha::new(AlphaParameters::chung_hulbert(0.8), 1e-6, 1e-9);
    alpha.control.step = Some(1.25e-4);
    vec![
        (Scheme::Rk45(Rk45::new(1e-9, 1e-12)), baumgarte, 1e-7),
        (Scheme::Dop853(Dop853::new(1e-10, 1e-13)), projection, 1e-8),
        (Scheme::Rk4(Rk4::new(1e-3)), projection, 1e-8),
        (Scheme::GeneralizedAlpha(alpha), projection, 3e-6),
        (Scheme::Radau(Radau::new(1e-9, 1e-12)), projection, 1e-7),
        (Scheme::Auto(Auto::default()), projection, 1e-6),
    ]
}

/// The last state of a run by each method.
pub fn ends(model: &Model, state: &State, t_end: f64, mut look: impl FnMut(&str, &Run, f64)) {
    for (method, stabilization, accuracy) in all() {
        let name = format!("{method:?}");
        let options = Options { method, stabilization, ..Options::new(t_end) };
        let outcome = dynamics(model, state, &options, |_| Flow::Continue);
        let run = outcome.unwrap_or_else(|failure| panic!("{name}: {}", failure.reason));
        look(&name, &run, accuracy);
    }
}

/// The last row of a table.
pub fn last(table: &[f64], width: usize) -> &[f64] {
    &table[table.len() - width..]
}

/// y′ = f(y) from 0 to `t` by the classical Runge–Kutta method with 20 000 steps.
pub fn integrated<const N: usize>(
    mut y: [f64; N],
    t: f64,
    f: impl Fn([f64; N]) -> [f64; N],
) -> [f64; N] {
    let h = t / 20_000.0;
    let moved =
        |y: [f64; N], k: [f64; N], h: f64| -> [f64; N] { std::array::from_fn(|i| y[i] + h * k[i]) };
    for _ in 0..20_000 {
        let k1 = f(y);
        let k2 = f(moved(y, k1, h / 2.0));
        let k3 = f(moved(y, k2, h / 2.0));
        let k4 = f(moved(y, k3, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}
