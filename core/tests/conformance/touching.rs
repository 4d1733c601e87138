//! Samples of stops and contacts.

use crate::samples::{curve, formula, on};
use kempe::elements::forces::{
    ClearanceJoint, Contact, ContactFriction, ContactSticking, Resting, Stop,
};
use kempe::elements::{
    BodyId, Constraint, Coordinate, CoordinateOf, Curve, CurveOn, ForceElement, NormalLaw, PointOn,
    Rim, Side,
};
use kempe::math::Local;
use std::f64::consts::TAU;

pub fn stops() -> Vec<ForceElement> {
    let mut all = Vec::new();
    let limits = [(Some(-0.3), None, 1.0), (None, Some(0.4), 1.5), (Some(-0.3), Some(0.8), 2.2)];
    for (lower, upper, exponent) in limits {
        let coordinate = CoordinateOf { body: BodyId(2), coordinate: Coordinate::Angle }.into();
        let (stiffness, damping) = (Some(7.0), 0.4);
        let (restitution, rest_speed) = (None, 1e-9);
        all.push(ForceElement::Stop(Stop {
            coordinate,
            lower,
            upper,
            stiffness,
            exponent,
            damping,
            restitution,
            rest_speed,
        }));
    }
    all
}

pub fn contacts() -> Vec<ForceElement> {
    let mut all = Vec::new();
    for form in ["circle", "line", "points", "formula", "polygon"] {
        for side in sides(form) {
            all.push(ForceElement::Contact(Contact {
                i: on(1, 0.2, -0.4),
                curve: Rim::new(curve(form)),
                radius: 0.3,
                side: *side,
                stiffness: Some(1.0),
                exponent: 1.5,
                damping: 0.3,
                law: NormalLaw::HuntCrossley,
                young: None,
                poisson: None,
                width: None,
                friction: 0.2,
                r#static: None,
                velocity: Some(0.5),
                restitution: None,
                rest_speed: 1e-9,
                wear: 0.4,
                curves: (),
                sides: (),
            }));
        }
    }
    all.extend(rubbing_contacts());
    all.extend(pressing_curves());
    all.extend([(0.5, false), (4.0, false), (4.0, true)].map(pin_in_bush));
    all
}

/// An ellipse on body i.
fn ellipse() -> CurveOn {
    let curve = formula(["a*cos(u)", "b*sin(u)"], [0.0, TAU], true, &[5.0, 4.0]);
    CurveOn { body: BodyId(1), curve }
}

/// Curves of body j that bulge outward, with the side outside: an egg, an arc, a polygon and a line.
fn bulging() -> Vec<(CurveOn, Side)> {
    let egg = ["(3 + a*cos(u))*cos(u)", "(3 + a*cos(u))*sin(u)"];
    let egg = CurveOn { body: BodyId(2), curve: formula(egg, [0.0, TAU], true, &[0.4, 0.0]) };
    let arc = formula(["a*cos(u)", "-b*sin(u)"], [-0.5, 1.5], false, &[3.0, 2.0]);
    let arc = CurveOn { body: BodyId(2), curve: arc };
    vec![
        (egg, Side::Right),
        (arc, Side::Left),
        (curve("polygon"), Side::Right),
        (curve("line"), Side::Left),
    ]
}

/// Two smooth curves, or one on a polygon or line, that press at some of the random places.
fn pressing_curves() -> Vec<ForceElement> {
    let of = |(on, side): (CurveOn, Side)| {
        let of_points = Contact {
            i: PointOn { body: BodyId(1), s: Local::zero() },
            curve: Rim::new(on).touched_by(Some((ellipse(), Side::Right))),
            radius: 0.3,
            side,
            stiffness: Some(1.0),
            exponent: 1.5,
            damping: 0.3,
            law: NormalLaw::HuntCrossley,
            young: None,
            poisson: None,
            width: None,
            friction: 0.2,
            r#static: None,
            velocity: Some(0.5),
            restitution: None,
            rest_speed: 1e-9,
            wear: 0.4,
            curves: (),
            sides: (),
        };
        ForceElement::Contact(of_points)
    };
    bulging().into_iter().map(of).collect()
}

/// A pin in a bush that touches at some of the random places.
fn pin_in_bush((clearance, of_cylinders): (f64, bool)) -> ForceElement {
    let of = |x: f64| of_cylinders.then_some(x);
    ForceElement::ClearanceJoint(ClearanceJoint {
        i: on(1, 0.2, -0.4),
        j: on(2, -0.3, 0.5),
        radius: 5.0,
        clearance,
        stiffness: (!of_cylinders).then_some(1.0),
        exponent: 1.5,
        damping: 0.3,
        law: if of_cylinders { NormalLaw::Hertz } else { NormalLaw::HuntCrossley },
        young: of(0.5),
        poisson: of(0.3),
        width: of(0.7),
        friction: 0.2,
        r#static: None,
        velocity: Some(0.5),
        restitution: None,
        rest_speed: 1e-9,
        wear: 0.4,
    })
}

/// The sides of a curve; a polygon is touched from outside.
fn sides(form: &str) -> &'static [Side] {
    match form {
        "polygon" => &[Side::Right],
        _ => &[Side::Right, Side::Left],
    }
}

/// The friction of contacts that slides and sticks.
fn rubbing_contacts() -> Vec<ForceElement> {
    let mut all = Vec::new();
    for form in ["circle", "line", "polygon"] {
        for side in sides(form) {
            all.push(ForceElement::ContactFriction(ContactFriction {
                i: on(1, 0.2, -0.4),
                curve: Rim::new(curve(form)),
                radius: 0.3,
                side: *side,
                stiffness: Some(1.0),
                exponent: 1.5,
                damping: 0.3,
                young: None,
                poisson: None,
                width: None,
                kinetic: 0.2,
                r#static: 0.3,
            }));
        }
    }
    all
}

/// Equations by which forces hold.
pub fn resting() -> Vec<Constraint> {
    let of = |form: &str, side: Side| {
        let curve = Rim::new(curve(form));
        Constraint::Resting(Resting { i: on(1, 0.2, -0.4), curve, radius: 0.3, side })
    };
    let pair = |(on, side): (CurveOn, Side)| {
        let curve = Rim::new(on).touched_by(Some((ellipse(), Side::Right)));
        let i = PointOn { body: BodyId(1), s: Local::zero() };
        Constraint::Resting(Resting { i, curve, radius: 0.3, side })
    };
    let mut all = vec![
        of("circle", Side::Left),
        of("line", Side::Right),
        of("points", Side::Right),
        of("polygon", Side::Right),
    ];
    all.extend(bulging().into_iter().map(pair));
    all
}

/// All equations of contacts.
pub fn held() -> Vec<Constraint> {
    [resting(), sticking()].concat()
}

/// Equations by which contacts stick, on a line that is longer than the random places: beyond its ends, the length rolled
/// jumps where a body is behind the line, and on a circle after half a turn.
fn sticking() -> Vec<Constraint> {
    let of = |side: Side| {
        let line = Curve::Line { from: Local::new(-20.0, -9.0), to: Local::new(25.0, 11.0) };
        let curve = Rim::new(CurveOn { body: BodyId(2), curve: line });
        let (radius, value) = (0.3, 0.1);
        let equation = ContactSticking { i: on(1, 0.2, -0.4), curve, radius, side, value };
        Constraint::ContactSticking(equation)
    };
    [Side::Left, Side::Right].map(of).to_vec()
}
