//! Bombs of one function or of one list in a module, and of instances.

use wasm_encoder::{
    BlockType, CodeSection, ConstExpr, ExportKind, ExportSection, Function, FunctionSection,
    GlobalSection, GlobalType, Instruction as I, MemArg, MemArgTarget, MemorySection, MemoryType,
    Module, RefType, TableSection, TableType, TypeSection, ValType,
};

use super::modules::count;

/// What stands in a module beside one function type, one memory, one table and a
/// global.
pub(super) struct Parts {
    signature: (u32, u32),
    locals: u32,
    bodies: Vec<Vec<I<'static>>>,
}

impl Parts {
    /// One function that takes a number.
    pub(super) fn one(locals: u32, body: Vec<I<'static>>) -> Vec<u8> {
        let parts = Self {
            signature: (1, 0),
            locals,
            bodies: vec![body],
        };
        parts.module()
    }

    fn module(&self) -> Vec<u8> {
        let mut module = Module::new();
        let values = |count: u32| (0..count).map(|_| ValType::I32);
        let (parameters, results) = self.signature;
        let mut types = TypeSection::new();
        types.ty().function(values(parameters), values(results));
        module.section(&types);
        let mut functions = FunctionSection::new();
        for _ in &self.bodies {
            functions.function(0);
        }
        module.section(&functions);
        let mut tables = TableSection::new();
        tables.table(TableType {
            element_type: RefType::FUNCREF,
            minimum: 1,
            maximum: None,
            table64: false,
            shared: false,
        });
        module.section(&tables);
        let mut memories = MemorySection::new();
        memories.memory(MemoryType {
            minimum: 1,
            maximum: None,
            memory64: false,
            shared: false,
            page_size_log2: None,
        });
        module.section(&memories);
        let mut globals = GlobalSection::new();
        globals.global(variable(), &ConstExpr::i32_const(0));
        module.section(&globals);
        let mut exports = ExportSection::new();
        exports.export("bomb", ExportKind::Func, 0);
        module.section(&exports);
        let mut code = CodeSection::new();
        for body in &self.bodies {
            let mut function = Function::new([(self.locals, ValType::I32)]);
            for instruction in body {
                function.instruction(instruction);
            }
            function.instruction(&I::End);
            code.function(&function);
        }
        module.section(&code);
        module.finish()
    }
}

fn variable() -> GlobalType {
    GlobalType {
        val_type: ValType::I32,
        mutable: true,
        shared: false,
    }
}

pub(super) fn argument(at: u32) -> MemArg {
    MemArg {
        offset: u64::from(at) * 4,
        align: 0,
        target: MemArgTarget::Memory(0),
        ordering: None,
    }
}

pub(super) fn load(at: u32) -> [I<'static>; 2] {
    [I::LocalGet(0), I::I32Load(argument(at))]
}

/// Nested loops, each with a branch back. 1,000: 7 KB, 3 s; 2,000: 25 s.
pub fn nested_loops(loops: u32) -> Vec<u8> {
    let mut body = vec![I::Loop(BlockType::Empty); count(loops)];
    for _ in 0..loops {
        body.extend([I::LocalGet(0), I::BrIf(0), I::End]);
    }
    Parts::one(0, body)
}

/// Nested blocks.
pub fn nested_blocks(blocks: u32) -> Vec<u8> {
    let mut body = vec![I::Block(BlockType::Empty); count(blocks)];
    body.extend(vec![I::End; count(blocks)]);
    Parts::one(0, body)
}

/// Locals that are written in branches and read at the end. 10,000 of each: 29 s and
/// 3.5 GB.
pub fn locals_and_branches(locals: u32, branches: u32) -> Vec<u8> {
    let mut body = Vec::new();
    for at in 0..branches {
        let local = 1 + at % locals;
        body.extend([I::LocalGet(0), I::If(BlockType::Empty), I::LocalGet(local)]);
        body.extend([I::I32Const(3), I::I32Mul, I::LocalSet(local), I::End]);
    }
    body.extend(uses(1, locals));
    Parts::one(locals, body)
}

/// Tables of branches, each to the same blocks. 100 of 1,000: 200 KB, 22 s.
pub fn branch_tables(tables: u32, targets: u32) -> Vec<u8> {
    let mut body = vec![I::Block(BlockType::Empty); count(targets)];
    for _ in 0..tables {
        let labels: Vec<u32> = (0..targets).collect();
        body.extend([I::Block(BlockType::Empty), I::LocalGet(0)]);
        body.extend([I::BrTable(labels.into(), 0), I::End]);
    }
    for at in 0..targets {
        let value = i32::try_from(at).expect("a small number");
        body.extend([I::LocalGet(0), I::LocalSet(1), I::I32Const(value)]);
        body.extend([I::LocalSet(1), I::End]);
    }
    Parts::one(1, body)
}

/// Exits of one block, each with other values in the locals. 3,000 with 30
/// locals: 800 KB, 12 s.
pub fn exits(exits: u32, locals: u32) -> Vec<u8> {
    let mut body = block_with_exits(exits, locals);
    body.extend(uses(1, locals));
    Parts::one(locals, body)
}

/// A block with exits, each with other values in the locals after the first one.
fn block_with_exits(exits: u32, locals: u32) -> Vec<I<'static>> {
    let mut block = vec![I::Block(BlockType::Empty)];
    for exit in 0..exits {
        for local in 0..locals {
            block.extend(load(exit * locals + local));
            block.push(I::LocalSet(1 + local));
        }
        block.extend([I::LocalGet(0), I::BrIf(0)]);
    }
    block.push(I::End);
    block
}

/// Uses that many locals.
pub(super) fn uses(first: u32, locals: u32) -> impl Iterator<Item = I<'static>> {
    (first..first + locals).flat_map(|local| [I::LocalGet(local), I::GlobalSet(0)])
}

/// The same, while floats and integers stay alive that are used after the exits. 2,000 with 10 locals
/// and 13 floats: 200 KB, 5 s.
pub fn held_values(exits: u32, locals: u32, floats: u32, integers: u32) -> Vec<u8> {
    let mut body = holds(floats, integers);
    body.extend(block_with_exits(exits, locals));
    body.extend(releases(floats, integers));
    body.extend(uses(1, locals));
    Parts::one(locals, body)
}

/// Loads floats and integers that stay on the operand stack.
pub(super) fn holds(floats: u32, integers: u32) -> Vec<I<'static>> {
    let mut body = vec![I::LocalGet(0), I::F64Const(1.0.into())];
    for at in 0..floats {
        let [address, _] = load(0);
        body.extend([address, I::F64Load(argument(2 * at))]);
    }
    body.push(I::I32Const(1));
    body.extend((0..integers).flat_map(|at| load(1_000_000 + at)));
    body
}

/// Uses what [`holds`] has loaded.
pub(super) fn releases(floats: u32, integers: u32) -> Vec<I<'static>> {
    let mut body = vec![I::I32Xor; count(integers)];
    body.push(I::GlobalSet(0));
    body.extend(vec![I::F64Add; count(floats)]);
    body.push(I::F64Store(argument(0)));
    body
}

/// A loop that hands values on from round to round, with branches in it, after exits of a block.
pub fn looped_values(values: u32, branches: u32, exits: u32) -> Vec<u8> {
    let mut body = block_with_exits(exits, 1);
    body.extend(uses(1, 1));
    body.push(I::Loop(BlockType::Empty));
    for value in 0..values {
        body.push(I::LocalGet(2 + value));
        body.extend(load(value));
        body.extend([I::I32Add, I::LocalSet(2 + value)]);
    }
    for branch in 0..branches {
        body.extend(load(branch));
        body.extend([
            I::If(BlockType::Empty),
            I::I32Const(3),
            I::GlobalSet(0),
            I::End,
        ]);
    }
    body.extend([I::LocalGet(0), I::BrIf(0), I::End]);
    body.extend(uses(2, values));
    Parts::one(1 + values, body)
}

/// Blocks that hand over values on the operand stack. 10,000 with 10: 70 KB, 5 GB.
pub fn typed_blocks(blocks: u32, values: u32) -> Vec<u8> {
    let mut body: Vec<I<'static>> = (0..values).flat_map(load).collect();
    for _ in 0..blocks {
        body.extend([I::Block(BlockType::FunctionType(0)), I::LocalGet(0)]);
        body.extend([I::BrIf(0), I::End]);
    }
    body.extend(vec![I::GlobalSet(0); count(values)]);
    body.extend(vec![I::I32Const(0); count(values)]);
    let parts = Parts {
        signature: (values, values),
        locals: 1,
        bodies: vec![body],
    };
    parts.module()
}

/// Indirect calls in one function. 30,000: 210 KB, 24 s.
pub fn indirect_calls(calls: u32) -> Vec<u8> {
    let call = [
        I::I32Const(0),
        I::I32Const(0),
        I::CallIndirect {
            type_index: 0,
            table_index: 0,
        },
    ];
    Parts::one(0, repeated(&call, calls))
}

/// Values on the operand stack, added up at the end, again and again. One time
/// 30,000: 236 KB, 24 s; 150 times 1,000: 1.2 MB, 41 s.
pub fn stacked_values(values: u32, times: u32) -> Vec<u8> {
    let mut body = Vec::new();
    for time in 0..times {
        for value in 0..values {
            body.extend(load(time * values + value));
        }
        body.extend(vec![I::I32Add; count(values) - 1]);
        body.push(I::GlobalSet(0));
    }
    Parts::one(0, body)
}

/// Loads from as many addresses, added up, and again: nothing is stored between them, so the compiler
/// takes the values of the first time, and keeps all of them until the end without a local or an
/// operand.
pub fn reused_loads(values: u32, times: u32) -> Vec<u8> {
    let mut body = Vec::new();
    for _ in 0..times {
        for value in 0..values {
            body.extend(load(value));
            body.extend([I::LocalGet(1), I::I32Add, I::LocalSet(1)]);
        }
    }
    body.extend([I::LocalGet(1), I::GlobalSet(0)]);
    Parts::one(1, body)
}

/// A chain of branches, and after it a table of branches to where others lead from its beginning: from
/// each of its targets the compiler walks up the chain.
pub fn shallow_joins(joins: u32, chain: u32) -> Vec<u8> {
    let mut body = vec![I::Block(BlockType::Empty); count(joins)];
    for join in 0..joins {
        body.extend([I::LocalGet(0), I::BrIf(join)]);
    }
    // What the chain leads to is around all.
    body.insert(0, I::Block(BlockType::Empty));
    body.extend(repeated(&[I::LocalGet(0), I::BrIf(joins)], chain));
    let labels: Vec<u32> = (0..joins).collect();
    body.extend([I::LocalGet(0), I::BrTable(labels.into(), joins)]);
    body.extend(vec![I::End; count(joins) + 1]);
    Parts::one(0, body)
}

/// A chain of branches, and after it additions of numbers that are all different: the compiler looks
/// up how far up the chain each could be computed.
pub fn deep_additions(chain: u32, additions: u32) -> Vec<u8> {
    let mut body = vec![I::Block(BlockType::Empty)];
    body.extend(repeated(&[I::LocalGet(0), I::BrIf(0)], chain));
    for addition in 0..additions {
        let number = i32::try_from(addition).expect("a small number") + 1000;
        body.extend([I::LocalGet(0), I::I32Const(number), I::I32Add]);
        body.push(I::GlobalSet(0));
    }
    body.push(I::End);
    Parts::one(0, body)
}

/// Values that are made after many joins, and live over as many others: for each block that they
/// live in, the compiler goes through the parameters of all blocks.
pub fn late_values(joins: u32, values: u32) -> Vec<u8> {
    // One way to the join takes more fuel, so the fuel is a parameter of it.
    let join = [
        I::Block(BlockType::Empty),
        I::LocalGet(0),
        I::BrIf(0),
        I::LocalGet(0),
        I::GlobalSet(0),
        I::End,
    ];
    let mut body = repeated(&join, joins);
    for value in 0..values {
        body.extend(load(value));
        body.push(I::LocalSet(1 + value));
    }
    body.extend(repeated(&join, joins));
    for value in 0..values {
        body.extend([I::LocalGet(1 + value), I::GlobalSet(0)]);
    }
    Parts::one(values, body)
}

/// Functions that do nothing. 1,000,000: 8.8 MB, 93 s and 6 GB.
pub fn empty_functions(functions: u32) -> Vec<u8> {
    let parts = Parts {
        signature: (0, 0),
        locals: 0,
        bodies: vec![Vec::new(); count(functions)],
    };
    parts.module()
}

/// One function without branches, of about that many bytes.
pub fn long_function(bytes: u32) -> Vec<u8> {
    let [local, load] = load(0);
    let step = [local.clone(), local, load, I::I32Add, I::LocalSet(0)];
    Parts::one(0, repeated(&step, bytes / 12))
}

/// Calls with as many parameters and results.
pub fn wide_calls(values: u32, calls: u32) -> Vec<u8> {
    let mut body = Vec::new();
    for _ in 0..calls {
        body.extend(vec![I::I32Const(0); count(values)]);
        body.push(I::Call(0));
        body.extend(vec![I::Drop; count(values)]);
    }
    body.extend(vec![I::I32Const(0); count(values)]);
    let parts = Parts {
        signature: (values, values),
        locals: 0,
        bodies: vec![body],
    };
    parts.module()
}

/// One block of SIMD operators that become dozens of instructions each.
pub fn simd(operators: u32) -> Vec<u8> {
    let mut body = vec![I::LocalGet(0), I::V128Const(1)];
    body.extend(vec![I::I32x4TruncSatF32x4U; count(operators)]);
    // Of what is dropped nothing is compiled.
    body.push(I::V128Store(argument(0)));
    Parts::one(0, body)
}

/// A constant expression of that many additions.
pub fn constant(additions: u32) -> Vec<u8> {
    let mut expression = ConstExpr::i32_const(0);
    for _ in 0..additions {
        expression = expression.with_i32_const(1).with_i32_add();
    }
    let mut globals = GlobalSection::new();
    globals.global(variable(), &expression);
    let mut module = Module::new();
    module.section(&globals);
    module.finish()
}

/// That many globals.
pub fn globals(number: u32) -> Vec<u8> {
    let mut globals = GlobalSection::new();
    for _ in 0..number {
        globals.global(variable(), &ConstExpr::i32_const(0));
    }
    let mut module = Module::new();
    module.section(&globals);
    module.finish()
}

/// That many exports of one memory.
pub fn exports(number: u32) -> Vec<u8> {
    let mut memories = MemorySection::new();
    memories.memory(MemoryType {
        minimum: 0,
        maximum: None,
        memory64: false,
        shared: false,
        page_size_log2: None,
    });
    let mut exports = ExportSection::new();
    for at in 0..number {
        exports.export(&at.to_string(), ExportKind::Memory, 0);
    }
    let mut module = Module::new();
    module.section(&memories);
    module.section(&exports);
    module.finish()
}

/// That many equal function types.
pub fn types(number: u32) -> Vec<u8> {
    let mut types = TypeSection::new();
    for _ in 0..number {
        types.ty().function([], []);
    }
    let mut module = Module::new();
    module.section(&types);
    module.finish()
}

/// An export with a name of that many bytes.
pub fn long_name(bytes: u32) -> Vec<u8> {
    let mut globals = GlobalSection::new();
    globals.global(variable(), &ConstExpr::i32_const(0));
    let mut exports = ExportSection::new();
    exports.export(&"n".repeat(count(bytes)), ExportKind::Global, 0);
    let mut module = Module::new();
    module.section(&globals);
    module.section(&exports);
    module.finish()
}

/// Components of which each instantiates the one before twice: 2^levels instances of
/// one core module. 30: 1 KB.
pub fn exponential(levels: u32) -> Vec<u8> {
    let mut text = String::from(
        "(component (component $c0 (core module $m) (core instance (instantiate $m)))",
    );
    for level in 1..=levels {
        let before = level - 1;
        text += &format!(
            "(component $c{level} (alias outer 1 $c{before} (component $c))
                (instance (instantiate $c)) (instance (instantiate $c)))"
        );
    }
    text += &format!("(instance (instantiate $c{levels})))");
    wat::parse_str(text).expect("written here")
}

/// Nested components.
pub fn nested_components(depth: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..depth {
        let mut outer = wasm_encoder::Component::new();
        if !bytes.is_empty() {
            outer.section(&wasm_encoder::RawSection {
                id: 4,
                data: &bytes,
            });
        }
        bytes = outer.finish();
    }
    bytes
}

/// A function between two components whose parameter is a tuple of two tuples of two
/// tuples: 2^levels values.
pub fn doubled_tuple(levels: u32) -> Vec<u8> {
    let mut types = String::from("(type $t0 (tuple u8 u8))");
    for level in 1..levels {
        let before = level - 1;
        types += &format!("(type $t{level} (tuple $t{before} $t{before}))");
    }
    let last = levels - 1;
    handing_over(&types, &format!("$t{last}"))
}

/// A function between two components whose parameter is a record of that many fields.
pub fn wide_record(fields: u32) -> Vec<u8> {
    let fields: String = (0..fields)
        .map(|field| format!("(field \"f{field}\" u8)"))
        .collect();
    handing_over(&format!("(type $r (record {fields}))"), "$r")
}

/// A component that lifts a function with that parameter, and lowers it again.
fn handing_over(types: &str, parameter: &str) -> Vec<u8> {
    wat::parse_str(format!(
        r#"(component {types}
            (core module $m
                (memory (export "memory") 1)
                (func (export "realloc") (param i32 i32 i32 i32) (result i32) i32.const 0)
                (func (export "f") (param i32)))
            (core instance $i (instantiate $m))
            (func $f (param "p" {parameter})
                (canon lift (core func $i "f")
                    (memory (core memory $i "memory")) (realloc (core func $i "realloc"))))
            (core func (canon lower (func $f) (memory (core memory $i "memory")))))"#
    ))
    .expect("written here")
}

fn repeated(body: &[I<'static>], times: u32) -> Vec<I<'static>> {
    (0..times).flat_map(|_| body.iter().cloned()).collect()
}
