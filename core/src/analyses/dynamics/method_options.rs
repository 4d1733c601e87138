//! Options of the methods of integration, as written in a file; each set becomes a [`Scheme`].

use super::absolute_tolerance::{absolute_tolerance, AbsoluteTolerance};
use super::methods::{self, Scheme};
use crate::analyses::options::{
    family, hht_alpha, not_negative, options, positive, spectral_radius,
};
use crate::integrate::{self, AlphaParameters, Atol, StepControl};

family!(Scheme, "method", [Auto, Rk45, Dop853, Rk4, GeneralizedAlpha, Hht, Radau]);

/// Declares an explicit method with step control.
macro_rules! explicit {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal, $class:literal) => {
        options! {
            $(#[doc = $doc])*
            $Name, $name, $class () {
                /// Relative tolerance of one step.
                rtol: not_negative = StepControl::USUAL.0,
                /// Absolute tolerance of one step. A number applies to every component, in its
                /// unit. A table such as `{ length = 1e-9, angle = 1e-9, z = 1e-9 }` contains one
                /// tolerance each for lengths, angles and first-order states, and for their rates
                /// per second. A missing tolerance is 1e-9; for lengths, it is multiplied by the
                /// size of the mechanism.
                atol: Option<absolute_tolerance> = None,
                /// Constant step, independent of the tolerances; if absent, the tolerances control
                /// the step.
                step: Option<positive> [s] = None,
                /// First step; if absent, the solver chooses it.
                first_step: Option<positive> [s] = None,
                /// Largest step; no limit if absent.
                max_step: Option<positive> [s] = None,
            }
            excludes { step: first_step, max_step; }
        }

        impl From<$Name> for Scheme {
            fn from(given: $Name) -> Self {
                let $Name { rtol, atol, step, first_step, max_step } = given;
                let atol = AbsoluteTolerance::resolve(atol, StepControl::USUAL.1);
                let control = StepControl { step, ..control(rtol, atol, first_step, max_step) };
                Self::$Name(integrate::$Name { control })
            }
        }
    };
}

/// Declares an implicit method. It may have one option of its own, which determines its parameters.
macro_rules! implicit {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal, $class:literal, $tolerances:expr,
        { $($(#[doc = $about:literal])* $own:ident: $kind:ident = $default:expr)? },
        |$control:ident $(, $parameter:ident)?| $scheme:expr
    ) => {
        options! {
            $(#[doc = $doc])*
            $Name, $name, $class () {
                $($(#[doc = $about])* $own: $kind = $default,)?
                /// Relative tolerance of one step. If absent, 1e-6, or 1e-4 for methods of order 2.
                /// With a constant step, it is the tolerance of Newton's iteration, 1e-10 if
                /// absent.
                rtol: Option<not_negative> = None,
                /// Absolute tolerance of one step, a number or a table as for `rk45`. A missing
                /// tolerance is 1e-9, or 1e-7 for methods of order 2. With a constant step, it is
                /// the tolerance of Newton's iteration, 1e-12 if absent. For lengths, these
                /// defaults are multiplied by the size of the mechanism.
                atol: Option<absolute_tolerance> = None,
                /// Constant step, without control of the error; if absent, the tolerances control
                /// the step.
                step: Option<positive> [s] = None,
                /// First step; if absent, the solver chooses it.
                first_step: Option<positive> [s] = None,
                /// Largest step; no limit if absent.
                max_step: Option<positive> [s] = None,
            }
            excludes { step: first_step, max_step; }
        }

        impl From<$Name> for Scheme {
            fn from(given: $Name) -> Self {
                let $Name { $($own,)? rtol, atol, step, first_step, max_step } = given;
                let usual = if step.is_some() { StepControl::NEWTON } else { $tolerances };
                let (rtol, atol) = (rtol.unwrap_or(usual.0), AbsoluteTolerance::resolve(atol, usual.1));
                let $control = StepControl { step, ..control(rtol, atol, first_step, max_step) };
                $(let $parameter = $own;)?
                $scheme
            }
        }
    };
}

fn control(rtol: f64, atol: Atol, first_step: Option<f64>, max_step: Option<f64>) -> StepControl {
    let max_step = max_step.unwrap_or(f64::INFINITY);
    StepControl { atol, first_step, max_step, ..StepControl::new(rtol, 0.0) }
}

explicit! {
    /// Explicit Runge-Kutta method of order 5(4) of Dormand and Prince (1980), with step control.
    Rk45, "rk45", "RK45"
}

explicit! {
    /// Explicit Runge-Kutta method of order 8(5,3) of Dormand and Prince (Hairer et al. 1993), with
    /// step control. It is suitable for tolerances below about 1e-6 and smooth forces. Between the
    /// steps, the method interpolates with order 8. At the start, and where the lengths of the
    /// steps differ much, it interpolates with order 7.
    Dop853, "dop853", "DOP853"
}

options! {
    /// Automatic choice of the method: DOP853, or Radau where the model is stiff. At the start, the
    /// fastest damped motion of the linearised equations is compared with the pace of the other
    /// motions. If this motion is far faster and has decayed, Radau begins; otherwise DOP853
    /// begins. If a damped motion keeps the steps of DOP853 at the limit of stability, Radau
    /// replaces it. If this does not lengthen the steps, DOP853 returns. The statistics contain the
    /// last method and the reason.
    Auto, "auto", "Auto" () {
        /// Relative tolerance of one step.
        rtol: not_negative = StepControl::AUTO.0,
        /// Absolute tolerance of one step, a number or a table as for `rk45`. A missing tolerance
        /// is 1e-11; for lengths, it is multiplied by the size of the mechanism.
        atol: Option<absolute_tolerance> = None,
        /// First step; if absent, the solver chooses it.
        first_step: Option<positive> [s] = None,
        /// Largest step; no limit if absent.
        max_step: Option<positive> [s] = None,
    }
}

impl From<Auto> for Scheme {
    fn from(Auto { rtol, atol, first_step, max_step }: Auto) -> Self {
        let atol = AbsoluteTolerance::resolve(atol, StepControl::AUTO.1);
        Self::Auto(methods::Auto { control: control(rtol, atol, first_step, max_step) })
    }
}

options! {
    /// Classical Runge-Kutta method of order 4 with a constant step.
    Rk4, "rk4", "RK4" (
        /// Length of a step.
        step: positive [s]
    ) {}
}

impl From<Rk4> for Scheme {
    fn from(Rk4 { step }: Rk4) -> Self {
        Self::Rk4(integrate::Rk4::new(step))
    }
}

implicit! {
    /// Implicit generalized-alpha method of order 2 (Chung and Hulbert 1993) at index 3 (Arnold and
    /// Bruels 2007). It is suitable for stiff forces and moderate accuracy. The equations of the
    /// method include the constraints, so that the positions satisfy them at every step.
    /// Projection, the default stabilization, does the same for the velocities. Between the steps,
    /// the method interpolates with a cubic polynomial.
    GeneralizedAlpha, "generalized_alpha", "GeneralizedAlpha", StepControl::LOW_ORDER, {
        /// Spectral radius at infinite frequency, in [0, 1); a smaller value damps high frequencies
        /// more.
        rho: spectral_radius = 0.8
    }, |control, rho| {
        let parameters = AlphaParameters::chung_hulbert(rho);
        Self::GeneralizedAlpha(integrate::GeneralizedAlpha { parameters, control })
    }
}

implicit! {
    /// Implicit method of order 2 of Hilber, Hughes and Taylor (1977), a case of generalized-alpha, at index 3.
    Hht, "hht", "HHT", StepControl::LOW_ORDER, {
        /// Parameter in [-1/3, 0); a smaller value damps high frequencies more.
        alpha: hht_alpha = -0.1
    }, |control, alpha| {
        let parameters = AlphaParameters::hht(alpha);
        Self::GeneralizedAlpha(integrate::GeneralizedAlpha { parameters, control })
    }
}

implicit! {
    /// Implicit Radau IIA method of order 5 at index 2 (Hairer and Wanner 1996), with step control.
    /// It is suitable for stiff forces. The velocities satisfy the constraints at every stage.
    /// Projection, the default stabilization, does the same for the positions. Between the steps,
    /// the method interpolates positions with order 4 and velocities with order 3.
    Radau, "radau", "Radau", StepControl::USUAL, {}, |control| {
        Self::Radau(integrate::Radau { control })
    }
}
