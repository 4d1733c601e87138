//! Time the integrators themselves take per evaluation: 18 states, a derivative that costs nothing.

use kempe::integrate::{FirstOrder, Flow, Method, Rk4, Rk45, Step};
use std::hint::black_box;
use std::time::Instant;

struct Idle;

impl FirstOrder for Idle {
    type Stop = ();
    fn len(&self) -> usize {
        18
    }
    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), ()> {
        dy.copy_from_slice(black_box(y));
        Ok(())
    }
}

fn time(name: &str, method: &impl Method) {
    let mut y = [1e-9; 18];
    let start = Instant::now();
    let done = method
        .integrate(&mut Idle, 0.0, 1.0, &mut y, &mut |_: &Step<'_>| Flow::Continue)
        .expect("a smooth system");
    let each = start.elapsed().as_secs_f64() * 1e9 / done.evaluations as f64;
    println!("{name}: {} steps, {each:.0} ns per evaluation", done.steps);
}

fn main() {
    for _ in 0..3 {
        time("rk45", &Rk45 { max_step: 2e-6, ..Rk45::default() });
        time("rk4", &Rk4::new(2e-6));
    }
}
