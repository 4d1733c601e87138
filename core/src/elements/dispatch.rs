//! Dispatch from a joint or driver of a model to the physics of its type: an enum over all types, and pools of
//! elements by type. The macro is called once, in `mod.rs`.

use super::declare::Table;
use super::group::Group;

/// A declaration with the section it belongs to.
pub(super) fn declared<E: super::declare::Element>(group: Group) -> (Group, Table) {
    (group, E::table())
}

macro_rules! constraints {
    ($($Group:ident { $($(#[$on:meta])* $Name:ident),+ $(,)? })+) => {
        /// A joint or a driver of any type.
        #[derive(Clone, Debug)]
        #[allow(missing_docs)] // each variant is documented at its element
        pub enum Constraint<S = f64> {
            $($($(#[$on])* $Name($Name<S>),)+)+
        }

        impl Constraint<Tape> {
            /// Reads an element by the name of its type. The outer option is None if there is no such type.
            pub fn read(group: Group, kind: &str, source: &mut dyn Source) -> Option<Option<Self>> {
                $($($(#[$on])* {
                    if group == Group::$Group && kind == <$Name>::NAME && <$Name as Joint>::IN_FILES {
                        return Some(<$Name>::read(source).map(Self::$Name));
                    }
                })+)+
                None
            }
        }

        /// The number of internal coordinates of a joint or driver of a type.
        pub fn own_of(kind: &str) -> usize {
            $($($(#[$on])* {
                if kind == <$Name>::NAME {
                    return <$Name as Joint>::OWN;
                }
            })+)+
            0
        }

        /// Whether joints of a type hold two points together.
        pub fn pins_points(kind: &str) -> bool {
            $($($(#[$on])* {
                if kind == <$Name>::NAME {
                    return <$Name as Joint>::CONSTANT_COLUMNS;
                }
            })+)+
            false
        }

        /// The fields that turn a joint or driver of a type into a force, unless they are 0.
        pub fn loose_fields(kind: &str) -> &'static [&'static str] {
            $($($(#[$on])* {
                if kind == <$Name>::NAME {
                    return <$Name as Joint>::LOOSE;
                }
            })+)+
            &[]
        }

        impl<S> Constraint<S> {
            /// The same constraint over another scalar.
            pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Constraint<T> {
                match self { $($($(#[$on])* Self::$Name(e) => Constraint::$Name(<$Name>::map(e, f)),)+)+ }
            }
            /// Passes each scalar to a function, in the order of [`Constraint::map`].
            pub fn visit(&self, f: &mut dyn FnMut(&S)) {
                // mapped to this scalar elsewhere too, so that it needs no further code
                self.map::<Jet>(&mut |x| {
                    f(x);
                    Jet::zero()
                });
            }
            /// The number of scalars of each field, in the order of [`Constraint::map`].
            pub fn scalars(&self) -> Vec<usize> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name>::scalars(e),)+)+ }
            }
            /// Name of the type.
            pub fn kind(&self) -> &'static str {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name>::NAME,)+)+ }
            }
            /// The bodies whose poses enter Φ: i and j first.
            pub fn bodies(&self) -> Vec<BodyId> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name>::bodies(e),)+)+ }
            }
            /// The position quantities that can be measured on it.
            pub fn measured(&self) -> &'static [Measured] {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::MEASURED,)+)+ }
            }
            /// Whether the element may have friction.
            pub fn rubs(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::RUBS,)+)+ }
            }
            /// Whether files contain elements of its type.
            pub fn in_files(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::IN_FILES,)+)+ }
            }
            /// Number of internal coordinates.
            pub fn own(&self) -> usize {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::OWN,)+)+ }
            }
            /// Results in addition to the reaction.
            pub fn result_quantities(&self) -> &'static [ResultQuantity] {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::RESULTS,)+)+ }
            }
            /// The curve along which the first internal coordinate is measured.
            pub fn curve(&self) -> Option<&CurveOn<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::curve(e),)+)+ }
            }
            /// The mutable curve along which the first internal coordinate is measured.
            pub fn curve_mut(&mut self) -> Option<&mut CurveOn<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::curve_mut(e),)+)+ }
            }
            /// The constant of the last equation that the start may change.
            pub fn phase_mut(&mut self) -> Option<&mut S> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::phase_mut(e),)+)+ }
            }
            /// Whether the columns of translation are -I for body i and +I for body j.
            pub fn constant_columns(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::CONSTANT_COLUMNS,)+)+ }
            }
            /// Whether it can be condensed with a body that it connects to ground.
            pub fn condenses(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::CONDENSES,)+)+ }
            }
            /// The position quantity that a driver moves.
            pub fn drives(&self) -> Option<&Followed<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::drives(e),)+)+ }
            }
            /// The law of a driver.
            pub fn value(&self) -> Option<&S> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::value(e),)+)+ }
            }
            /// The largest effort of a driver.
            pub fn limit(&self) -> Option<&S> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::limit(e),)+)+ }
            }
            /// Lets a driver have any effort.
            pub fn lift_limit(&mut self) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::lift_limit(e),)+)+ }
            }
            /// The condition at which a driver is released.
            pub fn release(&self) -> Option<&str> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::release(e),)+)+ }
            }
            /// Names and units of the equations.
            pub fn equations(&self) -> Vec<Equation> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name>::equations(e),)+)+ }
            }
        }

        impl<S: Clone> Constraint<S> {
            /// The play of its teeth.
            pub fn backlash(&self) -> Option<Backlash<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::backlash(e),)+)+ }
            }
            /// The strands of a belt that acts as a force.
            pub fn strands(&self) -> Option<Strands<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::strands(e),)+)+ }
            }
            /// The friction of a joint that may slip.
            pub fn slips(&self) -> Option<Slips<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::slips(e),)+)+ }
            }
            /// The geometry that the constraint fixes, for assembly.
            pub fn fixes(&self) -> Vec<Fixes<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::fixes(e),)+)+ }
            }
        }

        impl Constraint {
            /// The symbols of the element in a drawing.
            pub fn symbols(&self) -> Vec<SceneSymbol> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::symbols(e),)+)+ }
            }
            /// Initial values of the internal coordinates for bodies at given poses.
            pub fn own_start(&self, bodies: &[Pose]) -> Vec<f64> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::own_start(e, bodies),)+)+ }
            }
            /// The constant modulo which the last equation is taken, if there is one.
            pub fn modulus(&self) -> Option<f64> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::modulus(e),)+)+ }
            }
            /// The length by whose multiples the start may change the phase.
            pub fn pitch(&self) -> Option<f64> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::pitch(e),)+)+ }
            }
            /// A field with an impossible value, and the reason.
            pub fn fault(&self) -> Option<(&'static str, String)> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::fault(e),)+)+ }
            }
        }

        impl<S: Real> Constraint<S> {
            /// Φ, one entry for each equation.
            pub fn residual(&self, at: &At<'_, S>, phi: &mut [S]) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::residual(e, at, phi),)+)+ }
            }
            /// The opposite of the only equation of a joint with play.
            pub fn play(&self, at: &At<'_, S>) -> S {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::play(e, at),)+)+ }
            }
            /// The values of [`measured`](Self::measured).
            pub fn measure(&self, at: &At<'_, S>, out: &mut [S]) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::measure(e, at, out),)+)+ }
            }
            /// Φ, Φ̇, γ and Φ_q for fields that do not vary with time or state.
            pub fn linearize(&self, at: &Moving<'_, S>, out: Linearized<'_, S>) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::linearize(e, at, out),)+)+ }
            }
            /// Quantities that the other joints of the mechanism must hold.
            pub fn requires(&self, at: &At<'_, S>) -> Vec<Required<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::requires(e, at),)+)+ }
            }
            /// The point at which the reaction acts, in the frame of body j, if this point moves.
            pub fn contact(&self, at: &At<'_, S>) -> Option<Local<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::contact(e, at),)+)+ }
            }
            /// The values of [`Constraint::result_quantities`].
            pub fn results(&self, at: &At<'_, S>, lam: &[S], out: &mut [S]) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::results(e, at, lam, out),)+)+ }
            }
            /// Whether it has a [load](Self::load).
            pub fn has_load(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::has_load(e),)+)+ }
            }
            /// Wrenches that its multipliers cause in addition to -Φ_qᵀ λ.
            pub fn load(&self, at: &At<'_, S>, lam: &[S], out: &mut dyn FnMut(usize, Wrench<S>)) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::load(e, at, lam, out),)+)+ }
            }
            /// The joint frame on a body, given by its index in [`bodies`](Self::bodies).
            pub fn attachment(&self, body: usize) -> Attachment<S> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::attachment(e, body),)+)+ }
            }
            /// The same constraint over a scalar that contains this one.
            pub fn lift<T: Lift<S>>(&self) -> Constraint<T> {
                self.map(&mut |s| T::lift(*s))
            }
        }

        /// Joints and drivers, grouped by type. Only types that occur have a pool.
        #[derive(Clone, Debug)]
        pub struct JointPools<S = f64>(Vec<JointPool<S>>);

        /// All joints or drivers of one type.
        #[derive(Clone, Debug)]
        enum JointPool<S> {
            $($($(#[$on])* $Name(Vec<Pooled<$Name<S>>>),)+)+
        }

        impl<S> std::default::Default for JointPools<S> {
            fn default() -> Self {
                Self(Vec::new())
            }
        }

        impl<S: Real> JointPools<S> {
            /// Adds a joint or a driver.
            pub fn push(&mut self, constraint: &Constraint<S>, place: Place) {
                for pool in &mut self.0 {
                    match (pool, constraint) {
                        $($($(#[$on])* (JointPool::$Name(pool), Constraint::$Name(e)) => {
                            return pool.push(Pooled { element: e.clone(), place });
                        })+)+
                        _ => {} // of another type
                    }
                }
                self.0.push(match constraint {
                    $($($(#[$on])* Constraint::$Name(_) => JointPool::$Name(Vec::new()),)+)+
                });
                self.push(constraint, place);
            }
            /// Passes every type that occurs to the visitor.
            #[inline(always)]
            pub fn visit(&self, visitor: &mut impl VisitJoints<S>) {
                for pool in &self.0 {
                    match pool { $($($(#[$on])* JointPool::$Name(p) => visitor.visit::<$Name>(p),)+)+ }
                }
            }
        }

        /// The types of joints that may have friction.
        pub fn types_that_rub() -> Vec<&'static str> {
            let all = [$($($(#[$on])* (<$Name>::NAME, <$Name as Joint>::RUBS),)+)+];
            all.into_iter().filter(|(_, rubs)| *rubs).map(|(name, _)| name).collect()
        }

        #[allow(clippy::vec_init_then_push)] // some entries exist only with a feature
        fn constraint_tables() -> Vec<(Group, Table)> {
            let mut all = Vec::new();
            $($($(#[$on])* {
                if <$Name as Joint>::IN_FILES {
                    all.push(declared::<$Name>(Group::$Group));
                }
            })+)+
            all
        }
    };
}

pub(super) use constraints;
