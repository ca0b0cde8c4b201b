//! The language: from text to a tree, from a tree to a program, and back to canonical text.

pub mod check;
pub mod syntax;
