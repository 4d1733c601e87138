//! The equations of motion of several variants of a model, one in each lane.

use super::motion_ode::{rates, MotionOde};
use crate::equations::{Gains, Workspace};
use crate::integrate::{LaneOde, Mask};
use crate::math::{Lanes, Listed, ShortArray};
use crate::model::Model;
use crate::stabilize::LaneProjector;

const WIDTH: usize = Lanes::WIDTH;

/// The variants over lanes.
pub(super) struct LaneMotion {
    model: Box<Model<Lanes>>,
    workspace: Workspace<Lanes>,
    gains: Gains,
    projector: Option<LaneProjector>,
}

impl LaneMotion {
    /// Lanes for variants of one model whose equations have equal structure. None if the structures differ, or if one
    /// elimination cannot solve the equations of one of the variants.
    pub fn new(lanes: [&MotionOde<'_>; WIDTH]) -> Option<Self> {
        let [first, ..] = lanes;
        let alike = |one: &&MotionOde<'_>| {
            one.workspace.is_like(&first.workspace)
                && one.workspace.solves_directly()
                && one.gains == first.gains
                && one.projection() == first.projection()
        };
        if !lanes.iter().all(alike) {
            return None;
        }
        let models = lanes.each(|one| one.model);
        let parameter = |k| Lanes::new(models.each(|model| model.parameters[k]));
        let parameters: Vec<Lanes> = (0..first.model.parameters.len()).map(parameter).list();
        let model = Box::new(Model::new(&first.model.blueprint, &parameters));
        let mut workspace = Workspace::like(&model, &first.workspace);
        if first.passing {
            workspace.matrix.set_near_singular(first.workspace.matrix.near_singular());
        }
        if !first.workspace.is_like(&workspace) || !workspace.solves_directly() {
            return None;
        }
        let projection = first.projection();
        let projector = projection.map(|options| LaneProjector::new(models, &model, options));
        Some(Self { model, workspace, gains: first.gains, projector })
    }
}

/// The equations over lanes, and the equations of each lane.
pub(super) struct LaneEquations<'r, 'a> {
    pub motion: &'r mut LaneMotion,
    pub lanes: [Option<&'r mut MotionOde<'a>>; WIDTH],
}

impl LaneOde for LaneEquations<'_, '_> {
    fn components(&self) -> usize {
        self.motion.model.layout.n_y()
    }

    fn rates(&mut self, t: Lanes, y: &[Lanes], dy: &mut [Lanes]) -> bool {
        let LaneMotion { model, workspace, gains, .. } = &mut *self.motion;
        let [q, v, z, _] = model.layout.split(y);
        workspace.place(model, [q, v, z]);
        let solved = workspace.respond_directly(model, t, *gains);
        rates(model, workspace, t, v, dy);
        solved
    }

    fn on_trials(&mut self, t: [f64; WIDTH], lanes: Mask) -> Mask {
        let ratios = self.motion.workspace.matrix.cancellations().to_array();
        std::array::from_fn(|lane| match &mut self.lanes[lane] {
            Some(one) if lanes[lane] => one.passage.clears(t[lane], ratios[lane]),
            _ => false,
        })
    }

    fn project(&mut self, t: Lanes, y: &mut [Lanes], lanes: Mask) -> [Option<bool>; WIDTH] {
        let LaneMotion { model, workspace, projector, .. } = &mut *self.motion;
        let Some(projector) = projector else { return [Some(false); WIDTH] };
        let [q, v, ..] = model.layout.split_mut(y);
        projector.project((model, workspace), t, (q, v), lanes)
    }

    fn on_accepted(&mut self, t: [f64; WIDTH], lanes: Mask) {
        let ratios = self.motion.workspace.matrix.cancellations().to_array();
        for (lane, one) in self.lanes.iter_mut().enumerate().filter(|(lane, _)| lanes[*lane]) {
            if let Some(one) = one {
                one.passage.accept_clear(t[lane], ratios[lane]);
            }
        }
    }
}
