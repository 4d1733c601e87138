use kempe::analyses::dynamics::*;
use kempe::analyses::{assemble, State};
use kempe::case;
use kempe::integrate::*;
use kempe::model::{build, Model, Value};
use kempe::stabilize::Projection;
#[path = "../benches/mechanisms/mod.rs"]
mod mechanisms;
fn stiff(c: f64) -> (Model, State) {
    let text = mechanisms::FLAGSHIP;
    let (case, _) = case::read(text, case::Format::Toml).expect("");
    let model = build(&case.definition, &[("c".to_string(), Value::from(c))]).expect("");
    let set = assemble::wishes(&model, "set", &case.start.set).expect("");
    let guess = assemble::wishes(&model, "guess", &case.start.guess).expect("");
    let request = assemble::Request { set, guess, ..Default::default() };
    let (state, _) = assemble::assemble(&model, &request).expect("");
    (model, state)
}
fn go(name: &str, m: &Model, s: &State, t_end: f64, schemes: Vec<(String, Scheme)>) {
    let opt = |scheme: Scheme| Options {
        output: Output::Every(0.01),
        scheme,
        stabilization: Stabilization::Projection(Projection::default()),
        dense_output: false,
        ..Options::new(t_end)
    };
    let exact = dynamics(m, s, &opt(schemes[0].1.clone()), |_| Flow::Continue);
    let exact = match exact {
        Ok(r) => r,
        Err(f) => {
            println!("{name} exact: {}", f.reason);
            f.run
        }
    };
    println!("{name}: exact {:?}", exact.statistics);
    for (told, scheme) in &schemes[1..] {
        let bare = Options { output: Output::Every(t_end), ..opt(scheme.clone()) };
        match dynamics(m, s, &opt(scheme.clone()), |_| Flow::Continue) {
            Ok(r) => {
                let mut e = [0.0f64; 3];
                for (k, (a, b)) in [
                    (&r.trajectory.q, &exact.trajectory.q),
                    (&r.trajectory.v, &exact.trajectory.v),
                    (&r.trajectory.lam, &exact.trajectory.lam),
                ]
                .into_iter()
                .enumerate()
                {
                    e[k] = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                }
                let mut ms: Vec<f64> = (0..5)
                    .map(|_| {
                        dynamics(m, s, &bare, |_| Flow::Continue).unwrap().statistics.seconds * 1e3
                    })
                    .collect();
                ms.sort_by(f64::total_cmp);
                if let Some(choice) = &r.choice {
                    println!("  {} {}", choice.method, choice.why);
                }
                let s = r.statistics;
                println!("{told:<24} steps {:>6} rej {:>4} eval {:>6} jac {:>5} newton {:>6} fact {:>6} | q {:.1e} v {:.1e} lam {:.1e} | {:.2} ms {:.2} us/step", s.steps, s.rejected, s.evaluations, s.jacobians, s.iterations, s.factorisations, e[0], e[1], e[2], ms[2], 1e3*ms[2]/s.steps as f64);
            }
            Err(f) => println!("{told:<24} FAILED {} {:?}", f.reason, f.run.statistics),
        }
    }
}
fn schemes(first: Scheme) -> Vec<(String, Scheme)> {
    let mut out = vec![("exact".to_string(), first)];
    for rtol in [1e-3] {
        out.push((
            format!("alpha 0.8 {rtol:.0e}"),
            Scheme::GeneralizedAlpha(GeneralizedAlpha::new(
                AlphaParameters::chung_hulbert(0.8),
                rtol,
                1e-3 * rtol,
            )),
        ));
    }
    for rtol in [1e-3, 1e-4, 1e-6, 1e-8, 1e-10] {
        out.push((format!("radau {rtol:.0e}"), Scheme::Radau(Radau::new(rtol, 1e-3 * rtol))));
    }
    out.push(("auto".to_string(), Scheme::Auto(Auto::new())));
    for rtol in [1e-3, 1e-6, 1e-8] {
        out.push((format!("dop853 {rtol:.0e}"), Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol))));
    }
    out
}
fn main() {
    let dop = Scheme::Dop853(Dop853::new(1e-12, 1e-14));
    for (name, c, t) in [
        ("flagship", 1e4, 15.0),
        ("flagship c=1e6", 1e6, 2.0),
        ("flagship c=1e7", 1e7, 0.5),
        ("flagship c=1e7", 1e7, 15.0),
        ("flagship c=1e8", 1e8, 1.0),
    ] {
        let (m, s) = stiff(c);
        go(name, &m, &s, t, schemes(dop.clone()));
    }
    if std::env::args().nth(1).is_none() {
        return;
    }
    for n in [10, 100] {
        let (m, s) = mechanisms::chain(n);
        let clock = std::time::Instant::now();
        let _ = kempe::equations::tangent::Tangent::new(&m);
        println!("tangent made in {:?}", clock.elapsed());
        go(&format!("chain {n}"), &m, &s, 0.1, schemes(dop.clone()));
    }
}
