//! The instruction sets of this module and of the processor.
//!
//! A wheel contains this module twice, for every x86-64 processor and for x86-64-v3 (AVX2, FMA and related
//! instructions). Python loads the first module, and the second if the processor supports its instructions.

use pyo3::prelude::*;

use crate::guard::guard;

/// The instruction set for which this module was compiled: `x86-64-v3`, or the name of the architecture.
#[pyfunction]
pub fn instructions() -> PyResult<&'static str> {
    guard("instructions", || Ok(compiled_for()))
}

/// Whether the processor and the operating system support x86-64-v3.
#[pyfunction]
pub fn supports_v3() -> PyResult<bool> {
    guard("supports_v3", || Ok(found_v3()))
}

fn compiled_for() -> &'static str {
    match cfg!(all(target_arch = "x86_64", target_feature = "avx2", target_feature = "fma")) {
        true => "x86-64-v3",
        false => match std::env::consts::ARCH {
            "x86_64" => "x86-64",
            other => other,
        },
    }
}

/// The features that LLVM adds to x86-64-v2 for x86-64-v3. All processors with AVX2 support x86-64-v2.
#[cfg(target_arch = "x86_64")]
fn found_v3() -> bool {
    use std::is_x86_feature_detected as has;
    let vectors = has!("avx") && has!("avx2") && has!("fma") && has!("f16c") && has!("xsave");
    vectors && has!("bmi1") && has!("bmi2") && has!("lzcnt") && has!("movbe")
}

#[cfg(not(target_arch = "x86_64"))]
fn found_v3() -> bool {
    false
}
