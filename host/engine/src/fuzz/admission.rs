//! Any bytes as a robot file, up to where it would be compiled.

use wasmparser::Validator;

use crate::admission::{BinaryKind, JOURNAL_IMPORT, Rejection, examine, world};
use crate::limits::Limits;

/// Examines the bytes. What is admitted is valid WebAssembly, and admitted again as it is.
pub fn admission(bytes: &[u8]) -> bool {
    let limits = Limits::default();
    let examined = examine(bytes, &limits);
    let component = match examined.component {
        Ok(component) => component,
        Err(rejection) => {
            assert!(!rejection.reason().is_empty());
            let not_wasm = matches!(rejection, Rejection::Empty | Rejection::NotWasm(_));
            assert_eq!(not_wasm, examined.kind.is_none(), "{rejection:?}");
            return false;
        }
    };
    let validated = Validator::new().validate_all(&component);
    if let Err(error) = validated {
        panic!("admitted although it is invalid: {error}");
    }
    let again = examine(&component, &limits);
    assert_eq!(again.kind, Some(BinaryKind::Component));
    assert_eq!(again.shape, examined.shape);
    assert!(again.component.is_ok_and(|again| again == component));
    // Robots are described to people; nothing they contain may harm that.
    drop(world(&component));
    true
}

/// A robot in text, with names, folded and plain instructions, and comments.
#[cfg(test)]
const TEXT: &str = r#";; a robot
(module $robot (; that drives on ;)
  (import "journal" "paint" (func $paint (param i32 i32 i32)))
  (memory (export "memory") 1)
  (data (i32.const 16) "\00\01\01")
  (global $n (mut i32) (i32.const 0))
  (func (export "start") (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))
  (func (export "next_move") (param $left i32) (param i32 i32) (result i32)
    (block $out
      (br_if $out (local.get $left))
      (call $paint (i32.const 0) (global.get $n) (i32.const 1)))
    global.get $n
    i32.const 1
    i32.add
    global.set $n
    i32.const 16))
"#;

#[cfg(test)]
pub(super) fn seeds() -> Vec<Vec<u8>> {
    use crate::bundled::bundled;

    let module = super::modules::parse_robot("", "");
    let logging = super::modules::parse_robot(
        &format!(r#"(import "{JOURNAL_IMPORT}" "log" (func $log (param i32 i32 i32)))"#),
        "(call $log (i32.const 1) (i32.const 16) (i32.const 3))",
    );
    let component = |module: &[u8]| crate::admission::componentize(module).expect("a robot");
    let text = TEXT.as_bytes().to_vec();
    let mut seeds = vec![
        component(&module),
        component(&logging),
        module,
        logging,
        text,
    ];
    let smallest = bundled().iter().min_by_key(|robot| robot.component.len());
    seeds.extend(smallest.map(|robot| robot.component.to_vec()));
    seeds
}
