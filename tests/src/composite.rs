//! [`Composite`]: robots as components written out in full, for what a core module
//! alone cannot express: more modules, inner components, canonical options.

use crate::module::{Module, versioned, wasm};

/// A component around a robot's module, in text. Its memory is `$memory`, the
/// export of that name of the core instance `$libc`, and the module imports it with [`Composite::MEMORY`].
#[derive(Clone, Copy, Debug)]
pub struct Composite<'a> {
    /// The module of the robot.
    pub robot: Module<'a>,
    /// Fields before it: modules, instances, inner components.
    pub before: &'a str,
    /// What it imports besides its memory and `log`, as `(with ...)`.
    pub with: &'a str,
    /// Options of the lowered function `log`.
    pub log_options: &'a str,
    /// Options of the lifted function `next-move`, besides its memory.
    pub next_options: &'a str,
    /// Fields after it, before the exports.
    pub after: &'a str,
    /// The memory of the instance `$libc`.
    pub memory: &'a str,
}

impl Composite<'_> {
    /// The memory of the robot's module.
    pub const MEMORY: &'static str = r#"(import "env" "memory" (memory 0))"#;
}

impl Default for Composite<'_> {
    fn default() -> Self {
        Self {
            robot: Module {
                memory: Composite::MEMORY,
                ..Module::default()
            },
            before: "",
            with: "",
            log_options: "",
            next_options: "",
            after: "",
            memory: r#"(memory (export "memory") 1)"#,
        }
    }
}

/// The interface `types` as a component imports it, with names for its types.
pub const TYPES: &str = r#"
    (import "wasmouse:robot/types@VERSION" (instance $types
        (type $cell (record (field "x" u32) (field "y" u32)))
        (export "cell" (type $the-cell (eq $cell)))
        (type $area (record
            (field "origin" $the-cell) (field "width" u32) (field "height" u32)))
        (export "area" (type $the-area (eq $area)))
        (type $scope (enum "both-runs" "each-run"))
        (export "budget-scope" (type $the-scope (eq $scope)))
        (type $briefing (record
            (field "dimension" u32) (field "start" $the-cell) (field "goal" $the-area)
            (field "budget" u32) (field "budget-scope" $the-scope)
            (field "longest-move" u32) (field "units-per-cell" u32)
            (field "exploration-divisor" u32) (field "seed" u64) (field "variant" u32)))
        (export "briefing" (type (eq $briefing)))
        (type $sensors (record (field "left" u32) (field "front" u32) (field "right" u32)))
        (export "sensors" (type (eq $sensors)))
        (type $turn (enum "left" "straight" "right"))
        (export "turn" (type $the-turn (eq $turn)))
        (type $move (record (field "turn" $the-turn) (field "advance" s8)))
        (export "move" (type $the-move (eq $move)))
        (type $action (variant (case "move" $the-move) (case "reset")))
        (export "action" (type (eq $action)))))
    (alias export $types "briefing" (type $briefing))
    (alias export $types "sensors" (type $sensors))
    (alias export $types "action" (type $action))"#;

/// The function `log` of the journal as a component imports it.
pub const JOURNAL: &str = r#"
    (import "wasmouse:robot/journal@VERSION" (instance $journal
        (type $level (enum "debug" "info" "warning" "error"))
        (export "level" (type $the-level (eq $level)))
        (export "log" (func (param "level" $the-level) (param "message" string)))))"#;

impl Composite<'_> {
    /// The component as text.
    pub fn wat(&self) -> String {
        let Self {
            robot,
            before,
            with,
            log_options,
            next_options,
            after,
            memory,
        } = self;
        let robot = robot.wat().replacen("(module", "(core module $robot", 1);
        versioned(&format!(
            r#"(component
                {TYPES}
                {JOURNAL}
                (core module $libc {memory})
                (core instance $libc (instantiate $libc))
                (alias core export $libc "memory" (core memory $memory))
                (core func $log (canon lower (func $journal "log")
                    (memory $memory) {log_options}))
                (core instance $lowered (export "log" (func $log)))
                {before}
                {robot}
                (core instance $robot (instantiate $robot
                    (with "env" (instance $libc))
                    (with "wasmouse:robot/journal@VERSION" (instance $lowered))
                    {with}))
                (func $start (param "briefing" $briefing)
                    (canon lift (core func $robot "wasmouse:robot/controller@VERSION#start")))
                (func $next-move (param "sensors" $sensors) (result $action)
                    (canon lift (core func $robot "wasmouse:robot/controller@VERSION#next-move")
                        (memory $memory) {next_options}))
                {after}
                (instance $controller
                    (export "start" (func $start))
                    (export "next-move" (func $next-move)))
                (export "wasmouse:robot/controller@VERSION" (instance $controller)))"#
        ))
    }

    /// The robot as one of two components inside another, beside one in text that has
    /// the name `$callee` and exports the function `take`; the robot imports that.
    /// (A component cannot call those that are inside itself.)
    ///
    /// # Panics
    ///
    /// When the text is no component.
    #[track_caller]
    pub fn beside(&self, callee: &str) -> Vec<u8> {
        let robot = self.wat().replacen("(component", "(component $robot", 1);
        wasm(&format!(
            r#"(component
                {TYPES}
                {JOURNAL}
                (alias export $journal "level" (type $level))
                (alias export $journal "log" (func $log))
                {callee}
                (instance $callee (instantiate $callee
                    (with "level" (type $level))
                    (with "log" (func $log))))
                {robot}
                (instance $robot (instantiate $robot
                    (with "wasmouse:robot/types@VERSION" (instance $types))
                    (with "wasmouse:robot/journal@VERSION" (instance $journal))
                    (with "take" (func $callee "take"))))
                (alias export $robot "wasmouse:robot/controller@VERSION" (instance $controller))
                (export "wasmouse:robot/controller@VERSION" (instance $controller)))"#
        ))
    }

    /// The component in binary form.
    ///
    /// # Panics
    ///
    /// When the text is no component.
    #[track_caller]
    pub fn component(&self) -> Vec<u8> {
        wasm(&self.wat())
    }
}
