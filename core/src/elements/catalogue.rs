//! The one list of elements, and the dispatch from an entry of a model to its physics.

use super::declare::{Element, Table};
use super::derive::VelocityTerms;
use super::drivers::CoordinateDriver;
use super::forces::{SpringDamper, Torque, TorsionSpring};
use super::formula::Formula;
use super::joints::{Distance, Revolute, Translational};
use super::kinds::{BodyId, Source};
use super::traits::{Action, Attachment, Equation, Force, Joint, Part, Side, Situation};
use crate::expression::Tape;
use crate::math::{Jet, Lift, Local, Motion, Pose, Real};

/// Where an element stands in a model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// `[joints.…]`
    Joints,
    /// `[drivers.…]`
    Drivers,
    /// `[forces.…]`
    Forces,
}

impl Group {
    /// The section's name in the file.
    pub fn section(self) -> &'static str {
        ["joints", "drivers", "forces"][self as usize]
    }
    /// The same for one of them.
    pub fn singular(self) -> &'static str {
        ["joint", "driver", "force"][self as usize]
    }
}

/// Most equations that one constraint has.
pub const MOST_EQUATIONS: usize = 3;

/// Φ, Φ̇ and γ of one constraint, one slice entry for each equation.
#[derive(Debug)]
pub struct Rows<'a, S> {
    /// Φ.
    pub residual: &'a mut [S],
    /// Φ_q q̇ + Φ_t.
    pub rate: &'a mut [S],
    /// γ.
    pub gamma: &'a mut [S],
}

impl<S: Real> Rows<'_, S> {
    #[inline(always)]
    fn set<const M: usize>(self, terms: &VelocityTerms<S, M>) {
        self.residual.copy_from_slice(&terms.residual);
        self.rate.copy_from_slice(&terms.rate);
        self.gamma.copy_from_slice(&terms.gamma);
    }
}

/// Takes what [`Constraint::linearize`] finds, with the number of rows known to the compiler.
pub trait Linear<S> {
    /// Φ, Φ̇, γ and ∂Φ/∂(qᵢ, qⱼ) of a constraint between the bodies `ends`.
    fn take<const M: usize>(
        self,
        ends: [BodyId; 2],
        terms: &VelocityTerms<S, M>,
        rows: &[[S; 6]; M],
    );
}

/// A loop over constraints of one type, see [`Constraint::run_typed`].
pub trait TypedLoop<S: Real> {
    /// Runs for type `E` of `M` equations; `get` finds an element of this type in a constraint.
    fn run<const M: usize, E: Joint<M>>(self, get: impl Fn(&Constraint<S>) -> Option<&E::Over<S>>);
}

macro_rules! constraints {
    ($($Group:ident { $($Name:ident),+ $(,)? })+) => {
        /// A joint or a driver of any type.
        #[derive(Clone, Debug)]
        #[allow(missing_docs)] // each variant is documented at its element
        pub enum Constraint<S = f64> {
            $($($Name($Name<S>),)+)+
        }

        impl Constraint<Tape> {
            /// Reads an element by the name of its type; the outer None if there is no such type.
            pub fn read(group: Group, kind: &str, source: &mut dyn Source) -> Option<Option<Self>> {
                $($(if group == Group::$Group && kind == $Name::<f64>::table().name {
                    return Some(<$Name>::read(source).map(Self::$Name));
                })+)+
                None
            }
        }

        impl<S> Constraint<S> {
            /// The same constraint over another scalar.
            pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Constraint<T> {
                match self { $($(Self::$Name(e) => Constraint::$Name(<$Name>::map(e, f)),)+)+ }
            }
            /// Name of the type.
            pub fn kind(&self) -> &'static str {
                match self { $($(Self::$Name(_) => $Name::<f64>::table().name,)+)+ }
            }
            /// Bodies i and j.
            pub fn ends(&self) -> [BodyId; 2] {
                match self { $($(Self::$Name(e) => <$Name>::ends(e),)+)+ }
            }
            /// Whether the joint points of i and j coincide.
            pub fn pins(&self) -> bool {
                match self { $($(Self::$Name(_) => <$Name>::PINS,)+)+ }
            }
            /// Whether body j slides along an axis of body i without turning.
            pub fn slides(&self) -> bool {
                match self { $($(Self::$Name(_) => <$Name>::SLIDES,)+)+ }
            }
            /// Names and units of the equations.
            pub fn equations(&self) -> Vec<Equation> {
                match self { $($(Self::$Name(e) => <$Name>::equations(e).to_vec(),)+)+ }
            }
        }

        impl Constraint {
            /// A field whose value cannot be, and why.
            pub fn fault(&self) -> Option<(&'static str, String)> {
                match self { $($(Self::$Name(e) => <$Name>::fault(e),)+)+ }
            }
        }

        impl<S: Real> Constraint<S> {
            /// Φ, into one entry for each equation.
            #[inline]
            pub fn residual(&self, i: &Pose<S>, j: &Pose<S>, t: S, out: &mut [S]) {
                match self { $($(Self::$Name(e) => {
                    out.copy_from_slice(&<$Name>::residual(e, i, j, t));
                })+)+ }
            }
            /// ∂Φ/∂(qᵢ, qⱼ), one row for each equation.
            #[inline]
            pub fn jacobian(&self, i: &Pose<S>, j: &Pose<S>, t: S, out: &mut [[S; 6]]) {
                match self { $($(Self::$Name(e) => {
                    out.copy_from_slice(&<$Name>::jacobian(e, i, j, t));
                })+)+ }
            }
            /// Φ, Φ̇ and γ.
            #[inline]
            pub fn velocity_terms(&self, i: &Motion<S>, j: &Motion<S>, t: S, out: Rows<'_, S>) {
                match self { $($(Self::$Name(e) => {
                    out.set(&<$Name>::velocity_terms(e, i, j, t));
                })+)+ }
            }
            /// Φ, Φ̇ and γ as [`velocity_terms`](Self::velocity_terms), and the rows of Φ_q with
            /// the bodies i and j to `target`: all that the equations of motion ask of a constraint,
            /// by one dispatch.
            #[inline(always)]
            pub fn linearize(
                &self,
                motions: &[Motion<S>],
                t: S,
                target: impl Linear<S>,
            ) {
                match self { $($(Self::$Name(e) => {
                    let ends = <$Name>::ends(e);
                    let [i, j] = ends.map(|body| &motions[body.0]);
                    let (terms, rows) = <$Name>::linearize(e, i, j, t);
                    target.take(ends, &terms, &rows);
                })+)+ }
            }
            /// Runs a loop over constraints of the type of this one: the type is found once, not for each of them.
            #[inline(always)]
            pub fn run_typed(&self, work: impl TypedLoop<S>) {
                match self { $($(Self::$Name(_) => work.run::<_, $Name>(|constraint| {
                    match constraint {
                        Self::$Name(e) => Some(e),
                        #[allow(unreachable_patterns)]
                        _ => None,
                    }
                }),)+)+ }
            }
            /// The joint frame on a body.
            pub fn attachment(&self, side: Side) -> Attachment<S> {
                match self { $($(Self::$Name(e) => <$Name>::attachment(e, side),)+)+ }
            }
            /// The same constraint over a scalar that contains this one.
            pub fn lift<T: Lift<S>>(&self) -> Constraint<T> {
                self.map(&mut |s| T::lift(*s))
            }
        }

        fn constraint_tables() -> Vec<(Group, Table)> {
            vec![$($((Group::$Group, $Name::<f64>::table()),)+)+]
        }

        /// The equations of a type of joint or driver as formulas; None if there is no such type.
        pub fn formulas(group: Group, kind: &str) -> Option<&'static [Formula]> {
            $($(if group == Group::$Group && kind == $Name::<f64>::table().name {
                return Some(&<$Name>::FORMULAS);
            })+)+
            None
        }
    };
}

/// Takes what a force does to its bodies.
pub trait Acting<S> {
    /// The parts and their actions on the bodies i and j.
    fn take<const P: usize>(self, ends: [BodyId; 2], parts: &[Part; P], actions: &[Action<S>; P]);
}

macro_rules! forces {
    ($($Name:ident),+ $(,)?) => {
        /// A force of any type.
        #[derive(Clone, Debug)]
        #[allow(missing_docs)] // each variant is documented at its element
        pub enum ForceElement<S = f64> {
            $($Name($Name<S>),)+
        }

        impl ForceElement<Tape> {
            /// Reads an element by the name of its type; the outer None if there is no such type.
            pub fn read(kind: &str, source: &mut dyn Source) -> Option<Option<Self>> {
                $(if kind == $Name::<f64>::table().name {
                    return Some(<$Name>::read(source).map(Self::$Name));
                })+
                None
            }
        }

        impl<S> ForceElement<S> {
            /// The same force over another scalar.
            pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> ForceElement<T> {
                match self { $(Self::$Name(e) => ForceElement::$Name(<$Name>::map(e, f)),)+ }
            }
            /// Name of the type.
            pub fn kind(&self) -> &'static str {
                match self { $(Self::$Name(_) => $Name::<f64>::table().name,)+ }
            }
            /// Bodies i and j.
            pub fn ends(&self) -> [BodyId; 2] {
                match self { $(Self::$Name(e) => <$Name>::ends(e),)+ }
            }
            /// The named parts, in the order of [`ForceElement::action`].
            pub fn parts(&self) -> &'static [Part] {
                match self { $(Self::$Name(_) => &<$Name>::PARTS,)+ }
            }
        }

        impl<S: Real> ForceElement<S> {
            /// Gives the actions of all parts on the bodies i and j to `taker`: one dispatch, with
            /// the number of parts known to the compiler.
            #[inline(always)]
            pub fn action(&self, motions: &[Motion<S>], t: S, taker: impl Acting<S>) {
                match self { $(Self::$Name(e) => {
                    let ends = <$Name>::ends(e);
                    let [i, j] = ends.map(|body| motions[body.0]);
                    let actions = <$Name>::action(e, &Situation { i, j, t });
                    taker.take(ends, &<$Name>::PARTS, &actions);
                })+ }
            }
            /// The relative angle at which a rotational spring is relaxed.
            pub fn free_angle(&self) -> Option<S> {
                match self { $(Self::$Name(e) => <$Name>::free_angle(e),)+ }
            }
            /// The points of body i and body j between which the force acts along their line.
            pub fn points(&self) -> Option<[Local<S>; 2]> {
                match self { $(Self::$Name(e) => <$Name>::points(e),)+ }
            }
            /// Potential energy of the conservative parts, J.
            pub fn potential(&self, at: &Situation<S>) -> S {
                match self { $(Self::$Name(e) => <$Name>::potential(e, at),)+ }
            }
        }

        fn force_tables() -> Vec<(Group, Table)> {
            vec![$((Group::Forces, $Name::<f64>::table()),)+]
        }
    };
}

constraints! {
    Joints { Revolute, Translational, Distance }
    Drivers { CoordinateDriver }
}

forces! { TorsionSpring, SpringDamper, Torque }

/// The declarations of all elements, in the order of the list.
pub fn catalogue() -> Vec<(Group, Table)> {
    let mut tables = constraint_tables();
    tables.extend(force_tables());
    tables
}

/// Φ, Φ̇ and γ of a constraint over jets.
pub(crate) fn jets<S: Real>(
    constraint: &Constraint<Jet<S>>,
    i: &Pose<Jet<S>>,
    j: &Pose<Jet<S>>,
    t: Jet<S>,
    out: Rows<'_, S>,
) {
    let mut phi = [Jet::<S>::zero(); MOST_EQUATIONS];
    let m = out.residual.len();
    constraint.residual(i, j, t, &mut phi[..m]);
    for (k, p) in phi[..m].iter().enumerate() {
        out.residual[k] = p.value;
        out.rate[k] = p.rate;
        out.gamma[k] = -p.second;
    }
}
