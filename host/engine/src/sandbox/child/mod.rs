//! The code of worker processes: sandbox setup, then one loop for each role.

mod backtrace;
mod compile;
mod pipes;
mod privileges;
pub(super) mod run;
mod setup;

pub use backtrace::{enter as enter_backtrace, main as backtrace_main};
pub use compile::{enter as enter_compile, main as compile_main};
pub use privileges::{close_inherited, die_with_parent};
pub use run::{enter as enter_run, main as run_main, main_with as run_main_with};
