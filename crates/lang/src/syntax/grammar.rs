//! The parser that pest generates from `grammar/nb.pest`.
#![allow(missing_docs, reason = "pest names one rule for each of the grammar's")]

use pest_derive::Parser;

#[derive(Parser)]
#[grammar = "../grammar/nb.pest"]
pub struct NbParser;
