//! Contest files with one mistake each.

/// Who can see a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeenBy {
    /// Every reader of TOML, or of numbers of 64 bits.
    Toml,
    /// The JSON Schema and the parser.
    Schema,
    /// The parser alone: names that have to exist, or must not be given twice.
    Parser,
}

/// A contest file with a mistake: what it is, who sees it, and the text, in which `{robots}` and
/// `{mazes}` stand for valid entries.
pub type BadFile = (&'static str, SeenBy, &'static str);

use SeenBy::{Parser, Schema, Toml};

/// All of them.
pub const BAD_FILES: &[BadFile] = &[
    ("empty file", Schema, ""),
    ("no version", Schema, "name = \"x\"\n{robots}{mazes}"),
    ("later version", Schema, "version = 2\n{robots}{mazes}"),
    ("version 0", Schema, "version = 0\n{robots}{mazes}"),
    (
        "version as a string",
        Schema,
        "version = \"1\"\n{robots}{mazes}",
    ),
    (
        "version as a float",
        Schema,
        "version = 1.5\n{robots}{mazes}",
    ),
    (
        "version in a table",
        Schema,
        "[version]\nmajor = 1\n{robots}{mazes}",
    ),
    (
        "huge version",
        Toml,
        "version = 99999999999999999999999999999999999999999\n{robots}{mazes}",
    ),
    ("no robots", Schema, "version = 1\n{mazes}"),
    ("empty robots", Schema, "version = 1\nrobots = []\n{mazes}"),
    ("no mazes", Schema, "version = 1\n{robots}"),
    (
        "unterminated string",
        Toml,
        "version = 1\nname = \"spring\n{robots}{mazes}",
    ),
    ("no value", Toml, "version = 1\nname =\n{robots}{mazes}"),
    (
        "unquoted text",
        Toml,
        "version = 1\nname = spring\n{robots}{mazes}",
    ),
    (
        "unclosed array",
        Toml,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"tree-16\"\n",
    ),
    (
        "unclosed header",
        Toml,
        "version = 1\n{robots}{mazes}[seeds\ncount = 1\n",
    ),
    (
        "key given twice",
        Toml,
        "version = 1\nname = \"a\"\nname = \"b\"\n{robots}{mazes}",
    ),
    (
        "table given twice",
        Toml,
        "version = 1\n{robots}{mazes}[run]\njobs = 1\n[run]\njobs = 2\n",
    ),
    ("JSON", Toml, "{\"version\": 1}\n"),
    ("YAML", Toml, "version: 1\nrobots:\n  - flood\n"),
    (
        "control character in a string",
        Toml,
        "version = 1\nname = \"a\u{1b}[2Jb\"\n{robots}{mazes}",
    ),
    (
        "unknown key at the top",
        Schema,
        "version = 1\nstroe = \"a.db\"\n{robots}{mazes}",
    ),
    (
        "unknown key like no other",
        Schema,
        "version = 1\nzzz = 1\n{robots}{mazes}",
    ),
    (
        "unknown table",
        Schema,
        "version = 1\n{robots}{mazes}[socring]\nmethod = \"regret\"\n",
    ),
    (
        "misspelt key of a robot",
        Schema,
        "version = 1\n[[robots]]\nbundeld = \"flood\"\n{mazes}",
    ),
    (
        "misspelt key of a set",
        Schema,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npath = [\"tree-16\"]\n",
    ),
    (
        "misspelt limit",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"x\"\n[rules.sandbox]\nmemory_max_bytes = 65536\n",
    ),
    (
        "key of another table",
        Schema,
        "version = 1\n{robots}{mazes}[run]\ncount = 3\n",
    ),
    (
        "unknown key with a line break",
        Schema,
        "version = 1\n\"na\\nme\" = \"x\"\n{robots}{mazes}",
    ),
    (
        "one pair of brackets",
        Schema,
        "version = 1\n[robots]\nbundled = \"flood\"\n{mazes}",
    ),
    (
        "two pairs of brackets",
        Schema,
        "version = 1\n{robots}{mazes}[[seeds]]\ncount = 1\n",
    ),
    (
        "array instead of a table",
        Schema,
        "version = 1\nseeds = [0, 3]\n{robots}{mazes}",
    ),
    (
        "array instead of a robot",
        Schema,
        "version = 1\nrobots = [[\"a.wasm\"]]\n{mazes}",
    ),
    (
        "robot that is a string",
        Schema,
        "version = 1\nrobots = [\"flood\"]\n{mazes}",
    ),
    (
        "number for a name",
        Schema,
        "version = 1\nname = 2026\n{robots}{mazes}",
    ),
    (
        "date for a name",
        Schema,
        "version = 1\nname = 2026-11-28\n{robots}{mazes}",
    ),
    (
        "empty name",
        Schema,
        "version = 1\nname = \"\"\n{robots}{mazes}",
    ),
    (
        "name with a line break",
        Schema,
        "version = 1\nname = \"a\\nb\"\n{robots}{mazes}",
    ),
    (
        "name with an escape sequence",
        Schema,
        "version = 1\nname = \"\\u001B[31mred\"\n{robots}{mazes}",
    ),
    (
        "name from right to left",
        Parser,
        "version = 1\nname = \"a\\u202Eb\"\n{robots}{mazes}",
    ),
    (
        "name that ends with a space",
        Schema,
        "version = 1\nname = \"spring \"\n{robots}{mazes}",
    ),
    (
        "empty path",
        Schema,
        "version = 1\nstore = \"\"\n{robots}{mazes}",
    ),
    (
        "path with a null",
        Schema,
        "version = 1\nstore = \"a\\u0000b\"\n{robots}{mazes}",
    ),
    (
        "robot without a path",
        Schema,
        "version = 1\n[[robots]]\nauthor = \"ann\"\n{mazes}",
    ),
    (
        "path and bundled robot",
        Schema,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nbundled = \"flood\"\n{mazes}",
    ),
    (
        "unknown bundled robot",
        Parser,
        "version = 1\n[[robots]]\nbundled = \"flod\"\n{mazes}",
    ),
    (
        "name for a pattern",
        Schema,
        "version = 1\n[[robots]]\npath = \"s/*.wasm\"\nname = \"ann\"\n{mazes}",
    ),
    (
        "folder names for a bundled robot",
        Schema,
        "version = 1\n[[robots]]\nbundled = \"flood\"\nnames_from = \"folder\"\n{mazes}",
    ),
    (
        "unknown source of names",
        Schema,
        "version = 1\n[[robots]]\npath = \"s\"\nnames_from = \"files\"\n{mazes}",
    ),
    (
        "no variants",
        Schema,
        "version = 1\n[[robots]]\nbundled = \"flood\"\nvariants = []\n{mazes}",
    ),
    (
        "unknown variant",
        Parser,
        "version = 1\n[[robots]]\nbundled = \"flood\"\nvariants = [\"certian\"]\n{mazes}",
    ),
    (
        "named variant of a file",
        Parser,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nvariants = [\"fast\"]\n{mazes}",
    ),
    (
        "negative variant",
        Schema,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nvariants = [-1]\n{mazes}",
    ),
    (
        "variant that is no number",
        Schema,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nvariants = [true]\n{mazes}",
    ),
    (
        "variant given twice",
        Parser,
        "version = 1\n[[robots]]\nbundled = \"flood\"\nvariants = [0, \"reset\"]\n{mazes}",
    ),
    (
        "variants that are no list",
        Schema,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nvariants = 1\n{mazes}",
    ),
    (
        "robot given twice",
        Parser,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\n[[robots]]\npath = \"a.wasm\"\nvariants = [1, 0]\n{mazes}",
    ),
    (
        "name given twice",
        Parser,
        "version = 1\n[[robots]]\npath = \"a.wasm\"\nname = \"x\"\n[[robots]]\npath = \"b.wasm\"\nname = \"x\"\n{mazes}",
    ),
    (
        "unknown class",
        Parser,
        "version = 1\n[[robots]]\nbundled = \"flood\"\nclass = \"ligth\"\n[[classes]]\nname = \"light\"\n{mazes}",
    ),
    (
        "class without a name",
        Schema,
        "version = 1\n{robots}{mazes}[[classes]]\nstep_fuel_max = 1\n",
    ),
    (
        "class given twice",
        Parser,
        "version = 1\n{robots}{mazes}[[classes]]\nname = \"a\"\n[[classes]]\nname = \"a\"\n",
    ),
    (
        "class without fuel",
        Schema,
        "version = 1\n{robots}{mazes}[[classes]]\nname = \"a\"\nstep_fuel_max = 0\n",
    ),
    (
        "set without a name",
        Schema,
        "version = 1\n{robots}[[mazes]]\npaths = [\"tree-16\"]\n",
    ),
    (
        "set without mazes",
        Schema,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\n",
    ),
    (
        "set with an empty list",
        Schema,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = []\n",
    ),
    (
        "path that is no list",
        Schema,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = \"tree-16\"\n",
    ),
    (
        "set given twice",
        Parser,
        "version = 1\n{robots}{mazes}[[mazes]]\nset = \"public\"\npaths = [\"braid-12\"]\n",
    ),
    (
        "maze in two sets",
        Parser,
        "version = 1\n{robots}{mazes}[[mazes]]\nset = \"final\"\npaths = [\"braid-12\", \"tree-16\"]\n",
    ),
    (
        "weight 0",
        Schema,
        "version = 1\n{robots}{mazes}weight = 0\n",
    ),
    (
        "weight above 1000",
        Schema,
        "version = 1\n{robots}{mazes}weight = 1001\n",
    ),
    (
        "fractional weight",
        Schema,
        "version = 1\n{robots}{mazes}weight = 1.5\n",
    ),
    (
        "word for true",
        Schema,
        "version = 1\n{robots}{mazes}hidden = \"yes\"\n",
    ),
    (
        "generated maze of an odd size",
        Parser,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"gen:tree:15:1\"]\n",
    ),
    (
        "generated maze without a seed",
        Parser,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"gen:tree:16\"]\n",
    ),
    (
        "too many generated mazes",
        Parser,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"gen:tree:16:0..=100000\"]\n",
    ),
    (
        "generated maze in two sets",
        Parser,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"gen:tree:12..=16:1..=9\", \"gen:braid:16:1\"]\n[[mazes]]\nset = \"b\"\npaths = [\"gen:tree,loops=12:16..=20:9..=20\"]\n",
    ),
    (
        "standard input as a maze",
        Parser,
        "version = 1\n{robots}[[mazes]]\nset = \"a\"\npaths = [\"-\"]\n",
    ),
    (
        "no seeds",
        Schema,
        "version = 1\n{robots}{mazes}[seeds]\ncount = 0\n",
    ),
    (
        "negative seed",
        Schema,
        "version = 1\n{robots}{mazes}[seeds]\nfirst = -1\n",
    ),
    (
        "seed of 65 bits",
        Toml,
        "version = 1\n{robots}{mazes}[seeds]\nfirst = 18446744073709551616\n",
    ),
    (
        "seeds beyond the largest",
        Parser,
        "version = 1\n{robots}{mazes}[seeds]\nfirst = 18446744073709551615\ncount = 2\n",
    ),
    (
        "unknown ruleset",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nbase = \"udacty\"\n",
    ),
    (
        "rules without a name",
        Schema,
        "version = 1\n{robots}{mazes}[rules.game]\nbudget = 500\n",
    ),
    (
        "rules with a bundled name",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"udacity\"\n[rules.game]\nbudget = 500\n",
    ),
    (
        "no budget",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"x\"\n[rules.game]\nbudget = 0\n",
    ),
    (
        "unknown scope",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"x\"\n[rules.game]\nbudget_scope = \"each\"\n",
    ),
    (
        "move of 256 cells",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"x\"\n[rules.game]\nlongest_move = 256\n",
    ),
    (
        "memory above 4 GiB",
        Schema,
        "version = 1\n{robots}{mazes}[rules]\nname = \"x\"\n[rules.sandbox]\nmemory_bytes_max = 4294967297\n",
    ),
    (
        "unknown method",
        Schema,
        "version = 1\n{robots}{mazes}[scoring]\nmethod = \"mean\"\n",
    ),
    (
        "penalty of 0 steps",
        Schema,
        "version = 1\n{robots}{mazes}[scoring]\nunfinished_steps = 0\n",
    ),
    (
        "penalty of 33 bits",
        Schema,
        "version = 1\n{robots}{mazes}[scoring]\nunfinished_steps = 4294967296\n",
    ),
    (
        "unknown tie-break",
        Schema,
        "version = 1\n{robots}{mazes}[scoring]\ntie_breaks = [\"finishd\"]\n",
    ),
    (
        "tie-break given twice",
        Schema,
        "version = 1\n{robots}{mazes}[scoring]\ntie_breaks = [\"fuel\", \"memory\", \"fuel\"]\n",
    ),
    (
        "no jobs",
        Schema,
        "version = 1\n{robots}{mazes}[run]\njobs = 0\n",
    ),
    (
        "time with a unit",
        Schema,
        "version = 1\n{robots}{mazes}[run]\nmatch_time_seconds = \"60s\"\n",
    ),
    (
        "unknown transcripts",
        Schema,
        "version = 1\n{robots}{mazes}[run]\nkeep_transcripts = \"bets\"\n",
    ),
    (
        "top 0",
        Schema,
        "version = 1\n{robots}{mazes}[report]\nshow_top = 0\n",
    ),
    (
        "file written twice",
        Parser,
        "version = 1\nstore = \"a.db\"\n{robots}{mazes}[outputs]\nhtml = \"a.html\"\ncsv = \"./a.db\"\n",
    ),
];
