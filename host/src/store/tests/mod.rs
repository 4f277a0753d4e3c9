//! Laws of stores, on contests that are played at random.

mod reading;
mod round_trip;
mod writing;
