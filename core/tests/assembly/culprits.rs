//! A wrong length is found: the message names the loop that cannot close, not a sound one beside it.

use crate::mechanisms::{close, model, request, Random};
use kempe::analyses::assemble::{assemble, Failure};
use std::fmt::Write;

/// A body with its frame in the position meant, and its points in this frame.
struct Part {
    name: String,
    at: [f64; 2],
    angle: f64,
    points: Vec<[f64; 2]>,
}

impl Part {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [self.at[0] + cos * x - sin * y, self.at[1] + sin * x + cos * y]
    }
}

/// A crank with random dyads of bars on earlier bodies. One of them has a wrong length.
struct Mechanism {
    text: String,
    guesses: Vec<(String, String)>,
    /// The joints of the wrong dyad.
    wrong: Vec<String>,
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The bodies as text.
fn bodies(parts: &[Part]) -> String {
    let mut text = String::new();
    for part in parts {
        let points = part.points.iter().enumerate();
        let points: Vec<String> =
            points.map(|(k, [x, y])| format!("P{k} = [{x:e}, {y:e}]")).collect();
        let mass = if part.name == "ground" { "" } else { "mass = 1\ninertia = 1\n" };
        let _ =
            write!(text, "[bodies.{}]\n{mass}points = {{ {} }}\n", part.name, points.join(", "));
    }
    text
}

fn mechanism(random: &mut Random, size: f64, hopeless: bool) -> Mechanism {
    let mut parts = vec![
        Part { name: "ground".to_string(), at: [0.0; 2], angle: 0.0, points: vec![[0.0; 2]] },
        Part { name: "crank".to_string(), at: [0.0; 2], angle: 0.7, points: vec![[0.0; 2]] },
    ];
    let mut joints =
        "[joints]\nO = { type = 'revolute', i = 'ground.P0', j = 'crank.P0' }\n".to_string();
    let count = 2 + (1.5 * (1.0 + random.next())) as usize;
    let broken = ((0.5 + 0.5 * random.next()) * count as f64) as usize;
    let mut wrong = Vec::new();
    for k in 0..count {
        // two pins on earlier bodies, of which the second is new or ground
        let carriers =
            [parts.len() - 1, if random.next() < 0.3 { 0 } else { (k * 7) % (parts.len() - 1) }];
        let pins = carriers.map(|body| {
            let own = [0, 1].map(|_| size * 1.5 * random.next());
            parts[body].points.push(own);
            (
                parts[body].place(own),
                format!("{}.P{}", parts[body].name, parts[body].points.len() - 1),
            )
        });
        let [(a, from), (b, to)] = pins;
        let joint = [0, 1].map(|c| 0.5 * (a[c] + b[c]) + size * 1.5 * random.next());
        let mut lengths = [distance(a, joint), distance(b, joint)];
        let names = [format!("D{k}a"), format!("D{k}"), format!("D{k}b")];
        if k == broken {
            // a dyad on other dyads may close in another assembly, in which one of these is open
            let apart = distance(a, b);
            let sum = lengths[0] + lengths[1];
            lengths = match random.next() < 0.0 {
                _ if hopeless || k > 0 => [lengths[0], lengths[0] + 40.0 * size],
                true => lengths.map(|l| l * (0.75 + 0.15 * random.next()) * apart / sum),
                false => [lengths[0], lengths[0] + apart * (1.3 + 0.2 * random.next())],
            };
            wrong = names.to_vec();
        }
        let bars = [("l", a, lengths[0]), ("r", b, lengths[1])].map(|(side, at, length)| {
            let angle = (joint[1] - at[1]).atan2(joint[0] - at[0]);
            Part { name: format!("{side}{k}"), at, angle, points: vec![[0.0; 2], [length, 0.0]] }
        });
        let [l, r] = bars.each_ref().map(|bar| bar.name.clone());
        for (name, i, j) in [
            (&names[0], from, format!("{l}.P0")),
            (&names[1], format!("{l}.P1"), format!("{r}.P1")),
            (&names[2], to, format!("{r}.P0")),
        ] {
            let _ = writeln!(joints, "{name} = {{ type = 'revolute', i = '{i}', j = '{j}' }}");
        }
        parts.extend(bars);
    }
    let text = bodies(&parts);
    let guesses =
        parts[2..].iter().map(|part| (format!("{}.angle", part.name), format!("{}", part.angle)));
    Mechanism { guesses: guesses.collect(), text: text + &joints, wrong }
}

/// The failure. None if the wrong length closes in another assembly.
fn tried(text: &str, set: &[(&str, &str)], guesses: &[(String, String)]) -> Option<Box<Failure>> {
    let m = model(text);
    let guesses: Vec<(&str, &str)> =
        guesses.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    assemble(&m, &request(&m, set, &guesses)).err()
}

fn refused(text: &str, set: &[(&str, &str)], guesses: &[(String, String)]) -> Box<Failure> {
    tried(text, set, guesses).expect("a wrong length")
}

#[test]
fn the_wrong_one_of_random_dyads() {
    let mut random = Random::new(41);
    let mut missed = Vec::new();
    let mut found = 0;
    for k in 0.. {
        if found == 200 {
            break;
        }
        let size = 10.0_f64.powf(3.0 * random.next());
        let Mechanism { text, guesses, wrong } = mechanism(&mut random, size, k % 4 == 0);
        let guesses = if k % 4 == 0 { Vec::new() } else { guesses };
        let Some(failure) = tried(&text, &[("crank.angle", "0.7")], &guesses) else { continue };
        found += 1;
        if !wrong.contains(&failure.name) || !failure.message.contains("cannot close") {
            missed.push(format!("{k} {wrong:?}: {failure}"));
        }
    }
    assert!(missed.is_empty(), "{} {missed:#?}", missed.len());
}

/// A plate on parallel cranks of equal length, which are redundant, and a rod to a slider that is too short.
#[test]
fn a_short_rod_beside_redundant_cranks() {
    let mut random = Random::new(42);
    for k in 0..20 {
        let size = 10.0_f64.powf(3.0 * random.next());
        let (n, angle) = (3 + k % 3, 1.0 + 0.4 * random.next());
        let rod = size * angle.sin() * (0.5 + 0.3 * random.next());
        let points = |name: &str| {
            let all: Vec<String> =
                (0..n).map(|k| format!("{name}{k} = [{}, 0]", k as f64 * size)).collect();
            all.join(", ")
        };
        let mut text = format!(
            "redundancy = 'allow'\n[bodies.ground]\npoints = {{ {} }}\n[bodies.plate]\nmass = 2\ninertia = 1\npoints = {{ {} }}\n",
            points("G"),
            points("P")
        );
        let mut joints = String::new();
        let mut guesses = vec![("plate.angle".to_string(), "0".to_string())];
        for k in 0..n {
            let _ = write!(
                text,
                "[bodies.v{k}]\ntype = 'bar'\nmass = 1\nlength = {size}\nends = ['A', 'B']\n"
            );
            let _ =
                writeln!(joints, "A{k} = {{ type = 'revolute', i = 'ground.G{k}', j = 'v{k}.A' }}");
            let _ =
                writeln!(joints, "B{k} = {{ type = 'revolute', i = 'v{k}.B', j = 'plate.P{k}' }}");
            guesses.push((format!("v{k}.angle"), format!("{angle}")));
        }
        let last = n - 1;
        text += &format!(
            "[bodies.rod]\ntype = 'bar'\nmass = 1\nlength = {rod}\nends = ['T', 'E']\n[bodies.slider]\nmass = 1\ninertia = 1\n\
             points = {{ E = [0, 0] }}\n[joints]\n{joints}T = {{ type = 'revolute', i = 'v{last}.B', j = 'rod.T' }}\n\
             E = {{ type = 'revolute', i = 'rod.E', j = 'slider.E' }}\nS = {{ type = 'translational', i = 'ground.G0', j = 'slider.E' }}\n"
        );
        let angle = format!("{angle}");
        let failure = refused(&text, &[("v0.angle", &angle)], &guesses);
        let short = size * angle.parse::<f64>().unwrap().sin() - rod;
        close(&failure.to_string(), failure.gap, short, 1e-9 * short);
        assert!(["T", "E"].contains(&failure.name.as_str()), "{failure}");
        assert!(failure.message.contains(&format!("A{last}-T-E-S cannot close")), "{failure}");
    }
}

/// Two welded bodies between two pins that are too far apart, and a third body whose angle is set.
#[test]
fn a_value_that_is_set_is_not_blamed() {
    for size in [1e-3, 1.0, 1e3] {
        let bar = |name: &str| {
            format!("[bodies.{name}]\ntype = 'bar'\nmass = 1\nlength = {size}\nends = ['P', 'Q']\n")
        };
        let text = format!(
            "[bodies.ground]\npoints = {{ A = [0, 0], B = [{}, 0] }}\n{}{}{}[joints]\n\
             A = {{ type = 'revolute', i = 'ground.A', j = 'one.P' }}\nW = {{ type = 'weld', i = 'one.Q', j = 'two.P' }}\n\
             B = {{ type = 'revolute', i = 'ground.B', j = 'two.Q' }}\nT = {{ type = 'revolute', i = 'two.Q', j = 'tail.P' }}\n",
            2.5 * size,
            bar("one"),
            bar("two"),
            bar("tail"),
        );
        for set in
            [&[][..], &[("tail.angle", "0.3")], &[("one.angle", "0")], &[("two.angle", "0.1")]]
        {
            let failure = refused(&text, set, &[]);
            assert!(["A", "W", "B"].contains(&failure.name.as_str()), "{set:?} {failure}");
            assert!(!failure.message.contains("set "), "{set:?} {failure}");
            assert!((0.1..0.6).contains(&(failure.gap / size)), "{set:?} {failure}");
        }
    }
}

/// A chain of rods between pins that are too far apart, beside a chain that closes.
#[test]
fn a_chain_of_rods_that_is_too_short() {
    let mut random = Random::new(43);
    for k in 0..20 {
        let size = 10.0_f64.powf(3.0 * random.next());
        let n = 3 + k % 4;
        let mut text =
            format!("[bodies.ground]\npoints = {{ A = [0, 0], B = [{}, 0] }}\n", n as f64 * size);
        let mut joints = String::new();
        for (chain, length) in [("sound", 1.2), ("short", 0.8)] {
            let at = |k: usize| match k {
                0 => "ground.A".to_string(),
                _ if k == n => "ground.B".to_string(),
                _ => format!("{chain}{k}.P"),
            };
            for k in 1..n {
                let _ = write!(text, "[bodies.{chain}{k}]\ntype = 'point_mass'\nmass = 1\n");
            }
            for k in 0..n {
                let length = size * length * (1.0 + 0.05 * random.next());
                let _ = write!(
                    joints,
                    "[joints.{chain}_rod{k}]\ntype = 'distance'\ni = '{}'\nj = '{}'\nlength = {length}\n",
                    at(k),
                    at(k + 1)
                );
            }
        }
        let failure = refused(&(text + &joints), &[], &[]);
        assert!(failure.name.starts_with("short"), "{failure}");
        assert!(
            failure.message.contains("short") && !failure.message.contains("sound"),
            "{failure}"
        );
    }
}
