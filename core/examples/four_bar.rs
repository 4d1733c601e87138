//! A four-bar linkage with a rotational spring-damper: assembly, motion, joint reactions, energy balance.
//!
//! `cargo run --release --example four_bar`

use kempe::forces::TorsionSpring;
use kempe::joints::Revolute;
use kempe::{assemble, dynamics, Flow, Frame, Model, ModelBuilder, Options, Problems, Start};
use std::error::Error;

fn four_bar() -> Result<Model, Problems> {
    let mut m = ModelBuilder::new("Four-bar linkage with a rotational spring-damper");
    m.gravity(0.0, -9.81);
    m.parameter("L1", 10).parameter("L2", 26).parameter("L3", 18).parameter("G", 20);
    m.parameter("k", 1e6).parameter("c", 1e4);
    m.ground().point("A", 0, 0).point("D", "G", 0);
    m.bar("crank").mass(3).length("L1").ends("A", "B");
    m.bar("coupler").mass(5).length("L2").ends("B", "C");
    m.bar("rocker").mass(4).length("L3").ends("C", "D");
    for (name, i, j) in [
        ("A", "ground.A", "crank.A"),
        ("B", "crank.B", "coupler.B"),
        ("C", "coupler.C", "rocker.C"),
        ("D", "ground.D", "rocker.D"),
    ] {
        m.add(name, Revolute::written().i(i).j(j));
    }
    let spring = TorsionSpring::written().i("ground").j("rocker").stiffness("k").damping("c");
    m.add("spring", spring.free_angle("270*deg"));
    m.build()
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = four_bar()?;
    let start = Start::new()
        .set("crank.angle", "70*deg")
        .guess("coupler.angle", "14*deg")
        .guess("rocker.angle", "240*deg");
    let (state, report) = assemble(&model, &start.request(&model)?)?;
    println!("degrees of freedom: {}", report.degrees_of_freedom);

    let options = Options { output_step: Some(0.01), ..Options::new(15.0) };
    let run = dynamics(&model, &state, &options, |_| Flow::Continue)?;
    println!("{} steps in {:.1} ms", run.statistics.steps, 1e3 * run.statistics.seconds);

    let rocker = run.coordinate(&model, "rocker.angle")?;
    println!("\n     t   rocker    reaction on the coupler at C (global frame)");
    println!("     s        °             N             N");
    let at_c = run.reactions(&model, "C", "coupler", Frame::Global)?;
    for ((t, angle), reaction) in run.trajectory.t.iter().zip(&rocker).zip(&at_c).step_by(100) {
        let (angle, force) = (angle.to_degrees(), reaction.force);
        println!("{t:6.2} {angle:8.3} {:13.3} {:13.3}", force.x, force.y);
    }

    // kinetic, potential, dissipated energy, work of drivers, work of applied forces
    let energies = run.energies(&model)?;
    let balance = |e: &[f64]| e[0] + e[1] + e[2] - e[3] - e[4];
    let rows: Vec<f64> = energies.chunks(5).map(balance).collect();
    let off = rows.iter().fold(0.0_f64, |worst, row| worst.max((row - rows[0]).abs()));
    println!("\nlargest error of the energy balance: {off:.3} J");
    Ok(())
}
