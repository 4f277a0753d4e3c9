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
            assert!(!rejection.to_string().is_empty());
            let not_wasm = matches!(rejection, Rejection::Empty | Rejection::NotWasm(_));
            assert_eq!(not_wasm, examined.kind.is_none(), "{rejection}");
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

#[cfg(test)]
pub(super) fn seeds() -> Vec<Vec<u8>> {
    use crate::bundled::bundled;

    let module = super::modules::parse_robot("", "");
    let logging = super::modules::parse_robot(
        &format!(r#"(import "{JOURNAL_IMPORT}" "log" (func $log (param i32 i32 i32)))"#),
        "(call $log (i32.const 1) (i32.const 16) (i32.const 3))",
    );
    let component = |module: &[u8]| crate::admission::componentize(module).expect("a robot");
    let mut seeds = vec![component(&module), component(&logging), module, logging];
    let smallest = bundled().iter().min_by_key(|robot| robot.component.len());
    seeds.extend(smallest.map(|robot| robot.component.to_vec()));
    seeds
}
