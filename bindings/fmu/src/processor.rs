//! Whether this processor has the instructions for which the library was compiled.

/// An error if it lacks them. Without this check, the host would end at the first of them.
pub fn check() -> Result<(), String> {
    #[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
    if !(std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")) {
        return Err("this FMU needs a processor with AVX2 and FMA; export it from an \
                    installed wheel of kempe, whose FMUs need neither"
            .to_string());
    }
    Ok(())
}
