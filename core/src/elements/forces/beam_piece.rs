//! Piece of a beam: a geometrically exact elastic rod in the plane (Reissner 1972, Simo 1985) between four bodies.
//!
//! The four bodies are the nodes of [`beam_line`](crate::elements::beam_line). With the rotation A of a section, the
//! strains are Γ = Aᵀ r′ - Γ₀ (stretch and shear) and κ = φ′ - κ₀; Γ₀ and κ₀ are the values of the shape without
//! stress. The potential is V = ½ ∫ EA Γ₁² + GA Γ₂² + EI κ² ds, by three Gauss points. The section carries the normal
//! force N = EA Γ₁, the shear force Q = GA Γ₂ and the bending moment M = EI κ; damping d adds d EA Γ̇₁, d GA Γ̇₂ and
//! d EI κ̇ (Kelvin and Voigt). With n = A (N, Q), the force on node k is -∫ n Nₖ′ ds, and the torque is
//! -∫ (N t₂ - Q t₁) Nₖ + M Nₖ′ ds, where t = Aᵀ r′. All states are allowed.
//!
//! A file has no pieces: the reader of beams makes them.

use crate::elements::beam_line::{
    in_stations, section, Section, AT_GAUSS, AT_STATIONS, GAUSS, NODES, STATIONS, WEIGHTS,
};
use crate::elements::{
    element, BodyId, Force, Mark, Nature, Part, PointOn, ResultQuantity, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{each, indexed, Local, Pose, Real, ShortArray, Twist, Vec2, Wrench};

element! {
    /// Piece of a beam between four nodes.
    BeamPiece, "beam_piece" {
        /// First node.
        i: body,
        /// Last node.
        j: body,
        /// Second node.
        second: body,
        /// Third node.
        third: body,
        /// Arc length of the beam at the first node.
        start: number [m],
        /// Arc length of the piece.
        length: number [m],
        /// EA in the Gauss points.
        axial: triple [N, N, N],
        /// GA in the Gauss points.
        shear: triple [N, N, N],
        /// EI in the Gauss points.
        bending: triple [N*m^2, N*m^2, N*m^2],
        /// First component of Aᵀ r′ in the Gauss points without stress.
        stretch: triple [1, 1, 1] = [1.0, 1.0, 1.0],
        /// Second component of Aᵀ r′ in the Gauss points without stress.
        slide: triple [1, 1, 1] = [0.0, 0.0, 0.0],
        /// φ′ in the Gauss points without stress.
        curvature: triple [rad/m, rad/m, rad/m] = [0.0, 0.0, 0.0],
        /// Ratio of damping to stiffness.
        damping: optional_number [s],
        /// Stress for a normal force of 1 N in the Gauss points, 1/A.
        by_force: triple [1/m^2, 1/m^2, 1/m^2] = [0.0, 0.0, 0.0],
        /// Stress at the faces for a bending moment of 1 N·m in the Gauss points.
        by_moment: triple [1/m^3, 1/m^3, 1/m^3] = [0.0, 0.0, 0.0],
    }
}

/// The bodies in the order of the nodes, as indices in [`Force::bodies`].
const ORDER: [usize; NODES] = [0, 2, 3, 1];

/// Normal force, shear force and bending moment of a section.
#[derive(Clone, Copy, Debug)]
struct Efforts<S> {
    normal: S,
    shear: S,
    moment: S,
}

impl<S: Real> Efforts<S> {
    /// The efforts in Gauss point `g` for strains or their rates.
    #[inline(always)]
    fn of(e: &BeamPiece<S>, g: usize, strain: Local<S>, curvature: S) -> Self {
        Self {
            normal: e.axial[g] * strain.x,
            shear: e.shear[g] * strain.y,
            moment: e.bending[g] * curvature,
        }
    }
}

fn poses<'a, S>(at: &'a Situation<'_, S>) -> [&'a Pose<S>; NODES] {
    each(ORDER, |k| &at.body(k).pose)
}

fn twists<'a, S>(at: &'a Situation<'_, S>) -> [&'a Twist<S>; NODES] {
    each(ORDER, |k| &at.body(k).twist)
}

/// Strains in Gauss point `g`.
#[inline(always)]
fn strains<S: Real>(e: &BeamPiece<S>, g: usize, of: &Section<S>) -> (Local<S>, S) {
    let strain = Local::new(of.tangent.x - e.stretch[g], of.tangent.y - e.slide[g]);
    (strain, of.curvature - e.curvature[g])
}

/// dξ/ds.
#[inline(always)]
fn per_length<S: Real>(e: &BeamPiece<S>) -> S {
    S::constant(2.0) / e.length
}

/// Adds the wrenches of the efforts in Gauss point `g` on the nodes.
#[allow(clippy::needless_range_loop)] // loops over indices are inlined without optimisation across crates
#[inline(always)]
fn add<S: Real>(
    e: &BeamPiece<S>,
    g: usize,
    of: &Section<S>,
    by: Efforts<S>,
    sum: &mut [Wrench<S>; NODES],
) {
    let Efforts { normal, shear, moment } = by;
    // w L (dN/dξ) (2/L) = 2 w dN/dξ
    let force: Vec2<S> = of.rotation * Local::new(normal, shear);
    let turning = normal * of.tangent.y - shear * of.tangent.x;
    let weight = S::constant(WEIGHTS[g]) * e.length;
    for k in 0..NODES {
        let slope = S::constant(2.0 * WEIGHTS[g] * AT_GAUSS[g].slope[k]);
        let value = S::constant(AT_GAUSS[g].value[k]);
        sum[k].force = sum[k].force - force.scale(slope);
        sum[k].torque -= weight * turning * value + moment * slope;
    }
}

/// Efforts in the Gauss points, with damping.
fn efforts<S: Real>(e: &BeamPiece<S>, at: &Situation<'_, S>) -> [Efforts<S>; 3] {
    let (nodes, twists, per_length) = (poses(at), twists(at), per_length(e));
    indexed(|g| {
        let of = section(nodes, &AT_GAUSS[g], per_length);
        let (mut strain, mut curvature) = strains(e, g, &of);
        if let Some(damping) = e.damping {
            let (rate, bending) = of.rates(twists, &AT_GAUSS[g], per_length);
            strain = strain + rate.scale(damping);
            curvature += damping * bending;
        }
        Efforts::of(e, g, strain, curvature)
    })
}

/// The results of a piece: for each station its arc length, position, angle, efforts and stress.
const RESULTS: [ResultQuantity; 8 * STATIONS + 3] = {
    const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
        ResultQuantity { name, unit, negative: None }
    }
    [
        of("s_1", "m"),
        of("s_2", "m"),
        of("s_3", "m"),
        of("s_4", "m"),
        of("s_5", "m"),
        of("x_1", "m"),
        of("x_2", "m"),
        of("x_3", "m"),
        of("x_4", "m"),
        of("x_5", "m"),
        of("y_1", "m"),
        of("y_2", "m"),
        of("y_3", "m"),
        of("y_4", "m"),
        of("y_5", "m"),
        of("angle_1", "rad"),
        of("angle_2", "rad"),
        of("angle_3", "rad"),
        of("angle_4", "rad"),
        of("angle_5", "rad"),
        of("normal_force_1", "N"),
        of("normal_force_2", "N"),
        of("normal_force_3", "N"),
        of("normal_force_4", "N"),
        of("normal_force_5", "N"),
        of("shear_force_1", "N"),
        of("shear_force_2", "N"),
        of("shear_force_3", "N"),
        of("shear_force_4", "N"),
        of("shear_force_5", "N"),
        of("bending_moment_1", "N*m"),
        of("bending_moment_2", "N*m"),
        of("bending_moment_3", "N*m"),
        of("bending_moment_4", "N*m"),
        of("bending_moment_5", "N*m"),
        of("stress_1", "Pa"),
        of("stress_2", "Pa"),
        of("stress_3", "Pa"),
        of("stress_4", "Pa"),
        of("stress_5", "Pa"),
        of("stress", "Pa"),
        of("bending_moment", "N*m"),
        of("strain_energy", "J"),
    ]
};

impl Force for BeamPiece {
    const IN_FILES: bool = false;
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];

    fn bodies<S>(e: &BeamPiece<S>) -> Vec<BodyId> {
        vec![e.i, e.j, e.second, e.third]
    }

    #[allow(clippy::needless_range_loop)] // as in `add`
    #[inline(always)]
    fn action<S: Real>(e: &BeamPiece<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let (nodes, per_length) = (poses(at), per_length(e));
        let mut elastic = [Wrench::zero(); NODES];
        let mut damping = [Wrench::zero(); NODES];
        for g in 0..3 {
            let of = section(nodes, &AT_GAUSS[g], per_length);
            let (strain, curvature) = strains(e, g, &of);
            add(e, g, &of, Efforts::of(e, g, strain, curvature), &mut elastic);
            if let Some(factor) = e.damping {
                let (rate, bending) = of.rates(twists(at), &AT_GAUSS[g], per_length);
                let by = Efforts::of(e, g, rate.scale(factor), factor * bending);
                add(e, g, &of, by, &mut damping);
            }
        }
        for k in 0..NODES {
            out.put(0, ORDER[k], elastic[k]);
            if e.damping.is_some() {
                out.put(1, ORDER[k], damping[k]);
            }
        }
    }

    #[allow(clippy::needless_range_loop)] // as in `add`
    fn potential<S: Real>(e: &BeamPiece<S>, at: &Situation<'_, S>) -> S {
        let (nodes, per_length) = (poses(at), per_length(e));
        let mut sum = S::zero();
        for g in 0..3 {
            let (strain, curvature) = strains(e, g, &section(nodes, &AT_GAUSS[g], per_length));
            let Efforts { normal, shear, moment } = Efforts::of(e, g, strain, curvature);
            let density = normal * strain.x + shear * strain.y + moment * curvature;
            sum += S::constant(0.5 * WEIGHTS[g]) * e.length * density;
        }
        sum
    }

    fn result_quantities<S>(_: &BeamPiece<S>) -> &'static [ResultQuantity] {
        &RESULTS
    }

    fn results<S: Real>(e: &BeamPiece<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let nodes = poses(at);
        let in_gauss = efforts(e, at);
        let along = |of: fn(&Efforts<S>) -> S| in_stations(each([0, 1, 2], |g| of(&in_gauss[g])));
        let normal = along(|of| of.normal);
        let moment = along(|of| of.moment);
        let (by_force, by_moment) = (in_stations(e.by_force), in_stations(e.by_moment));
        let columns: [[S; 8]; STATIONS] = indexed(|k| {
            let of = &AT_STATIONS[k];
            let s = [-1.0, GAUSS[0], GAUSS[1], GAUSS[2], 1.0][k];
            let mut place = [nodes[0].r.x, nodes[0].r.y, nodes[0].angle];
            for n in 1..NODES {
                let (value, node) = (S::constant(of.value[n]), nodes[n]);
                place[0] += value * (node.r.x - nodes[0].r.x);
                place[1] += value * (node.r.y - nodes[0].r.y);
                place[2] += value * (node.angle - nodes[0].angle);
            }
            let s = e.start + S::constant(0.5 * (1.0 + s)) * e.length;
            let stress = normal[k].abs() * by_force[k] + moment[k].abs() * by_moment[k];
            let shear = along(|of| of.shear)[k];
            [s, place[0], place[1], place[2], normal[k], shear, moment[k], stress]
        });
        let mut largest = [S::zero(); 2];
        for (k, column) in columns.iter().enumerate() {
            for (quantity, value) in column.iter().enumerate() {
                out[quantity * STATIONS + k] = *value;
            }
            largest = [largest[0].max(column[7]), largest[1].max(column[6].abs())];
        }
        out[8 * STATIONS] = largest[0];
        out[8 * STATIONS + 1] = largest[1];
        out[8 * STATIONS + 2] = Self::potential(e, at);
    }

    /// The arc length of the beam up to its last node.
    fn reach<S: Real>(e: &BeamPiece<S>) -> Option<S> {
        Some(e.start + e.length)
    }

    fn has_stress(e: &BeamPiece) -> bool {
        e.by_force.iter().all(|x| *x != 0.0)
    }

    fn symbols(e: &BeamPiece) -> Vec<SceneSymbol> {
        let node = |body| PointOn { body, s: Local::zero() };
        let nodes = [e.i, e.second, e.third, e.j].each(node);
        let lines = nodes.windows(2);
        lines.map(|ends| SceneSymbol::between_points(Mark::Beam, &ends[0], &ends[1])).collect()
    }

    fn fault(e: &BeamPiece) -> Option<(&'static str, String)> {
        let stiffness = [("EA", e.axial, "N"), ("GA", e.shear, "N"), ("EI", e.bending, "N·m²")];
        for (name, values, unit) in stiffness {
            let stiff = |x: &f64| *x > 0.0 && x.is_finite();
            if let Some(x) = values.into_iter().find(|x| !stiff(x)) {
                let what = format!("the stiffness {name} of the beam is {x} {unit}; must be > 0");
                return Some(("stiffness", what));
            }
        }
        if !(e.length > 0.0 && e.length.is_finite()) {
            let message = format!(
                "an element of the beam has the length {} m; must be > 0: named points must keep their order",
                e.length
            );
            return Some(("length", message));
        }
        if e.by_moment.iter().any(|x| *x < 0.0) {
            return Some(("section", "the height of the section must be > 0".to_string()));
        }
        let damping = e.damping.unwrap_or(0.0);
        (!(damping.is_finite() && damping >= 0.0))
            .then(|| ("damping", format!("the damping of the beam is {damping} s; must be ≥ 0")))
    }
}
