//! Reactions (Haug 6.6.8, 6.6.9): each body is in equilibrium with m a and J α under its weight, its
//! forces and the reactions of all its joints and drivers; and so is ground.

use crate::mechanisms::{close, model, Random};
use crate::samples::{constraints, Participants};
use kempe::elements::{self, BodyId};
use kempe::equations::forces::{self, Acting};
use kempe::equations::kinematics::Motions;
use kempe::equations::newton_euler::balances;
use kempe::equations::reactions::{reaction, Frame};
use kempe::equations::{Gains, Workspace};
use kempe::math::{Local, Pose, Rotation, Vec2};
use kempe::model::Model;

const COUPLED: &str = r#"
gravity = [1.3, -9.81]
[bodies.ground]
points = { O = [0.1, -0.2], Q = [1, 0] }
[bodies.one]
mass = 2
inertia = 0.3
center = [0.1, 0.2]
points = { A = [-0.4, 0.1], B = [0.5, -0.3] }
[bodies.two]
mass = 1.1
inertia = 0.2
center = [-0.3, 0.05]
points = { B = [0.2, 0.7] }
[bodies.three]
mass = 0.7
inertia = 0.15
points = { Q = [0, -0.5] }
[joints.A]
type = "revolute"
i = "ground.O"
j = "one.A"
axes = [0.3, -1.1]
[joints.B]
type = "revolute"
i = "one.B"
j = "two.B"
axes = [0.7, 0.2]
[joints.Q]
type = "revolute"
i = "three.Q"
j = "ground.Q"
[drivers.gear]
type = "coordinate_driver"
coordinate = "two.angle"
value = "-1.5*three.angle + 0.2*one.x*sin(t) + 0.1*two.y"
[drivers.slide]
type = "coordinate_driver"
coordinate = "one.y"
value = "0.3*t^2"
[forces.spring]
type = "torsion_spring"
i = "one"
j = "two"
stiffness = "5 + t"
damping = "0.2*three.omega"
[forces.other]
type = "torsion_spring"
i = "ground"
j = "three"
stiffness = 2
"#;

struct At {
    workspace: Workspace,
    t: f64,
}

impl At {
    fn random(m: &Model, seed: u64) -> Self {
        let mut numbers = Random::new(seed);
        let (q, v) = (numbers.many(m.layout.n_q), numbers.many(m.layout.n_q));
        let mut workspace = Workspace::new(m);
        workspace.accelerate(m, 0.4, [&q, &v, &[]], Gains::default()).unwrap();
        Self { workspace, t: 0.4 }
    }

    fn lam(&self, m: &Model, k: usize) -> Vec<f64> {
        self.workspace.lam()[m.layout.constraints[k].rows.clone()].to_vec()
    }

    /// Force and torque about the global origin of everything that acts on a body.
    fn loads(&self, m: &Model, body: BodyId) -> (Vec2, f64) {
        let (mut force, mut moment) = (Vec2::zero(), 0.0);
        let motions = &self.workspace.motions;
        let pose = motions[body.0].pose;
        for (k, item) in m.constraints.iter().enumerate() {
            let lam = self.lam(m, k);
            let Some(w) = reaction(m, k, body, Frame::Global, motions, self.t, &lam) else {
                continue;
            };
            let at = match item.bodies.iter().position(|b| *b == body) {
                Some(place) => pose.point(item.element.attachment(place).s),
                None => pose.r,
            };
            force = force + w.force;
            moment += w.torque + at.cross(w.force);
        }
        for k in 0..m.forces.len() {
            let acting = Acting { z: &[], lam: None, t: self.t };
            forces::each_wrench(m, k, motions, acting, |_, on, w| {
                if on == body {
                    force = force + w.force;
                    moment += w.torque + pose.r.cross(w.force);
                }
            });
        }
        (force, moment)
    }
}

#[test]
fn of_every_body() {
    let m = model(COUPLED);
    for seed in 1..20 {
        let at = At::random(&m, seed);
        let (mut all, mut all_moments) = (Vec2::zero(), 0.0);
        for (b, body) in m.bodies.iter().enumerate().skip(1) {
            let motion = at.workspace.motions[b];
            let a = m.layout.bodies[b].of(at.workspace.a());
            let arm = motion.pose.global(body.center);
            let w = motion.twist.omega;
            let a_c = Vec2::new(a[0], a[1]) + arm.perp().scale(a[2]) - arm.scale(w * w);
            let (force, moment) = at.loads(&m, BodyId(b));
            let weight = m.gravity.scale(body.mass);
            let centre = motion.pose.r + arm;
            let size = 1.0 + force.norm();
            let left = force + weight - a_c.scale(body.mass);
            close(&body.name, left.norm(), 0.0, 1e-11 * size);
            let about_centre = moment - centre.cross(force);
            close(&body.name, about_centre, body.inertia * a[2], 1e-11 * size);
            all = all + force;
            all_moments += moment;
        }
        // internal forces cancel: the remaining force acts on ground, opposite
        let (force, moment) = at.loads(&m, BodyId::GROUND);
        let size = 1.0 + force.norm() + moment.abs();
        close("force on ground", (force + all).norm(), 0.0, 1e-11 * size);
        // pins of a state that does not close carry a couple of gap and force
        let couple: f64 = (0..3).map(|k| gap_couple(&m, &at, k)).sum();
        close("moment on ground", moment + all_moments, couple, 1e-11 * size);
    }
}

#[test]
fn newton_and_euler_balance_every_body_and_find_a_wrong_multiplier() {
    let m = model(COUPLED);
    for seed in 1..20 {
        let at = At::random(&m, seed);
        let of = |lam: &[f64]| {
            let acting = Acting { z: &[], lam: Some(lam), t: at.t };
            balances(&m, &at.workspace.motions, at.workspace.a(), acting).bodies
        };
        let mut lam = at.workspace.lam().to_vec();
        for found in of(&lam) {
            assert!(found.largest_force > 1.0 && found.largest_moment > 1e-3, "{found:?}");
            close("force", found.force, 0.0, 1e-12 * found.largest_force);
            close(
                "moment",
                found.moment,
                0.0,
                1e-12 * (found.largest_moment + found.largest_force),
            );
        }
        lam[1] += 0.5; // the y row of pin A, on body one alone
        let found = of(&lam);
        close("wrong force", found[0].force, 0.5, 1e-9);
        assert!(found[1].force < 1e-9 && found[2].force < 1e-9);
    }
}

fn gap_couple(m: &Model, at: &At, k: usize) -> f64 {
    let motions = &at.workspace.motions;
    let item = &m.constraints[k];
    let point =
        |place: usize| motions[item.bodies[place].0].pose.point(item.element.attachment(place).s);
    let on_j = reaction(m, k, item.bodies[1], Frame::Global, motions, at.t, &at.lam(m, k));
    (point(1) - point(0)).cross(on_j.unwrap().force)
}

#[test]
fn frames_turn_the_components() {
    let m = model(COUPLED);
    let at = At::random(&m, 7);
    let motions = &at.workspace.motions;
    for (k, item) in m.constraints.iter().enumerate() {
        for (place, &body) in item.bodies.iter().enumerate() {
            let lam = at.lam(&m, k);
            let [global, in_body, joint] = [Frame::Global, Frame::Body, Frame::Joint]
                .map(|frame| reaction(&m, k, body, frame, motions, at.t, &lam).unwrap());
            let rotation = motions[body.0].pose.rotation;
            let back = rotation * Local::new(in_body.force.x, in_body.force.y);
            close(&item.name, (back - global.force).norm(), 0.0, 1e-12 * (1.0 + back.norm()));
            let axis = motions[body.0].pose.angle + item.element.attachment(place).axis;
            let back = Rotation::new(axis) * Local::new(joint.force.x, joint.force.y);
            close(&item.name, (back - global.force).norm(), 0.0, 1e-11 * (1.0 + back.norm()));
            assert_eq!(global.torque.to_bits(), joint.torque.to_bits());
        }
    }
}

#[test]
fn the_axes_of_a_pin_are_its_joint_frame() {
    let m = model(COUPLED);
    let element = &m.constraints[0].element;
    assert_eq!(element.attachment(0).axis, 0.3);
    assert_eq!(element.attachment(1).axis, -1.1);
}

#[test]
fn a_pin_carries_no_torque_and_a_motor_no_force() {
    let m = model(COUPLED);
    let at = At::random(&m, 9);
    let on = |k: usize, place: usize| {
        let (body, lam) = (m.constraints[k].bodies[place], at.lam(&m, k));
        reaction(&m, k, body, Frame::Global, &at.workspace.motions, at.t, &lam).unwrap()
    };
    for k in 0..3 {
        close("torque of a pin", on(k, 1).torque, 0.0, 1e-10);
        close("torque of a pin", on(k, 0).torque, 0.0, 1e-10);
    }
    let lam = at.lam(&m, 3)[0];
    let gear = reaction(&m, 3, BodyId(3), Frame::Global, &at.workspace.motions, at.t, &[lam]);
    close("torque on the other wheel", gear.unwrap().torque, -1.5 * lam, 1e-12 * lam.abs());
    close("torque on the driven wheel", on(3, 1).torque, -lam, 1e-12 * lam.abs());
    let nothing = reaction(&m, 4, BodyId(3), Frame::Global, &at.workspace.motions, at.t, &[1.0]);
    assert!(nothing.is_none());
}

/// Columns of Φ_q of all bodies that a law names, against differences.
#[test]
fn laws_of_other_bodies_have_their_columns() {
    let m = model(COUPLED);
    let mut numbers = Random::new(11);
    let q = numbers.many(m.layout.n_q);
    let dense = kempe::equations::dense::jacobian(&m, &Motions::at_rest(&m.layout, &q), 0.4);
    let n = m.layout.n_q;
    let phi = |q: &[f64]| {
        let mut phi = vec![0.0; m.layout.n_rows];
        let motions = Motions::at_rest(&m.layout, q);
        kempe::equations::constraints::residual(&m, &motions, 0.4, &mut phi);
        phi
    };
    let h = 1e-6;
    for column in 0..n {
        let moved = |h: f64| {
            let mut q = q.clone();
            q[column] += h;
            phi(&q)
        };
        for (row, (up, down)) in moved(h).iter().zip(moved(-h)).enumerate() {
            close("Φ_q", dense[row * n + column], (up - down) / (2.0 * h), 1e-8);
        }
    }
    let gear = m.layout.constraints[3].rows.start * n;
    assert_eq!(dense[gear + 8], 1.5);
}

/// Loads of a joint on its bodies cancel, as its reactions do.
#[test]
fn loads_cancel() {
    let mut numbers = Random::new(1);
    for sample in constraints() {
        let participants = Participants::random(&sample, &mut numbers);
        let poses: Vec<_> =
            participants.bodies.iter().map(|q| Pose::new(q[0], q[1], q[2])).collect();
        let own: Vec<f64> = participants.own.iter().map(|u| u[0]).collect();
        let lam: Vec<f64> = (0..sample.equations().len()).map(|k| k as f64 - 1.3).collect();
        let (mut force, mut moment, mut count) = (Vec2::zero(), 0.0, 0);
        let at = elements::At { bodies: &poses, own: &own, t: 0.7 };
        sample.load(&at, &lam, &mut |place, w| {
            force = force + w.force;
            moment += w.torque + poses[place].r.cross(w.force);
            count += 1;
        });
        assert_eq!(count > 0, sample.has_load(), "{}", sample.kind());
        for x in [force.x, force.y, moment] {
            close(sample.kind(), x, 0.0, 1e-13);
        }
    }
}
