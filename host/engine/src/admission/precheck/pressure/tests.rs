use super::*;

/// A load of that offset from the first local, added to the second.
fn add_loaded(pressure: &mut Pressure, offset: u8) {
    let [address, sum] = [0, 1].map(|local_index| Operator::LocalGet { local_index });
    pressure.operator(&address, &[0x20, 0], 0, (0, 1), 0);
    // Which load it is does not matter: the bytes tell.
    pressure.operator(&Operator::I32Eqz, &[0x28, 2, offset], 1, (1, 1), 2);
    pressure.operator(&sum, &[0x20, 1], 1, (0, 1), 0);
    pressure.operator(&Operator::I32Add, &[0x6a], 2, (2, 1), 1);
    pressure.operator(
        &Operator::LocalSet { local_index: 1 },
        &[0x21, 1],
        1,
        (1, 0),
        0,
    );
}

fn loaded(times: u8, calls: bool) -> Pressed {
    let mut pressure = Pressure::default();
    pressure.begin(Loads::Kept, 2, 2, |_| false);
    for _ in 0..times {
        for offset in 0..100 {
            add_loaded(&mut pressure, offset);
        }
        if calls {
            let call = Operator::Call { function_index: 0 };
            pressure.operator(&call, &[0x10, 0], 0, (0, 0), 8);
        }
    }
    pressure.finish(&mut [])
}

#[test]
fn what_is_loaded_again_stays_alive() {
    let once = loaded(1, false);
    assert!(once.alive < 5 * once.operators, "{once:?}");
    assert_eq!(once.pressed, 0);
    let again = loaded(4, false);
    assert!(again.alive > 70 * again.operators, "{again:?}");
    // The loads of the first time, and all additions but the first few.
    assert_eq!(again.made, 100 * 2 + 400);
    assert!(again.pressed > 550, "{again:?}");
    assert!(again.passed_by > 550, "{again:?}");
}

#[test]
fn calls_end_it() {
    let again = loaded(4, true);
    assert!(again.alive < 5 * again.operators, "{again:?}");
    assert_eq!(again.pressed, 0);
    assert!(again.passed_by <= 300, "{again:?}");
}

/// A sum of loads with stores between them, which something needs at the end or nothing does.
fn summed(needs: bool) -> Pressed {
    let mut pressure = Pressure::default();
    pressure.begin(Loads::Kept, 2, 2, |_| false);
    for _ in 0..4 {
        for offset in 0..100 {
            add_loaded(&mut pressure, offset);
        }
        let address = Operator::LocalGet { local_index: 0 };
        pressure.operator(&address, &[0x20, 0], 0, (0, 1), 0);
        pressure.operator(&address, &[0x20, 0], 1, (0, 1), 0);
        // Which store it is does not matter either.
        pressure.operator(&Operator::Nop, &[0x36, 2, 0], 2, (2, 0), 1);
    }
    let sum = Operator::LocalGet { local_index: 1 };
    pressure.operator(&sum, &[0x20, 1], 0, (0, 1), 0);
    if needs {
        let write = Operator::GlobalSet { global_index: 0 };
        pressure.operator(&write, &[0x24, 0], 1, (1, 0), 1);
    } else {
        pressure.operator(&Operator::Drop, &[0x1a], 1, (1, 0), 0);
    }
    pressure.finish(&mut [])
}

#[test]
fn what_is_summed_stays_alive_until_the_sum_is_needed() {
    let needed = summed(true);
    assert!(needed.alive > 180 * needed.operators, "{needed:?}");
    let dropped = summed(false);
    assert!(dropped.alive < 5 * dropped.operators, "{dropped:?}");
}

#[test]
fn what_was_loaded_before_a_branch_may_be_lost() {
    let alive = |loads| {
        let mut pressure = Pressure::default();
        pressure.begin(loads, 2, 2, |_| false);
        for _ in 0..4 {
            for offset in 0..100 {
                add_loaded(&mut pressure, offset);
            }
            let condition = Operator::LocalGet { local_index: 0 };
            pressure.operator(&condition, &[0x20, 0], 0, (0, 1), 0);
            let blockty = wasmparser::BlockType::Empty;
            pressure.operator(&Operator::If { blockty }, &[0x04, 0x40], 1, (1, 0), 1);
            pressure.operator(&Operator::End, &[0x0b], 0, (0, 0), 0);
        }
        pressure.finish(&mut []).made
    };
    // 100 loads once or four times, each with its address, and 400 additions.
    assert_eq!(alive(Loads::Kept), 100 * 2 + 400);
    assert_eq!(alive(Loads::Lost), 4 * 100 * 2 + 400);
}

#[test]
fn a_call_that_is_passed_by_ends_nothing() {
    let mut pressure = Pressure::default();
    pressure.begin(Loads::Kept, 2, 2, |_| false);
    for _ in 0..4 {
        for offset in 0..100 {
            add_loaded(&mut pressure, offset);
        }
        let nothing: &[u8] = &[];
        let call = Operator::Call { function_index: 0 };
        let ty = wasmparser::BlockType::Empty;
        pressure.operator(&Operator::Block { blockty: ty }, nothing, 0, (0, 0), 0);
        pressure.operator(&call, &[0x10, 0], 0, (0, 0), 8);
        pressure.operator(&Operator::Unreachable, nothing, 0, (0, 0), 0);
        pressure.operator(&Operator::End, nothing, 0, (0, 0), 0);
    }
    let passed = pressure.finish(&mut []);
    assert!(passed.passed_by > 800, "{passed:?}");
}
