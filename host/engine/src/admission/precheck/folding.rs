//! [`Folded`]: what a compiler finds out about a number without running anything.
//!
//! Compilers drop what is never reached, as far as they know where branches go. Compilers to
//! WebAssembly have done so before; what is left for Cranelift to drop was put there on purpose. So this
//! knows constants, the bits that a number may have, and operators on one number twice.

use wasmparser::Operator;

/// What is known of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Folded {
    /// All of it.
    pub(super) is_known: bool,
    /// The bits that may be set; of a constant, its bits.
    bits: u64,
}

impl Folded {
    /// Nothing is known.
    pub(super) const UNKNOWN: Self = Self {
        is_known: false,
        bits: u64::MAX,
    };

    /// All of it may be known.
    pub(super) const PERHAPS: Self = Self {
        is_known: true,
        bits: u64::MAX,
    };

    /// The result of an operator that takes no numbers to compute with.
    pub(super) fn of(operator: &Operator<'_>) -> Self {
        let constant = |bits| Self {
            is_known: true,
            bits,
        };
        let loaded = |bits| Self {
            is_known: false,
            bits,
        };
        match operator {
            Operator::I32Const { value } => constant(value.cast_unsigned().into()),
            Operator::I64Const { value } => constant(value.cast_unsigned()),
            Operator::F32Const { .. }
            | Operator::F64Const { .. }
            | Operator::RefNull { .. }
            | Operator::RefIsNull
            | Operator::RefFunc { .. } => Self::PERHAPS,
            Operator::I32Load8U { .. } | Operator::I64Load8U { .. } => loaded(0xff),
            Operator::I32Load16U { .. } | Operator::I64Load16U { .. } => loaded(0xffff),
            _ => Self::UNKNOWN,
        }
    }

    /// One of two values.
    pub(super) const fn chosen(self, other: Self, is_same: bool) -> Self {
        Self {
            is_known: is_same || self.is_known && other.is_known,
            bits: self.bits | other.bits,
        }
    }

    /// Whether a result is surely another number than that from which it is computed: shifted or multiplied
    /// by a constant that does so.
    pub(super) fn is_other(operator: &Operator<'_>, by: Self) -> bool {
        use Operator as O;
        let shifts = matches!(
            operator,
            O::I32Shl | O::I32ShrU | O::I32ShrS | O::I64Shl | O::I64ShrU | O::I64ShrS
        );
        let multiplies = matches!(operator, O::I32Mul | O::I64Mul);
        by.is_known && (shifts && by.bits & 31 != 0 || multiplies && by.bits > 1)
    }

    /// The result of a numeric operator on one number.
    pub(super) const fn one(self, operator: &Operator<'_>) -> Self {
        let bits = match operator {
            Operator::I32Eqz | Operator::I64Eqz => 1,
            Operator::I32WrapI64 | Operator::I64ExtendI32U => self.bits & 0xffff_ffff,
            _ => u64::MAX,
        };
        Self {
            is_known: self.is_known || self.bits == 0,
            bits,
        }
    }

    /// The result of a numeric operator on two numbers, which may both be computed from the same one.
    pub(super) fn two(self, other: Self, is_same: bool, operator: &Operator<'_>) -> Self {
        use Operator as O;
        let (a, b) = (self.bits, other.bits);
        let shift = u32::try_from(b & 63).unwrap_or(0);
        let is_either = |bits: u64| a == bits && self.is_known || b == bits && other.is_known;
        // A constant that the other number may not have, or that no number exceeds.
        let is_out_of_range = |constant: u64, bits: u64| constant & !bits != 0;
        let is_decided = match operator {
            O::I32Eq | O::I64Eq | O::I32Ne | O::I64Ne => {
                other.is_known && is_out_of_range(b, a) || self.is_known && is_out_of_range(a, b)
            }
            O::I32LtU
            | O::I32LeU
            | O::I32GtU
            | O::I32GeU
            | O::I64LtU
            | O::I64LeU
            | O::I64GtU
            | O::I64GeU => {
                let is_extreme = |bits: u64| matches!(bits, 0 | 0xffff_ffff | u64::MAX);
                other.is_known && (is_extreme(b) || b >= a)
                    || self.is_known && (is_extreme(a) || a >= b)
            }
            O::I32LtS | O::I32LeS | O::I32GtS | O::I32GeS => {
                is_either(0x8000_0000) || is_either(0x7fff_ffff)
            }
            O::I64LtS | O::I64LeS | O::I64GtS | O::I64GeS => {
                is_either(1 << 63) || is_either((1 << 63) - 1)
            }
            O::I32Or | O::I64Or => is_either(0xffff_ffff) || is_either(u64::MAX),
            O::I32RemU | O::I32RemS | O::I64RemU | O::I64RemS => {
                other.is_known && matches!(b, 1 | 0xffff_ffff | u64::MAX)
            }
            _ => false,
        };
        let bits = match operator {
            O::I32And | O::I64And => a & b,
            O::I32Or | O::I64Or | O::I32Xor | O::I64Xor => a | b,
            O::I32Mul | O::I64Mul if a == 0 || b == 0 => 0,
            O::I32Shl if other.is_known => (a << (shift & 31)) & 0xffff_ffff,
            O::I64Shl if other.is_known => a << shift,
            O::I32ShrU if other.is_known => (a & 0xffff_ffff) >> (shift & 31),
            O::I64ShrU if other.is_known => a >> shift,
            _ if is_comparison(operator) => 1,
            _ => u64::MAX,
        };
        Self {
            is_known: is_same || is_decided || bits == 0 || self.is_known && other.is_known,
            bits,
        }
    }
}

const fn is_comparison(operator: &Operator<'_>) -> bool {
    use Operator as O;
    matches!(
        operator,
        O::I32Eq
            | O::I32Ne
            | O::I32LtS
            | O::I32LtU
            | O::I32GtS
            | O::I32GtU
            | O::I32LeS
            | O::I32LeU
            | O::I32GeS
            | O::I32GeU
            | O::I64Eq
            | O::I64Ne
            | O::I64LtS
            | O::I64LtU
            | O::I64GtS
            | O::I64GtU
            | O::I64LeS
            | O::I64LeU
            | O::I64GeS
            | O::I64GeU
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const BYTE: Folded = Folded {
        is_known: false,
        bits: 0xff,
    };

    fn constant(value: i32) -> Folded {
        Folded::of(&Operator::I32Const { value })
    }

    #[test]
    fn what_is_computed_from_constants_is_known() {
        let sum = constant(3).two(constant(4), false, &Operator::I32Add);
        assert!(sum.is_known);
        assert!(constant(3).one(&Operator::I32Eqz).is_known);
        assert!(!BYTE.one(&Operator::I32Eqz).is_known);
        assert!(!BYTE.two(constant(4), false, &Operator::I32Add).is_known);
    }

    #[test]
    fn some_operators_give_a_constant_whatever_the_number_is() {
        use Operator as O;
        let is_known =
            |operator: &Operator<'_>, value| BYTE.two(constant(value), false, operator).is_known;
        assert!(is_known(&O::I32And, 0));
        assert!(is_known(&O::I32And, 0x100));
        assert!(!is_known(&O::I32And, 0x80));
        assert!(is_known(&O::I32Or, -1));
        assert!(is_known(&O::I32Mul, 0));
        assert!(is_known(&O::I32ShrU, 8));
        assert!(!is_known(&O::I32ShrU, 7));
        assert!(is_known(&O::I32LtU, 0));
        assert!(is_known(&O::I32LtU, 0x100));
        assert!(!is_known(&O::I32LtU, 0x80));
        assert!(is_known(&O::I32Eq, 0x100));
        assert!(!is_known(&O::I32Eq, 0x10));
        assert!(is_known(&O::I32GtS, i32::MAX));
        assert!(!is_known(&O::I32LtS, 0));
        assert!(is_known(&O::I32RemU, 1));
        assert!(BYTE.two(BYTE, true, &O::I32Sub).is_known);
        let low = Folded::UNKNOWN.two(constant(8), false, &O::I32Shl);
        assert!(low.two(constant(0xff), false, &O::I32And).is_known);
    }
}
