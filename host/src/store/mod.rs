//! Results of contests in a SQLite database.
