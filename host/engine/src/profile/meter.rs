//! [`Meter`]: from marks and fuel counters to the fuel of every path of calls.
//!
//! Pure bookkeeping: knows neither wasmtime nor time. What an instrumented component costs more than
//! the original is known exactly, because every wrapper is the same sequence of operators; the meter
//! takes it off, and the rest is the fuel of the match to the last unit.

use std::collections::HashMap;

use super::instrument::Mark;

/// Fuel that operators of wrappers cost; `runtime/cost.rs` and wasmtime's defaults.
const FUNCTION: u64 = 1;
const LOCAL_GET: u64 = 1;
const CALL: u64 = 3;

/// Paths of calls that are told apart, at most. Calls on other paths count for their callers.
pub(super) const NODES_MAX: usize = 50_000;

/// A path of calls: a function, called on the path of the parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    /// Index of the caller's node; `None` for calls from the host.
    pub(super) parent: Option<u32>,
    /// Index of the function.
    pub(super) function: u32,
    /// Fuel of the function itself on this path.
    pub(super) fuel: u64,
    /// How often it was called on this path.
    pub(super) calls: u64,
}

/// Adds up the fuel of one match.
pub(super) struct Meter {
    /// Parameters of each function.
    parameters: Vec<u64>,
    nodes: Vec<Node>,
    children: HashMap<(Option<u32>, u32), u32>,
    /// Nodes of the calls in progress, most recent last.
    stack: Vec<u32>,
    /// The counter of this call when the last mark came.
    last: u64,
    /// What the wrappers have cost since then.
    pending: u64,
    /// Fuel of this call without that of wrappers, as far as it is known.
    spent: u64,
    /// The node that was charged last.
    charged: usize,
    /// Whether a function cost less than its wrapper, which cannot be.
    is_wrong: bool,
    /// Calls on paths that are not told apart.
    collapsed: u64,
}

impl Meter {
    /// A meter for functions with so many parameters.
    pub(super) fn new(parameters: Vec<u64>) -> Self {
        Self {
            parameters,
            nodes: Vec::new(),
            children: HashMap::new(),
            stack: Vec::new(),
            last: 0,
            pending: 0,
            spent: 0,
            charged: 0,
            is_wrong: false,
            collapsed: 0,
        }
    }

    /// A call of the host begins: `start`, or a step.
    pub(super) fn begin(&mut self) {
        self.stack.clear();
        (self.last, self.pending, self.spent) = (0, 0, 0);
    }

    /// Fuel of the call in progress, without that of wrappers, until the last mark.
    pub(super) const fn spent(&self) -> u64 {
        self.spent
    }

    /// A mark at which the call in progress had used `counter` units, wrappers included.
    pub(super) fn mark(&mut self, mark: Mark, counter: u64) {
        match mark {
            Mark::Enter { function } => {
                let Some(&parameters) = self.parameters.get(function) else {
                    return;
                };
                self.charge(counter);
                self.push(u32::try_from(function).unwrap_or(u32::MAX));
                self.pending = FUNCTION + parameters * LOCAL_GET + CALL;
            }
            Mark::Leave => {
                self.pending += CALL;
                self.charge(counter);
                self.stack.pop();
                self.pending = FUNCTION;
            }
        }
    }

    /// The call of the host that used so much fuel in the match has returned.
    pub(super) fn end(&mut self, fuel: u64) {
        self.is_wrong |= self.spent != fuel || !self.stack.is_empty();
    }

    /// The call of the host that used so much fuel in the match has ended in a fault. What came
    /// after the last mark belongs to the function that was running; what this match has used more,
    /// because it ended at the next mark, to none.
    pub(super) fn end_with_fault(&mut self, fuel: u64) {
        if let Some(more) = self.spent.checked_sub(fuel) {
            match self.nodes.get_mut(self.charged) {
                Some(node) if node.fuel >= more => node.fuel -= more,
                _ => self.is_wrong |= more > 0,
            }
        } else {
            self.spend(fuel - self.spent);
        }
        self.stack.clear();
    }

    /// The paths; `None` when the numbers contradict each other.
    pub(super) fn finish(self) -> Option<(Vec<Node>, u64)> {
        (!self.is_wrong).then_some((self.nodes, self.collapsed))
    }

    fn charge(&mut self, counter: u64) {
        let used = counter.checked_sub(self.last);
        match used.and_then(|it| it.checked_sub(self.pending)) {
            Some(fuel) => self.spend(fuel),
            None => self.is_wrong = true,
        }
        self.last = counter;
    }

    fn spend(&mut self, fuel: u64) {
        self.spent += fuel;
        // Without a call in progress, it was the last one.
        if let Some(&running) = self.stack.last() {
            self.charged = running as usize;
        }
        match self.nodes.get_mut(self.charged) {
            Some(node) => node.fuel += fuel,
            None => self.is_wrong |= fuel > 0,
        }
    }

    fn push(&mut self, function: u32) {
        let parent = self.stack.last().copied();
        let key = (parent, function);
        let node = match self.children.get(&key) {
            Some(&node) => node,
            None if self.nodes.len() < NODES_MAX => {
                let node = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
                self.nodes.push(Node {
                    parent,
                    function,
                    fuel: 0,
                    calls: 0,
                });
                self.children.insert(key, node);
                node
            }
            None => {
                self.collapsed += 1;
                self.stack.push(parent.unwrap_or(0));
                return;
            }
        };
        self.nodes[node as usize].calls += 1;
        self.stack.push(node);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn enter(function: usize) -> Mark {
        Mark::Enter { function }
    }

    /// A function with two parameters that calls one without, twice.
    #[test]
    fn wrappers_are_taken_off_and_the_rest_is_told_apart() {
        let mut meter = Meter::new(vec![2, 0]);
        for _ in 0..2 {
            meter.begin();
            meter.mark(enter(0), 0);
            // Its wrapper has cost 1 + 2 + 3, and it 10.
            meter.mark(enter(1), 16);
            // The wrapper 1 + 3, the function 7, the wrapper 3.
            meter.mark(Mark::Leave, 30);
            // The mark itself 1, the caller 5.
            meter.mark(enter(1), 36);
            meter.mark(Mark::Leave, 50);
            // The mark 1, the caller 2, the wrapper 3.
            meter.mark(Mark::Leave, 56);
            assert_eq!(meter.spent(), 31);
            meter.end(31);
        }
        let (nodes, collapsed) = meter.finish().expect("consistent numbers");
        let node = |parent, function, fuel, calls| Node {
            parent,
            function,
            fuel,
            calls,
        };
        assert_eq!(nodes, [node(None, 0, 34, 2), node(Some(0), 1, 28, 4)]);
        assert_eq!(collapsed, 0);
    }

    /// A call that ends in a trap has no marks for its ends.
    #[test]
    fn the_rest_belongs_to_the_function_that_was_running() {
        let mut meter = Meter::new(vec![0, 0]);
        meter.begin();
        meter.mark(enter(0), 0);
        meter.mark(enter(1), 10);
        meter.end_with_fault(1000);
        let (nodes, _) = meter.finish().expect("consistent numbers");
        let fuel: Vec<_> = nodes.iter().map(|it| it.fuel).collect();
        assert_eq!(fuel, [6, 994]);

        // It ended at a mark that came too late.
        let mut meter = Meter::new(vec![0]);
        meter.begin();
        meter.mark(enter(0), 0);
        meter.mark(enter(0), 104);
        meter.end_with_fault(60);
        let (nodes, _) = meter.finish().expect("consistent numbers");
        let fuel: Vec<_> = nodes.iter().map(|it| it.fuel).collect();
        assert_eq!(fuel, [60, 0]);
    }

    #[test]
    fn numbers_that_contradict_each_other_are_found() {
        let mut meter = Meter::new(vec![0]);
        meter.begin();
        meter.mark(enter(0), 0);
        meter.mark(Mark::Leave, 3);
        assert!(meter.finish().is_none(), "less than its wrapper");
        let mut meter = Meter::new(vec![0]);
        meter.begin();
        meter.mark(enter(0), 0);
        meter.mark(Mark::Leave, 20);
        meter.end(12);
        assert!(meter.finish().is_none(), "more than the match");
    }

    #[test]
    fn paths_are_limited_and_nothing_is_lost() {
        let mut meter = Meter::new(vec![0]);
        meter.begin();
        let mut counter = 0;
        for _ in 0..NODES_MAX + 100 {
            meter.mark(enter(0), counter);
            counter += 10;
        }
        meter.end_with_fault(u64::MAX / 2);
        let (nodes, collapsed) = meter.finish().expect("consistent numbers");
        assert_eq!((nodes.len(), collapsed), (NODES_MAX, 100));
        let sum: u64 = nodes.iter().map(|it| it.fuel).sum();
        assert_eq!(sum, u64::MAX / 2);
    }
}
