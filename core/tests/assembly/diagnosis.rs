//! Freedoms, redundancies, kinds of singular positions, locked and loose bodies, four-bar loops.

use crate::mechanisms::{linkage, model, request, SLIDER_CRANK};
use kempe::analyses::diagnosis::{diagnose, Diagnosis, Grashof, SingularKind};
use kempe::model::Model;

/// Ground pins at a distance g, a crank a, a coupler b and a rocker c, and more text.
fn four_bar([g, a, b, c]: [f64; 4], more: &str) -> Model {
    let text = linkage([g, a, b, c], [1; 3]).replace("D = [", "E = [9, 9], D = [");
    model(&format!("redundancy = 'allow'\n{text}{more}"))
}

fn at(m: &Model, hints: &[(&str, &str)]) -> Diagnosis {
    let request = request(m, &[], hints);
    let (state, _) =
        kempe::analyses::assemble::assemble(m, &request).unwrap_or_else(|f| panic!("{f}"));
    diagnose(m, &state)
}

const DRIVER: &str =
    "[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'crank.angle'\nvalue = ";

#[test]
fn a_four_bar_has_one_freedom_and_its_driver_takes_it() {
    let hints = [("crank.angle", "1"), ("coupler.angle", "0.3")];
    let found = at(&four_bar([4.0, 1.0, 3.5, 2.5], ""), &hints);
    assert_eq!((found.gruebler, found.driven, found.mobility.degrees_of_freedom), (1, 0, 1));
    assert!(found.redundant.is_empty() && found.singular.is_empty() && found.locked.is_empty());
    let found = at(&four_bar([4.0, 1.0, 3.5, 2.5], &format!("{DRIVER} '1'")), &hints);
    assert_eq!((found.gruebler, found.driven, found.mobility.degrees_of_freedom), (0, 1, 0));
    // the crank is driven, but not locked
    assert!(found.locked.is_empty());
}

/// A third crank parallel to the others: one equation too many, of all joints.
#[test]
fn a_redundant_crank_is_consistent_and_each_equation_across_may_be_removed() {
    let third = "[bodies.third]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['F', 'G']\n\
                 [joints.F]\ntype = 'revolute'\ni = 'ground.F'\nj = 'third.F'\n\
                 [joints.G]\ntype = 'revolute'\ni = 'third.G'\nj = 'coupler.M'\n";
    let text =
        "redundancy = 'allow'\n[bodies.ground]\npoints = { A = [0, 0], D = [3, 0], F = [1, 0] }\n\
         [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'B']\n\
         [bodies.coupler]\nmass = 1\ninertia = 1\npoints = { B = [0, 0], M = [1, 0], C = [3, 0] }\n\
         [bodies.rocker]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['D', 'C']\n\
         [joints.A]\ntype = 'revolute'\ni = 'ground.A'\nj = 'crank.A'\n\
         [joints.B]\ntype = 'revolute'\ni = 'crank.B'\nj = 'coupler.B'\n\
         [joints.C]\ntype = 'revolute'\ni = 'coupler.C'\nj = 'rocker.C'\n\
         [joints.D]\ntype = 'revolute'\ni = 'ground.D'\nj = 'rocker.D'\n";
    let m = model(&format!("{text}{third}"));
    let hints =
        [("crank.angle", "1"), ("coupler.angle", "0"), ("rocker.angle", "1"), ("third.angle", "1")];
    let found = at(&m, &hints);
    assert_eq!(
        (found.gruebler, found.mobility.degrees_of_freedom, found.mobility.rank),
        (0, 1, 11)
    );
    let [one] = &found.redundant[..] else { panic!("{:?}", found.redundant) };
    assert_eq!(one.joints, ["A", "B", "C", "D", "F", "G"]);
    assert!(one.consistent && one.equations.contains(&one.remove), "{one:?}");
    assert!(found.singular.is_empty());
    // every equation that takes part may be removed alone: the rank stays
    for name in &one.equations {
        assert!(name.ends_with(".x") || name.ends_with(".y"), "{name}");
    }
    // three loops of two cranks each
    assert_eq!(found.four_bars.len(), 3);
    assert!(found.four_bars.iter().all(|loop_| loop_.class == Grashof::ChangePoint));
}

#[test]
fn drivers_that_contradict_each_other_are_not_consistent() {
    let second =
        "[drivers.second]\ntype = 'coordinate_driver'\ncoordinate = 'rocker.angle'\nvalue = ";
    let hints = [("coupler.angle", "0"), ("rocker.angle", "1"), ("crank.angle", "1")];
    for (law, consistent) in [("'1 + t'", true), ("'1 + 2*t'", false)] {
        let m = four_bar([3.0, 1.0, 3.0, 1.0], &format!("{DRIVER} '1 + t'\n{second} {law}\n"));
        let state = kempe::analyses::State {
            t: 0.0,
            q: position(&m, [1.0, 0.0, 1.0]),
            v: vec![0.0; m.layout.n_q],
            z: vec![],
        };
        let found = diagnose(&m, &state);
        let [one] = &found.redundant[..] else { panic!("{hints:?} {:?}", found.redundant) };
        assert_eq!(one.consistent, consistent, "{law}");
        assert!(
            one.joints.contains(&"motor".to_string()) && one.joints.contains(&"second".to_string())
        );
        assert_eq!(found.driven, 2);
    }
}

/// The coordinates of the parallelogram with g = b = 3, a = c = 1 for angles of crank, coupler and rocker.
fn position(m: &Model, [crank, coupler, rocker]: [f64; 3]) -> Vec<f64> {
    let b = [crank.cos(), crank.sin()];
    let mut q = vec![0.0; m.layout.n_q];
    let poses = [
        [0.5 * b[0], 0.5 * b[1], crank],
        [b[0] + 1.5 * coupler.cos(), b[1] + 1.5 * coupler.sin(), coupler],
        [3.0 + 0.5 * rocker.cos(), 0.5 * rocker.sin(), rocker],
    ];
    for (k, pose) in poses.iter().enumerate() {
        q[3 * k..3 * k + 3].copy_from_slice(pose);
    }
    q
}

#[test]
fn a_flat_parallelogram_is_at_a_change_point() {
    for (more, driven) in [(String::new(), 0), (format!("{DRIVER} 't'"), 1)] {
        let m = four_bar([3.0, 1.0, 3.0, 1.0], &more);
        let state = kempe::analyses::State {
            t: 0.0,
            q: position(&m, [0.0, 0.0, 0.0]),
            v: vec![0.0; m.layout.n_q],
            z: vec![],
        };
        let found = diagnose(&m, &state);
        assert_eq!(found.driven, driven);
        assert!(found.redundant.is_empty());
        let [(one, kind)] = &found.singular[..] else { panic!("{:?}", found.singular) };
        assert_eq!(*kind, SingularKind::ChangePoint);
        assert_eq!(one.joints, ["A", "B", "C", "D"]);
    }
}

#[test]
fn a_crank_at_the_end_of_its_motion_is_at_a_dead_point() {
    let [g, a, b, c] = [4.0, 3.0, 2.0, 2.5];
    let out = f64::acos((g * g + a * a - (b + c) * (b + c)) / (2.0 * g * a));
    let m = four_bar([g, a, b, c], &format!("{DRIVER} '{out:.17}'"));
    let found = at(&m, &[("coupler.angle", "-0.71"), ("rocker.angle", "2.43")]);
    let [(one, kind)] = &found.singular[..] else { panic!("{:?}", found.singular) };
    assert_eq!(*kind, SingularKind::DeadPoint);
    assert!(one.joints.contains(&"motor".to_string()));
    assert!(found.locked.is_empty());
}

/// Two bars in line between two pins of ground: they can shake a little, and cannot move.
#[test]
fn bars_in_line_between_two_pins_have_play_of_the_first_order() {
    let m = model(
        "[bodies.ground]\npoints = { A = [0, 0], D = [3, 0] }\n\
         [bodies.left]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'B']\n\
         [bodies.right]\ntype = 'bar'\nmass = 1\nlength = 2\nends = ['B', 'D']\n\
         [joints.A]\ntype = 'revolute'\ni = 'ground.A'\nj = 'left.A'\n\
         [joints.B]\ntype = 'revolute'\ni = 'left.B'\nj = 'right.B'\n\
         [joints.D]\ntype = 'revolute'\ni = 'ground.D'\nj = 'right.D'\n",
    );
    let found = at(&m, &[("left.angle", "0"), ("right.angle", "0")]);
    assert_eq!(found.gruebler, 0);
    let [(_, kind)] = &found.singular[..] else { panic!("{:?}", found.singular) };
    assert_eq!(*kind, SingularKind::Uncertainty);
}

#[test]
fn locked_and_loose_bodies_are_named() {
    let more = "[bodies.plate]\nmass = 1\ninertia = 1\npoints = { P = [0, 0], Q = [1, 0] }\n\
                [joints.W]\ntype = 'weld'\ni = 'ground.E'\nj = 'plate.P'\n\
                [bodies.bird]\nmass = 1\ninertia = 1\npoints = { P = [0, 0] }\n\
                [bodies.tail]\nmass = 1\ninertia = 1\npoints = { P = [0, 0] }\n\
                [joints.T]\ntype = 'revolute'\ni = 'bird.P'\nj = 'tail.P'\n";
    let found = at(&four_bar([4.0, 1.0, 3.5, 2.5], more), &[("crank.angle", "1")]);
    assert_eq!(found.locked, ["plate"]);
    assert_eq!(found.loose, ["bird", "tail"]);
    assert_eq!(found.mobility.degrees_of_freedom, 5);
}

/// At a dead centre the piston has no velocity, but it can move.
#[test]
fn a_piston_at_a_dead_centre_is_not_locked() {
    for more in [
        "",
        "[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'crank.angle'\nvalue = 't'\n",
    ] {
        let m = model(&format!("{}{more}", SLIDER_CRANK));
        let found = at(&m, &[("crank.angle", "0"), ("piston.x", "0.4")]);
        assert!(found.locked.is_empty(), "{:?}", found.locked);
    }
}

/// A cylinder with a given length moves its boom; one of constant length locks it.
#[test]
fn a_length_with_a_law_is_a_driver() {
    let text = |length: &str| {
        format!(
            "[bodies.ground]\npoints = {{ A = [0, 0], B = [1, 0] }}\n\
         [bodies.boom]\ntype = 'bar'\nmass = 1\nlength = 2\nends = ['A', 'P']\n\
         [joints.A]\ntype = 'revolute'\ni = 'ground.A'\nj = 'boom.A'\n\
         [joints.cylinder]\ntype = 'distance'\ni = 'ground.B'\nj = 'boom.P'\nlength = {length}\n"
        )
    };
    let hints = [("boom.angle", "1")];
    let driven = at(&model(&text("'1.7 + t'")), &hints);
    assert_eq!((driven.driven, driven.mobility.degrees_of_freedom, driven.locked.len()), (1, 0, 0));
    let held = at(&model(&text("1.7")), &hints);
    assert_eq!((held.driven, held.mobility.degrees_of_freedom), (0, 0));
    assert_eq!(held.locked, ["boom"]);
}

#[test]
fn four_bar_loops_by_grashofs_rule() {
    let cases = [
        ([4.0, 1.0, 3.5, 2.5], Grashof::CrankRocker(1)),
        ([4.0, 2.5, 3.5, 1.0], Grashof::CrankRocker(3)),
        ([1.0, 3.0, 3.5, 2.5], Grashof::DoubleCrank(0)),
        ([4.0, 3.0, 1.0, 2.5], Grashof::DoubleRocker(2)),
        ([4.0, 3.0, 2.0, 2.5], Grashof::TripleRocker),
        ([3.0, 1.0, 3.0, 1.0], Grashof::ChangePoint),
        ([4.0, 2.0, 3.0, 3.0], Grashof::ChangePoint),
    ];
    for (links, class) in cases {
        let found = at(&four_bar(links, ""), &[("crank.angle", "0.4"), ("coupler.angle", "0.3")]);
        let [one] = &found.four_bars[..] else { panic!("{:?}", found.four_bars) };
        assert_eq!(one.class, class, "{links:?}");
        assert_eq!(one.bodies, ["ground", "crank", "coupler", "rocker"]);
        assert_eq!(one.pins, ["A", "B", "C", "D"]);
        assert!(one
            .lengths
            .iter()
            .zip(links)
            .all(|(found, length)| (found - length).abs() < 1e-12));
    }
}
