//! MSC ADAMS: a rod pendulum, free and with a rotational spring-damper.

use crate::mechanisms::{close, model, pinned, run, start, tolerances, worst};
use crate::{number, numbers, reference};
use kempe::elements::BodyId;
use kempe::equations::kinematics;
use kempe::equations::reactions::{reaction, Frame};

fn rod() -> String {
    let fields = "mass = 1\ninertia = 0.1\npoints = { O = [-2, 0] }";
    format!("gravity = [0, -9.80665]\n{}", pinned("rod", fields))
}

const SPRING: &str = r#"
[forces.spring]
type = "torsion_spring"
i = "ground"
j = "rod"
stiffness = 200
damping = 10
"#;

fn compare(case: &str, text: &str) {
    let m = model(text);
    let (mut state, _) = start(&m, &[("rod.angle", "0")], &[]);
    let table = reference("adams")["cases"][case]["rows"].clone();
    let rows = table.as_array().unwrap();
    assert_eq!(rows.len(), 7);
    for truth in rows {
        let t = number(&truth["t"]);
        let run = run(&m, &state, &tolerances(t, 1e-10, 1e-13));
        let last = run.trajectory.t.len() - 1;
        let at = |table: &[f64], n: usize| table[last * n..][..n].to_vec();
        let found = run.accelerations(&m).unwrap();
        let (a, lam) = (at(&found.a, 3), at(&found.lam, 2));
        state.t = t;
        state.q = at(&run.trajectory.q, 3);
        state.v = at(&run.trajectory.v, 3);
        assert!(worst(&state.q, &numbers(&truth["q"])) < 1e-8, "{case} t = {t}: q");
        assert!(worst(&state.v, &numbers(&truth["v"])) < 1e-7, "{case} t = {t}: v");
        assert!(worst(&a, &numbers(&truth["a"])) < 2e-6, "{case} t = {t}: a {a:?}");
        let motions = kinematics::Motions::at(&m.layout, &state.q, &state.v);
        let on_ground = reaction(&m, 0, BodyId::GROUND, Frame::Global, &motions, t, &lam).unwrap();
        let force = [on_ground.force.x, on_ground.force.y];
        assert!(worst(&force, &numbers(&truth["Rforce"])) < 2e-6, "{case} t = {t}: {force:?}");
        // the numbers printed by ADAMS, to their digits
        assert!(worst(&state.q[..2], &numbers(&truth["adams_pos"])) < 1e-4, "{case} t = {t}");
        assert!(worst(&state.v[..2], &numbers(&truth["adams_vel"])) < 1e-3, "{case} t = {t}");
        let printed = numbers(&truth["adams_Rforce"]);
        assert!(worst(&force, &printed) < 2e-3, "{case} t = {t}: {force:?} {printed:?}");
        close("torque of the joint", on_ground.torque, 0.0, 1e-12);
    }
}

#[test]
fn rod_pendulum() {
    compare("rod_pendulum", &rod());
}

#[test]
fn rod_pendulum_with_torsion_spring() {
    compare("rod_pendulum_torsion_spring", &(rod() + SPRING));
}
