//! The kempe core for web pages: requests and replies are JSON texts. `README.md` lists them.
//!
//! The page writes a request at the address that [`request`] returns, calls [`call`], and reads the reply. Long lists
//! of numbers are in memory at [`numbers`]. There is one [`Session`]. Tests in Rust use it without WebAssembly.
#![deny(unsafe_code)]

mod cam;
mod catalogue;
mod columns;
mod convert;
mod dragged;
mod drawn;
mod editing;
mod exercise;
mod fault;
mod findings;
mod foreign;
mod instant;
mod live;
mod loaded;
mod mechanism;
mod modes;
mod named;
mod optimize;
mod pose;
mod readiness;
mod run;
mod session;
mod synthesis;
mod typed;

pub use session::Session;

use std::cell::RefCell;

thread_local! {
    static MODULE: RefCell<Module> = RefCell::default();
}

/// The session with the texts of the request and the reply.
#[derive(Default)]
struct Module {
    request: Vec<u8>,
    reply: String,
    session: Session,
}

impl Module {
    fn room(&mut self, length: usize) -> *mut u8 {
        self.request = vec![0; length];
        self.request.as_mut_ptr()
    }

    fn call(&mut self) {
        self.reply = match std::str::from_utf8(&self.request) {
            Ok(text) => self.session.call(text),
            Err(fault) => fault::Fault::new(format!("the request is not UTF-8: {fault}")).reply(),
        };
        self.request = Vec::new();
    }
}

fn module<T>(f: impl FnOnce(&mut Module) -> T) -> T {
    MODULE.with(|module| f(&mut module.borrow_mut()))
}

/// Declares functions that JavaScript may call.
macro_rules! export {
    ($($(#[doc = $doc:literal])+ fn $name:ident($($argument:ident: $Type:ty),*) -> $Result:ty = $call:expr;)+) => {
        $(
            $(#[doc = $doc])+
            #[allow(unsafe_code)] // an exported name could collide with another; these do not
            #[no_mangle]
            pub extern "C" fn $name($($argument: $Type),*) -> $Result {
                let call: fn(&mut Module, $($Type),*) -> $Result = $call;
                module(|module| call(module, $($argument),*))
            }
        )+
    };
}

export! {
    /// Address of memory for a request with this number of bytes in UTF-8.
    fn request(length: usize) -> *mut u8 = Module::room;
    /// Answers the request.
    fn call() -> () = Module::call;
    /// Address of the reply, in UTF-8.
    fn reply() -> *const u8 = |module| module.reply.as_ptr();
    /// Number of bytes of the reply.
    fn reply_length() -> usize = |module| module.reply.len();
    /// Address of the numbers of the last reply that contains numbers, in double precision.
    fn numbers() -> *const f64 = |module| module.session.numbers().as_ptr();
    /// Count of these numbers.
    fn numbers_length() -> usize = |module| module.session.numbers().len();
}
