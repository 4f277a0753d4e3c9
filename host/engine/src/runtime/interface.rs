//! Whether a compiled component exports `controller` with the types of the WIT.
//!
//! The generated bindings look at the names of an exported interface's functions
//! when they link and at their types only in an instance; a robot with other
//! types would be admitted and fail in every match.

use wasmouse_core::guest_text;
use wasmtime::component::Component;
use wasmtime::component::types::{ComponentFunc, ComponentInstance, ComponentItem};

use super::bindings::types::{Action, Briefing, Sensors};
use crate::admission::{CONTROLLER, Rejection};

/// Checks the types of `start` and `next-move`.
///
/// # Errors
///
/// [`Rejection::WrongType`] with the export that differs.
pub(crate) fn check_types(component: &Component) -> Result<(), Rejection> {
    let component_type = component.component_type();
    // As the bindings look it up: another patch version is found as well.
    let item = component.get_export(None, CONTROLLER);
    let Some((ComponentItem::ComponentInstance(controller), _)) = item else {
        return Err(Rejection::WrongType(guest_text!(
            "`{}` is not an interface",
            CONTROLLER
        )));
    };
    let types = component_type.instance_type();
    let function = |name| function(component, &controller, name);
    function("start")?
        .typecheck::<(Briefing,), ()>(&types)
        .map_err(|error| wrong_type("start", &error))?;
    function("next-move")?
        .typecheck::<(Sensors,), (Action,)>(&types)
        .map_err(|error| wrong_type("next-move", &error))
}

fn function(
    component: &Component,
    controller: &ComponentInstance,
    name: &str,
) -> Result<ComponentFunc, Rejection> {
    match controller.get_export(component.engine(), name) {
        Some(export) => match export.ty {
            ComponentItem::ComponentFunc(function) => Ok(function),
            _ => Err(Rejection::WrongType(guest_text!(
                "`{}` is not a function",
                name
            ))),
        },
        None => Err(Rejection::WrongType(guest_text!(
            "`{}` has no function `{}`",
            CONTROLLER,
            name
        ))),
    }
}

fn wrong_type(name: &str, error: &wasmtime::Error) -> Rejection {
    Rejection::WrongType(guest_text!(
        "the function `{}` has the wrong type: {}",
        name,
        format!("{error:#}")
    ))
}
