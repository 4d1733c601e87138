//! The functions of FMI 3.0 for co-simulation (Modelica Association, Functional Mock-up Interface 3.0.2, chapters 2 and 4).
#![allow(unsafe_code, non_snake_case)]

use crate::component::{Log, Status};
use crate::pointers::{self, behind, passed_on, with, write};
use std::ffi::{c_char, c_int, c_void, CString};
use std::ptr::null_mut;

/// `fmi3LogMessageCallback`.
type Logger = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

fn log(logger: Option<Logger>, environment: *mut c_void) -> Log {
    Box::new(move |status, message| {
        let Some(logger) = logger else { return };
        let message = CString::new(message.replace('\0', "")).unwrap_or_default();
        let category = CString::new(status.category()).unwrap_or_default();
        // SAFETY: the host gave this function for the life of the instance; the texts remain during the call
        unsafe { logger(environment, status as c_int, category.as_ptr(), message.as_ptr()) };
    })
}

/// `fmi3GetVersion`.
#[no_mangle]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// `fmi3SetDebugLogging`. There are only messages about errors and warnings, which are always sent.
#[no_mangle]
pub extern "C" fn fmi3SetDebugLogging(
    _instance: *mut c_void,
    _on: bool,
    _count: usize,
    _categories: *const *const c_char,
) -> c_int {
    Status::Ok as c_int
}

/// `fmi3InstantiateModelExchange` is refused.
///
/// # Safety
/// The pointers are those of the standard, as for all functions of this file.
#[no_mangle]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger>,
) -> *mut c_void {
    let message = "model exchange is not supported, only co-simulation";
    log(logger, environment)(Status::Error, message);
    null_mut()
}

/// `fmi3InstantiateScheduledExecution` is refused.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger>,
    _update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> *mut c_void {
    let message = "scheduled execution is not supported, only co-simulation";
    log(logger, environment)(Status::Error, message);
    null_mut()
}

/// `fmi3InstantiateCoSimulation`.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    event_mode: bool,
    _early_return: bool,
    _intermediate: *const u32,
    count: usize,
    environment: *mut c_void,
    logger: Option<Logger>,
    _update: *const c_void,
) -> *mut c_void {
    let log = log(logger, environment);
    let refusal = match (event_mode, count) {
        (true, _) => Some("there is no event mode"),
        (false, 1..) => Some("there are no intermediate variables"),
        (false, 0) => None,
    };
    // SAFETY: see above
    unsafe { pointers::instantiated(token, resources, refusal, log) }
}

/// `fmi3FreeInstance`.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    // SAFETY: see above
    unsafe { pointers::free(instance) };
}

/// `fmi3EnterInitializationMode`. The end does not matter.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    has_tolerance: bool,
    tolerance: f64,
    start: f64,
    _has_stop: bool,
    _stop: f64,
) -> c_int {
    let tolerance = has_tolerance.then_some(tolerance);
    // SAFETY: see above
    unsafe {
        with(instance, |own| {
            own.instance.set_up(tolerance, start)?;
            own.instance.enter_initialization().map(|()| Status::Ok)
        })
    }
}

/// `fmi3GetFloat64`. All variables are scalars.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
    n_values: usize,
) -> c_int {
    // SAFETY: see above
    unsafe {
        match count == n_values {
            true => pointers::get(instance, references, count, values),
            false => with(instance, |_| Err(lengths(count, n_values))),
        }
    }
}

/// `fmi3SetFloat64`. All variables are scalars.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
    n_values: usize,
) -> c_int {
    // SAFETY: see above
    unsafe {
        match count == n_values {
            true => pointers::set(instance, references, count, values),
            false => with(instance, |_| Err(lengths(count, n_values))),
        }
    }
}

fn lengths(count: usize, n_values: usize) -> String {
    format!("{count} value references, {n_values} values; all variables are scalars")
}

passed_on! {
    fmi3ExitInitializationMode() = exit_initialization;
    fmi3Terminate() = terminate;
    fmi3Reset() = reset;
    fmi3GetFMUState(to: *mut *mut c_void) = get_state;
    fmi3SetFMUState(state: *mut c_void) = set_state;
    fmi3FreeFMUState(state: *mut *mut c_void) = free_state;
    fmi3SerializedFMUStateSize(state: *mut c_void, size: *mut usize) = state_size;
    fmi3SerializeFMUState(state: *mut c_void, to: *mut u8, size: usize) = write_state;
    fmi3DeserializeFMUState(from: *const u8, size: usize, to: *mut *mut c_void) = read_state;
}

/// `fmi3DoStep`. A step ends early where an event stops the run.
///
/// # Safety
/// See [`fmi3InstantiateModelExchange`].
#[no_mangle]
#[allow(clippy::too_many_arguments)] // those of the standard
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    at: f64,
    duration: f64,
    _no_return: bool,
    needs_event: *mut bool,
    end: *mut bool,
    early: *mut bool,
    reached: *mut f64,
) -> c_int {
    // SAFETY: see above
    unsafe {
        let Some(component) = behind(instance) else { return Status::Error as c_int };
        let (status, stopped) = component.step(at, duration);
        write(needs_event, false);
        write(end, stopped);
        write(early, stopped);
        if let Ok(t) = component.instance.t() {
            write(reached, t);
        }
        status as c_int
    }
}
