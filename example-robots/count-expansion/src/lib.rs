//! count-expansion
