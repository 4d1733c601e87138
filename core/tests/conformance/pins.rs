//! Evaluations put joints of two rows into the matrix as they come, and condense grounded bodies: the results must be
//! those of the full matrices.

use crate::mechanisms::{model, Random, FOUR_BAR};
use kempe::equations::augmented::Augmented;
use kempe::equations::{constraints, dense, kinematics, Gains, Residuals, Workspace};
use kempe::model::{row_scales, Model};

/// Pins among frames on and off the mass centre, on ground from both sides, beside a slide, and a driven body.
const MIXED: &str = r#"
gravity = [0.3, -9.81]
[bodies.ground]
points = { A = [0, 0], D = [2, 0.1], S = [3, 0] }
[bodies.crank]
mass = 1.5
inertia = 0.2
center = [0.3, -0.1]
points = { A = [0, 0], B = [0.6, 0] }
[bodies.coupler]
mass = 2
inertia = 0.4
points = { B = [-0.8, 0], C = [0.9, 0.1], E = [0.2, 0.5] }
[bodies.rocker]
mass = 1
inertia = 0.1
center = [0.2, 0.2]
points = { C = [1, 0], D = [0, 0] }
[bodies.rod]
mass = 0.7
inertia = 0.05
points = { E = [-0.5, 0], S = [0.5, 0] }
[bodies.slider]
mass = 0.4
inertia = 0.02
points = { S = [0, 0] }
[joints.A]
type = "revolute"
i = "crank.A"
j = "ground.A"
[joints.B]
type = "revolute"
i = "crank.B"
j = "coupler.B"
[joints.C]
type = "revolute"
i = "rocker.C"
j = "coupler.C"
[joints.D]
type = "revolute"
i = "ground.D"
j = "rocker.D"
[joints.E]
type = "revolute"
i = "coupler.E"
j = "rod.E"
[joints.S]
type = "revolute"
i = "rod.S"
j = "slider.S"
[joints.slide]
type = "translational"
i = "ground.S"
j = "slider.S"
"#;

fn mechanisms() -> [Model; 3] {
    let driven = format!(
        "{MIXED}[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\n\
         value = \"0.4 + 3 * t\"\n"
    );
    [model(FOUR_BAR), model(MIXED), model(&driven)]
}

fn close(a: &[f64], b: &[f64], what: &str) {
    let largest = b.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= 1e-9 * largest, "{what}: {a} and {b} of {largest}");
    }
}

/// M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ̂ in full matrices, at random states.
#[test]
fn accelerations_solve_the_equations_in_full() {
    let gains = Gains { alpha: 3.0, beta: 7.0 };
    for model in mechanisms() {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let mut numbers = Random::new(11);
        for _ in 0..5 {
            let (q, v) = (numbers.many(n), numbers.many(n));
            let mut workspace = Workspace::new(&model);
            workspace
                .accelerate(&model, 0.2, [&q, &v, &[]], gains)
                .expect("random states are regular");
            let full = dense::matrices(&model, 0.2, [&q, &v, &[]]);
            let (mut phi, mut rate, mut gamma) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
            let motions = &workspace.motions;
            constraints::velocity_terms(&model, motions, 0.2, &mut phi, &mut rate, &mut gamma);
            let hat = (0..m).map(|r| gamma[r] - 6.0 * rate[r] - 49.0 * phi[r]);
            let right: Vec<f64> = full.forces.iter().copied().chain(hat).collect();
            let x = [workspace.a(), workspace.lam()].concat();
            let times = |row: &[f64]| row.iter().zip(&x).map(|(k, x)| k * x).sum();
            let left: Vec<f64> = full.kkt.chunks_exact(n + m).map(times).collect();
            close(&left, &right, "K x = b");
        }
    }
}

/// An evaluation leaves all entries of Φ_q.
#[test]
fn an_evaluation_leaves_the_entries() {
    for model in mechanisms() {
        let n = model.layout.n_q;
        let mut numbers = Random::new(12);
        let (q, v) = (numbers.many(n), numbers.many(n));
        let mut workspace = Workspace::new(&model);
        workspace
            .accelerate(&model, 0.0, [&q, &v, &[]], Gains::default())
            .expect("a regular state");
        let mut entries = vec![0.0; model.layout.n_entries];
        constraints::jacobian(&model, &workspace.motions, 0.0, &mut entries);
        close(workspace.matrix.jacobian(), &entries, "Φ_q");
    }
}

/// The residuals and entries of projection, computed in one pass, equal those of the single constraints.
#[test]
fn residuals_are_those_of_the_constraints() {
    for model in mechanisms() {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let mut numbers = Random::new(15);
        let (q, v) = (numbers.many(n), numbers.many(n));
        let mut workspace = Workspace::new(&model);
        workspace
            .accelerate(&model, 0.2, [&q, &v, &[]], Gains::default())
            .expect("a regular state");
        let motions = &workspace.motions;
        let mut residuals = Residuals::new(&model);
        let gaps = residuals.look((&model, &workspace.compiled), motions, 0.2, &[]);
        let (mut phi, mut rate, mut gamma) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
        constraints::velocity_terms(&model, motions, 0.2, &mut phi, &mut rate, &mut gamma);
        for ((rows, expected), gap) in residuals.rows.iter().zip([&phi, &rate]).zip(gaps) {
            close(rows, expected, "Φ or Φ̇");
            let scaled = expected.iter().zip(row_scales(&model)).map(|(x, scale)| x.abs() / scale);
            close(&[gap], &[scaled.fold(0.0, f64::max)], "the largest");
        }
        let mut entries = vec![0.0; model.layout.n_entries];
        constraints::jacobian(&model, motions, 0.2, &mut entries);
        residuals.jacobian(&model, motions, 0.2, workspace.matrix.jacobian_mut());
        close(workspace.matrix.jacobian(), &entries, "Φ_q");
    }
}

/// The factor that an evaluation leaves solves as one of the entries does.
#[test]
fn the_factor_of_an_evaluation_serves_other_right_sides() {
    for model in mechanisms() {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let mut numbers = Random::new(14);
        let (q, v, b) = (numbers.many(n), numbers.many(n), numbers.many(n + m));
        let mut workspace = Workspace::new(&model);
        workspace
            .accelerate(&model, 0.0, [&q, &v, &[]], Gains::default())
            .expect("a regular state");
        let motions = kinematics::Motions::at(&model.layout, &q, &v);
        let mut matrix = Augmented::new(&model);
        constraints::jacobian(&model, &motions, 0.0, matrix.jacobian_mut());
        matrix.set_mass(&workspace.compiled, &motions);
        matrix.factor().expect("a regular state");
        let (mut found, mut wanted) = (b.clone(), b);
        workspace.matrix.solve(&mut found);
        matrix.solve(&mut wanted);
        close(&found, &wanted, "x");
    }
}
