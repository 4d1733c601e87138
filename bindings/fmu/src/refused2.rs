//! Functions of FMI 2.0 for what these FMUs do not have: they are an error, with the reason in the log.
#![allow(unsafe_code, non_snake_case)]

use crate::pointers::with;
use std::ffi::{c_char, c_int, c_uint, c_void};

macro_rules! refused {
    ($($name:ident($($argument:ident: $of:ty),*): $reason:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` is refused.")]
        ///
        /// # Safety
        /// The component is null or from `fmi2Instantiate`.
        #[no_mangle]
        pub unsafe extern "C" fn $name(component: *mut c_void, $($argument: $of),*) -> c_int {
            $(let _ = $argument;)*
            // SAFETY: see above
            unsafe { with(component, |_| Err(format!("{}: {}", stringify!($name), $reason))) }
        }
    )*};
}

const REAL: &str = "all variables are real";
const INPUTS: &str = "inputs are constant over a step";
const OUTPUTS: &str = "there are no derivatives of outputs";
const PARTIAL: &str = "there are no directional derivatives";
const SYNCHRONOUS: &str = "steps end before the function returns";

/// Value references.
type Refs = *const c_uint;

refused! {
    fmi2GetInteger(_refs: Refs, _count: usize, _values: *mut c_int): REAL;
    fmi2GetBoolean(_refs: Refs, _count: usize, _values: *mut c_int): REAL;
    fmi2GetString(_refs: Refs, _count: usize, _values: *mut *const c_char): REAL;
    fmi2SetInteger(_refs: Refs, _count: usize, _values: *const c_int): REAL;
    fmi2SetBoolean(_refs: Refs, _count: usize, _values: *const c_int): REAL;
    fmi2SetString(_refs: Refs, _count: usize, _values: *const *const c_char): REAL;
    fmi2GetDirectionalDerivative(_unknown: Refs, _n: usize, _known: Refs, _m: usize,
        _seed: *const f64, _found: *mut f64): PARTIAL;
    fmi2SetRealInputDerivatives(_refs: Refs, _count: usize, _orders: *const c_int,
        _values: *const f64): INPUTS;
    fmi2GetRealOutputDerivatives(_refs: Refs, _count: usize, _orders: *const c_int,
        _values: *mut f64): OUTPUTS;
    fmi2CancelStep(): SYNCHRONOUS;
    fmi2GetStatus(_kind: c_int, _value: *mut c_int): SYNCHRONOUS;
    fmi2GetIntegerStatus(_kind: c_int, _value: *mut c_int): SYNCHRONOUS;
    fmi2GetStringStatus(_kind: c_int, _value: *mut *const c_char): SYNCHRONOUS;
}
