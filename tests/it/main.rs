//! Integration tests, in one binary.

mod pictures;
mod tidy;
