//! Integration tests, in one binary.

mod physics;
mod pictures;
mod tidy;
