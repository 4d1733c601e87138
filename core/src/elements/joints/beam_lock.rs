//! Lock of a strain of a piece of a beam between four nodes: its sections do not shear, or its centre line keeps its
//! length.
//!
//! With the strain Γ = Aᵀ r′ - Γ₀ of the [piece](crate::elements::beam_line) and the unit vector c of the axes of the
//! section, Φ_g = w_g L c·Γ(s_g) = 0 in the three Gauss points with weights w_g, m. The potential of an elastic piece
//! has the same points, so that a lock is the limit of a large stiffness (Arnold, *Numerische Mathematik* 37, 1981):
//! it keeps the order of the elements and does not lock bending. The multiplier λ_g is the internal force along c in
//! the Gauss point: the normal force for c = (1, 0), the shear force for c = (0, 1). All positions are allowed.
//!
//! A file has no locks: the reader of beams makes them.

use crate::elements::beam_line::{in_stations, section, AT_GAUSS, NODES, STATIONS, WEIGHTS};
use crate::elements::{
    element, At, Attachment, BodyId, Equation, Joint, Linearized, Moving, ResultQuantity,
};
use crate::math::{each, indexed, Local, Pose, Real, ShortArray, Vec2};

element! {
    /// Lock of a strain of a piece of a beam between four nodes.
    BeamLock, "beam_lock" {
        /// First node.
        i: body,
        /// Last node.
        j: body,
        /// Second node.
        second: body,
        /// Third node.
        third: body,
        /// Arc length of the piece.
        length: number [m],
        /// Components of the direction in the axes of the section.
        along: pair [1, 1],
        /// First component of Aᵀ r′ in the Gauss points without stress.
        stretch: triple [1, 1, 1],
        /// Second component of Aᵀ r′ in the Gauss points without stress.
        slide: triple [1, 1, 1],
        /// φ′ in the Gauss points without stress.
        curvature: triple [rad/m, rad/m, rad/m],
        /// EI in the Gauss points.
        bending: triple [N*m^2, N*m^2, N*m^2],
        /// Stress for a normal force of 1 N in the Gauss points, 1/A.
        by_force: triple [1/m^2, 1/m^2, 1/m^2],
        /// Stress at the faces for a bending moment of 1 N·m in the Gauss points.
        by_moment: triple [1/m^3, 1/m^3, 1/m^3],
    }
}

/// The bodies in the order of the nodes, as indices in [`Joint::bodies`].
const ORDER: [usize; NODES] = [0, 2, 3, 1];

/// The internal force in the stations of the piece, and the stress if it is a normal force.
const RESULTS: [ResultQuantity; 2 * STATIONS + 1] = {
    const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
        ResultQuantity { name, unit, negative: None }
    }
    [
        of("force_1", "N"),
        of("force_2", "N"),
        of("force_3", "N"),
        of("force_4", "N"),
        of("force_5", "N"),
        of("stress_1", "Pa"),
        of("stress_2", "Pa"),
        of("stress_3", "Pa"),
        of("stress_4", "Pa"),
        of("stress_5", "Pa"),
        of("stress", "Pa"),
    ]
};

fn poses<'a, S>(at: &'a At<'_, S>) -> [&'a Pose<S>; NODES] {
    each(ORDER, |k| &at.bodies[k])
}

impl Joint for BeamLock {
    const IN_FILES: bool = false;
    const RESULTS: &'static [ResultQuantity] = &RESULTS;

    fn bodies<S>(e: &BeamLock<S>) -> Vec<BodyId> {
        vec![e.i, e.j, e.second, e.third]
    }

    fn equations<S>(_: &BeamLock<S>) -> Vec<Equation> {
        ["first", "second", "third"].each(Equation::length).into()
    }

    fn residual<S: Real>(e: &BeamLock<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (nodes, per_length) = (poses(at), S::constant(2.0) / e.length);
        for (g, phi) in phi.iter_mut().enumerate() {
            let of = section(nodes, &AT_GAUSS[g], per_length).tangent;
            let strain = Local::new(of.x - e.stretch[g], of.y - e.slide[g]);
            let along = e.along[0] * strain.x + e.along[1] * strain.y;
            *phi = S::constant(WEIGHTS[g]) * e.length * along;
        }
    }

    /// Closed form: with R Γ = (Γ₂, -Γ₁), ∂Γ/∂(rₖ, φₖ) = [Nₖ′ Aᵀ, Nₖ R Γ] and Γ̈ = 2 φ̇ R Aᵀ ṙ′ - φ̇² Γ.
    fn linearize<S: Real>(e: &BeamLock<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        let nodes = each(ORDER, |k| &at.bodies[k].pose);
        let per_length = S::constant(2.0) / e.length;
        let along = Local::new(e.along[0], e.along[1]);
        let turned = |of: Local<S>| Local::new(of.y, -of.x);
        let times = |of: Local<S>| along.x * of.x + along.y * of.y;
        for g in 0..3 {
            let (weight, of) =
                (S::constant(WEIGHTS[g]) * e.length, section(nodes, &AT_GAUSS[g], per_length));
            let (mut rate, mut omega) = (Vec2::zero(), S::zero());
            let axis: Vec2<S> = of.rotation * along;
            for (k, body) in ORDER.into_iter().enumerate() {
                let value = S::constant(AT_GAUSS[g].value[k]);
                let slope = S::constant(AT_GAUSS[g].slope[k]) * per_length;
                let twist = &at.bodies[body].twist;
                rate = rate + twist.velocity.scale(slope);
                omega += value * twist.omega;
                out.columns[3 * body + g] = [
                    weight * slope * axis.x,
                    weight * slope * axis.y,
                    weight * value * times(turned(of.tangent)),
                ];
            }
            let rate = of.rotation.inverse(rate);
            let strain = Local::new(of.tangent.x - e.stretch[g], of.tangent.y - e.slide[g]);
            out.residual[g] = weight * times(strain);
            out.rate[g] = weight * times(rate + turned(of.tangent).scale(omega));
            let bent = turned(rate).scale(S::constant(2.0) * omega);
            out.gamma[g] = weight * times(of.tangent.scale(omega * omega) - bent);
        }
    }

    fn attachment<S: Real>(_: &BeamLock<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }

    fn results<S: Real>(e: &BeamLock<S>, at: &At<'_, S>, lam: &[S], out: &mut [S]) {
        let (nodes, per_length) = (poses(at), S::constant(2.0) / e.length);
        let moment = indexed(|g| {
            let curvature = section(nodes, &AT_GAUSS[g], per_length).curvature;
            e.bending[g] * (curvature - e.curvature[g])
        });
        let (force, moment) = (in_stations([lam[0], lam[1], lam[2]]), in_stations(moment));
        let (by_force, by_moment) = (in_stations(e.by_force), in_stations(e.by_moment));
        let mut largest = S::zero();
        for k in 0..STATIONS {
            let stress = force[k].abs() * by_force[k] + moment[k].abs() * by_moment[k];
            (out[k], out[STATIONS + k]) = (force[k], stress);
            largest = largest.max(stress);
        }
        out[2 * STATIONS] = largest;
    }
}
