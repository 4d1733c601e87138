//! Samples of friction.

use kempe::elements::forces::Friction;
use kempe::elements::{
    Attachment, Bearing, BodyId, ForceElement, JointId, QuantityKind, QuantityOf,
};
use kempe::expression::Tape;
use kempe::math::Local;

/// A joint between bodies 1 and 2.
fn bearing(kind: &'static str, quantity: &'static str, measures: QuantityKind) -> Bearing {
    let end = |x: f64, y: f64, axis: f64| Attachment { s: Local::new(x, y), axis };
    let ends = [end(0.3, -0.7, 0.4), end(-1.1, 0.4, -0.2)];
    let tapes = ends.map(|Attachment { s, axis }| Attachment {
        s: Local { x: Tape::from(s.x), y: Tape::from(s.y) },
        axis: Tape::from(axis),
    });
    let coordinate = QuantityOf {
        name: format!("joint.{quantity}"),
        word: quantity,
        kind: measures,
        bodies: [BodyId(1), BodyId(2)],
        ends: tapes,
        value: Tape::from(0.0),
    };
    let holds_angle = kind == "translational";
    Bearing { joint: JointId(0), holds_angle, ends, coordinate: coordinate.into() }
}

pub fn frictions() -> Vec<ForceElement> {
    let pin = Friction {
        joint: bearing("revolute", "angle", QuantityKind::Angle),
        kinetic: 0.3,
        r#static: Some(0.5),
        radius: Some(0.2),
        guide: 0.0,
        stribeck: Some(0.7),
        viscous: 0.4,
        velocity: Some(0.6),
        load: None,
    };
    let slide = Friction {
        joint: bearing("translational", "displacement", QuantityKind::Length),
        radius: None,
        guide: 0.5,
        ..pin.clone()
    };
    let slot = Friction {
        joint: bearing("pin_in_slot", "displacement", QuantityKind::Length),
        guide: 0.0,
        velocity: Some(0.3),
        load: Some(2.5),
        ..slide.clone()
    };
    [pin, slide, slot].map(ForceElement::Friction).into()
}
