//! An instance with its log. Errors and panics become a status, and their message goes to the host.

use crate::instance::Instance;
use std::any::Any;
use std::cell::RefCell;
use std::panic::{catch_unwind, set_hook, AssertUnwindSafe};
use std::sync::Once;

/// The status that a function returns; the numbers are those of both standards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Status {
    Ok = 0,
    Warning = 1,
    Discard = 2,
    Error = 3,
}

impl Status {
    /// The category of messages with this status.
    pub fn category(self) -> &'static str {
        match self {
            Self::Ok => "logAll",
            Self::Warning => "logStatusWarning",
            Self::Discard => "logStatusDiscard",
            Self::Error => "logStatusError",
        }
    }
}

/// Takes a status and a message.
pub type Log = Box<dyn Fn(Status, &str)>;

/// What the host holds.
pub struct Component {
    pub instance: Instance,
    pub log: Log,
    /// Whether a panic has left the instance in an unknown state.
    broken: bool,
}

thread_local! {
    /// The place of the last panic.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Keeps the place of a panic in place of printing it. The hook belongs to this library, not to the host.
fn keep_places() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        set_hook(Box::new(|info| {
            let place = info.location().map_or(String::new(), ToString::to_string);
            PLACE.with(|known| *known.borrow_mut() = place);
        }));
    });
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(ToString::to_string);
    let text = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    PLACE.with(|place| format!("internal error of kempe: {text} ({})", place.borrow()))
}

/// The result of a function; a panic is an error with its message.
pub fn caught<T>(body: impl FnOnce() -> Result<T, String>) -> (Result<T, String>, bool) {
    keep_places();
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(outcome) => (outcome, false),
        Err(payload) => (Err(message(payload.as_ref())), true),
    }
}

impl Component {
    /// An instance with a log.
    pub fn new(instance: Instance, log: Log) -> Self {
        Self { instance, log, broken: false }
    }

    /// Carries out a function on the instance.
    pub fn call(&mut self, body: impl FnOnce(&mut Self) -> Result<Status, String>) -> Status {
        if self.broken {
            (self.log)(Status::Error, "an internal error has ended this instance; reset it");
            return Status::Error;
        }
        let (outcome, panicked) = caught(|| body(self));
        self.broken = panicked;
        outcome.unwrap_or_else(|message| {
            (self.log)(Status::Error, &message);
            Status::Error
        })
    }

    /// Returns to the state after the creation.
    pub fn reset(&mut self) -> Status {
        self.broken = false;
        self.call(|own| {
            own.instance.reset();
            Ok(Status::Ok)
        })
    }

    /// Advances. Returns the status, and whether an event has stopped the run.
    pub fn step(&mut self, at: f64, duration: f64) -> (Status, bool) {
        let mut stopped = false;
        let status = self.call(|own| {
            let found = own.instance.step(at, duration)?;
            stopped = found.stopped_by.is_some();
            if let Some(event) = found.stopped_by {
                let t = own.instance.t()?;
                (own.log)(Status::Ok, &format!("the event {event} stopped the run at {t} s"));
            }
            for doubt in &found.doubts {
                (own.log)(Status::Warning, doubt);
            }
            Ok(if found.doubts.is_empty() { Status::Ok } else { Status::Warning })
        });
        (status, stopped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exported::{Exported, Interface};
    use std::rc::Rc;

    fn component() -> (Component, Rc<RefCell<Vec<String>>>) {
        let text = "kempe = 1\n[bodies.ball]\nmass = 1\ninertia = 1\n[analyses.fall]\ntype = \"dynamics\"\nt_end = 1\n";
        let case = kempe::case::read(text, kempe::case::Format::Toml).expect("a case").0;
        let (token, analysis) = ("k".to_string(), "fall".to_string());
        let interface = Interface { token, analysis, outputs: Vec::new(), parameters: Vec::new() };
        let instance = Instance::of(Exported::new(interface, case).expect("it builds"));
        let told = Rc::new(RefCell::new(Vec::new()));
        let own = Rc::clone(&told);
        let log = move |_, text: &str| own.borrow_mut().push(text.to_string());
        (Component::new(instance, Box::new(log)), told)
    }

    #[test]
    fn a_panic_is_an_error_until_a_reset() {
        let (mut component, told) = component();
        let status = component.call(|_| panic!("the sky falls"));
        assert_eq!(status, Status::Error);
        let line = line!() - 2;
        let wanted = format!("component.rs:{line}:");
        assert!(told.borrow()[0].contains("the sky falls"), "{:?}", told.borrow());
        assert!(told.borrow()[0].contains(&wanted), "{:?}", told.borrow());
        assert_eq!(component.step(0.0, 0.1), (Status::Error, false));
        assert_eq!(component.reset(), Status::Ok);
        assert_eq!(component.call(|own| own.instance.t().map(|_| Status::Ok)), Status::Ok);
    }

    #[test]
    fn the_order_of_calls_is_checked() {
        let (mut component, told) = component();
        assert_eq!(component.step(0.0, 0.1), (Status::Error, false));
        assert!(told.borrow()[0].contains("a step is not allowed in the state Instantiated"));
        component.call(|own| own.instance.enter_initialization().map(|()| Status::Ok));
        component.call(|own| own.instance.exit_initialization().map(|()| Status::Ok));
        assert_eq!(component.step(0.0, 0.1), (Status::Ok, false));
        assert_eq!(component.step(0.5, 0.1), (Status::Error, false));
        assert!(told.borrow()[1].contains("the instance is at 0.1 s"), "{:?}", told.borrow());
        assert_eq!(component.step(0.1, -0.1), (Status::Error, false));
    }
}
