//! Dispatch from a force of a model to the physics of its type: an enum over all types, and pools of elements by type.
//! The macro is called once, in `mod.rs`.

macro_rules! forces {
    ($($(#[$on:meta])* $Name:ident),+ $(,)?) => {
        /// A force of any type.
        #[derive(Clone, Debug)]
        #[allow(missing_docs)] // each variant is documented at its element
        pub enum ForceElement<S = f64> {
            $($(#[$on])* $Name($Name<S>),)+
        }

        impl ForceElement<Tape> {
            /// Reads an element of a section by the name of its type. The outer option is None if there is no such type.
            pub fn read(
                group: Group,
                kind: &str,
                source: &mut dyn Source,
            ) -> Option<Option<Self>> {
                $($(#[$on])* {
                    let own = kind == <$Name>::NAME && group == <$Name as Force>::GROUP;
                    if own && !kind.contains(' ') && <$Name as Force>::IN_FILES {
                        return Some(<$Name>::read(source).map(Self::$Name));
                    }
                })+
                None
            }
        }

        /// Whether joints of a type act as forces.
        pub fn acts_as_force(kind: &str) -> bool {
            $($(#[$on])* {
                if kind == <$Name>::NAME {
                    return matches!(<$Name as Force>::GROUP, Group::Joints);
                }
            })+
            false
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

        /// The first-order [states](Force::states) of a force of a type.
        pub fn states_of<'a>(
            kind: &str,
            given: &dyn Fn(&str) -> Option<&'a str>,
        ) -> &'static [OwnState] {
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
            /// Passes each scalar to a function, in the order of [`ForceElement::map`].
            pub fn visit(&self, f: &mut dyn FnMut(&S)) {
                // mapped to this scalar elsewhere too, so that it needs no further code
                self.map::<Jet>(&mut |x| {
                    f(x);
                    Jet::zero()
                });
            }
            /// The number of scalars of each field, in the order of [`ForceElement::map`].
            pub fn scalars(&self) -> Vec<usize> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::scalars(e),)+ }
            }
            /// Name of the type.
            pub fn kind(&self) -> &'static str {
                match self { $($(#[$on])* Self::$Name(_) => <$Name>::NAME,)+ }
            }
            /// Name of the type in files: for a joint with play or slip, that of the joint.
            pub fn written(&self) -> &'static str {
                self.joint().map_or(self.kind(), Constraint::kind)
            }
            /// The bodies on which the force acts: i and j first.
            pub fn bodies(&self) -> Vec<BodyId> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::bodies(e),)+ }
            }
            /// The position quantities that can be measured on it.
            pub fn measured(&self) -> &'static [Measured] {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::measured(e),)+ }
            }
            /// Whether laws may use its position quantities.
            pub fn has_formulas(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::has_formulas(e),)+ }
            }
            /// Whether the only formulas of the state in the force are those of a position quantity that it follows.
            pub fn follows(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::FOLLOWS,)+ }
            }
            /// Whether bodies touch or rub in the element.
            pub fn touches_or_rubs(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::TOUCHES_OR_RUBS,)+ }
            }
            /// The position quantity that the element follows.
            pub fn followed(&self) -> Option<&Followed<S>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::followed(e),)+ }
            }
            /// The section of files that contains it.
            pub fn group(&self) -> Group {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::GROUP,)+ }
            }
            /// Whether files contain elements of its type.
            pub fn in_files(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::IN_FILES,)+ }
            }
            /// The named parts, in the order of [`ForceElement::action`].
            pub fn parts(&self) -> &'static [Part] {
                match self { $($(#[$on])* Self::$Name(_) => <$Name as Force>::PARTS,)+ }
            }
            /// Results in addition to the wrenches.
            pub fn result_quantities(&self) -> &'static [ResultQuantity] {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::result_quantities(e),)+ }
            }
            /// The joint with play that the force is.
            pub fn joint(&self) -> Option<&Constraint<S>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::joint(e),)+ }
            }
            /// The driver whose effort the force limits.
            pub fn driver(&self) -> Option<&Constraint<S>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::driver(e),)+ }
            }
            /// Lets the force act in place of its driver, or not.
            pub fn take_over(&mut self, acts: bool) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::take_over(e, acts),)+ }
            }
            /// The joint on whose reaction the force depends.
            pub fn reaction(&self) -> Option<JointId> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::reaction(e),)+ }
            }
        }

        impl ForceElement<Tape> {
            /// The equation with which the force [holds](Mode::holds).
            pub fn holding(&self, side: f64, value: f64) -> Option<Constraint<Tape>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::holding(e, side, value),)+ }
            }
        }

        impl ForceElement<Tape> {
            /// A second element of the force, see [`Force::companion`].
            pub fn companion(&self) -> Option<ForceElement<Tape>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::companion(e),)+ }
            }
        }

        impl ForceElement {
            /// The coefficients of friction of a contact that slides and that sticks.
            pub fn coefficients(&self) -> [f64; 2] {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::coefficients(e),)+ }
            }
            /// The distances whose zeros begin and end a contact.
            pub fn clearances(&self) -> Vec<Clearance<'_>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::clearances(e),)+ }
            }
            /// The field that contains its play, and the play, m.
            pub fn play(&self) -> Option<(&'static str, f64)> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::play(e),)+ }
            }
            /// A quantity that a start must meet.
            pub fn requires(&self, at: &At<'_, f64>) -> Option<Required<f64>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::requires(e, at),)+ }
            }
            /// Whether the dimensions that give a stress are known.
            pub fn has_stress(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::has_stress(e),)+ }
            }
            /// The symbols of the force in a drawing.
            pub fn symbols(&self) -> Vec<SceneSymbol> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::symbols(e),)+ }
            }
            /// A field with an impossible value, and the reason.
            pub fn fault(&self) -> Option<(&'static str, String)> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::fault(e),)+ }
            }
        }

        impl<S: Real> ForceElement<S> {
            /// A length of the element that counts for the size of the mechanism.
            pub fn reach(&self) -> Option<S> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::reach(e),)+ }
            }
            /// The wrench of each part on each body, see [`Force::action`].
            pub fn action(&self, at: &Situation<'_, S>, out: &mut dyn Wrenches<S>) {
                // one type for all receivers, so that each force is compiled once for them
                let put = |part: usize, body: usize, wrench: Wrench<S>| out.put(part, body, wrench);
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::action(e, at, put),)+ }
            }
            /// The values of [`measured`](Self::measured).
            pub fn measure(&self, at: &At<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::measure(e, at, out),)+ }
            }
            /// ż of the element.
            pub fn state_rates(&self, at: &Situation<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::state_rates(e, at, out),)+ }
            }
            /// Powers in addition to those of the wrenches.
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
            /// The values of [`result_quantities`](Self::result_quantities).
            pub fn results(&self, at: &Situation<'_, S>, out: &mut [S]) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::results(e, at, out),)+ }
            }
            /// The changes of mode during a run.
            pub fn behaviour(&self) -> Option<Behaviour<S>> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::behaviour(e),)+ }
            }
            /// The function whose zero may change the mode.
            pub fn threshold(&self, at: &Situation<'_, S>) -> S {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::threshold(e, at),)+ }
            }
            /// The effort that depends on a reaction, and its derivatives with respect to the reaction.
            pub fn effort(&self, at: &Situation<'_, S>) -> (S, Wrench<S>) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::effort(e, at),)+ }
            }
            /// The wrenches of such an effort.
            pub fn put_effort(&self, at: &Situation<'_, S>, effort: S, out: &mut dyn Wrenches<S>) {
                let put = |part: usize, body: usize, wrench: Wrench<S>| out.put(part, body, wrench);
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::put_effort(e, at, effort, put),)+ }
            }
            /// The largest effort of sticking friction, and its derivatives with respect to the reaction.
            pub fn limit(&self, at: &Situation<'_, S>) -> (S, Wrench<S>) {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::limit(e, at),)+ }
            }
            /// The reserve while the force holds. It is positive until friction slips or a contact separates.
            pub fn reserve(&self, at: &Situation<'_, S>) -> S {
                let reserve = self.reserve_of_force(at);
                let margin = match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::margin(e, at),)+ };
                match margin {
                    // near the end of its range, the force may not hold
                    Some(margin) => reserve.min(S::constant(1e3) * margin * reserve.abs()),
                    None => reserve,
                }
            }
            fn reserve_of_force(&self, at: &Situation<'_, S>) -> S {
                match (at.mode, self.behaviour()) {
                    (Mode::Holds(_) | Mode::Carries(_), Some(Behaviour::Sticks)) => {
                        let left = self.limit(at).0 - at.multiplier.abs();
                        if self.only_pushes() { left.min(-at.multiplier) } else { left }
                    }
                    (Mode::Holds(side), _) => S::constant(side.signum()) * at.multiplier,
                    _ => S::constant(f64::INFINITY),
                }
            }
            /// Whether its last state is the rate with which its gap closed when the contact began.
            pub fn keeps_speed(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::keeps_speed(e),)+ }
            }
            /// Whether friction acts in one direction only.
            pub fn only_pushes(&self) -> bool {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::only_pushes(e),)+ }
            }
            /// The [limit](Force::limit) in the direction of the effort for a multiplier of this sign.
            pub fn limit_against(
                &self,
                at: &Situation<'_, S>,
                multiplier: S,
            ) -> (S, Wrench<S>) {
                let (limit, slope) = self.limit(at);
                match self.only_pushes() {
                    true => (S::select(multiplier, S::zero(), limit), Wrench::zero()),
                    false => (limit, slope),
                }
            }
            /// The side at which a contact or stop touches.
            pub fn side(&self, at: &Situation<'_, S>) -> f64 {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::side(e, at),)+ }
            }
            /// The relative angle at which a rotational spring is relaxed.
            pub fn free_angle(&self) -> Option<S> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::free_angle(e),)+ }
            }
            /// The points of bodies i and j, if the force acts along the line between them.
            pub fn points(&self) -> Option<[Local<S>; 2]> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name>::points(e),)+ }
            }
            /// The vectors from the origins of bodies i and j to the point at which the force acts, if it has one.
            pub fn arms(&self, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
                match self { $($(#[$on])* Self::$Name(e) => <$Name as Force>::arms(e, at),)+ }
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

        /// Forces, grouped by type. Only types that occur have a pool.
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
                for pool in &mut self.0 {
                    match (pool, force) {
                        $($(#[$on])* (ForcePool::$Name(pool), ForceElement::$Name(e)) => {
                            return pool.push(Pooled { element: e.clone(), place });
                        })+
                        _ => {} // of another type
                    }
                }
                self.0.push(match force {
                    $($(#[$on])* ForceElement::$Name(_) => ForcePool::$Name(Vec::new()),)+
                });
                self.push(force, place);
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
            $($(#[$on])* {
                if <$Name as Force>::IN_FILES {
                    all.push(declared::<$Name>(<$Name as Force>::GROUP));
                }
            })+
            all
        }
    };
}

pub(super) use forces;
