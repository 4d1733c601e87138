//! Random mechanisms as matrices.

use kempe::math::Real;
use kempe::solve::{CondensedGroup, Group, InverseMass, Pattern, RowBlock, Saddle};

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

/// [W Aᵀ; A -μI] as numbers: W by its five entries (d₀, d₁, d₂, b₀, b₁) for each group; those that a shorter group
/// does not have are 1 and 0.
#[derive(Clone)]
pub struct Matrix {
    pub sizes: Vec<usize>,
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
        let mut m = Self { sizes: vec![3; bodies], masses, blocks: vec![], entries: vec![] };
        for (k, &(i, j)) in pins.iter().enumerate() {
            let size = if k % 5 == 4 { 1 } else { 2 };
            let bodies = [(Some(i), -1.0), (j, 1.0)];
            m.push(size, &bodies, random);
        }
        m
    }

    /// The same with groups of one to three unknowns.
    pub fn shortened(mut self, random: &mut Random) -> Self {
        for (size, mass) in self.sizes.iter_mut().zip(&mut self.masses) {
            *size = 1 + ((random.next() + 1.0) * 1.5) as usize;
            let unit = [1.0, 1.0, 1.0, 0.0, 0.0];
            if *size < 3 {
                *mass = std::array::from_fn(|c| if c < *size { mass[c] } else { unit[c] });
            }
        }
        for block in &mut self.blocks {
            for &(group, first) in &block.touches {
                for row in &mut self.entries[first / 3..first / 3 + block.size] {
                    row[self.sizes[group]..].fill(0.0);
                }
            }
            if block.touches.iter().any(|&(group, _)| self.sizes[group] == 1) {
                block.signs.clear(); // no room for a unit block
            }
        }
        self
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

    /// Two rows at one group that do not begin with ±I, such as those of a slide.
    pub fn push_slide(&mut self, group: usize, random: &mut Random) {
        let touches = vec![(group, 3 * self.entries.len())];
        let (c, s) = (random.next(), random.next());
        self.entries.extend([[c, s, random.next()], [0.0, 0.0, 1.0]]);
        self.blocks.push(RowBlock { size: 2, touches, signs: vec![] });
    }

    /// First unknown of each group.
    pub fn starts(&self) -> Vec<usize> {
        (0..self.sizes.len()).map(|k| self.sizes[..k].iter().sum()).collect()
    }

    pub fn unknowns(&self) -> usize {
        self.sizes.iter().sum()
    }

    /// Unknowns and rows, without padding.
    pub fn n(&self) -> usize {
        self.unknowns() + self.rows()
    }

    pub fn rows(&self) -> usize {
        self.blocks.iter().map(|b| b.size).sum()
    }

    fn groups(&self) -> Vec<Group> {
        self.sizes.iter().map(|&size| Group { size, coupled: size == 3 }).collect()
    }

    pub fn pattern(&self) -> Pattern {
        Pattern::new(&self.groups(), &self.blocks, &[])
    }

    pub fn saddle(&self, pattern: &Pattern) -> Saddle<f64> {
        let mut saddle = Saddle::new(pattern);
        saddle.masses = self.masses.iter().map(inverse_mass).collect();
        saddle.entries.clone_from(&self.entries);
        saddle
    }

    /// Pairs of rows at only one group of three unknowns, at most one for each group.
    pub fn condensable(&self) -> Vec<usize> {
        let mut held: Vec<bool> = self.sizes.iter().map(|size| *size < 3).collect();
        let holds = |b: &RowBlock| b.size == 2 && b.touches.len() == 1;
        let first = |k: &usize| !std::mem::replace(&mut held[self.blocks[*k].touches[0].0], true);
        (0..self.blocks.len()).filter(|k| holds(&self.blocks[*k])).filter(first).collect()
    }

    /// The same matrix with these condensed; d₀ = d₁.
    pub fn condensed(&self) -> (Pattern, Saddle<f64>) {
        let condensed = self.condensable();
        let pattern = Pattern::new(&self.groups(), &self.blocks, &condensed);
        let mut saddle = self.saddle(&pattern);
        for (k, block) in condensed.iter().map(|k| &self.blocks[*k]).enumerate() {
            let (group, entry) = (block.touches[0].0, block.touches[0].1 / 3);
            let [d, _, d2, b0, b1] = self.masses[group];
            saddle.condensed[k] = CondensedGroup::new(d, [b0, b1], d2);
            let mass = &mut saddle.masses[group];
            (mass.translation, mass.held) = ([0.0; 2], 1.0 / d);
            if let [sign] = block.signs[..] {
                let b = [self.entries[entry][2], self.entries[entry + 1][2]];
                mass.along = 1.0 / saddle.condensed[k].about_pin(sign, b).1;
            }
        }
        (pattern, saddle)
    }

    pub fn dense(&self) -> Vec<Vec<f64>> {
        let (n, first, starts) = (self.n(), self.unknowns(), self.starts());
        let mut a = vec![vec![0.0; n]; n];
        for ((&at, &size), d) in starts.iter().zip(&self.sizes).zip(&self.masses) {
            for c in 0..size {
                a[at + c][at + c] = d[c];
            }
            for c in 0..2 * usize::from(size == 3) {
                a[at + c][at + 2] = d[3 + c];
                a[at + 2][at + c] = d[3 + c];
            }
        }
        let mut start = first;
        for block in &self.blocks {
            for &(group, at) in &block.touches {
                for (r, entries) in self.entries[at / 3..at / 3 + block.size].iter().enumerate() {
                    for (c, &e) in entries.iter().enumerate().take(self.sizes[group]) {
                        a[start + r][starts[group] + c] = e;
                        a[starts[group] + c][start + r] = e;
                    }
                }
            }
            start += block.size;
        }
        a
    }
}

pub fn inverse_mass<S: Real>(d: &[S; 5]) -> InverseMass<S> {
    let one = S::one();
    let e = [-(d[3] / d[0]), -(d[4] / d[1])];
    let left = d[2] + e[0] * d[3] + e[1] * d[4];
    let diagonal = InverseMass::diagonal([d[0], d[1], left].map(|d| one / d));
    InverseMass { direction: [e[0], e[1], one], ..diagonal }
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
