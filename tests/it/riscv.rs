//! The processor of `circuits/riscv.nb` runs RV32I.

mod instructions;
mod machine;
mod physics;
mod programs;
mod reference;
