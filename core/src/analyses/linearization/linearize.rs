//! The linear equations of a mechanism at a state, on independent coordinates u:
//!
//! ```text
//! M δü + C δu̇ + K δu = forces of inputs and of first-order states
//! ẋ = A x + B w,   y = C x + D w,   x = (δu, δu̇, δz)
//! ```
//!
//! The constraints extend a direction of x to all coordinates: δq = N δu and δv = N δu̇ + S δu, where
//! Φ_q S = -∂(Φ_q v + Φ_t)/∂q N. The changes of the accelerations follow from the derivatives of the equations of
//! motion, so that A, B, C and D are exact at any state, also in motion.

use super::failure::Failure;
use super::freedoms::Freedoms;
use super::names::{output, Input};
use super::parameters::slopes_by_parameter;
use super::response::Linear;
use super::rotation::RotatingFrame;
use super::variation::{Slopes, StatePoint, Variation, D};
use crate::analyses::dynamics::{Accelerations, Prepared, States};
use crate::analyses::signals::{Seen, Signal};
use crate::analyses::{second_order, State};
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, reactive};
use crate::integrate::Flow;
use crate::math::{Lift, Listed, Real};
use crate::model::{row_scales, Model, Problem};

/// Largest residual of a position, relative to the size of the mechanism.
const CLOSED: f64 = 1e-6;

/// Linear equations at a state. Matrices are stored row by row; x = (u, u̇, z) has n = 2 f + n_z components.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Linearization {
    /// Indices of the independent coordinates in q, shape (f).
    pub coordinates: Vec<usize>,
    /// Indices of the states in z that belong to x. Those that do not change with time are not in x.
    pub states: Vec<usize>,
    /// N by columns, each of shape (n_q).
    pub basis: Vec<Vec<f64>>,
    /// M, shape (f, f).
    pub mass: Vec<f64>,
    /// C, shape (f, f).
    pub damping: Vec<f64>,
    /// K, shape (f, f).
    pub stiffness: Vec<f64>,
    /// A, shape (n, n).
    pub a: Vec<f64>,
    /// B, shape (n, inputs).
    pub b: Vec<f64>,
    /// C, shape (outputs, n).
    pub c: Vec<f64>,
    /// D, shape (outputs, inputs).
    pub d: Vec<f64>,
    /// Velocities of all coordinates at the state, shape (n_q); zero in a frame that rotates with the mechanism.
    pub velocity: Vec<f64>,
    /// Accelerations of all coordinates at the state, shape (n_q); zero at an equilibrium.
    pub acceleration: Vec<f64>,
    /// Values of the outputs at the state.
    pub values: Vec<f64>,
}

/// A change of the state, of the forces or of a parameter.
#[derive(Debug, Default)]
struct StateChange {
    q: Vec<f64>,
    v: Vec<f64>,
    z: Vec<f64>,
    /// A generalized force, shape (n_q), or empty.
    force: Vec<f64>,
    /// The index of a parameter.
    parameter: Option<usize>,
}

/// One column of the state-space matrices and of the reduced forces.
struct Column {
    /// ü of the independent coordinates, then ż.
    rates: Vec<f64>,
    outputs: Vec<f64>,
    /// The reduced force.
    force: Vec<f64>,
}

/// Linearizes the equations of motion at a state that satisfies the constraints, with inputs and outputs by name.
///
/// An input is a parameter or, given by its position quantity, a generalized force. An output is any quantity of the
/// state. Drivers hold their coordinates, and the time is constant. The motions are those in the frame of ground or, if
/// requested, in one that rotates with the mechanism.
///
/// # Errors
/// [`Failure`]: a singular position, an open joint, a degree of freedom without inertia, a massless body whose motion is
/// not determined, an invalid name, or no uniform rotation.
pub fn linearize(
    model: &Model,
    state: &State,
    (inputs, outputs): (&[String], &[String]),
    rotating: bool,
) -> Result<Linearization, Failure> {
    let own = second_order::acting(model, state.t, &state.q);
    let model = own.as_ref().unwrap_or(model);
    let named = |problem: Problem| Failure::Name(Box::new(problem));
    let read = |name: &String| Input::named(model, name).map_err(named);
    let inputs = inputs.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let read = |name: &String| output(model, name).map_err(named);
    let outputs = outputs.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let State { t, q, v, z } = state;
    check_closed(model, state)?;
    let freedom = Freedoms::with_factors(model, *t, q)?;
    let solved = solved(model, state)?;
    let rotation = rotating.then(|| RotatingFrame::of(model, state, &solved.a)).transpose()?;
    let at = StatePoint { q, v, z, a: &solved.a, lam: &solved.lam };
    let variation = Variation::new(model, *t, at, true);
    let linear = Linear::new(model, [q, v], freedom, (&variation, &reactive::rows(model)));
    let linear = linear.map_err(|column| Failure::no_inertia(model, *t, column))?;
    LinearEquations { model, t: *t, at, variation, linear, outputs, rotation }.all(&inputs)
}

/// Checks, without computing derivatives, whether a state can be linearized: the joints must be closed, the position
/// must not be singular, and the accelerations must be determined.
///
/// # Errors
/// [`Failure`].
pub fn begins(model: &Model, state: &State) -> Result<(), Failure> {
    let own = second_order::acting(model, state.t, &state.q);
    let model = own.as_ref().unwrap_or(model);
    check_closed(model, state)?;
    Freedoms::regular(model, state.t, &state.q)?;
    solved(model, state).map(|_| ())
}

/// Accelerations and multipliers.
fn solved(model: &Model, State { t, q, v, z }: &State) -> Result<Accelerations, Failure> {
    let states = States { t: &[*t], q, v, z };
    let solved = Prepared::new(model).accelerations(states, false, |_| Flow::Continue);
    solved.map_err(Failure::Motion)
}

/// The linearization at a state.
struct LinearEquations<'a> {
    model: &'a Model,
    t: f64,
    at: StatePoint<'a>,
    variation: Variation<'a>,
    linear: Linear<'a>,
    outputs: Vec<Signal>,
    /// The frame in which the motions are small; None for that of ground.
    rotation: Option<RotatingFrame>,
}

impl LinearEquations<'_> {
    fn all(self, inputs: &[Input]) -> Result<Linearization, Failure> {
        let Self { model, ref linear, at, .. } = self;
        let states = model.changing_states();
        let basis = &linear.freedoms.basis;
        let f = basis.len();
        let mut of_state: Vec<Column> = Vec::with_capacity(2 * f + states.len());
        for motion in basis {
            let v = match self.rotation {
                Some(rotation) => rotation.turned(model, motion),
                None => self.velocities(motion),
            };
            of_state.push(self.column(&StateChange {
                q: motion.clone(),
                v,
                ..StateChange::default()
            })?);
        }
        for motion in basis {
            of_state
                .push(self.column(&StateChange { v: motion.clone(), ..StateChange::default() })?);
        }
        for place in &states {
            let mut z = vec![0.0; at.z.len()];
            z[*place] = 1.0;
            of_state.push(self.column(&StateChange { z, ..StateChange::default() })?);
        }
        let of_inputs = inputs.iter().map(|input| self.column(&self.direction(input)));
        let of_inputs = of_inputs.collect::<Result<Vec<_>, _>>()?;
        let reduced = |columns: &[Column]| {
            let entry = |row: usize| columns.iter().map(move |column| -column.force[row]);
            (0..f).flat_map(entry).list()
        };
        let (a, c) = self.matrices(&of_state, &states, true);
        let (b, d) = self.matrices(&of_inputs, &states, false);
        Ok(Linearization {
            mass: linear.mass.clone(),
            stiffness: reduced(&of_state[..f]),
            damping: reduced(&of_state[f..2 * f]),
            a,
            b,
            c,
            d,
            velocity: self.in_frame(at.v),
            acceleration: self.in_frame(at.a),
            values: self.observe(&self.variation, StatePoint::default()).map(|y| y.value).list(),
            coordinates: linear.freedoms.coordinates.clone(),
            basis: basis.clone(),
            states,
        })
    }

    /// The change of the velocities with the positions.
    fn velocities(&self, motion: &[f64]) -> Vec<f64> {
        let moved = StatePoint { q: motion, ..StatePoint::default() };
        let mut rates = self.variation.along(moved).rates;
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        self.linear.velocities(&rates)
    }

    /// Rates as they are in the frame: a mechanism is at rest in a frame that rotates with it.
    fn in_frame(&self, rates: &[f64]) -> Vec<f64> {
        rates.iter().map(|x| if self.rotation.is_some() { 0.0 } else { *x }).list()
    }

    /// The matrices of the rates and of the outputs, assembled from the columns of the state or of the inputs.
    fn matrices(
        &self,
        columns: &[Column],
        states: &[usize],
        of_state: bool,
    ) -> (Vec<f64>, Vec<f64>) {
        let f = self.linear.freedoms.basis.len();
        let mut rates = Vec::new();
        for row in 0..f {
            let unit = |column: usize| f64::from(u8::from(of_state && column == f + row));
            (0..columns.len()).map(unit).append_to(&mut rates);
        }
        let places = (0..f).chain(states.iter().map(|place| f + place));
        for place in places {
            columns.iter().map(|column| column.rates[place]).append_to(&mut rates);
        }
        let output = |row: usize| columns.iter().map(move |column| column.outputs[row]);
        (rates, (0..self.outputs.len()).flat_map(output).list())
    }

    /// The derivatives of accelerations, state rates and outputs along a direction.
    fn column(&self, direction: &StateChange) -> Result<Column, Failure> {
        let StateChange { q, v, z, force, parameter } = direction;
        let of_parameter =
            parameter.map(|k| self.variation.by_parameters(&slopes_by_parameter(self.model, k)));
        let variation = of_parameter.as_ref().unwrap_or(&self.variation);
        if let Some(k) = parameter.filter(|_| variation.moves_constraints()) {
            return Err(Failure::geometry(self.model, k));
        }
        let Slopes { mut forces, mut accelerations, states, .. } =
            variation.along(StatePoint { q, v, z, ..StatePoint::default() });
        forces.iter_mut().for_each(|x| *x = -*x);
        forces.iter_mut().zip(force).for_each(|(x, force)| *x += force);
        accelerations.iter_mut().for_each(|x| *x = -*x);
        let response = self.linear.response(&forces, &accelerations);
        let moved = StatePoint { q, v, z, a: &response.a, lam: &response.lam };
        let outputs: Vec<f64> = self.observe(variation, moved).map(|y| y.slope[0]).list();
        if let Some(k) = outputs.iter().position(|y| !y.is_finite()) {
            return Err(Failure::no_derivative(k));
        }
        let own = |of: &[f64]| -> Vec<f64> {
            self.linear.freedoms.coordinates.iter().map(|column| of[*column]).list()
        };
        let (mut rates, mut force) = (own(&response.a), response.force);
        if let (Some(rotation), false) = (self.rotation, q.is_empty() && v.is_empty()) {
            // the velocities that belong to a change of the position are those of the frame
            let still = vec![0.0; self.model.layout.n_q];
            let [position, velocity] = if q.is_empty() { [&still, v] } else { [q, &still] };
            let of_frame = own(&rotation.of_frame(self.model, position, velocity));
            let n = of_frame.len();
            for (row, force) in force.iter_mut().enumerate() {
                let mass = &self.linear.mass[row * n..][..n];
                *force += mass.iter().zip(&of_frame).map(|(m, x)| m * x).sum::<f64>();
            }
            rates.iter_mut().zip(of_frame).for_each(|(rate, x)| *rate += x);
        }
        Ok(Column { rates: rates.into_iter().chain(states).list(), outputs, force })
    }

    /// The direction of an input.
    fn direction(&self, input: &Input) -> StateChange {
        match input {
            Input::Parameter(k) => StateChange { parameter: Some(*k), ..StateChange::default() },
            Input::Quantity(of) => {
                StateChange { force: self.gradient(of), ..StateChange::default() }
            }
        }
    }

    /// The derivatives of a position quantity with respect to the coordinates, shape (n_q).
    fn gradient(&self, of: &Signal) -> Vec<f64> {
        let n = self.at.q.len();
        let by = |k: usize| {
            let mut q = vec![0.0; n];
            q[k] = 1.0;
            self.see(
                &self.variation,
                StatePoint { q: &q, ..StatePoint::default() },
                |model, seen| of.value(model, seen).slope[0],
            )
        };
        (0..n).map(by).list()
    }

    /// The outputs with their derivatives along a direction.
    fn observe<'s>(
        &'s self,
        variation: &'s Variation<'_>,
        along: StatePoint<'s>,
    ) -> impl Iterator<Item = D> + 's {
        let values = self.see(variation, along, |model, seen| {
            self.outputs.iter().map(|output| output.value(model, seen)).list()
        });
        values.into_iter()
    }

    /// Calls `f` with the state and its derivatives along a direction.
    fn see<R>(
        &self,
        variation: &Variation<'_>,
        along: StatePoint<'_>,
        f: impl FnOnce(&Model<D>, &Seen<'_, D>) -> R,
    ) -> R {
        let (model, at) = (variation.model(), self.at);
        let [q, v, z, a, lam] = at.seeded(along);
        let motions = Motions::at(&model.layout, &q, &v);
        let t = D::lift(self.t);
        let works = [D::zero(); crate::model::WORKS];
        let (state, solved) = ([&q[..], &v, &z], [&a[..], &lam]);
        f(model, &Seen { t, state, works: &works, motions: &motions, solved, so_far: None })
    }
}

/// Checks that the state satisfies the constraints.
fn check_closed(model: &Model, state: &State) -> Result<(), Failure> {
    let mut phi = vec![0.0; model.layout.n_rows];
    let motions = Motions::at_rest(&model.layout, &state.q);
    constraints::residual(model, &motions, state.t, &mut phi);
    let scales = row_scales(model);
    let open =
        phi.iter().zip(&scales).position(|(gap, scale)| gap.is_nan() || gap.abs() > CLOSED * scale);
    match open {
        None => Ok(()),
        Some(row) => {
            let (k, equation) = model.layout.owner(row);
            let item = &model.constraints[k];
            let unit = item.equations[equation].kind.unit();
            Err(Failure::Open { t: state.t, name: item.name.clone(), gap: phi[row], unit })
        }
    }
}
