//! Reference masses of light groups.
//!
//! A light group between heavy ones has a large W⁻¹, and thus large terms in the sums S_kk. The pivots that remain after
//! cancellation are those of the heavy groups. Compared with S_kk they would be small in every position, as at a
//! singular one. In the sums with which pivots are compared, a light group therefore counts with a reference mass M̃,
//! the mass of its surroundings. Since M̃ ≥ W, no pivot is smaller than with M̃ in place of W, and a small ratio still
//! means that the rows are nearly dependent.

use super::mass_block::dot;
use super::pattern::{GroupRow, Pattern};
use super::records::LightRow;
use super::saddle::Saddle;
use crate::math::{Listed, Real, ShortArray};

/// A light group: the ratios W/M̃ of its first two unknowns and of its third one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightGroup {
    /// Index of the group.
    pub group: usize,
    /// W/M̃, at most 1.
    pub ratios: [f64; 2],
}

impl<S: Real> Saddle<S> {
    /// Sets the light groups, in place of those before.
    pub fn set_light(&mut self, pattern: &Pattern, groups: &[LightGroup]) {
        let mut of_group = vec![None; self.masses.len()];
        groups.iter().for_each(|light| of_group[light.group] = Some(light.ratios));
        let rows = pattern.rows_of_groups().into_iter();
        let light = |GroupRow { entry, group, sum }: GroupRow| {
            let excess = of_group[group as usize]?.each(|ratio: f64| 1.0 - ratio);
            Some(LightRow { entry, group, sum, excess })
        };
        self.light = rows.filter_map(light).list();
    }

    /// Subtracts from the sums of the pivots what light groups exceed their reference masses by.
    #[inline(never)] // rare
    pub(super) fn count_light_as_reference(&mut self) {
        for &LightRow { entry, group, sum, excess: [moved, turned] } in &self.light {
            let (mass, row) = (&self.masses[group as usize], &self.entries[entry as usize]);
            let [d0, d1] = mass.translation.each(|inverse| inverse + mass.held);
            let along = dot(row, &mass.direction);
            let first = row[0] * row[0] * d0 + row[1] * row[1] * d1;
            self.factors[sum as usize] -=
                first * S::constant(moved) + along * along * mass.along * S::constant(turned);
        }
    }
}
