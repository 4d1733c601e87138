//! What lies behind the pointers of the host: components, arrays, texts and states.
//!
//! The host must pass pointers as the standards prescribe. Null pointers are errors where a value is needed.
#![allow(unsafe_code)]

use crate::component::{caught, Component, Log, Status};
use crate::instance::Instance;
use crate::location::folder;
use crate::processor;
use crate::snapshot::Snapshot;
use std::ffi::{c_char, c_int, c_void, CStr};

/// Exports functions of this file under their names in a standard.
macro_rules! passed_on {
    ($($name:ident($($argument:ident: $type:ty),*) = $function:ident;)+) => {
        $(
            #[doc = concat!("`", stringify!($name), "`.")]
            ///
            /// # Safety
            /// The pointers are those of the standard.
            #[no_mangle]
            pub unsafe extern "C" fn $name(
                component: *mut std::ffi::c_void,
                $($argument: $type),*
            ) -> std::ffi::c_int {
                // SAFETY: see above
                unsafe { $crate::pointers::$function(component, $($argument),*) }
            }
        )+
    };
}
pub(crate) use passed_on;

/// Carries out a function on the component behind a pointer.
///
/// # Safety
/// `component` is null or from [`give`], and no other thread uses it.
pub unsafe fn with(
    component: *mut c_void,
    body: impl FnOnce(&mut Component) -> Result<Status, String>,
) -> c_int {
    // SAFETY: see above
    match unsafe { component.cast::<Component>().as_mut() } {
        Some(component) => component.call(body) as c_int,
        None => Status::Error as c_int,
    }
}

/// The component behind a pointer.
///
/// # Safety
/// As for [`with`].
pub unsafe fn behind<'a>(component: *mut c_void) -> Option<&'a mut Component> {
    // SAFETY: see above
    unsafe { component.cast::<Component>().as_mut() }
}

/// A new component for the host, or null after a message.
///
/// # Safety
/// As for [`text`].
pub unsafe fn instantiated(
    token: *const c_char,
    resources: *const c_char,
    refusal: Option<&str>,
    log: Log,
) -> *mut c_void {
    let (made, _) = caught(|| {
        processor::check()?;
        if let Some(refusal) = refusal {
            return Err(refusal.to_string());
        }
        // SAFETY: see above
        unsafe { Instance::new(text(token)?, &folder(text(resources)?)?) }
    });
    match made {
        Ok(instance) => give(Component::new(instance, log)),
        Err(message) => {
            log(Status::Error, &message);
            std::ptr::null_mut()
        }
    }
}

/// Gives a component to the host.
fn give(component: Component) -> *mut c_void {
    Box::into_raw(Box::new(component)).cast()
}

/// Takes a component back.
///
/// # Safety
/// `component` is null or from [`give`], and the host does not use it again.
pub unsafe fn free(component: *mut c_void) {
    if !component.is_null() {
        // SAFETY: see above
        drop(unsafe { Box::from_raw(component.cast::<Component>()) });
    }
}

/// A text of the host; empty for null.
///
/// # Safety
/// `text` is null, or ends with a zero and remains during the call.
pub unsafe fn text<'a>(text: *const c_char) -> Result<&'a str, String> {
    if text.is_null() {
        return Ok("");
    }
    // SAFETY: see above
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|_| "a text is not UTF-8".to_string())
}

/// An array of the host.
///
/// # Safety
/// `first` is null, or the array has `count` values and remains during the call.
unsafe fn array<'a, T>(first: *const T, count: usize) -> Result<&'a [T], String> {
    match (first.is_null(), count) {
        (_, 0) => Ok(&[]),
        (true, _) => Err("an array is null".to_string()),
        // SAFETY: see above
        (false, _) => Ok(unsafe { std::slice::from_raw_parts(first, count) }),
    }
}

/// Writes a value for the host, unless the pointer is null.
///
/// # Safety
/// `to` is null or valid.
pub unsafe fn write<T>(to: *mut T, value: T) {
    if !to.is_null() {
        // SAFETY: see above
        unsafe { to.write(value) };
    }
}

/// Enters the initialization.
///
/// # Safety
/// As for [`with`].
pub unsafe fn enter_initialization(component: *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |own| own.instance.enter_initialization().map(|()| Status::Ok)) }
}

/// Ends the initialization.
///
/// # Safety
/// As for [`with`].
pub unsafe fn exit_initialization(component: *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |own| own.instance.exit_initialization().map(|()| Status::Ok)) }
}

/// Ends the run.
///
/// # Safety
/// As for [`with`].
pub unsafe fn terminate(component: *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |own| own.instance.terminate().map(|()| Status::Ok)) }
}

/// Returns to the state after the instantiation.
///
/// # Safety
/// As for [`with`].
pub unsafe fn reset(component: *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { behind(component) }.map_or(Status::Error, Component::reset) as c_int
}

/// Reads variables.
///
/// # Safety
/// The arrays have `count` values.
pub unsafe fn get(
    component: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
) -> c_int {
    // SAFETY: see above
    let body = |own: &mut Component| unsafe {
        let references = array(references, count)?;
        array(values, count)?;
        for (k, reference) in references.iter().enumerate() {
            values.add(k).write(own.instance.get(*reference)?);
        }
        Ok(Status::Ok)
    };
    // SAFETY: see above
    unsafe { with(component, body) }
}

/// Sets variables.
///
/// # Safety
/// The arrays have `count` values.
pub unsafe fn set(
    component: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> c_int {
    // SAFETY: see above
    let body = |own: &mut Component| unsafe {
        let (references, values) = (array(references, count)?, array(values, count)?);
        for (reference, value) in references.iter().zip(values) {
            own.instance.set(*reference, *value)?;
        }
        Ok(Status::Ok)
    };
    // SAFETY: see above
    unsafe { with(component, body) }
}

/// The state behind a pointer.
///
/// # Safety
/// `state` is null, or from this library and not freed.
unsafe fn snapshot<'a>(state: *mut c_void) -> Result<&'a Snapshot, String> {
    // SAFETY: see above
    unsafe { state.cast::<Snapshot>().as_ref() }.ok_or_else(|| "the state is null".to_string())
}

/// Puts a state at a place of the host. A state that is there already is replaced.
///
/// # Safety
/// `to` is valid, and its state is null or from this library.
unsafe fn put_state(to: *mut *mut c_void, state: Snapshot) -> Result<Status, String> {
    if to.is_null() {
        return Err("the place of the state is null".to_string());
    }
    // SAFETY: see above
    match unsafe { (*to).cast::<Snapshot>().as_mut() } {
        Some(old) => *old = state,
        // SAFETY: see above
        None => unsafe { to.write(Box::into_raw(Box::new(state)).cast()) },
    }
    Ok(Status::Ok)
}

/// Gives the present state to the host.
///
/// # Safety
/// As for [`put_state`].
pub unsafe fn get_state(component: *mut c_void, to: *mut *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |own| put_state(to, own.instance.snapshot())) }
}

/// Continues from a state.
///
/// # Safety
/// As for [`snapshot`].
pub unsafe fn set_state(component: *mut c_void, state: *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |own| own.instance.restore(snapshot(state)?).map(|()| Status::Ok)) }
}

/// Frees a state, and makes its pointer null.
///
/// # Safety
/// As for [`put_state`].
pub unsafe fn free_state(component: *mut c_void, state: *mut *mut c_void) -> c_int {
    // SAFETY: see above
    unsafe {
        with(component, |_| {
            if !state.is_null() && !(*state).is_null() {
                drop(Box::from_raw((*state).cast::<Snapshot>()));
                state.write(std::ptr::null_mut());
            }
            Ok(Status::Ok)
        })
    }
}

/// The number of bytes of a state.
///
/// # Safety
/// As for [`snapshot`].
pub unsafe fn state_size(component: *mut c_void, state: *mut c_void, size: *mut usize) -> c_int {
    // SAFETY: see above
    unsafe {
        with(component, |_| {
            write(size, snapshot(state)?.bytes()?.len());
            Ok(Status::Ok)
        })
    }
}

/// Writes a state as bytes.
///
/// # Safety
/// As for [`snapshot`]; `to` has room for `size` bytes.
pub unsafe fn write_state(
    component: *mut c_void,
    state: *mut c_void,
    to: *mut u8,
    size: usize,
) -> c_int {
    // SAFETY: see above
    unsafe {
        with(component, |_| {
            let bytes = snapshot(state)?.bytes()?;
            if to.is_null() || bytes.len() > size {
                return Err(format!("the state has {} bytes, the array {size}", bytes.len()));
            }
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), to, bytes.len());
            Ok(Status::Ok)
        })
    }
}

/// Reads a state from bytes.
///
/// # Safety
/// As for [`put_state`]; `from` has `size` bytes.
pub unsafe fn read_state(
    component: *mut c_void,
    from: *const u8,
    size: usize,
    to: *mut *mut c_void,
) -> c_int {
    // SAFETY: see above
    unsafe { with(component, |_| put_state(to, Snapshot::read(array(from, size)?)?)) }
}
