//! A contest as one self-contained web page: [`page`] puts it together, and every other file
//! makes one section of it.

mod boxes;
mod method;
mod page;
mod parts;
mod pictures;
mod player;
mod plots;
mod scale;
mod scatter;
mod scores;
mod standings;

pub use page::html;
