//! Random mechanisms as matrices.

use kempe::math::Real;
use kempe::solve::{Anchor, Pattern, RowBlock, Saddle, Weight};

/// xorshift64*: reproducible numbers in [-1, 1).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// [W Aᵀ; A -μI] as numbers: W by its five entries (d₀, d₁, d₂, b₀, b₁) for each group.
#[derive(Clone)]
pub struct Matrix {
    pub masses: Vec<[f64; 5]>,
    pub blocks: Vec<RowBlock>,
    pub entries: Vec<[f64; 3]>,
}

impl Matrix {
    /// Bodies joined by pins: `pins[k]` = (body, body or ground); every fifth joint has
    /// one row, the others two.
    pub fn mechanism(bodies: usize, pins: &[(usize, Option<usize>)], random: &mut Random) -> Self {
        let mut mass = |_| {
            let d = [1.5, 1.5, 1.5].map(|d| d + random.next());
            [d[0], d[1], d[2], 0.3 * random.next(), 0.3 * random.next()] // origin off the mass centre
        };
        let masses = (0..bodies).map(&mut mass).collect();
        let mut m = Self { masses, blocks: vec![], entries: vec![] };
        for (k, &(i, j)) in pins.iter().enumerate() {
            let size = if k % 5 == 4 { 1 } else { 2 };
            let bodies = [(Some(i), -1.0), (j, 1.0)];
            m.push(size, &bodies, random);
        }
        m
    }

    /// A joint: x and y of points, then a combination of all coordinates.
    pub fn push(&mut self, size: usize, bodies: &[(Option<usize>, f64)], random: &mut Random) {
        let mut touches = vec![];
        for &(body, sign) in bodies {
            let Some(body) = body else { continue };
            touches.push((body, 3 * self.entries.len()));
            let rows = [
                [sign, 0.0, random.next()],
                [0.0, sign, random.next()],
                [random.next(), random.next(), random.next()],
            ];
            self.entries.extend_from_slice(&rows[..size]);
        }
        let there = bodies.iter().filter(|(body, _)| body.is_some());
        let signs = if size == 2 { there.map(|(_, sign)| *sign).collect() } else { vec![] };
        self.blocks.push(RowBlock { size, touches, signs });
    }

    pub fn n(&self) -> usize {
        3 * self.masses.len() + self.rows()
    }

    pub fn rows(&self) -> usize {
        self.blocks.iter().map(|b| b.size).sum()
    }

    pub fn pattern(&self) -> Pattern {
        Pattern::new(vec![true; self.masses.len()], &self.blocks, &[])
    }

    pub fn weights(&self) -> Vec<Weight> {
        self.masses.iter().map(weight).collect()
    }

    pub fn saddle(&self, pattern: &Pattern) -> Saddle<f64> {
        let mut saddle = Saddle::new(pattern);
        saddle.weights = self.weights();
        saddle.entries.clone_from(&self.entries);
        saddle
    }

    /// Pairs of rows that hold one group alone, one for each group that has any.
    pub fn anchors(&self) -> Vec<usize> {
        let mut held = vec![false; self.masses.len()];
        let holds = |b: &RowBlock| b.size == 2 && b.signs.len() == 1;
        let first = |k: &usize| !std::mem::replace(&mut held[self.blocks[*k].touches[0].0], true);
        (0..self.blocks.len()).filter(|k| holds(&self.blocks[*k])).filter(first).collect()
    }

    /// The same matrix with the anchors as such; d₀ = d₁.
    pub fn anchored(&self) -> (Pattern, Saddle<f64>) {
        let anchors = self.anchors();
        let pattern = Pattern::new(vec![true; self.masses.len()], &self.blocks, &anchors);
        let mut saddle = self.saddle(&pattern);
        for (k, block) in anchors.iter().map(|k| &self.blocks[*k]).enumerate() {
            let (group, entry) = (block.touches[0].0, block.touches[0].1 / 3);
            let [d, _, d2, b0, b1] = self.masses[group];
            let shift = [0, 1].map(|i| block.signs[0] * self.entries[entry + i][2]);
            let moment = [b0 - d * shift[0], b1 - d * shift[1]];
            let about = d2 - shift[0] * (b0 + moment[0]) - shift[1] * (b1 + moment[1]);
            saddle.anchors[k] = Anchor { mass: d, inverse: 1.0 / about, moment, shift };
            let inverse = [0.0, 0.0, 1.0 / about];
            saddle.weights[group] = Weight { inverse, shift, held: 1.0 / d };
        }
        (pattern, saddle)
    }

    pub fn dense(&self) -> Vec<Vec<f64>> {
        let (n, first) = (self.n(), 3 * self.masses.len());
        let mut a = vec![vec![0.0; n]; n];
        for (k, d) in self.masses.iter().enumerate() {
            for c in 0..3 {
                a[3 * k + c][3 * k + c] = d[c];
            }
            for c in 0..2 {
                a[3 * k + c][3 * k + 2] = d[3 + c];
                a[3 * k + 2][3 * k + c] = d[3 + c];
            }
        }
        let mut start = first;
        for block in &self.blocks {
            for &(group, at) in &block.touches {
                for (r, entries) in self.entries[at / 3..at / 3 + block.size].iter().enumerate() {
                    for (c, &e) in entries.iter().enumerate() {
                        a[start + r][3 * group + c] = e;
                        a[3 * group + c][start + r] = e;
                    }
                }
            }
            start += block.size;
        }
        a
    }
}

pub fn weight<S: Real>(d: &[S; 5]) -> Weight<S> {
    let shift = [d[3] / d[0], d[4] / d[1]];
    let left = d[2] - shift[0] * d[3] - shift[1] * d[4];
    let one = S::one();
    Weight { inverse: [one / d[0], one / d[1], one / left], shift, held: S::zero() }
}

pub fn four_bar(random: &mut Random) -> Matrix {
    Matrix::mechanism(3, &[(0, None), (0, Some(1)), (1, Some(2)), (2, None)], random)
}

/// A chain of `bodies` hung between two pins.
pub fn chain(bodies: usize, random: &mut Random) -> Matrix {
    let mut pins = vec![(0, None)];
    pins.extend((1..bodies).map(|b| (b - 1, Some(b))));
    pins.push((bodies - 1, None));
    Matrix::mechanism(bodies, &pins, random)
}

/// `arms` bodies on one hub: its joints become a dense block, with long columns.
pub fn hub(arms: usize, random: &mut Random) -> Matrix {
    let pins: Vec<_> = (1..=arms).map(|b| (0, Some(b))).collect();
    Matrix::mechanism(arms + 1, &pins, random)
}

/// Random loops over a tree.
pub fn tangle(bodies: usize, random: &mut Random) -> Matrix {
    let mut pins = vec![(0, None)];
    for b in 1..bodies {
        let parent = ((random.next() + 1.0) / 2.0 * b as f64) as usize;
        pins.push((parent, Some(b)));
    }
    for b in (4..bodies).step_by(4) {
        let other = (b + bodies / 2 + 1) % bodies; // odd, so no loop comes twice
        let joined = pins.contains(&(b, Some(other))) || pins.contains(&(other, Some(b)));
        if !joined {
            pins.push((b, Some(other)));
        }
    }
    Matrix::mechanism(bodies, &pins, random)
}
