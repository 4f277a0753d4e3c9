//! `wasmouse contest merge`: joins the stores of the parts of a contest.

use std::path::PathBuf;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output::{self, message};
use super::super::store_failure::store_failure;
use super::failures::print_hint;
use crate::report::number::{counted, counted_were};
use crate::report::text::{Text, text};
use crate::store::{MergeOptions, Store};

const EXAMPLES: &str = "\
Example:
  wasmouse contest run --shard 1/2 --store part-1.db    on one machine
  wasmouse contest run --shard 2/2 --store part-2.db    on another
  wasmouse contest merge contest.db part-1.db part-2.db
  wasmouse contest run                                  plays what is missing, writes reports

Exit codes:
  0  everything was merged
  1  some stores were not merged: they contradict others, or were changed
  3  a store is missing or is none";

/// Add the results of other stores to a store
///
/// A store is added completely or not at all. One that contradicts what is known, or was changed
/// since its contest ended, is refused by name. Merging a store again changes nothing.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The store to add to; created if it does not exist
    #[arg(value_name = "INTO")]
    into: PathBuf,
    /// The stores to add
    #[arg(value_name = "STORE", required = true)]
    stores: Vec<PathBuf>,
    /// Accept stores whose contests were interrupted
    #[arg(long)]
    unsealed: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let mut stores = Vec::with_capacity(args.stores.len());
    for path in &args.stores {
        stores.push(Store::open_read_only(path).map_err(store_failure)?);
    }
    let mut into = Store::create_or_open(&args.into).map_err(store_failure)?;
    let options = MergeOptions {
        require_seal: !args.unsealed,
    };
    let mut refused = 0;
    for (store, path) in stores.iter().zip(&args.stores) {
        match into.merge(store, options) {
            Ok(report) => {
                let line = text!(
                    "{}: {} added, {} there already\n",
                    Text::of_path(path),
                    counted(report.added, "match"),
                    counted_were(report.same, "match")
                );
                output::print(line.as_str())?;
            }
            Err(error) => {
                refused += 1;
                message!("error: not merged: {}", error);
                print_hint(&error);
            }
        }
    }
    if into.sealed().map_err(store_failure)?.is_none() {
        into.seal().map_err(store_failure)?;
    }
    Ok(if refused > 0 {
        Exit::CheckFailed
    } else {
        Exit::Success
    })
}
