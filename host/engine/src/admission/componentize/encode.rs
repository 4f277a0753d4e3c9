//! Makes a component of a module that has the names of a robot.

use std::fmt::Display;

use wit_component::{ComponentEncoder, StringEncoding, embed_component_metadata};
use wit_parser::{PackageId, Resolve, WorldId};

use super::error::ComponentizeError;

/// The text of the WIT package `wasmouse:robot`, the contract every robot keeps.
pub const ROBOT_WIT: &str = include_str!("../../../../../wit/robot.wit");

/// The robot world, parsed from [`ROBOT_WIT`], in the compatible version that ends in
/// `patch`: a component has the names that its module has.
pub(super) fn robot_world(patch: u64) -> (Resolve, WorldId) {
    let (resolve, package) = robot_package(patch);
    let world = resolve
        .select_world(&[package], Some("robot"))
        .expect("the embedded WIT has the world `robot`; a test holds it");
    (resolve, world)
}

/// The package of [`ROBOT_WIT`] in that version.
pub(super) fn robot_package(patch: u64) -> (Resolve, PackageId) {
    let mut resolve = Resolve::default();
    let package = resolve
        .push_str("robot.wit", ROBOT_WIT)
        .expect("the embedded WIT parses; a test holds it");
    let mut name = resolve.packages[package].name.clone();
    resolve.package_names.swap_remove(&name);
    name.version
        .as_mut()
        .expect("the embedded WIT has a version; a test holds it")
        .patch = patch;
    resolve.packages[package].name = name.clone();
    resolve.package_names.insert(name, package);
    (resolve, package)
}

/// The component around a module with types.
pub(super) fn encode(typed_module: &[u8]) -> Result<Vec<u8>, ComponentizeError> {
    let mut encoder = ComponentEncoder::default();
    encoder
        .validate(true)
        .module(typed_module)
        .and_then(|encoder| encoder.encode())
        .map_err(mismatch)
}

/// The encoder rejects a module.
pub(super) fn mismatch(error: impl Display) -> ComponentizeError {
    ComponentizeError::Mismatch {
        // `:#` joins the causes; the innermost one names the function. It
        // may quote the guest, so it must not reach a terminal raw.
        message: format!("{error:#}").replace(char::is_control, " "),
    }
}

/// The module with the types of the world `robot`, which says that it encodes strings so.
pub(super) fn with_robot_types(
    mut untyped: Vec<u8>,
    strings: Option<StringEncoding>,
    patch: u64,
) -> Vec<u8> {
    let (resolve, world) = robot_world(patch);
    embed_component_metadata(
        &mut untyped,
        &resolve,
        world,
        strings.unwrap_or_default(),
        false,
    )
    .expect("the embedded WIT encodes; a test holds it");
    untyped
}
