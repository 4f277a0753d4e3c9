//! [`Profile`]: the fuel of one match by function and path of calls.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};
use wasmouse_core::GuestText;

use super::{instrument, meter};
use crate::runtime::{readable, shortened};

/// Bytes of all names together, at most, so that a profile fits into a message of a worker.
const NAMES_BYTES_MAX: usize = 1 << 20;

/// The fuel of one match by function and path of calls.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Profile {
    /// The functions that were called.
    pub functions: Vec<ProfiledFunction>,
    /// The paths of calls. A parent comes before its children.
    pub nodes: Vec<ProfileNode>,
    /// Calls on further paths, which count for their callers: there are at most 50,000 paths.
    pub collapsed: u64,
}

/// A function of a profile.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct ProfiledFunction {
    /// Its name, demangled and cut; or else `wasm-function[N]` with its index, and
    /// `module M` before it when the robot has several modules.
    pub name: GuestText,
}

/// A function, called on the path of its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProfileNode {
    /// Index of the caller's node; `None` for calls from the host.
    pub parent: Option<u32>,
    /// Index of the function.
    pub function: u32,
    /// Fuel of the function itself on this path.
    pub fuel: u64,
    /// How often it was called on this path.
    pub calls: u64,
}

/// What a function cost in all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FunctionCost {
    /// Fuel of the function itself.
    pub own: u64,
    /// Fuel of the function and of what it called; calls within calls of itself count once.
    pub total: u64,
    /// How often it was called.
    pub calls: u64,
}

impl Profile {
    /// The fuel of the match.
    pub fn fuel(&self) -> u64 {
        self.nodes.iter().map(|it| it.fuel).sum()
    }

    /// What each function cost, by index.
    pub fn costs(&self) -> Vec<FunctionCost> {
        let mut costs = vec![FunctionCost::default(); self.functions.len()];
        let mut seen = Vec::new();
        for node in &self.nodes {
            let own = &mut costs[node.function as usize];
            own.own += node.fuel;
            own.calls += node.calls;
            if node.fuel == 0 {
                continue;
            }
            seen.clear();
            seen.extend(self.path(node).map(|it| it.function));
            seen.sort_unstable();
            seen.dedup();
            for &function in &seen {
                costs[function as usize].total += node.fuel;
            }
        }
        costs
    }

    /// A node and its callers, most recent call first.
    pub fn path<'a>(&'a self, node: &'a ProfileNode) -> impl Iterator<Item = &'a ProfileNode> {
        let parent = |it: &&ProfileNode| it.parent.and_then(|at| self.nodes.get(at as usize));
        std::iter::successors(Some(node), move |it| parent(it))
    }

    /// The profile as it may have come from a worker that is not itself any more; `None` if it
    /// cannot be one of a match that used so much fuel.
    pub(crate) fn checked(mut self, fuel: u64) -> Option<Self> {
        let functions = self.functions.len();
        let is_sound = |(at, node): (usize, &ProfileNode)| {
            (node.function as usize) < functions
                && node.parent.is_none_or(|parent| (parent as usize) < at)
        };
        let mut sum = 0_u64;
        for node in &self.nodes {
            sum = sum.checked_add(node.fuel)?;
        }
        let calls = self
            .nodes
            .iter()
            .try_fold(0_u64, |sum, it| sum.checked_add(it.calls));
        if sum != fuel
            || calls.is_none()
            || self.nodes.len() > meter::NODES_MAX
            || !self.nodes.iter().enumerate().all(is_sound)
        {
            return None;
        }
        for function in &mut self.functions {
            function.name = shortened(&function.name);
        }
        Some(self)
    }

    /// The profile of nodes whose functions are numbered as in the component.
    pub(super) fn new(nodes: &[meter::Node], collapsed: u64, all: &[instrument::Function]) -> Self {
        let has_modules = all.iter().any(|it| it.module > 0);
        let mut profile = Self {
            collapsed,
            ..Self::default()
        };
        let mut names_bytes = 0;
        let mut indices: HashMap<u32, u32> = HashMap::new();
        for node in nodes {
            let function = *indices.entry(node.function).or_insert_with(|| {
                let mut name = name(&all[node.function as usize], has_modules);
                if names_bytes + name.len() > NAMES_BYTES_MAX {
                    name = format!("wasm-function[{}]", all[node.function as usize].index);
                }
                names_bytes += name.len();
                let name = name.into();
                profile.functions.push(ProfiledFunction { name });
                u32::try_from(profile.functions.len() - 1).unwrap_or(u32::MAX)
            });
            profile.nodes.push(ProfileNode {
                parent: node.parent,
                function,
                fuel: node.fuel,
                calls: node.calls,
            });
        }
        profile
    }
}

fn name(function: &instrument::Function, has_modules: bool) -> String {
    match &function.name {
        Some(name) => readable(name),
        None if has_modules => format!(
            "module {} wasm-function[{}]",
            function.module, function.index
        ),
        None => format!("wasm-function[{}]", function.index),
    }
}
