//! The functions of FMI 2.0 for co-simulation (Modelica Association, Functional Mock-up Interface 2.0.5, chapters 2 and 4).
#![allow(unsafe_code, non_snake_case)]

use crate::component::{Log, Status};
use crate::pointers::{self, behind, passed_on, text, with, write};
use std::ffi::{c_char, c_int, c_uint, c_void, CString};
use std::ptr::null_mut;

/// `fmi2CallbackLogger`. The message is a format, as for printf.
type Logger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`.
#[repr(C)]
pub struct Callbacks {
    logger: Option<Logger>,
    allocate: *const c_void,
    free: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// `fmi2CoSimulation` of `fmi2Type`.
const CO_SIMULATION: c_int = 1;
/// `fmi2LastSuccessfulTime` of `fmi2StatusKind`.
const LAST_TIME: c_int = 2;
/// `fmi2Terminated` of `fmi2StatusKind`.
const TERMINATED: c_int = 3;

fn log(name: &str, logger: Option<Logger>, environment: *mut c_void) -> Log {
    let name = CString::new(name).unwrap_or_default();
    Box::new(move |status, message| {
        let Some(logger) = logger else { return };
        let message =
            CString::new(message.replace('%', "%%").replace('\0', "")).unwrap_or_default();
        let category = CString::new(status.category()).unwrap_or_default();
        let (name, category, message) = (name.as_ptr(), category.as_ptr(), message.as_ptr());
        // SAFETY: the host gave this function for the life of the instance; the texts remain during the call
        unsafe { logger(environment, name, status as c_int, category, message) };
    })
}

/// `fmi2GetTypesPlatform`.
#[no_mangle]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `fmi2GetVersion`.
#[no_mangle]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`.
///
/// # Safety
/// The pointers are those of the standard, as for all functions of this file.
#[no_mangle]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    token: *const c_char,
    resources: *const c_char,
    functions: *const Callbacks,
    _visible: c_int,
    _logging: c_int,
) -> *mut c_void {
    // SAFETY: see above
    let functions = unsafe { functions.as_ref() };
    let (logger, environment) = functions.map_or((None, null_mut()), |f| (f.logger, f.environment));
    // SAFETY: see above
    let log = log(unsafe { text(name) }.unwrap_or_default(), logger, environment);
    let refusal =
        (kind != CO_SIMULATION).then_some("model exchange is not supported, only co-simulation");
    // SAFETY: see above
    unsafe { pointers::instantiated(token, resources, refusal, log) }
}

/// `fmi2FreeInstance`.
///
/// # Safety
/// See [`fmi2Instantiate`].
#[no_mangle]
pub unsafe extern "C" fn fmi2FreeInstance(component: *mut c_void) {
    // SAFETY: see above
    unsafe { pointers::free(component) };
}

/// `fmi2SetDebugLogging`. There are only messages about errors and warnings, which are always sent.
#[no_mangle]
pub extern "C" fn fmi2SetDebugLogging(
    _component: *mut c_void,
    _on: c_int,
    _count: usize,
    _categories: *const *const c_char,
) -> c_int {
    Status::Ok as c_int
}

/// `fmi2SetupExperiment`. The end does not matter.
///
/// # Safety
/// See [`fmi2Instantiate`].
#[no_mangle]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: *mut c_void,
    has_tolerance: c_int,
    tolerance: f64,
    start: f64,
    _has_stop: c_int,
    _stop: f64,
) -> c_int {
    let tolerance = (has_tolerance != 0).then_some(tolerance);
    // SAFETY: see above
    unsafe { with(component, |own| own.instance.set_up(tolerance, start).map(|()| Status::Ok)) }
}

passed_on! {
    fmi2EnterInitializationMode() = enter_initialization;
    fmi2GetReal(references: *const c_uint, count: usize, values: *mut f64) = get;
    fmi2SetReal(references: *const c_uint, count: usize, values: *const f64) = set;
    fmi2ExitInitializationMode() = exit_initialization;
    fmi2Terminate() = terminate;
    fmi2Reset() = reset;
    fmi2GetFMUstate(to: *mut *mut c_void) = get_state;
    fmi2SetFMUstate(state: *mut c_void) = set_state;
    fmi2FreeFMUstate(state: *mut *mut c_void) = free_state;
    fmi2SerializedFMUstateSize(state: *mut c_void, size: *mut usize) = state_size;
    fmi2SerializeFMUstate(state: *mut c_void, to: *mut u8, size: usize) = write_state;
    fmi2DeSerializeFMUstate(from: *const u8, size: usize, to: *mut *mut c_void) = read_state;
}

/// `fmi2DoStep`. Discards the rest of a step in which an event stops the run.
///
/// # Safety
/// See [`fmi2Instantiate`].
#[no_mangle]
pub unsafe extern "C" fn fmi2DoStep(
    component: *mut c_void,
    at: f64,
    duration: f64,
    _no_return: c_int,
) -> c_int {
    // SAFETY: see above
    let Some(component) = (unsafe { behind(component) }) else { return Status::Error as c_int };
    match component.step(at, duration) {
        (Status::Ok | Status::Warning, true) => Status::Discard as c_int,
        (status, _) => status as c_int,
    }
}

/// `fmi2GetRealStatus`: the time that the last step reached.
///
/// # Safety
/// See [`fmi2Instantiate`].
#[no_mangle]
pub unsafe extern "C" fn fmi2GetRealStatus(
    component: *mut c_void,
    kind: c_int,
    value: *mut f64,
) -> c_int {
    // SAFETY: see above
    unsafe {
        with(component, |own| {
            if kind != LAST_TIME {
                return Ok(Status::Discard);
            }
            write(value, own.instance.t()?);
            Ok(Status::Ok)
        })
    }
}

/// `fmi2GetBooleanStatus`: whether an event has stopped the run.
///
/// # Safety
/// See [`fmi2Instantiate`].
#[no_mangle]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    component: *mut c_void,
    kind: c_int,
    value: *mut c_int,
) -> c_int {
    // SAFETY: see above
    unsafe {
        with(component, |own| {
            if kind != TERMINATED {
                return Ok(Status::Discard);
            }
            write(value, c_int::from(own.instance.is_stopped()));
            Ok(Status::Ok)
        })
    }
}
