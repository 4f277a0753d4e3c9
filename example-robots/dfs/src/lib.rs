//! dfs
