//! The case of a cam with its follower, as TOML.

use super::curves::{curve, Cam, Closure, Layer};
use super::follower::End;
use crate::conditions::Refused;
use crate::plane::{scaled, turn};
use kempe::math::Complex;
use std::f64::consts::{PI, TAU};

/// Density × thickness of the cam, a disc of steel of the base radius, 10 mm thick, kg/m².
const SURFACE: f64 = 78.5;
/// The case of every cam, with a turn of 360 outputs.
const CASE: &str = r#"kempe = 1
title = "cam, <way> <kind> follower"
gravity = [0, <down>]

[parameters]
speed = <speed>
mass = <mass>
stiffness = <stiffness>
force = <force>

[bodies.ground]
points = { O = [0, 0], <ground> }

[bodies.cam]
type = "body"
points = { O = [0, 0] }
curves = { <curves> }
shapes = [{ type = "disc", radius = <radius>, mass = <heavy> }]

[bodies.follower]
<body>

[joints.<joint>

[joints.shaft]
type = "revolute"
i = "ground.O"
j = "cam.O"

[joints.contact]
<contact>

[drivers.drive]
type = "coordinate_driver"
coordinate = "cam.angle"
value = "<law>"
<more>
[start]
guess = { "cam.angle" = 0, <guess>, "contact.u" = 0 }

[analyses.turn]
type = "inverse_dynamics"
t_end = "2*pi/speed"
output_step = "2*pi/speed/360"
"#;
/// A follower in a vertical guide: points of ground, body, joint, guesses, and a spring above.
const TRANSLATING: [&str; 5] = [
    "G = [<x>, 0], S = [<x>, <above>]",
    "type = \"body\"\nmass = \"mass\"\ninertia = 0\npoints = { P = [0, 0], T = [0, <top>] }",
    r#"guide]
type = "translational"
i = "ground.G"
j = "follower.P"
axes = ["90 deg", "90 deg"]"#,
    r#""follower.x" = <x>, "follower.y" = <low>, "follower.angle" = 0"#,
    r#"
[forces.spring]
type = "spring_damper"
i = "ground.S"
j = "follower.T"
stiffness = "stiffness"
free_length = <free>
preload = "-force"
"#,
];
/// A bar on a pivot with a torsion spring, in the same order.
const OSCILLATING: [&str; 5] = [
    "M = [<x>, <y>]",
    r#"type = "bar"
mass = "mass"
length = <length>
ends = ["M", "P"]<points>"#,
    r#"pivot]
type = "revolute"
i = "ground.M"
j = "follower.M""#,
    r#""follower.x" = <middle>, "follower.y" = <height>, "follower.angle" = <angle>"#,
    r#"
[forces.spring]
type = "torsion_spring"
i = "ground"
j = "follower"
stiffness = "stiffness"
free_angle = <angle>
preload = "<preload>"
"#,
];
/// The joints of faces, of rollers on one side, and of followers that a cam pushes and pulls.
const FACE: &str = r#"type = "flat_on_curve"
i = "follower.<point>"
curve = "cam.rim""#;
const ROLLER: &str = r#"type = "roller_on_curve"
i = "follower.P"
curve = "cam.rim"
radius = <roller><side>"#;
const RAIL: &str = r#"type = "point_on_curve"
i = "follower.P"
curve = "cam.<rail>""#;
/// The force along the motion of an oscillating follower.
const ALONG: &str = "contact.fx*sin(follower.angle) - contact.fy*cos(follower.angle)";

impl Cam {
    /// The cam with its follower as a case, with a turn by inverse dynamics. The bodies are `cam` with the curve `rim`,
    /// and `follower`; the joints are `shaft`, `guide` or `pivot`, and `contact`; the driver is `drive`.
    ///
    /// # Errors
    /// The profile is undercut.
    pub fn case(&self) -> Result<String, Refused> {
        self.refuse_undercut()?;
        let (of, drive) = (&self.follower, &self.drive);
        let held = self.held();
        let [ground, body, joint, guess, spring] = held.each_ref().map(String::as_str);
        let forces = if drive.spring == [0.0; 2] { "" } else { spring };
        let (contact, measures) = self.contact();
        let texts = [
            ("way", if of.arm.is_some() { "oscillating" } else { "translating" }),
            ("kind", of.kind.name()),
            ("ground", ground),
            ("curves", &self.curves()?),
            ("body", body),
            ("joint", joint),
            ("contact", &contact),
            ("law", if self.clockwise { "-speed*t" } else { "speed*t" }),
            ("more", &[forces, &measures].concat()),
            ("guess", guess),
        ];
        let numbers = [
            ("down", -drive.gravity),
            ("speed", drive.speed),
            ("mass", drive.mass),
            ("stiffness", drive.spring[0]),
            ("force", drive.spring[1]),
            ("radius", of.base),
            ("heavy", SURFACE * PI * (of.base * of.base)),
        ];
        Ok(filled(CASE, &texts, &numbers))
    }

    /// Whether the cam pushes and pulls the follower.
    fn pulls(&self) -> bool {
        self.closure != Closure::Force
    }

    /// The curves of the body: all profiles, and the pitch curve if the follower runs on it.
    fn curves(&self) -> Result<String, Refused> {
        let angles = self.angles();
        let mut found = self.walls(&angles)?;
        if self.pulls() && self.rolls() {
            found.push(("pitch", curve(&self.over(&angles, false)?, |of| of.pitch)));
        }
        let through = |(layer, places): &Layer| {
            let points = places.iter().map(|z| format!("[{:?}, {:?}]", z.re, z.im));
            let points = points.collect::<Vec<_>>().join(", ");
            let name = match *layer {
                "cam" => "rim",
                "conjugate" => "second",
                name => name,
            };
            format!("{name} = {{ points = [{points}], periodic = true }}")
        };
        Ok(found.iter().map(through).collect::<Vec<_>>().join(", "))
    }

    /// Points of ground, the body of the follower, its joint, guesses, and its spring.
    fn held(&self) -> [String; 5] {
        let of = &self.follower;
        let Some(arm) = of.arm else {
            let (low, long) = (of.start(), self.programme.size + of.base + of.roller);
            let numbers = [
                ("x", if self.clockwise { -of.offset } else { of.offset }),
                ("low", low),
                ("above", low + 3.0 * long),
                ("top", long),
                ("free", 2.0 * long),
            ];
            return TRANSLATING.map(|part| filled(part, &[], &numbers));
        };
        let (mut angle, mut sense, mut pivot) = (of.direction(0.0), of.sense(), of.pivot);
        if self.clockwise {
            // the mirror image
            (angle, sense, pivot) = (PI - angle, -sense, Complex::new(-pivot.re, pivot.im));
        }
        angle = (angle + PI).rem_euclid(TAU) - PI;
        let middle = pivot + scaled(turn(angle), arm / 2.0);
        let texts = [
            ("points", if of.kind == End::Flat { "\npoints = { F = [0, <face>] }" } else { "" }),
            ("preload", if sense > 0.0 { "force" } else { "-force" }),
        ];
        let numbers = [
            ("x", pivot.re),
            ("y", pivot.im),
            ("length", arm),
            ("face", -sense * of.face),
            ("middle", middle.re),
            ("height", middle.im),
            ("angle", angle),
        ];
        OSCILLATING.map(|part| filled(part, &texts, &numbers))
    }

    /// The joint between follower and cam, and the measure `press` where it has no `normal`.
    fn contact(&self) -> (String, String) {
        let of = &self.follower;
        let swings = of.arm.is_some();
        let one_sided = match of.kind {
            End::Flat => Some(FACE),
            End::Roller if !self.pulls() => Some(ROLLER),
            _ => None,
        };
        let texts = [
            ("point", if swings { "F" } else { "P" }),
            ("side", if self.clockwise { "" } else { "\nside = \"left\"" }),
            ("rail", if self.rolls() { "pitch" } else { "rim" }),
        ];
        let joint = filled(one_sided.unwrap_or(RAIL), &texts, &[("roller", of.roller)]);
        let press = match (of.sense() > 0.0) != self.clockwise {
            _ if one_sided.is_some() => return (joint, String::new()),
            _ if !swings => "-contact.fy".into(),
            true => ALONG.into(),
            false => ["-(", ALONG, ")"].concat(),
        };
        (joint, ["\n[measures]\npress = \"", &press, "\"\n"].concat())
    }
}

/// A template with its texts, and with all digits of its numbers.
fn filled(template: &str, texts: &[(&str, &str)], numbers: &[(&str, f64)]) -> String {
    let mut made = template.to_string();
    for (name, text) in texts {
        made = made.replace(&["<", name, ">"].concat(), text);
    }
    for (name, x) in numbers {
        made = made.replace(&["<", name, ">"].concat(), &format!("{x:?}"));
    }
    made
}
