//! The balances of bodies and internal coordinates: they vanish for a solution, and see a reaction that leaves only the
//! row of a massless coordinate unbalanced.

use crate::mechanisms::{start, with};
use kempe::analyses::dynamics::{Prepared, States};
use kempe::equations::constraints;
use kempe::equations::forces::Acting;
use kempe::equations::kinematics::Motions;
use kempe::equations::newton_euler::balances;
use kempe::integrate::Flow;

/// A bead on a wire.
const BEAD: &str = r#"
gravity = [0, -9.81]
[parameters]
m = 1
R = 1
[bodies.ground]
curves = { wire = { circle = [0, 0, "R"] } }
[bodies.bead]
type = "point_mass"
mass = "m"
[joints.on]
type = "point_on_curve"
i = "bead.P"
curve = "ground.wire"
"#;

/// A force along the wire beside the reaction, and the acceleration that it gives the bead: the equations of the bead
/// hold, that of its place on the wire does not.
#[test]
fn a_massless_row_out_of_balance_is_seen() {
    for (mass, radius) in [(1e-3, 1e-3), (1e-3, 1e3), (1.0, 1.0), (1e3, 1e-3), (1e3, 1e3)] {
        let m = with(BEAD, &[("m", mass), ("R", radius)]);
        let (state, _) = start(&m, &[("bead.x", "0.8*R")], &[("bead.y", "0.6*R")]);
        let states = States { t: &[0.0], q: &state.q, v: &state.v, z: &[] };
        let found = Prepared::new(&m).accelerations(states, true, |_| Flow::Continue).unwrap();
        let motions = Motions::at(&m.layout, &state.q, &state.v);
        let mut entries = vec![0.0; m.layout.n_entries];
        constraints::jacobian(&m, &motions, 0.0, &mut entries);
        let share = |part: f64| {
            let (mut a, mut lam) = (found.a.clone(), found.lam.clone());
            let extra = [-0.6, 0.8].map(|x| part * mass * 9.81 * x);
            lam.iter_mut().zip(extra).for_each(|(lam, extra)| *lam += extra);
            for (row, column, at) in m.layout.positions().filter(|(_, column, _)| *column < 2) {
                a[column] -= entries[at] * extra[row] / mass;
            }
            let at = balances(&m, &motions, &a, Acting { z: &[], lam: Some(&lam), t: 0.0 });
            assert!(at.bodies[0].force < 1e-13 * at.bodies[0].largest_force);
            at.coordinates[0].effort / at.coordinates[0].largest_effort
        };
        assert!(share(0.0) < 1e-13, "{mass} kg, {radius} m: {}", share(0.0));
        assert!((1e-6..1e-4).contains(&share(3e-6)), "{mass} kg, {radius} m: {}", share(3e-6));
    }
}
