//! Large mechanisms: ladders of unit squares, free bodies and chains.

use crate::mechanisms::{clock, close, count, largest, model, request, residual, start};
use kempe::analyses::assemble::{assemble, assemble_until, Fault, Request};
use kempe::analyses::mobility;
use std::cell::Cell;
use std::fmt::Write as _;
use std::time::Instant;

/// Rods on pins of ground, 1 m apart, with couplers between neighbours: `squares` unit squares in a row.
fn ladder(squares: usize) -> String {
    let mut text = String::from("[bodies.ground.points]\n");
    (0..=squares).for_each(|k| _ = writeln!(text, "G{k} = [{k}, 0]"));
    let mut bar = |name: String| {
        _ = writeln!(
            text,
            "[bodies.{name}]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = [\"A\", \"B\"]"
        );
    };
    (0..=squares).for_each(|k| bar(format!("rod{k}")));
    (0..squares).for_each(|k| bar(format!("link{k}")));
    let mut pin = |name: String, i: String, j: String| {
        _ = writeln!(text, "[joints.{name}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"");
    };
    (0..=squares).for_each(|k| pin(format!("P{k}"), format!("ground.G{k}"), format!("rod{k}.A")));
    for k in 0..squares {
        pin(format!("L{k}"), format!("rod{k}.B"), format!("link{k}.A"));
        pin(format!("R{k}"), format!("link{k}.B"), format!("rod{}.B", k + 1));
    }
    text
}

#[test]
fn ladders_assemble_unfolded() {
    for squares in [1, 2, 8, 255, 256, 257, 1000] {
        let m = model(&ladder(squares));
        let (state, report) = start(&m, &[("rod0.angle", "80*deg")], &[]);
        for k in 0..=squares {
            close("rod", state.q[3 * k + 2], 80_f64.to_radians(), 1e-9);
        }
        for k in squares + 1..2 * squares + 1 {
            close("link", state.q[3 * k + 2], 0.0, 1e-9);
        }
        assert!(largest(&residual(&m, &state)) < 1e-11);
        assert_eq!(report.degrees_of_freedom, 1);
        assert_eq!(report.modes.len(), squares);
        assert!(report.modes.iter().all(|mode| mode.folded == Some(false)));
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }
}

/// The number of other assemblies is 2^n - 1, if there is a number for it.
#[test]
fn other_assemblies_are_counted_without_overflow() {
    for (squares, others) in [(1, Some(1)), (8, Some(255)), (63, Some((1 << 63) - 1)), (64, None)] {
        let m = model(&ladder(squares));
        let (_, report) = start(&m, &[("rod0.angle", "80*deg")], &[]);
        assert_eq!(report.alternatives, others, "{squares} squares");
    }
}

/// A guess decides for the folded side, as the report shows. Rod 1 lies on ground and the links on rod 0; the other
/// rods are stretched, which is singular on the whole branch but not redundant.
#[test]
fn a_folded_ladder_is_singular_but_not_redundant() {
    // more than the 102 warnings that are reported
    for squares in [3, 30, count(110, 300) as usize] {
        let m = model(&ladder(squares));
        let (state, report) = start(&m, &[("rod0.angle", "80*deg")], &[("rod1.angle", "170*deg")]);
        close("rod1", state.q[5], 180_f64.to_radians(), 1e-7);
        assert_eq!(report.modes[0].folded, Some(true));
        // a model that is not too large has the linear constraints that the stretched rods imply
        let kinds = ["singular position", "in every position"];
        let told = |w: &&String| kinds.iter().any(|kind| w.contains(kind));
        assert!(report.warnings.iter().any(|w| told(&w)), "{:?}", report.warnings);
        assert!(report.warnings.len() <= 102, "{}", report.warnings.len());
    }
}

/// All rods along ground: every square may fold or not.
#[test]
fn a_flat_ladder_is_singular_but_not_redundant() {
    for squares in [1, 5, count(120, 500) as usize] {
        let m = model(&ladder(squares));
        let guess: Vec<(String, &str)> =
            (1..m.bodies.len()).map(|b| (format!("{}.angle", m.bodies[b].name), "0")).collect();
        let guess: Vec<(&str, &str)> = guess.iter().map(|(k, x)| (k.as_str(), *x)).collect();
        let (state, report) = start(&m, &[("rod0.angle", "0")], &guess);
        assert!(report.warnings.iter().any(|w| w.contains("singular position")));
        let found = mobility(&m, 0.0, &state.q);
        assert!(found.redundant.is_empty());
        assert_eq!(found.rank, m.layout.n_rows - squares);
    }
}

/// A second pin at the top of the last square is found as redundant at any size.
#[test]
fn a_twin_joint_in_a_large_ladder_is_redundant() {
    for squares in [3, 400] {
        let twin = format!(
            "[joints.twin]\ntype = \"revolute\"\ni = \"ground.G{squares}\"\nj = \"rod{squares}.A\"\n"
        );
        let m = model(&(ladder(squares) + &twin));
        let failure = assemble(&m, &request(&m, &[("rod0.angle", "1.3")], &[])).unwrap_err();
        assert_eq!(
            failure.message,
            format!("joint twin repeats joint P{squares}: both fix point rod{squares}.A to ground")
        );
    }
}

/// Two stretched bars between pins: the bars cannot move, and each of the four pins is needed.
#[test]
fn a_stretched_dyad_is_singular_but_not_redundant() {
    let text = ladder(1).replace("G1 = [1, 0]", "G1 = [3, 0]");
    let m = model(&text);
    let (_, report) = start(&m, &[("rod0.angle", "0")], &[]);
    assert!(report.warnings.iter().any(|w| w.contains("singular position")), "{report:?}");
}

/// The time of some assemblies, s.
fn seconds(text: &str, set: &[(&str, &str)], repetitions: usize) -> f64 {
    let m = model(text);
    let request = request(&m, set, &[]);
    let origin = Instant::now();
    let begin = clock(origin);
    for _ in 0..repetitions {
        assert!(assemble(&m, &request).is_ok());
    }
    clock(origin) - begin
}

fn free(bodies: usize) -> String {
    (0..bodies).map(|k| format!("[bodies.b{k}]\nmass = 1\ninertia = 1\n")).collect()
}

/// A chain of links, of which only the first hangs on ground.
fn chain(links: usize) -> String {
    let mut text = String::from("[bodies.ground]\npoints = { B = [0, 0] }\n");
    (0..links).for_each(|k| {
        _ = writeln!(
            text,
            "[bodies.b{k}]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = [\"A\", \"B\"]"
        );
    });
    let before = |k: usize| if k == 0 { "ground".to_string() } else { format!("b{}", k - 1) };
    (0..links).for_each(|k| {
        let i = before(k);
        _ = writeln!(text, "[joints.J{k}]\ntype = \"revolute\"\ni = \"{i}.B\"\nj = \"b{k}.A\"");
    });
    text
}

/// The text of a mechanism of some size.
type Text = fn(usize) -> String;

/// 2 assemblies of 4000 bodies take no more than three times as long as 16 of 500; quadratic work takes 8 times as long.
#[test]
fn the_time_is_linear() {
    let set: [(&str, &str); 1] = [("rod0.angle", "1.3")];
    let kinds = [(free as Text, &[][..]), (chain, &[]), (ladder, &set)];
    for (k, (text, set)) in kinds.into_iter().enumerate() {
        let (few, many) = (seconds(&text(500), set, 16), seconds(&text(4000), set, 2));
        assert!(many < 3.0 * few, "kind {k}: {few} s and {many} s");
    }
}

/// A request to stop ends the assembly.
#[test]
fn an_assembly_can_be_stopped() {
    let m = model(&ladder(50));
    // open loops: the rods stand, the links lie
    let names: Vec<String> = m.bodies.iter().map(|body| format!("{}.angle", body.name)).collect();
    let rods = names.iter().filter(|name| name.starts_with("rod")).skip(1);
    let guess: Vec<(&str, &str)> = rods.map(|name| (name.as_str(), "1.2")).collect();
    let request = request(&m, &[("rod0.angle", "1.3")], &guess);
    let failure = assemble_until(&m, &request, &|| true).expect_err("stopped");
    assert_eq!(failure.fault, Fault::Stopped);
    let request = Request { from_guess: true, ..request };
    let looks = Cell::new(0);
    let stop = || {
        looks.set(looks.get() + 1);
        false
    };
    let outcome = assemble_until(&m, &request, &stop);
    let iterations = outcome.map_or(0, |(_, report)| report.iterations.len());
    assert!(iterations > 3 && looks.get() > iterations, "{iterations} {}", looks.get());
}
