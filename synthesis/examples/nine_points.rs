//! Makes the start of the search for all four-bars through nine points:
//!
//!     cargo run --release -p kempe-synthesis --example nine_points python/kempe/synthesis/nine_points.bin
//!
//! From a random complex four-bar through nine points, the points move to others and back on random triangles. Four-bars
//! that follow them end as other ones of the same points (monodromy), until there are as many as theory gives. Further
//! triangles must find no more.

use kempe::math::{Complex, Field, Random};
use kempe_synthesis::{followed, settled, Care, Posture, Shifts, PATHS};

const SEED: u64 = 2;
const CARE: Care = Care { tolerance: 1e-4, exact: true, most: 20_000 };
/// Triangles after the last four-bar was found.
const MORE: usize = 4;
/// Two four-bars are the same within this share.
const SAME: f64 = 1e-8;

fn main() {
    let path = std::env::args().nth(1).expect("the name of a file");
    let random = &mut Random::new(SEED);
    let (first, from) = drawn(random);
    let base = rounded(random);
    let first = followed(&first, &from, &base, CARE).expect("the first four-bar");
    let (mut known, mut idle) = (vec![first], 0);
    while idle < MORE {
        let corners = [rounded(random), rounded(random)];
        let (before, mut lost) = (known.len(), 0);
        for k in 0..before {
            match around(&known[k], &base, &corners) {
                Some(end) if known.iter().all(|one| !is_same(one, &end)) => known.push(end),
                Some(_) => {}
                None => lost += 1,
            }
        }
        println!("{} four-bars, {lost} of {before} ways lost", known.len());
        idle = if known.len() == PATHS && before == PATHS { idle + 1 } else { 0 };
        assert!(known.len() <= PATHS, "more four-bars than theory gives");
    }
    let bytes = stored(&base, &known);
    std::fs::write(&path, &bytes).expect("a file that can be written");
    println!("{path}: {} bytes", bytes.len());
}

/// The end of a four-bar whose points move around a triangle.
fn around(start: &Posture, base: &Shifts, [one, two]: &[Shifts; 2]) -> Option<Posture> {
    let at = followed(start, base, one, CARE)?;
    followed(&followed(&at, one, two, CARE)?, two, base, CARE)
}

fn is_same(one: &Posture, other: &Posture) -> bool {
    let (one, other) = (one.pivots(), other.pivots());
    (0..2).all(|k| (one[k] - other[k]).magnitude() < SAME * (1.0 + one[k].magnitude()))
}

/// The numbers with four bytes. Each four-bar must be found again from them.
fn stored(base: &Shifts, known: &[Posture]) -> Vec<u8> {
    let rows = [base.at, base.mirrored].into_iter().chain(known.iter().map(|one| one.bars));
    for one in known {
        let again = settled(Posture::new(one.bars.map(single), base), base).expect("a four-bar");
        assert!(is_same(one, &again), "another four-bar than {one:?}");
    }
    let parts = rows.flatten().flat_map(|z| [z.re as f32, z.im as f32]);
    parts.flat_map(f32::to_le_bytes).collect()
}

fn single(z: Complex) -> Complex {
    Complex::new(f64::from(z.re as f32), f64::from(z.im as f32))
}

/// A random number with a size near 1.
fn complex(random: &mut Random) -> Complex {
    let size = (-random.uniform().ln()).sqrt();
    let (sine, cosine) = (std::f64::consts::TAU * random.uniform()).sin_cos();
    Complex::new(size * cosine, size * sine)
}

/// Random points that four-byte numbers give exactly.
fn rounded(random: &mut Random) -> Shifts {
    let mut eight = || std::array::from_fn(|_| single(complex(random)));
    Shifts { at: eight(), mirrored: eight() }
}

/// A random four-bar with eight of its points.
fn drawn(random: &mut Random) -> (Posture, Shifts) {
    let mut eight = || -> [Complex; 8] { std::array::from_fn(|_| complex(random)) };
    let (bars, turns) = (eight(), eight());
    let points = turns.map(|g| point(&bars, g));
    let points =
        Shifts { at: points.map(|point| point[0]), mirrored: points.map(|point| point[1]) };
    (Posture { bars, turns }, points)
}

/// A point after a turn: the equations of both sides are (u + x g + δ)(û + x̂ ĝ + δ̂) = u û.
fn point(bars: &[Complex; 8], g: Complex) -> [Complex; 2] {
    let h = -(g * (Complex::one() + g).reciprocal());
    // δ δ̂ + q δ̂ + p δ + r = 0
    let [one, two] = [0, 4].map(|side| {
        let [x, m, u, n] = std::array::from_fn(|k| bars[side + k]);
        let (q, p) = (u + x * g, n + m * h);
        [p, q, p * q - u * n]
    });
    // their difference is linear: δ̂ = rest + slope δ
    let inverse = (one[1] - two[1]).reciprocal();
    let (rest, slope) = (-((one[2] - two[2]) * inverse), -((one[0] - two[0]) * inverse));
    // slope δ² + 2 half δ + last = 0
    let half = (rest + one[0] + one[1] * slope) * Complex::from_real(0.5);
    let last = one[1] * rest + one[2];
    let at = (root(half * half - slope * last) - half) * slope.reciprocal();
    [at, rest + slope * at]
}

fn root(z: Complex) -> Complex {
    let size = z.re.hypot(z.im).sqrt();
    let (sine, cosine) = (0.5 * z.im.atan2(z.re)).sin_cos();
    Complex::new(size * cosine, size * sine)
}
