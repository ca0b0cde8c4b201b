//! `nbc new`: a first program.

use std::path::PathBuf;

use clap::Args;

use crate::cli::options::new_path::new_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_circuit::formats::is_word;
use nbc_session::store;

/// `NAME` stands for the circuit's name, `FILE` for the path.
const STARTER: &str = "\
//! Adds two bits.
//!
//! `nbc check FILE` finds errors, `nbc test FILE` tests the circuit, made of soft robots, in
//! full physics, and `nbc run FILE` also draws its robots and writes a page with a film.

// A circuit has inputs, outputs and a line for each net. The order of the lines does not matter.
circuit NAME(a, b) -> (sum, carry) {
    sum   = a xor b
    carry = a and b
}

// Each row has inputs and the outputs that are expected of them. `-` is not checked.
test NAME \"adds\" {
    a b | sum carry
    0 0 | 0   0
    0 1 | 1   0
    1 0 | 1   -
    1 1 | 0   1
}
";

/// Write a first program with a test
#[derive(Args)]
#[command(after_help = "Examples:
  nbc new adder             writes adder.nb
  nbc new circuits/adder.nb
  nbc watch adder.nb        checks and tests it whenever it is saved

A file that exists is not changed.
Exit status: 0 done, 2 the file exists or cannot be written.")]
pub struct NewArguments {
    /// The name of the circuit, or the path of its file
    #[arg(value_parser = new_path())]
    name: PathBuf,
}

impl NewArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let path = self.name.with_extension("nb");
        let shown = path.display().to_string();
        let name = path.file_stem().and_then(|stem| stem.to_str()).filter(|stem| is_word(stem));
        let Some(name) = name else { return Err(wording::no_word(&shown).into()) };
        if context.format == OutputFormat::Json {
            return Err(wording::no_json("a first program").into());
        }
        if path.exists() {
            return Err(wording::exists(&shown).into());
        }
        let text = STARTER.replace("NAME", name).replace("FILE", &shown);
        store::write(&path, text.as_bytes()).map_err(|error| Failure::unwritable(&path, &error))?;
        context.print(format_args!("wrote {shown}; `nbc test {shown}` tests it\n"))?;
        Ok(Status::Done)
    }
}
