//! [`engine_hint`]: who can verify what another engine has recorded.

use wasmouse_core::record::EngineId;

use super::escape::for_terminal;

/// What differs between two engines, and which program verifies what the first has recorded.
///
/// Fuel differs between versions of wasmtime and its configuration, and the depth of recursion
/// at which the stack overflows differs between the processors that code is made for.
pub fn engine_hint(recorded: &EngineId, found: &EngineId) -> String {
    let (Some(recorded), Some(found)) = (Engine::parse(recorded), Engine::parse(found)) else {
        return "verify it with the version of wasmouse that recorded it".to_owned();
    };
    let mut parts = Vec::new();
    if recorded.wasmtime != found.wasmtime {
        parts.push(format!("wasmtime {}", recorded.wasmtime));
    }
    if recorded.revision != found.revision {
        parts.push(format!("configuration {}", recorded.revision));
    }
    let program = match parts.is_empty() {
        true => "this version of wasmouse",
        false => "the version of wasmouse that recorded it",
    };
    let machine = match recorded.target {
        Some(target) if recorded.target != found.target => {
            parts.push(format!("processor {target}"));
            format!(", on a machine with a processor of type {target}")
        }
        _ => String::new(),
    };
    let parts = parts.join(", ");
    let hint = format!("its engine differs in: {parts}; verify it with {program}{machine}");
    for_terminal(&hint)
}

/// The parts of an engine id, such as `wasmtime-48.0.8+wasmouse.5.x86-64-v2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Engine<'a> {
    wasmtime: &'a str,
    revision: &'a str,
    /// Until revision 4, it was the processor of the machine, which was not recorded.
    target: Option<&'a str>,
}

impl<'a> Engine<'a> {
    fn parse(id: &'a EngineId) -> Option<Self> {
        let (wasmtime, rest) = id
            .as_str()
            .strip_prefix("wasmtime-")?
            .split_once("+wasmouse.")?;
        let (revision, target) = match rest.split_once('.') {
            Some((revision, target)) => (revision, Some(target)),
            None => (rest, None),
        };
        Some(Self {
            wasmtime,
            revision,
            target,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_part_of_the_engine_that_differs_is_named() {
        let hint = |recorded: &str| {
            let found = EngineId::new("wasmtime-48.0.8+wasmouse.5.x86-64-v2");
            engine_hint(&EngineId::new(recorded), &found)
        };
        assert_eq!(
            hint("wasmtime-48.0.8+wasmouse.5.armv8-a"),
            "its engine differs in: processor armv8-a; verify it with this version of wasmouse, \
             on a machine with a processor of type armv8-a"
        );
        assert_eq!(
            hint("wasmtime-48.0.8+wasmouse.4"),
            "its engine differs in: configuration 4; verify it with the version of wasmouse that \
             recorded it"
        );
        assert_eq!(
            hint("wasmtime-47.0.0+wasmouse.3.armv8-a"),
            "its engine differs in: wasmtime 47.0.0, configuration 3, processor armv8-a; verify \
             it with the version of wasmouse that recorded it, on a machine with a processor of \
             type armv8-a"
        );
        assert_eq!(
            hint("wasmtime-48.0.8+wasmouse.5.\u{1b}[31m"),
            "its engine differs in: processor \\u{1b}[31m; verify it with this version of \
             wasmouse, on a machine with a processor of type \\u{1b}[31m"
        );
        assert_eq!(
            hint("another"),
            "verify it with the version of wasmouse that recorded it"
        );
    }
}
