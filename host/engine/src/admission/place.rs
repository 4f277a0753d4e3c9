//! [`Place`]: where in a file something was found.

use std::fmt;

/// A place in a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Offset in the file, in bytes.
    pub byte: u64,
    /// Which core module of a component, counted in the order of the file; `None`
    /// outside of one, and in a file that is a core module.
    pub module: Option<u32>,
    /// Which function of the core module.
    pub function: Option<FunctionPlace>,
}

/// A function of a core module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FunctionPlace {
    /// Its index, imported functions counted.
    pub index: u32,
    /// What the file calls it: text of the guest.
    pub name: Option<String>,
}

impl Place {
    pub(super) const fn at(byte: u64) -> Self {
        Self {
            byte,
            module: None,
            function: None,
        }
    }
}

impl fmt::Display for Place {
    /// `core module 1, function 7 ``f``, byte 1234`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(module) = self.module {
            write!(f, "core module {module}, ")?;
        }
        if let Some(function) = &self.function {
            write!(f, "function {}", function.index)?;
            if let Some(name) = &function.name {
                write!(f, " `{name}`")?;
            }
            f.write_str(", ")?;
        }
        write!(f, "byte {}", self.byte)
    }
}
