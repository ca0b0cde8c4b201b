//! Diagnostics as text for people, through miette.
