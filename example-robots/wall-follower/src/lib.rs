//! wall-follower
