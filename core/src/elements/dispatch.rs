//! Dispatch from an entry of a model to the physics of its type: enums over all types, and pools of
//! elements by type. The macros are called once, in `mod.rs`.

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
            /// Reads an element by the name of its type; the outer None if there is no such type.
            pub fn read(group: Group, kind: &str, source: &mut dyn Source) -> Option<Option<Self>> {
                $($($(#[$on])* {
                    if group == Group::$Group && kind == <$Name>::NAME {
                        return Some(<$Name>::read(source).map(Self::$Name));
                    }
                })+)+
                None
            }
        }

        impl<S> Constraint<S> {
            /// The same constraint over another scalar.
            pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Constraint<T> {
                match self { $($($(#[$on])* Self::$Name(e) => Constraint::$Name(<$Name>::map(e, f)),)+)+ }
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
            /// The position quantities that may be measured on it.
            pub fn measured(&self) -> &'static [Measured] {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::MEASURED,)+)+ }
            }
            /// Number of internal coordinates.
            pub fn own(&self) -> usize {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::OWN,)+)+ }
            }
            /// Results beside the reaction.
            pub fn result_quantities(&self) -> &'static [ResultQuantity] {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::RESULTS,)+)+ }
            }
            /// The curve along which the first internal coordinate is measured.
            pub fn curve(&self) -> Option<&CurveOn<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::curve(e),)+)+ }
            }
            /// The same, mutable.
            pub fn curve_mut(&mut self) -> Option<&mut CurveOn<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::curve_mut(e),)+)+ }
            }
            /// Whether the columns of translation are -I for body i and +I for body j.
            pub fn constant_columns(&self) -> bool {
                match self { $($($(#[$on])* Self::$Name(_) => <$Name as Joint>::CONSTANT_COLUMNS,)+)+ }
            }
            /// Names and units of the equations.
            pub fn equations(&self) -> Vec<Equation> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name>::equations(e),)+)+ }
            }
        }

        impl<S: Clone> Constraint<S> {
            /// The geometry that the constraint fixes, for assembly.
            pub fn fixes(&self) -> Vec<Fixes<S>> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::fixes(e),)+)+ }
            }
        }

        impl Constraint {
            /// The symbols that a drawing shows for it.
            pub fn symbols(&self) -> Vec<SceneSymbol> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::symbols(e),)+)+ }
            }
            /// First values of the internal coordinates for bodies at given poses.
            pub fn own_start(&self, bodies: &[Pose]) -> Vec<f64> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::own_start(e, bodies),)+)+ }
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
            /// The place where the reaction acts, in the frame of body j, if it moves.
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
            /// Wrenches beside -Φ_qᵀ λ that its multipliers cause.
            pub fn load(&self, at: &At<'_, S>, lam: &[S], out: &mut dyn FnMut(usize, Wrench<S>)) {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::load(e, at, lam, out),)+)+ }
            }
            /// The joint frame on a body, given by its place in [`bodies`](Self::bodies).
            pub fn attachment(&self, body: usize) -> Attachment<S> {
                match self { $($($(#[$on])* Self::$Name(e) => <$Name as Joint>::attachment(e, body),)+)+ }
            }
            /// The same constraint over a scalar that contains this one.
            pub fn lift<T: Lift<S>>(&self) -> Constraint<T> {
                self.map(&mut |s| T::lift(*s))
            }
        }

        /// Joints and drivers, stored together by type; only the types that occur.
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
                match constraint { $($($(#[$on])* Constraint::$Name(e) => {
                    let entry = Pooled { element: e.clone(), place };
                    for pool in &mut self.0 {
                        if let JointPool::$Name(pool) = pool {
                            return pool.push(entry);
                        }
                    }
                    self.0.push(JointPool::$Name(vec![entry]));
                })+)+ }
            }
            /// Passes every type that occurs to the visitor.
            #[inline(always)]
            pub fn visit(&self, visitor: &mut impl VisitJoints<S>) {
                for pool in &self.0 {
                    match pool { $($($(#[$on])* JointPool::$Name(p) => visitor.visit::<$Name>(p),)+)+ }
                }
            }
        }

        #[allow(clippy::vec_init_then_push)] // some entries exist only with a feature
        fn constraint_tables() -> Vec<(Group, Table)> {
            let mut all = Vec::new();
            $($($(#[$on])* all.push(declared::<$Name>(Group::$Group));)+)+
            all
        }
    };
}

macro_rules! forces {
    ($($(#[$on:meta])* $Name:ident),+ $(,)?) => {
        /// A force of any type.
        #[derive(Clone, Debug)]
        #[allow(missing_docs)] // each variant is documented at its element
        pub enum ForceElement<S = f64> {
            $($(#[$on])* $Name($Name<S>),)+
        }

        impl ForceElement<Tape> {
            /// Reads an element by the name of its type; the outer None if there is no such type.
            pub fn read(kind: &str, source: &mut dyn Source) -> Option<Option<Self>> {
                $($(#[$on])* {
                    if kind == <$Name>::NAME {
                        return Some(<$Name>::read(source).map(Self::$Name));
                    }
                })+
                None
            }
        }

        /// The position quantities of a force of a type.
        pub fn measured_of(kind: &str) -> &'static [Measured] {
            $($(#[$on])* {
                if kind == <$Name>::NAME {
                    return <$Name as Force>::MEASURED;
                }
            })+
            &[]
        }

        /// The first-order states of a force of a type for which the named fields are `given`.
        pub fn states_of(kind: &str, given: &dyn Fn(&str) -> bool) -> &'static [OwnState] {
            $($(#[$on])* {
                if kind == <$Name>::NAME {
                    return <$Name as Force>::states(given);
                }
            })+
            &[]
        }

        impl<S> ForceElement<S> {
            /// The same force over another scalar.
            pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> ForceElement<T> {
                match self { $($(#[$on])* Self::$Name(e) => ForceElement::$Name(<$Name>::map(e, f)),)+ }
            }
            /// The number of scalars of each field, in the order of [`ForceElement::map`].
            pub fn scalars(&self) -> Vec<usize> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::scalars(e),)+ }
            }
            /// Name of the type.
            pub fn kind(&self) -> &'static str {
                match self { $($(#[$on])* Self::$Name(_) => <$Name>::NAME,)+ }
            }
            /// The bodies on which the force acts: i and j first.
            pub fn bodies(&self) -> Vec<BodyId> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::bodies(e),)+ }
            }
            /// The position quantities that may be measured on it.
            pub fn measured(&self) -> &'static [Measured] {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::MEASURED,)+ }
            }
            /// The named parts, in the order of [`ForceElement::action`].
            pub fn parts(&self) -> &'static [Part] {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::PARTS,)+ }
            }
            /// The joint whose reaction enters the force.
            pub fn reaction(&self) -> Option<JointId> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::reaction(e),)+ }
            }
        }

        impl ForceElement {
            /// The symbols that a drawing shows for it.
            pub fn symbols(&self) -> Vec<SceneSymbol> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::symbols(e),)+ }
            }
            /// A field with an impossible value, and the reason.
            pub fn fault(&self) -> Option<(&'static str, String)> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::fault(e),)+ }
            }
        }

        impl<S: Real> ForceElement<S> {
            /// The wrench of each part on each body, see [`Force::action`].
            pub fn action(&self, at: &Situation<'_, S>, out: impl Wrenches<S>) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::action(e, at, out),)+ }
            }
            /// The values of [`measured`](Self::measured).
            pub fn measure(&self, at: &At<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::measure(e, at, out),)+ }
            }
            /// ż of the element.
            pub fn state_rates(&self, at: &Situation<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::state_rates(e, at, out),)+ }
            }
            /// Powers beside those of the wrenches.
            pub fn own_powers(&self, at: &Situation<'_, S>) -> OwnPowers<S> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::own_powers(e, at),)+ }
            }
            /// Number of switches.
            pub fn switch_count(&self) -> usize {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::switch_count(e),)+ }
            }
            /// The functions of the switches.
            pub fn switches(&self, at: &Situation<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::switches(e, at, out),)+ }
            }
            /// The relative angle at which a rotational spring is relaxed.
            pub fn free_angle(&self) -> Option<S> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::free_angle(e),)+ }
            }
            /// The points of body i and body j between which the force acts along their line.
            pub fn points(&self) -> Option<[Local<S>; 2]> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::points(e),)+ }
            }
            /// Energy stored in the states, J.
            pub fn own_energy(&self, at: &Situation<'_, S>) -> S {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::own_energy(e, at),)+ }
            }
            /// Potential energy of the conservative parts, J.
            pub fn potential(&self, at: &Situation<'_, S>) -> S {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::potential(e, at),)+ }
            }
        }

        /// Forces, stored together by type; only the types that occur.
        #[derive(Clone, Debug)]
        pub struct ForcePools<S = f64>(Vec<ForcePool<S>>);

        /// All forces of one type.
        #[derive(Clone, Debug)]
        enum ForcePool<S> {
            $($(#[$on])* $Name(Vec<Pooled<$Name<S>>>),)+
        }

        impl<S> std::default::Default for ForcePools<S> {
            fn default() -> Self {
                Self(Vec::new())
            }
        }

        impl<S: Real> ForcePools<S> {
            /// Adds a force.
            pub fn push(&mut self, force: &ForceElement<S>, place: Place) {
                match force { $($(#[$on])* ForceElement::$Name(e) => {
                    let entry = Pooled { element: e.clone(), place };
                    for pool in &mut self.0 {
                        if let ForcePool::$Name(pool) = pool {
                            return pool.push(entry);
                        }
                    }
                    self.0.push(ForcePool::$Name(vec![entry]));
                })+ }
            }
            /// Passes every type that occurs to the visitor.
            #[inline(always)]
            pub fn visit(&self, visitor: &mut impl VisitForces<S>) {
                for pool in &self.0 {
                    match pool { $($(#[$on])* ForcePool::$Name(p) => visitor.visit::<$Name>(p),)+ }
                }
            }
        }

        #[allow(clippy::vec_init_then_push)] // some entries exist only with a feature
        fn force_tables() -> Vec<(Group, Table)> {
            let mut all = Vec::new();
            $($(#[$on])* all.push(declared::<$Name>(Group::Forces));)+
            all
        }
    };
}

pub(super) use {constraints, forces};
