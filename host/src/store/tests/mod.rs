//! Laws of stores, on contests that are played at random.

mod build;
mod damage;
mod merging;
mod opening;
mod reading;
mod round_trip;
mod tamper;
mod writing;
