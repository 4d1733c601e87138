//! Cams: a programme and sizes in; curves, limits and remarks, a case or a drawing out.

use crate::convert::{row, Fields};
use crate::fault::Fault;
use kempe::math::Complex;
use kempe_exchange::dxf::{self, Sheet};
use kempe_synthesis::cam::{Cam, Closure, Drive, End, Follower, Law, Programme, Segment, Way};
use serde_json::{json, Value};

/// Step of the angle for the diagram of the lift, rad.
const STEP: f64 = std::f64::consts::PI / 90.0;

fn unknown(what: &str, name: &str) -> Fault {
    Fault::new(format!("there is no {what} '{name}'"))
}

/// A segment of the programme.
fn segment(given: &Value) -> Result<Segment, Fault> {
    let of = Fields(given.as_object().ok_or_else(|| Fault::new("a segment must be a table"))?);
    let way = match of.text("way")? {
        "rise" => Way::Rise,
        "dwell" => Way::Dwell,
        "return" => Way::Return,
        other => return Err(unknown("segment", other)),
    };
    let lift = match way {
        Way::Rise => Some(of.number("lift")?),
        _ => of.get("lift").map(|_| of.number("lift")).transpose()?,
    };
    let law = if way == Way::Dwell { "linear" } else { of.text("law")? };
    Ok((way, of.number("angle")?, lift, Law::Named(law.into())))
}

/// The cam of a request.
fn read(of: &Fields<'_>) -> Result<Cam, Fault> {
    let (kind, closure) = (of.text("follower")?, of.text("closure")?);
    let arm = of.get("arm").map(|_| of.number("arm")).transpose()?;
    let [x, y] = if arm.is_some() { of.pair("pivot")? } else { [0.0; 2] };
    let follower = Follower {
        kind: End::named(kind).ok_or_else(|| unknown("follower", kind))?,
        base: of.number("base_radius")?,
        roller: of.number_or("roller_radius", 0.0)?,
        offset: of.number_or("offset", 0.0)?,
        arm,
        pivot: Complex::new(x, y),
        face: of.number_or("face", 0.0)?,
        opposite: false,
    };
    let clockwise = of.text("direction")? == "cw";
    let segments = of.need("programme")?.as_array().map(Vec::as_slice).unwrap_or_default();
    let segments = segments.iter().map(segment).collect::<Result<Vec<_>, _>>()?;
    let cam = Cam {
        programme: Programme::new(&segments, arm.is_some())?,
        follower: if clockwise { follower.mirrored() } else { follower },
        clockwise,
        closure: Closure::named(closure).ok_or_else(|| unknown("closure", closure))?,
        drive: Drive {
            speed: of.number("speed")?,
            mass: of.number("mass")?,
            spring: of.pair("spring")?,
            gravity: of.number("gravity")?,
        },
    };
    cam.check()?;
    Ok(cam)
}

/// Places, one after the other.
fn flat(curve: &[Complex]) -> Value {
    row(&curve.iter().flat_map(|z| [z.re, z.im]).collect::<Vec<_>>())
}

/// The curves of a cam, its limits and what is doubtful.
pub fn described(fields: &Fields<'_>) -> Result<Value, Fault> {
    let cam = read(fields)?;
    let angles = cam.angles();
    let touched = cam.over(&angles, false)?;
    let curve =
        |place: &dyn Fn(usize) -> Complex| flat(&(0..angles.len()).map(place).collect::<Vec<_>>());
    let mut curves = vec![("profile", curve(&|k| touched[k].profile))];
    if cam.follower.kind == End::Roller {
        curves.push(("pitch", curve(&|k| touched[k].pitch)));
    }
    if cam.closure == Closure::Groove {
        let wide = 2.0 * cam.follower.roller;
        curves.push(("outer", curve(&|k| touched[k].beside(wide))));
    }
    if cam.closure == Closure::Conjugate {
        let second = cam.over(&angles, true)?;
        curves.push(("conjugate", curve(&|k| second[k].profile)));
    }
    let (steep, steep_at) = cam.largest_pressure_angle()?;
    let (sharp, sharp_at) = cam.least_radius_of_curvature()?;
    let undercut = cam.undercut()?;
    let remedies = (!undercut.is_empty()).then(|| cam.remedies());
    let samples = cam.programme.sampled(STEP);
    let lift =
        |order: usize| row(&samples.iter().map(|(.., rows)| rows[order]).collect::<Vec<_>>());
    let at = cam.over(&[0.0], false)?[0];
    Ok(json!({
        "angles": angles,
        "curves": curves.into_iter().collect::<Value>(),
        "diagram": {
            "angle": row(&samples.iter().map(|(_, angle, _)| *angle).collect::<Vec<_>>()),
            "s": lift(0), "v": lift(1), "a": lift(2),
        },
        "start": { "pitch": [at.pitch.re, at.pitch.im], "normal": [at.normal.re, at.normal.im],
            "profile": [at.profile.re, at.profile.im] },
        "pressure_angle": { "largest": steep, "at": steep_at,
            "recommended": cam.recommended_pressure_angle() },
        "radius_of_curvature": { "least": sharp, "at": sharp_at },
        "undercut": undercut,
        "remedies": remedies.map(|of| json!({ "base": of.base, "roller": of.roller })),
        "least_base": cam.least_base(Some(cam.recommended_pressure_angle()), 0.0),
        "lift_off_speed": cam.lift_off_speed(),
        "remarks": cam.doubts()?,
    }))
}

/// The case of a cam with its follower, as TOML.
pub fn case(fields: &Fields<'_>) -> Result<Value, Fault> {
    Ok(json!({ "text": read(fields)?.case()? }))
}

/// The profiles as a drawing in mm, with the bore of the shaft.
pub fn drawing(fields: &Fields<'_>) -> Result<Value, Fault> {
    let cam = read(fields)?;
    let line = |(layer, curve): (&str, Vec<Complex>)| {
        (layer.to_string(), true, curve.iter().map(|z| [z.re, z.im]).collect(), Vec::new())
    };
    let bore = cam.bore();
    let sheet = Sheet {
        unit: 1e-3,
        lines: cam.walls(&cam.angles())?.into_iter().map(line).collect(),
        circles: vec![("cam".into(), [0.0; 2], bore)],
        texts: vec![("cam".into(), [0.0; 2], bore, "O".into())],
    };
    Ok(json!({ "text": dxf::write(&sheet) }))
}
