//! Python: componentize-py, with its interpreter and the robot in one component.

mod messages;
mod project;
mod state;

pub use project::LANGUAGE;
