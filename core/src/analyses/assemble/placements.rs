//! The placements for all undecided choices. Placements without gaps come first.

use super::placement::Placement;
use super::placer::place;
use super::targets::Targets;
use crate::model::Model;

/// Largest number of placements that are computed.
const MOST: usize = 256;

/// Placements, in the order in which assembly tries them. They are computed when they are needed. A placement without
/// gaps is returned at once, and placements with gaps after all others.
pub(super) struct Placements<'a> {
    model: &'a Model,
    targets: &'a Targets,
    /// The choices for the next placement. None if all placements have been computed.
    choices: Option<Vec<usize>>,
    computed: usize,
    /// Placements with gaps, in order.
    open: std::collections::VecDeque<Placement>,
}

impl<'a> Placements<'a> {
    pub fn new(model: &'a Model, targets: &'a Targets) -> Self {
        let choices = Some(Vec::new());
        Self { model, targets, choices, computed: 0, open: std::collections::VecDeque::new() }
    }

    /// The next placement, with or without gaps.
    fn compute(&mut self) -> Option<Placement> {
        let choices = self.choices.take().filter(|_| self.computed < MOST)?;
        let placement = place(self.model, self.targets, &choices);
        self.computed += 1;
        self.choices = following(choices, &placement);
        Some(placement)
    }
}

/// The next combination of choices: the last choice with a remaining option uses it. Later choices cannot close a
/// gap.
pub(in crate::analyses) fn following(
    choices: Vec<usize>,
    placement: &Placement,
) -> Option<Vec<usize>> {
    following_before(placement.options.len(), choices, placement)
}

/// The next combination of choices with another option for one of the first `most` choices.
pub(in crate::analyses) fn following_before(
    most: usize,
    mut choices: Vec<usize>,
    placement: &Placement,
) -> Option<Vec<usize>> {
    let options = &placement.options;
    choices.resize(options.len(), 0);
    let before_gap = placement.gaps.first().map_or(most, |gap| gap.choices.min(most));
    let last = (0..before_gap).rev().find(|k| choices[*k] + 1 < options[*k])?;
    choices.truncate(last + 1);
    choices[last] += 1;
    Some(choices)
}

impl Iterator for Placements<'_> {
    type Item = Placement;

    fn next(&mut self) -> Option<Placement> {
        while let Some(placement) = self.compute() {
            if placement.gaps.is_empty() {
                return Some(placement);
            }
            self.open.push_back(placement);
        }
        self.open.pop_front()
    }
}
