//! What users write on the command line for mazes, formats and rules.

use wasmouse::maze::format::Format;
use wasmouse::maze::generate::GenSpec;
use wasmouse::sim::Ruleset;

use super::Target;

pub(super) const TARGET: Target = Target {
    name: "specifications",
    about: "names of rulesets and formats, specifications of generated mazes",
    seeds,
    words: &[
        b"gen:",
        b"tree",
        b",loops=",
        b"braid",
        b"division",
        b"stretches",
        b"..=",
        b":",
        b"12",
        b"20",
        b"18446744073709551615",
    ],
    bytes_max: 256,
    make: || Box::new(run),
    short: 4000,
    takes_modules: false,
};

fn seeds() -> Vec<Vec<u8>> {
    let texts = [
        "gen:braid:12:1",
        "gen:tree,loops=15:12..=20:1..=100",
        "gen:division:14:7",
        "gen:stretches:16:0..=3",
        "udacity",
        "udacity-each-run",
        "competition",
    ];
    texts.map(|text| text.as_bytes().to_vec()).to_vec()
}

fn run(bytes: &[u8]) -> String {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return "no text".into();
    };
    if let Some(rules) = Ruleset::by_name(text) {
        return rules.name.to_owned();
    }
    if let Ok(format) = text.parse::<Format>() {
        return format.name().to_owned();
    }
    let spec: GenSpec = match text.parse() {
        Ok(spec) => spec,
        // The rest is the input.
        Err(error) => return error.to_string().chars().take(24).collect(),
    };
    let again: GenSpec = spec.to_string().parse().expect("what it says of itself");
    assert_eq!(again, spec, "printed and read");
    assert!(spec.count() > 0, "no mazes");
    let (name, maze) = spec.expand().next().expect("at least one maze");
    let alone: GenSpec = name.parse().expect("the name of one maze");
    let mazes: Vec<_> = alone.expand().collect();
    assert_eq!(mazes, [(name, maze)], "the maze by its name");
    format!("{:?}", spec.kind())
}
