//! [`Gauge`]: compares what is found in a file with the limits.

use super::super::place::Place;
use super::super::rejection::Rejection;
use super::measure::{Measure, Measures, NS_IN_MS};
use super::spills::Spills;
use crate::limits::{COMPILE_THREADS, Limits};

/// Memory of the compiler before it compiles anything, in bytes.
const COMPILER_BYTES: u64 = 12 << 20;

/// What is found in a file, and the sums of its estimates.
pub(super) struct Gauge<'a> {
    limits: &'a Limits,
    found: Measures,
    /// The estimated time for the whole file so far, in ns.
    work_ns: u64,
    /// What is spilled in all functions so far; its time is not part of `work_ns`.
    spills: Spills,
    /// The estimated memory for what is kept until all is compiled, in bytes.
    kept_bytes: u64,
    /// The estimated memory for the largest functions while they are compiled, all at the same time, in
    /// bytes, ascending.
    largest_bytes: [u64; COMPILE_THREADS],
}

impl<'a> Gauge<'a> {
    pub(super) fn new(limits: &'a Limits) -> Self {
        Self {
            limits,
            found: Measures::default(),
            work_ns: 0,
            spills: Spills::default(),
            kept_bytes: COMPILER_BYTES,
            largest_bytes: [0; COMPILE_THREADS],
        }
    }

    pub(super) const fn found(&self) -> &Measures {
        &self.found
    }

    /// Notes a value.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`] when it is above the limit.
    pub(super) fn note(
        &mut self,
        measure: Measure,
        found: u64,
        byte: u64,
    ) -> Result<(), Rejection> {
        let greatest = self.found.get_mut(measure);
        *greatest = found.max(*greatest);
        let max = measure.max(self.limits);
        if found <= max {
            return Ok(());
        }
        Err(Rejection::OverLimit {
            what: measure.what(),
            found,
            max,
            at: Place::at(byte),
        })
    }

    /// Adds to a value that is a sum over the file.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`] when the sum is above the limit.
    pub(super) fn add(&mut self, measure: Measure, more: u64, byte: u64) -> Result<(), Rejection> {
        let sum = self.found.get(measure).saturating_add(more);
        self.note(measure, sum, byte)
    }

    /// Adds to the estimated memory for the file: what is kept until its end, and what is taken
    /// for a while.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`] when the sum is above the limit.
    pub(super) fn add_memory(
        &mut self,
        kept_bytes: u64,
        passing_bytes: u64,
        byte: u64,
    ) -> Result<(), Rejection> {
        self.kept_bytes = self.kept_bytes.saturating_add(kept_bytes);
        let [least, ..] = &mut self.largest_bytes;
        if passing_bytes > *least {
            *least = passing_bytes;
            self.largest_bytes.sort_unstable();
        }
        let largest = self.largest_bytes.into_iter();
        let bytes = largest.fold(self.kept_bytes, u64::saturating_add);
        self.note(Measure::Memory, bytes >> 20, byte)
    }

    /// Adds to the estimated time for the file.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`] when the sum is above the limit.
    pub(super) fn add_work(&mut self, work_ns: u64, byte: u64) -> Result<(), Rejection> {
        self.work_ns = self.work_ns.saturating_add(work_ns);
        self.note_work(byte)
    }

    /// Adds what a function spills to the estimated time for the file.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`] when the sum is above the limit.
    pub(super) fn add_spills(&mut self, spills: Spills, byte: u64) -> Result<(), Rejection> {
        self.spills.add(spills);
        self.note_work(byte)
    }

    fn note_work(&mut self, byte: u64) -> Result<(), Rejection> {
        let work_ns = self.work_ns.saturating_add(self.spills.work_ns());
        self.note(Measure::Work, work_ns / NS_IN_MS, byte)
    }
}
