//! What operators cost in fuel: [`operator_cost`].
//!
//! Fuel has to end a match after about the time that an organiser expects, whatever a
//! robot does with it. Most operators take a fraction of a nanosecond and cost 1; those
//! that take much longer cost about what they take in units of such operators. What is
//! slow for reasons outside its instructions gets more time for its fuel all the same:
//! memory in no cache, denormal floats, handles made and given back. `cargo bench -p
//! wasmouse -- fuel` measures the kinds of work beside the flood robot.

use wasmtime::OperatorCost;

/// Growing, which asks the limiter and the system.
const GROW: u8 = 200;

/// Operators that call into the runtime, whatever little they do there.
const RUNTIME_CALL: u8 = 200;

/// Calls through a table: the callee's type is checked.
const INDIRECT_CALL: u8 = 6;

/// Writing to memory. Reading is cheap as long as reads do not wait for each other;
/// writing to memory that is in no cache is not.
const STORE: u8 = 8;
const LOAD: u8 = 2;

/// Arithmetic of floats, whose results are looked through for NaN.
const FLOAT: u8 = 4;

/// Roundings, minima and maxima of floats: sequences of instructions.
const FLOAT_SEQUENCE: u8 = 10;

/// Numbers of one kind made into numbers of another, which may trap.
const CONVERSION: u8 = 2;

/// Divisions and roots: the slowest things that a processor computes.
const FLOAT_DIVISION: u8 = 16;
const INTEGER_DIVISION: u8 = 8;

/// The costs of all operators.
pub(crate) fn operator_cost() -> OperatorCost {
    let mut cost = OperatorCost::new();
    memory(&mut cost);
    tables_and_calls(&mut cost);
    numbers(&mut cost);
    vectors(&mut cost);
    cost
}

/// Sets the cost of each of these operators.
macro_rules! set {
    ($cost:ident, $value:expr; $($operator:ident)*) => {
        $( $cost.$operator = $value; )*
    };
}

fn memory(cost: &mut OperatorCost) {
    cost.MemoryGrow = GROW;
    // Only asking for it; what touches the pages pays for that.
    cost.variable.memory_grow_per_page = 16;
    set!(cost, RUNTIME_CALL; MemoryFill MemoryCopy MemoryInit DataDrop);
    set!(cost, LOAD;
        I32Load I64Load F32Load F64Load I32Load8S I32Load8U I32Load16S I32Load16U
        I64Load8S I64Load8U I64Load16S I64Load16U I64Load32S I64Load32U
        V128Load V128Load8x8S V128Load8x8U V128Load16x4S V128Load16x4U V128Load32x2S
        V128Load32x2U V128Load8Splat V128Load16Splat V128Load32Splat V128Load64Splat
        V128Load32Zero V128Load64Zero V128Load8Lane V128Load16Lane V128Load32Lane
        V128Load64Lane);
    set!(cost, STORE;
        I32Store I64Store F32Store F64Store I32Store8 I32Store16 I64Store8 I64Store16
        I64Store32 V128Store V128Store8Lane V128Store16Lane V128Store32Lane
        V128Store64Lane);
}

fn tables_and_calls(cost: &mut OperatorCost) {
    cost.TableGrow = GROW;
    set!(cost, RUNTIME_CALL; TableFill TableCopy TableInit ElemDrop RefFunc);
    set!(cost, 4; TableGet TableSet);
    cost.variable.table_init_per_element = 16;
    cost.variable.table_copy_per_element = 4;
    cost.variable.table_fill_per_element = 4;
    set!(cost, INDIRECT_CALL; CallIndirect ReturnCallIndirect);
    set!(cost, 3; Call ReturnCall);
}

fn numbers(cost: &mut OperatorCost) {
    set!(cost, INTEGER_DIVISION;
        I32DivS I32DivU I32RemS I32RemU I64DivS I64DivU I64RemS I64RemU);
    set!(cost, FLOAT; F32Add F32Sub F32Mul F64Add F64Sub F64Mul);
    set!(cost, FLOAT; F32DemoteF64 F64PromoteF32);
    set!(cost, CONVERSION;
        I32TruncF32S I32TruncF32U I32TruncF64S I32TruncF64U
        I64TruncF32S I64TruncF32U I64TruncF64S I64TruncF64U
        I32TruncSatF32S I32TruncSatF32U I32TruncSatF64S I32TruncSatF64U
        I64TruncSatF32S I64TruncSatF32U I64TruncSatF64S I64TruncSatF64U
        F32ConvertI32S F32ConvertI32U F32ConvertI64S F32ConvertI64U
        F64ConvertI32S F64ConvertI32U F64ConvertI64S F64ConvertI64U);
    set!(cost, FLOAT_SEQUENCE;
        F32Ceil F32Floor F32Trunc F32Nearest F32Min F32Max
        F64Ceil F64Floor F64Trunc F64Nearest F64Min F64Max);
    set!(cost, FLOAT_DIVISION; F32Div F64Div F32Sqrt F64Sqrt);
}

fn vectors(cost: &mut OperatorCost) {
    set!(cost, 2 * FLOAT; F32x4Add F32x4Sub F32x4Mul F64x2Add F64x2Sub F64x2Mul);
    set!(cost, 2 * FLOAT_SEQUENCE;
        F32x4Ceil F32x4Floor F32x4Trunc F32x4Nearest F32x4Min F32x4Max
        F64x2Ceil F64x2Floor F64x2Trunc F64x2Nearest F64x2Min F64x2Max);
    set!(cost, 2 * FLOAT_DIVISION; F32x4Div F64x2Div F32x4Sqrt F64x2Sqrt);
    // What the processor has no single instruction for.
    set!(cost, 10;
        I64x2Mul I8x16Popcnt I8x16Shl I8x16ShrS I8x16ShrU I64x2ShrS
        I32x4TruncSatF32x4U I32x4TruncSatF32x4S I32x4TruncSatF64x2SZero
        I32x4TruncSatF64x2UZero F32x4ConvertI32x4U F64x2ConvertLowI32x4U);
}
