//! Artefacts: compiled code as a compile worker makes it and the cache keeps it, followed by what
//! can only be known from the component: its [`startup_fuel`], in 8 bytes.

use wasmtime::Engine;
use wasmtime::component::Component;

use super::startup::startup_fuel;

/// Compiles a component to an artefact, without loading it.
///
/// # Errors
///
/// When the component is not valid.
pub(crate) fn precompile(engine: &Engine, component: &[u8]) -> wasmtime::Result<Vec<u8>> {
    let code = engine.precompile_component(component)?;
    Ok(seal(code, startup_fuel(component)))
}

/// The artefact of that code.
pub(super) fn seal(mut code: Vec<u8>, startup_fuel: u64) -> Vec<u8> {
    code.extend(startup_fuel.to_le_bytes());
    code
}

/// The component of an artefact, and what its start costs.
///
/// # Errors
///
/// When it is damaged, or from another version of wasmtime.
///
/// # Safety
///
/// It must be what [`precompile`] or [`seal`] made in this build: wasmtime trusts it.
pub(super) unsafe fn load(engine: &Engine, artefact: &[u8]) -> wasmtime::Result<(Component, u64)> {
    let (code, fuel) = artefact
        .split_last_chunk()
        .ok_or_else(|| wasmtime::Error::msg("compiled code is cut off"))?;
    // SAFETY: the caller's promise is the one that wasmtime asks for.
    let component = unsafe { Component::deserialize(engine, code) }?;
    Ok((component, u64::from_le_bytes(*fuel)))
}
