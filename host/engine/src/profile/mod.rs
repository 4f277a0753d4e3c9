//! [`Profile`]: the fuel of one match by function.
//!
//! The robot is instrumented ([`instrument`]), so that each call and each return is announced to the
//! host, where fuel is exact; a [`Meter`](meter::Meter) adds it up by path of calls. Nothing is
//! sampled, so the same match has the same profile everywhere, and its sum is the fuel of the match.
//!
//! Other ways were worse: samples at epochs have a fuel counter that is as old as the last call, so a
//! loop would be blamed on whatever is called after it; samples by interval need fibers; and imports
//! of host functions would shift the indices of everything in a component.

mod instrument;
mod meter;
mod model;
mod play;

pub use model::{FunctionCost, Profile, ProfileNode, ProfiledFunction};
pub(crate) use play::{Expected, ProfileError, Profiler};
