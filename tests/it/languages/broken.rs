//! Broken projects: each gives one clear error.
