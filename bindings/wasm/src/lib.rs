//! The kempe core for WebAssembly: text of a case in, numbers out.
//!
//! The page writes the text of a case in TOML at the address that [`text`] returns, calls [`run`] and
//! reads the results where [`times`] and [`coordinate`] say. A name, such as `rocker.angle`, is passed in
//! the same way as a case. [`message`] explains a failure. One run is kept at a time.
#![deny(unsafe_code)]

mod session;

use session::Session;
use std::cell::RefCell;

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
}

fn session<T>(f: impl FnOnce(&mut Session) -> T) -> T {
    SESSION.with(|session| f(&mut session.borrow_mut()))
}

/// Declares functions that JavaScript may call.
macro_rules! export {
    ($($(#[doc = $doc:literal])+ fn $name:ident($($argument:ident: $Type:ty),*) -> $Result:ty = $call:expr;)+) => {
        $(
            $(#[doc = $doc])+
            #[allow(unsafe_code)] // an exported name could collide with another; these do not
            #[no_mangle]
            pub extern "C" fn $name($($argument: $Type),*) -> $Result {
                let call: fn(&mut Session, $($Type),*) -> $Result = $call;
                session(|session| call(session, $($argument),*))
            }
        )+
    };
}

export! {
    /// Address of room for a text of so many bytes in UTF-8.
    fn text(length: usize) -> *mut u8 = Session::room;
    /// Assembles the case whose text was given and runs its first analysis; 0 if that went well.
    fn run() -> i32 = |session| session.report(Session::run);
    /// Number of reported states.
    fn states() -> usize = |session| session.times().len();
    /// Address of the reported times, s.
    fn times() -> *const f64 = |session| session.times().as_ptr();
    /// Selects the coordinate whose name was given, such as `rocker.angle`; 0 if the model has it.
    fn select() -> i32 = |session| session.report(Session::select);
    /// Address of the selected coordinate at the reported times, m or rad.
    fn coordinate() -> *const f64 = |session| session.selected().as_ptr();
    /// Address of the explanation of the last failure, in UTF-8.
    fn message() -> *const u8 = |session| session.message().as_ptr();
    /// Its number of bytes.
    fn message_length() -> usize = |session| session.message().len();
}
