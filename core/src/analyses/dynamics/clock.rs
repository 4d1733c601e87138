//! The clock of a run, which the caller may replace: `std::time::Instant` panics in WebAssembly.

/// Seconds since a fixed time.
pub type Clock = fn() -> f64;

/// The clock of the system; always zero on a platform without one, such as WebAssembly.
pub fn system_clock() -> f64 {
    #[cfg(not(target_family = "wasm"))]
    {
        use std::sync::LazyLock;
        use std::time::Instant;
        static START: LazyLock<Instant> = LazyLock::new(Instant::now);
        START.elapsed().as_secs_f64()
    }
    #[cfg(target_family = "wasm")]
    0.0
}
