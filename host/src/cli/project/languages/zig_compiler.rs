//! Zig's compiler, which also compiles C and C++ and brings all that it needs for that.

use crate::cli::project::tool::{Program, Tool, Version};

/// The ways to start it: an installation of its own, then the package of Python.
pub const PROGRAMS: [Program; 3] = [
    Program::OnPath("zig"),
    Program::OnPath("python-zig"),
    Program::PythonModule("ziglang"),
];

/// For robots in Zig. The language and its build files change with every release.
pub static ZIG: Tool = Tool {
    name: "zig",
    programs: &PROGRAMS,
    version_arguments: &["version"],
    oldest: Version(0, 17, 0),
    tested: Version(0, 17, 1),
    install: "python3 -m pip install ziglang==0.17.1",
};

/// For robots in C and C++.
pub static ZIG_CC: Tool = Tool {
    name: "zig",
    programs: &[
        PROGRAMS[0],
        PROGRAMS[1],
        PROGRAMS[2],
        Program::Other(&CLANG),
    ],
    version_arguments: &["version"],
    oldest: Version(0, 14, 0),
    tested: Version(0, 17, 1),
    install: "python3 -m pip install ziglang==0.17.1\n\
              (clang 20 or later with wasm-ld will do as well)",
};

/// Clang, with the linker for WebAssembly, under the names of Debian and of LLVM itself.
pub static CLANG: Tool = Tool {
    name: "clang",
    programs: &[
        Program::OnPath("clang-22"),
        Program::OnPath("clang-21"),
        Program::OnPath("clang-20"),
        Program::OnPath("clang"),
    ],
    version_arguments: &["--version"],
    // Earlier ones call `memcpy` and `memset`, which no library has here.
    oldest: Version(20, 0, 0),
    tested: Version(22, 1, 8),
    install: "apt-get install --no-install-recommends clang-22 lld-22",
};
