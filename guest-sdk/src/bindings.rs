//! The code that `wit-bindgen` generates from `wit/robot.wit`.
//!
//! Hidden: the crate root re-exports the types one by one, [`journal`](crate::journal)
//! wraps the imports, and [`export_robot!`](crate::export_robot) uses the export
//! macro. Nothing else should name this module.

wit_bindgen::generate!({
    world: "robot",
    path: "../wit",
    additional_derives: [PartialEq, Eq, Hash, PartialOrd, Ord],
    pub_export_macro: true,
    export_macro_name: "export",
    default_bindings_module: "wasmouse_sdk::bindings",
});
