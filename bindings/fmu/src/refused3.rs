//! Functions of FMI 3.0 for what these FMUs do not have: they are an error, with the reason in the log.
#![allow(unsafe_code, non_snake_case)]

use crate::pointers::with;
use std::ffi::{c_char, c_int, c_void};

macro_rules! refused {
    ($($name:ident($($argument:ident: $of:ty),*): $reason:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` is refused.")]
        ///
        /// # Safety
        /// The instance is null or from `fmi3InstantiateCoSimulation`.
        #[no_mangle]
        pub unsafe extern "C" fn $name(instance: *mut c_void, $($argument: $of),*) -> c_int {
            $(let _ = $argument;)*
            // SAFETY: see above
            unsafe { with(instance, |_| Err(format!("{}: {}", stringify!($name), $reason))) }
        }
    )*};
}

const REAL: &str = "all variables are of type Float64";
const CLOCK: &str = "there are no clocks";
const EVENT: &str = "there is no event mode";
const STATE: &str = "there is no model exchange";
const DERIVATIVE: &str = "there are no derivatives";
const DEPENDENCY: &str = "there is no list of dependencies; each output may depend on all inputs";
const CONFIGURATION: &str = "there are no structural parameters";

/// Value references.
type Refs = *const u32;

refused! {
    fmi3EnterEventMode(): EVENT;
    fmi3GetFloat32(_refs: Refs, _n: usize, _values: *mut f32, _m: usize): REAL;
    fmi3GetInt8(_refs: Refs, _n: usize, _values: *mut i8, _m: usize): REAL;
    fmi3GetUInt8(_refs: Refs, _n: usize, _values: *mut u8, _m: usize): REAL;
    fmi3GetInt16(_refs: Refs, _n: usize, _values: *mut i16, _m: usize): REAL;
    fmi3GetUInt16(_refs: Refs, _n: usize, _values: *mut u16, _m: usize): REAL;
    fmi3GetInt32(_refs: Refs, _n: usize, _values: *mut i32, _m: usize): REAL;
    fmi3GetUInt32(_refs: Refs, _n: usize, _values: *mut u32, _m: usize): REAL;
    fmi3GetInt64(_refs: Refs, _n: usize, _values: *mut i64, _m: usize): REAL;
    fmi3GetUInt64(_refs: Refs, _n: usize, _values: *mut u64, _m: usize): REAL;
    fmi3GetBoolean(_refs: Refs, _n: usize, _values: *mut bool, _m: usize): REAL;
    fmi3GetString(_refs: Refs, _n: usize, _values: *mut *const c_char, _m: usize): REAL;
    fmi3GetBinary(_refs: Refs, _n: usize, _sizes: *mut usize, _values: *mut *const u8,
        _m: usize): REAL;
    fmi3GetClock(_refs: Refs, _n: usize, _values: *mut bool): CLOCK;
    fmi3SetFloat32(_refs: Refs, _n: usize, _values: *const f32, _m: usize): REAL;
    fmi3SetInt8(_refs: Refs, _n: usize, _values: *const i8, _m: usize): REAL;
    fmi3SetUInt8(_refs: Refs, _n: usize, _values: *const u8, _m: usize): REAL;
    fmi3SetInt16(_refs: Refs, _n: usize, _values: *const i16, _m: usize): REAL;
    fmi3SetUInt16(_refs: Refs, _n: usize, _values: *const u16, _m: usize): REAL;
    fmi3SetInt32(_refs: Refs, _n: usize, _values: *const i32, _m: usize): REAL;
    fmi3SetUInt32(_refs: Refs, _n: usize, _values: *const u32, _m: usize): REAL;
    fmi3SetInt64(_refs: Refs, _n: usize, _values: *const i64, _m: usize): REAL;
    fmi3SetUInt64(_refs: Refs, _n: usize, _values: *const u64, _m: usize): REAL;
    fmi3SetBoolean(_refs: Refs, _n: usize, _values: *const bool, _m: usize): REAL;
    fmi3SetString(_refs: Refs, _n: usize, _values: *const *const c_char, _m: usize): REAL;
    fmi3SetBinary(_refs: Refs, _n: usize, _sizes: *const usize, _values: *const *const u8,
        _m: usize): REAL;
    fmi3SetClock(_refs: Refs, _n: usize, _values: *const bool): CLOCK;
    fmi3GetNumberOfVariableDependencies(_of: u32, _count: *mut usize): DEPENDENCY;
    fmi3GetVariableDependencies(_of: u32, _indices: *mut usize, _refs: *mut u32,
        _elements: *mut usize, _kinds: *mut c_int, _count: usize): DEPENDENCY;
    fmi3GetDirectionalDerivative(_unknowns: Refs, _n: usize, _knowns: Refs, _m: usize,
        _seed: *const f64, _n_seed: usize, _found: *mut f64, _n_found: usize): DERIVATIVE;
    fmi3GetAdjointDerivative(_unknowns: Refs, _n: usize, _knowns: Refs, _m: usize,
        _seed: *const f64, _n_seed: usize, _found: *mut f64, _n_found: usize): DERIVATIVE;
    fmi3EnterConfigurationMode(): CONFIGURATION;
    fmi3ExitConfigurationMode(): CONFIGURATION;
    fmi3GetIntervalDecimal(_refs: Refs, _n: usize, _found: *mut f64, _kinds: *mut c_int): CLOCK;
    fmi3GetIntervalFraction(_refs: Refs, _n: usize, _counters: *mut u64, _resolutions: *mut u64,
        _kinds: *mut c_int): CLOCK;
    fmi3GetShiftDecimal(_refs: Refs, _n: usize, _shifts: *mut f64): CLOCK;
    fmi3GetShiftFraction(_refs: Refs, _n: usize, _counters: *mut u64,
        _resolutions: *mut u64): CLOCK;
    fmi3SetIntervalDecimal(_refs: Refs, _n: usize, _intervals: *const f64): CLOCK;
    fmi3SetIntervalFraction(_refs: Refs, _n: usize, _counters: *const u64,
        _resolutions: *const u64): CLOCK;
    fmi3SetShiftDecimal(_refs: Refs, _n: usize, _shifts: *const f64): CLOCK;
    fmi3SetShiftFraction(_refs: Refs, _n: usize, _counters: *const u64,
        _resolutions: *const u64): CLOCK;
    fmi3EvaluateDiscreteStates(): EVENT;
    fmi3UpdateDiscreteStates(_again: *mut bool, _end: *mut bool, _nominals: *mut bool,
        _states: *mut bool, _defined: *mut bool, _next: *mut f64): EVENT;
    fmi3EnterContinuousTimeMode(): STATE;
    fmi3CompletedIntegratorStep(_no_return: bool, _event: *mut bool, _end: *mut bool): STATE;
    fmi3SetTime(_time: f64): STATE;
    fmi3SetContinuousStates(_states: *const f64, _n: usize): STATE;
    fmi3GetContinuousStateDerivatives(_found: *mut f64, _n: usize): STATE;
    fmi3GetEventIndicators(_found: *mut f64, _n: usize): STATE;
    fmi3GetContinuousStates(_found: *mut f64, _n: usize): STATE;
    fmi3GetNominalsOfContinuousStates(_found: *mut f64, _n: usize): STATE;
    fmi3GetNumberOfEventIndicators(_count: *mut usize): STATE;
    fmi3GetNumberOfContinuousStates(_count: *mut usize): STATE;
    fmi3EnterStepMode(): EVENT;
    fmi3GetOutputDerivatives(_refs: Refs, _n: usize, _orders: *const i32, _values: *mut f64,
        _m: usize): DERIVATIVE;
    fmi3ActivateModelPartition(_clock: u32, _time: f64): CLOCK;
}
