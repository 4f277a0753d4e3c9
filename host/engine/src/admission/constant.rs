//! [`Constant`]: what a constant expression of a core module is made of.

use wasmparser::{ConstExpr, Operator, Result};

/// A constant expression, as far as it matters to what is compiled of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Constant {
    /// Operators, without the `end`.
    pub(crate) operators: u64,
    /// The value, where the expression is one `i32.const`.
    pub(crate) number: Option<u64>,
    /// Whether it is one number of any type, which the compiler writes down as it is.
    pub(crate) is_number: bool,
    /// The function, where the expression is one `ref.func`.
    pub(crate) function: Option<u32>,
    /// Functions that it makes references to.
    pub(crate) functions: Vec<u32>,
}

impl Constant {
    /// Reads an expression, which need not be valid.
    pub(crate) fn read(expression: &ConstExpr<'_>) -> Result<Self> {
        let mut constant = Self::default();
        for operator in expression.get_operators_reader() {
            let operator = operator?;
            if matches!(operator, Operator::End) {
                continue;
            }
            constant.operators += 1;
            match operator {
                Operator::I32Const { value } => {
                    constant.number = Some(u64::from(value.cast_unsigned()));
                    constant.is_number = true;
                }
                Operator::I64Const { .. }
                | Operator::F32Const { .. }
                | Operator::F64Const { .. }
                | Operator::V128Const { .. } => constant.is_number = true,
                Operator::RefFunc { function_index } => {
                    constant.function = Some(function_index);
                    constant.functions.push(function_index);
                }
                _ => {}
            }
        }
        if constant.operators != 1 {
            constant.number = None;
            constant.is_number = false;
            constant.function = None;
        }
        Ok(constant)
    }
}
