//! One or more samples of each element, and random motions to look at them.
use crate::mechanisms::Random;
use kempe::elements::drivers::CoordinateDriver;
use kempe::elements::forces::{
    Actuator, Bushing, Clutch, GeneralizedForce, Motor, PointForce, Torque, TorsionSpring,
};
use kempe::elements::joints::{
    Belt, Coupling, Distance, FlatOnCurve, Gear, GivenConstraint, PinInSlot, PointOnCurve, Rack,
    Revolute, RollerOnCurve, Rolling, Translational, Weld,
};
use kempe::elements::test_elements::{
    Bead, Blower, GapSpring, Lag, Levels, Overload, Pulley, Rubbing, TurnedPin,
};
use kempe::elements::{
    catalogue, At, BodyId, Constraint, Coordinate, CoordinateOf, Curve, CurveFormula, CurveOn,
    CurvePoints, ForceElement, Frame, JointId, Linearized, Moving, PointOn, Polygon, QuantityKind,
    Side,
};
use kempe::expression::{Expression, FormulaValues, Names, Symbol, Tape};
use kempe::math::{Interpolation, Local, Motion, Pose, Real, Twist, Vec2};

pub fn on(body: usize, x: f64, y: f64) -> PointOn {
    PointOn { body: BodyId(body), s: Local::new(x, y) }
}

/// A curve of body 2 in one of its forms.
pub fn curve(form: &str) -> CurveOn {
    let local = Local::new;
    let curve = match form {
        "circle" => Curve::Circle { center: local(0.3, -0.2), radius: 0.8 },
        "line" => Curve::Line { from: local(-0.4, 0.1), to: local(0.9, 0.7) },
        "polygon" => {
            let corners = [[-0.9, -0.5], [0.6, -0.7], [0.8, 0.4], [-0.2, 0.9]];
            Curve::Polygon(Polygon::new(&corners.map(|[x, y]| local(x, y))))
        }
        "points" => {
            let points = [[1.0, 0.0], [0.8, 0.9], [-0.2, 1.1], [-1.2, 0.1], [0.1, -0.8]];
            let points = points.map(|[x, y]| local(x, y)).to_vec();
            Curve::Points(CurvePoints::new(points, Interpolation::Quintic, true))
        }
        _ => {
            let [x, y] = ["a*cos(u) + 0.1*u^3", "b*sin(u) - a*exp(0.3*u)"];
            formula([x, y], [-2.0, 2.0], false, &[1.3, 0.7])
        }
    };
    CurveOn { body: BodyId(2), curve }
}

/// A curve by formulas of u and of the parameters a and b.
pub fn formula(xy: [&str; 2], range: [f64; 2], periodic: bool, values: &[f64]) -> Curve {
    let names = WithU(&["a", "b"]);
    let [x, y] = xy.map(|text| Expression::parse(text).unwrap().compile(&names).unwrap());
    let curve = Curve::Formula(CurveFormula::new(x, y, range.map(Tape::from), periodic));
    let values = FormulaValues { parameters: values, time: f64::NAN, variables: &[] };
    curve.map(&mut |tape: &Tape| tape.evaluate(&values))
}

/// Parameters, and the variable u.
struct WithU<'a>(&'a [&'a str]);

impl Names for WithU<'_> {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        match name {
            "u" => Some(Symbol::Variable(0)),
            _ => self.0.iter().position(|own| *own == name).map(Symbol::Parameter),
        }
    }
    fn known(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Joints and drivers; drivers act from ground.
pub fn constraints() -> Vec<Constraint> {
    [
        pins_and_slides(),
        crate::beams::locks(),
        wheels(),
        on_curves(),
        crate::touching::held(),
        by_formulas(),
        of_tests(),
        drivers(),
    ]
    .concat()
}

fn pins_and_slides() -> Vec<Constraint> {
    vec![
        Constraint::Revolute(Revolute {
            i: on(1, 0.3, -0.7),
            j: on(2, -1.1, 0.4),
            axes: [0.2, -0.5],
        }),
        Constraint::Translational(Translational {
            i: on(1, -0.4, 0.2),
            j: on(2, 0.5, 0.9),
            axes: [0.7, -0.3],
        }),
        Constraint::Distance(Distance { i: on(1, 0.6, -0.2), j: on(2, -0.3, 0.8), length: 1.4 }),
        Constraint::Weld(Weld { i: on(1, -0.2, 0.6), j: on(2, 0.7, -0.5), angle: 0.8 }),
        Constraint::PinInSlot(PinInSlot { i: on(1, 0.4, -0.3), j: on(2, -0.6, 0.2), axis: 0.7 }),
    ]
}

fn wheels() -> Vec<Constraint> {
    let mut all = vec![Constraint::Rack(Rack {
        i: on(1, 0.3, 0.1),
        j: on(2, -0.2, 0.4),
        radius: -0.6,
        axis: 0.4,
        offset: 0.3,
        backlash: None,
        restitution: 0.0,
    })];
    for friction in [None, Some(0.3)] {
        all.push(Constraint::Rolling(Rolling {
            i: on(1, 0.5, 0.2),
            j: on(2, 0.1, -0.3),
            radius: 0.8,
            axis: -1.1,
            offset: -0.2,
            friction,
            r#static: None,
        }));
    }
    for (internal, toothed) in [(false, false), (true, false), (false, true)] {
        all.push(Constraint::Gear(Gear {
            i: on(1, 0.2, -0.1),
            j: on(2, 0.3, 0.4),
            radii: (!toothed).then_some([0.7, 0.3]),
            teeth: toothed.then_some([24.0, 17.0]),
            module: toothed.then_some(0.05),
            internal,
            offset: 0.1,
            pressure_angle: 0.35,
            backlash: None,
            restitution: 0.0,
        }));
    }
    for (radii, crossed) in [([0.7, 0.3], false), ([0.7, 0.3], true), ([0.4, 0.4], false)] {
        let (i, j) = (on(1, 0.2, -0.1), on(2, 0.3, 0.4));
        all.push(Constraint::Belt(Belt {
            i,
            j,
            radii,
            crossed,
            offset: -0.2,
            preload: None,
            friction: None,
            stiffness: None,
            slack: None,
        }));
    }
    all
}

fn on_curves() -> Vec<Constraint> {
    vec![
        Constraint::PointOnCurve(PointOnCurve { i: on(1, 0.2, 0.5), curve: curve("formula") }),
        Constraint::PointOnCurve(PointOnCurve { i: on(1, 0.2, 0.5), curve: curve("line") }),
        Constraint::RollerOnCurve(RollerOnCurve {
            i: on(1, -0.3, 0.4),
            curve: curve("points"),
            radius: 0.3,
            side: Side::Right,
        }),
        Constraint::RollerOnCurve(RollerOnCurve {
            i: on(1, -0.3, 0.4),
            curve: curve("formula"),
            radius: 0.2,
            side: Side::Left,
        }),
        Constraint::FlatOnCurve(FlatOnCurve {
            i: on(1, 0.1, 0.6),
            curve: curve("circle"),
            axis: 0.4,
        }),
        Constraint::FlatOnCurve(FlatOnCurve {
            i: on(1, 0.1, 0.6),
            curve: curve("points"),
            axis: -0.7,
        }),
    ]
}

fn by_formulas() -> Vec<Constraint> {
    let of = |body, coordinate| CoordinateOf { body: BodyId(body), coordinate }.into();
    vec![
        Constraint::Coupling(Coupling {
            terms: vec![(of(1, Coordinate::Angle), 2.0), (of(2, Coordinate::Y), -0.7)],
            value: 0.4,
            unit: None,
        }),
        Constraint::GivenConstraint(GivenConstraint {
            residual: vec![0.3, -0.2],
            units: vec![QuantityKind::Length, QuantityKind::Angle],
        }),
    ]
}

/// The elements of the tests.
fn of_tests() -> Vec<Constraint> {
    vec![
        Constraint::TurnedPin(TurnedPin { i: on(1, 0.3, -0.7), j: on(2, -1.1, 0.4) }),
        Constraint::Bead(Bead { i: on(1, 0.2, 0.5), j: BodyId(2), bend: 0.8 }),
        Constraint::Levels(Levels { i: BodyId(1), j: BodyId(2), k: BodyId(3), steps: [0.3, -0.4] }),
        Constraint::Pulley(Pulley { i: BodyId(1), j: BodyId(2), k: BodyId(3), ratio: 0.7 }),
    ]
}

fn drivers() -> Vec<Constraint> {
    let driven = |coordinate| CoordinateOf { body: BodyId(2), coordinate };
    let mut all = Vec::new();
    for (coordinate, value) in
        [(Coordinate::X, 0.4), (Coordinate::Y, -1.3), (Coordinate::Angle, 2.1)]
    {
        let coordinate = driven(coordinate).into();
        let driver = CoordinateDriver { coordinate, value, limit: None, release: None };
        all.push(Constraint::CoordinateDriver(driver));
    }
    all
}

/// Forces.
pub fn forces() -> Vec<ForceElement> {
    let mut all = vec![ForceElement::TorsionSpring(TorsionSpring {
        i: BodyId(1),
        j: BodyId(2),
        stiffness: 3.5,
        damping: 0.8,
        free_angle: 0.6,
        preload: 0.4,
    })];
    all.push(ForceElement::Torque(Torque { i: BodyId(1), j: BodyId(2), torque: 1.3 }));
    for one_way in [false, true] {
        let clutch = Clutch { i: BodyId(1), j: BodyId(2), capacity: 1.7, one_way };
        all.push(ForceElement::Clutch(clutch));
    }
    all.push(ForceElement::Lag(Lag { i: BodyId(1), j: BodyId(2), stiffness: 4.0, time: 0.3 }));
    let (joint, i, j) = (JointId(0), BodyId(1), BodyId(2));
    all.push(ForceElement::Rubbing(Rubbing { joint, i, j, arm: 0.05, speed: 0.4 }));
    let (stiffness, gap, preload) = (3.0, 0.4, 0.7);
    all.push(ForceElement::GapSpring(GapSpring { i, j, stiffness, gap, preload }));
    all.push(ForceElement::Overload(Overload { joint, i, j, torque: 1.2, limit: 0.5 }));
    all.push(ForceElement::Blower(Blower {
        j,
        i,
        force: [1.2, -0.4],
        gusts: vec![0.3, 0.9],
        factor: Some(1.7),
        side: Side::Left,
        off: false,
        more: None,
        less: Some(0.2),
    }));
    all.extend(motors());
    all.extend(crate::rubbing::frictions());
    for frame in [Frame::Global, Frame::I, Frame::J] {
        let (force, i) = ([1.2, -0.5], BodyId(1));
        all.push(ForceElement::PointForce(PointForce { i, j: on(2, -1.1, 0.4), force, frame }));
    }
    let (from, to) = (on(1, 0.3, -0.7), on(2, -1.1, 0.4));
    let (stiffness, damping) = ([2.5, 1.2, 0.7], [0.4, 0.9, 0.3]);
    all.push(ForceElement::Bushing(Bushing { i: from.clone(), j: to.clone(), stiffness, damping }));
    let coordinate = CoordinateOf { body: j, coordinate: Coordinate::Angle }.into();
    all.push(ForceElement::GeneralizedForce(GeneralizedForce { coordinate, value: 0.9 }));
    all.push(ForceElement::Actuator(Actuator { i: from, j: to, force: 1.4 }));
    all.extend(crate::spring_damper::springs());
    all.extend(crate::touching::stops());
    all.extend(crate::touching::contacts());
    all
}

fn motors() -> Vec<ForceElement> {
    let mut all = Vec::new();
    for inductance in [0.0, 0.3] {
        all.push(ForceElement::Motor(Motor {
            i: BodyId(1),
            j: BodyId(2),
            voltage: Some(2.4),
            resistance: Some(1.7),
            torque_constant: Some(0.6),
            inductance,
            stall_torque: None,
            free_speed: None,
            command: 1.0,
        }));
    }
    all.push(ForceElement::Motor(Motor {
        i: BodyId(1),
        j: BodyId(2),
        voltage: None,
        resistance: None,
        torque_constant: None,
        inductance: 0.0,
        stall_torque: Some(2.1),
        free_speed: Some(1.6),
        command: 0.8,
    }));
    all
}

/// A motion over any scalar.
pub fn motion<S: Real>([x, y, angle, vx, vy, omega]: [S; 6]) -> Motion<S> {
    Motion { pose: Pose::new(x, y, angle), twist: Twist { velocity: Vec2::new(vx, vy), omega } }
}

/// Random coordinates and rates of one body, each within 2.
pub fn random(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| 2.0 * random.next())
}

/// The state after `h` along the motion with constant rates.
pub fn later(s: [f64; 6], h: f64) -> [f64; 6] {
    std::array::from_fn(|k| if k < 3 { s[k] + h * s[k + 3] } else { s[k] })
}

/// A state of all participants of a joint: bodies, and internal coordinates with their rates.
#[derive(Clone, Debug)]
pub struct Participants<S = f64> {
    pub bodies: Vec<[S; 6]>,
    pub own: Vec<[S; 2]>,
}

impl Participants {
    /// Random; ground rests in the origin.
    pub fn random(c: &Constraint, numbers: &mut Random) -> Self {
        let body = |b: &BodyId, numbers: &mut Random| match b.is_ground() {
            true => [0.0; 6],
            false => random(numbers),
        };
        let bodies = c.bodies().iter().map(|b| body(b, numbers)).collect();
        let own = (0..c.own()).map(|_| [2.0 * numbers.next(), 2.0 * numbers.next()]).collect();
        Self { bodies, own }
    }

    /// After `h` along the motion with constant rates.
    pub fn later(&self, h: f64) -> Self {
        let own = self.own.iter().map(|[u, rate]| [u + h * rate, *rate]).collect();
        Self { bodies: self.bodies.iter().map(|s| later(*s, h)).collect(), own }
    }

    /// Moved by `h` in one coordinate: three to a body, then the internal ones.
    pub fn moved(&self, coordinate: usize, h: f64) -> Self {
        let mut moved = self.clone();
        match moved.bodies.get_mut(coordinate / 3) {
            Some(body) => body[coordinate % 3] += h,
            None => moved.own[coordinate - 3 * self.bodies.len()][0] += h,
        }
        moved
    }
}

impl<S: Real> Participants<S> {
    /// Over another scalar.
    pub fn map<T>(&self, f: impl Fn(S) -> T + Copy) -> Participants<T> {
        Participants {
            bodies: self.bodies.iter().map(|s| s.map(f)).collect(),
            own: self.own.iter().map(|s| s.map(f)).collect(),
        }
    }
}

/// Φ.
pub fn phi<S: Real>(c: &Constraint<S>, at: &Participants<S>, t: S) -> Vec<S> {
    let mut out = vec![S::zero(); c.equations().len()];
    let bodies: Vec<Pose<S>> = at.bodies.iter().map(|s| motion(*s).pose).collect();
    let own: Vec<S> = at.own.iter().map(|[u, _]| *u).collect();
    c.residual(&At { bodies: &bodies, own: &own, t }, &mut out);
    out
}

/// Φ, Φ̇, γ, and Φ_q with a row of three for each equation of each participant.
pub type Terms<S> = ([Vec<S>; 3], Vec<[S; 3]>);

/// All of [`Terms`].
pub fn terms<S: Real>(c: &Constraint<S>, at: &Participants<S>, t: S) -> Terms<S> {
    let m = c.equations().len();
    let mut out = [0, 1, 2].map(|_| vec![S::zero(); m]);
    let participants = at.bodies.len() + usize::from(c.own() > 0);
    let mut columns = vec![[S::zero(); 3]; m * participants];
    let bodies: Vec<Motion<S>> = at.bodies.iter().map(|s| motion(*s)).collect();
    let own: Vec<S> = at.own.iter().map(|[u, _]| *u).collect();
    let own_rates: Vec<S> = at.own.iter().map(|[_, rate]| *rate).collect();
    let [residual, rate, gamma] = &mut out;
    let moving = Moving { bodies: &bodies, own: &own, own_rates: &own_rates, t };
    c.linearize(&moving, Linearized { residual, rate, gamma, columns: &mut columns });
    (out, columns)
}

#[test]
fn every_element_of_the_catalogue_has_a_sample() {
    for (group, table) in catalogue() {
        // some joints act as forces
        let sampled = forces().iter().any(|f| f.group() == group && f.kind() == table.name)
            || constraints().iter().any(|c| c.kind() == table.name);
        assert!(sampled, "{} has no sample", table.name);
    }
}
