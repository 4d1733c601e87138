//! Numbers and positions of the teeth of drawn gears, so that pairs mesh.
//!
//! Meshing wheels and racks have one module. If the model does not define it, it is chosen such that the numbers of
//! teeth are nearly integers.

use super::data::{Symbol, Teeth};
use super::mark::is_toothed_wheel;
use super::paths::Paths;
use crate::plane::{ahead, direction, dot, left_of, minus, placed, size, At, Pose};
use kempe::elements::Mark;
use std::f64::consts::PI;

/// Deviation below which a number of teeth counts as an integer.
const WHOLE: f64 = 1e-6;
/// Height of a tooth above the pitch line, and distance of the rim of a ring from the pitch line, in pitches.
const TOOTH: f64 = 0.25;
const RIM: f64 = 0.9;

/// The outer radius of a drawn wheel, m.
pub fn outer_radius(symbol: &Symbol) -> f64 {
    let share = if symbol.mark == Mark::ToothedRing { RIM } else { TOOTH };
    symbol.radii()[1] + symbol.teeth.map_or(0.0, |teeth| share * PI * teeth.module)
}

/// Mark, body, position and radius. Symbols with equal keys are one wheel or rack.
type Key = (Mark, usize, [i64; 2], u64);
/// The indices of two toothed symbols that mesh.
type Pair = [usize; 2];

/// Sets the teeth of all toothed symbols. They mesh at the first instant.
pub fn add_teeth(symbols: &mut [Symbol], paths: Paths<'_>) {
    for group in connected(symbols, &pairs(symbols)) {
        let module = module(symbols, &group);
        let mut phases: Vec<(Key, f64)> = Vec::new();
        for pair in in_order(symbols, &group) {
            let known = |phases: &[(Key, f64)], k: usize| {
                let key = key(&symbols[k]);
                phases.iter().find(|(other, _)| *other == key).map(|(_, phase)| *phase)
            };
            let [a, b] = pair;
            let [first, second] = if known(&phases, a).is_some() { [a, b] } else { [b, a] };
            let phase = known(&phases, first).unwrap_or_else(|| {
                phases.push((key(&symbols[first]), 0.0));
                0.0
            });
            if known(&phases, second).is_none() {
                let mesh = Mesh { symbols: [&symbols[first], &symbols[second]], module, paths };
                let other = mesh.phase(phase);
                phases.push((key(&symbols[second]), other));
            }
        }
        for k in group.into_iter().flatten() {
            let key = key(&symbols[k]);
            let phase = phases.iter().find(|(other, _)| *other == key).map_or(0.0, |of| of.1);
            symbols[k].teeth = Some(Teeth { module, phase });
        }
    }
}

fn is_toothed(mark: Mark) -> bool {
    is_toothed_wheel(mark) || mark == Mark::ToothedLine
}

/// The pairs of toothed symbols, for each element with two.
fn pairs(symbols: &[Symbol]) -> Vec<Pair> {
    let mut found = Vec::new();
    let mut first = 0;
    for own in symbols.chunk_by(|a, b| a.element == b.element) {
        let toothed: Vec<usize> =
            (first..first + own.len()).filter(|k| is_toothed(symbols[*k].mark)).collect();
        if let [a, b] = toothed[..] {
            found.push([a, b]);
        }
        first += own.len();
    }
    found
}

fn key(symbol: &Symbol) -> Key {
    let k = usize::from(is_toothed_wheel(symbol.mark));
    let at = symbol.points[k].unwrap_or_default().map(|x| (x * 1e12).round() as i64);
    let radius = symbol.radii()[1].abs() * k as f64;
    (symbol.mark, symbol.bodies[k], at, radius.to_bits())
}

fn touches(symbols: &[Symbol], group: &[Pair], keys: &[Key]) -> bool {
    group.iter().flatten().any(|k| keys.contains(&key(&symbols[*k])))
}

/// Groups of pairs that are connected by common wheels, directly or indirectly.
fn connected(symbols: &[Symbol], pairs: &[Pair]) -> Vec<Vec<Pair>> {
    let mut groups: Vec<Vec<Pair>> = Vec::new();
    for pair in pairs {
        let keys = pair.map(|k| key(&symbols[k]));
        let (touching, mut others): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group| touches(symbols, group, &keys));
        let mut group: Vec<Pair> = touching.into_iter().flatten().collect();
        group.push(*pair);
        others.push(group);
        groups = others;
    }
    groups
}

/// The pairs of a group, ordered such that each has a wheel in common with earlier pairs.
fn in_order(symbols: &[Symbol], group: &[Pair]) -> Vec<Pair> {
    let mut left = group.to_vec();
    let mut seen = vec![key(&symbols[group[0][0]])];
    let mut found = Vec::new();
    while let Some(k) = left.iter().position(|pair| touches(symbols, &[*pair], &seen)) {
        let pair = left.remove(k);
        seen.extend(pair.map(|k| key(&symbols[k])));
        found.push(pair);
    }
    found
}

fn module(symbols: &[Symbol], group: &[Pair]) -> f64 {
    let own = || group.iter().flatten().map(|k| &symbols[*k]);
    if let Some(given) = own().find_map(|one| one.module) {
        return given;
    }
    let radii: Vec<f64> = own().map(|one| one.radii()[1].abs()).collect();
    let least = radii.iter().copied().fold(f64::INFINITY, f64::min);
    let error = |count: &f64| {
        let off = |radius: &f64| {
            let teeth = radius / least * count;
            (teeth - teeth.round_ties_even()).abs()
        };
        radii.iter().map(off).fold(0.0, f64::max)
    };
    // numbers of teeth of the smallest wheel, the usual number first
    let counts: Vec<f64> = std::iter::once(18).chain(14..31).map(f64::from).collect();
    let whole = counts.iter().find(|count| error(count) < WHOLE);
    let best = whole.or_else(|| counts.iter().min_by(|a, b| error(a).total_cmp(&error(b))));
    2.0 * least / best.copied().unwrap_or(18.0)
}

/// Two symbols that mesh.
struct Mesh<'a> {
    symbols: [&'a Symbol; 2],
    module: f64,
    paths: Paths<'a>,
}

impl Mesh<'_> {
    /// The phase of the second symbol for which its teeth are in the gaps of the first.
    fn phase(&self, phase: f64) -> f64 {
        let [first, second] = self.symbols;
        let pitch = PI * self.module;
        let contact = self.contact();
        let (mut place, sign) = self.of_pitches(first, contact);
        let (other, other_sign) = self.of_pitches(second, contact);
        let unit = if is_toothed_wheel(first.mark) { first.radii()[1] } else { 1.0 };
        place -= phase * unit / pitch;
        // a gap of the first symbol is at this distance along the common tangent, in pitches
        let gap = (0.5 - place) * sign;
        let shift = other + other_sign * gap; // whole where a tooth of the second one is in the gap
        if is_toothed_wheel(second.mark) {
            return shift * pitch / second.radii()[1];
        }
        shift * pitch
    }

    /// The pitch point and the direction of the common tangent.
    fn contact(&self) -> (At, At) {
        let [first, second] = self.symbols;
        let swap = !is_toothed_wheel(first.mark);
        let (wheel, other) = if swap { (second, first) } else { (first, second) };
        let (centre, radius) = (self.end(wheel, 1), wheel.radii()[1]);
        if !is_toothed_wheel(other.mark) {
            let along = direction(self.pose(other.bodies[0])[2] + other.axes[0]);
            let side = -1.0_f64.copysign(other.radii()[1]);
            return (ahead(centre, side * radius, left_of(along)), along);
        }
        let away = minus(self.end(other, 1), centre);
        let length = if size(away) > 0.0 { size(away) } else { 1.0 };
        let sense = if other.mark == Mark::ToothedRing { -1.0 } else { 1.0 };
        let out = away.map(|x| sense * x / length);
        (ahead(centre, radius, out), left_of(out))
    }

    /// The position of the pitch point on a symbol, in pitches, and its sense along the tangent.
    fn of_pitches(&self, symbol: &Symbol, (point, along): (At, At)) -> (f64, f64) {
        let pitch = PI * self.module;
        if is_toothed_wheel(symbol.mark) {
            let arm = minus(point, self.end(symbol, 1));
            let turn = arm[1].atan2(arm[0]) - self.pose(symbol.bodies[1])[2];
            let sense = 1.0_f64.copysign(arm[0] * along[1] - arm[1] * along[0]);
            return (turn * symbol.radii()[1] / pitch, sense);
        }
        let axis = direction(self.pose(symbol.bodies[0])[2] + symbol.axes[0]);
        let place = dot(axis, minus(point, self.end(symbol, 0)));
        (place / pitch, 1.0_f64.copysign(dot(axis, along)))
    }

    fn end(&self, symbol: &Symbol, k: usize) -> At {
        placed(self.pose(symbol.bodies[k]), symbol.points[k].unwrap_or_default())
    }

    fn pose(&self, body: usize) -> Pose {
        self.paths.of(body).next().unwrap_or_default()
    }
}
