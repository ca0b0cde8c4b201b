//! The command line: a file for each command, named for it, with the arguments that clap reads and a `run` that does
//! it. A command with many parts is a folder. `nbc devices` is in `gpu`; `nbc worker` and `nbc workers` are in
//! `cluster`.
//!
//! A new command is a file, a `mod` line and a line of [`commands!`], both in alphabetical order.

mod bench;
mod bug_report;
mod build;
mod check;
#[cfg(feature = "cluster")]
mod cluster;
mod completions;
mod context;
mod documents;
mod draw;
mod evolution_folder;
mod evolve;
mod explain;
mod export;
mod failure;
mod fmt;
#[cfg(feature = "gpu")]
mod gpu;
mod harden;
mod in_order;
mod interrupt;
mod learn;
mod library;
mod lsp;
mod manual;
mod new;
#[cfg(not(feature = "gpu"))]
mod only_processor;
mod options;
mod output;
#[cfg(feature = "play")]
mod play;
mod progress;
mod prove;
mod robots;
mod run;
mod runs;
#[cfg(test)]
mod schemas;
mod see;
mod simulate;
mod source_path;
mod standard_input;
mod status;
mod synth;
mod task_executor;
mod test;
mod threads;
mod usage;
mod watch;
mod wording;
mod world_runs;

use std::ffi::OsString;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

#[cfg(feature = "gpu")]
pub use gpu::OpenDevice;
#[cfg(not(feature = "gpu"))]
pub use only_processor::OnlyProcessor as OpenDevice;

pub use context::{Context, OutputFormat};
pub use failure::Failure;
pub use interrupt::Interrupt;
pub use progress::Progress;
pub use status::Status;

macro_rules! commands {
    ($($(#[$when:meta])* $name:ident($module:ident::$arguments:ident),)*) => {
        #[derive(Subcommand)]
        enum Command {
            $($(#[$when])* $name($module::$arguments),)*
        }

        impl Command {
            fn run(self, context: &mut Context) -> Result<Status, Failure> {
                match self {
                    $($(#[$when])* Self::$name(arguments) => arguments.run(context),)*
                }
            }
        }
    };
}

commands! {
    Bench(bench::BenchArguments),
    BugReport(bug_report::BugReportArguments),
    Build(build::BuildArguments),
    Check(check::CheckArguments),
    Completions(completions::CompletionsArguments),
    #[cfg(feature = "gpu")]
    Devices(gpu::DevicesArguments),
    Draw(draw::DrawArguments),
    Evolve(evolve::EvolveArguments),
    Explain(explain::ExplainArguments),
    Export(export::ExportArguments),
    Fmt(fmt::FmtArguments),
    Learn(learn::LearnArguments),
    Library(library::LibraryArguments),
    Lsp(lsp::LspArguments),
    Manual(manual::ManualArguments),
    New(new::NewArguments),
    #[cfg(feature = "play")]
    Play(play::PlayArguments),
    Prove(prove::ProveArguments),
    Run(run::RunArguments),
    See(see::SeeArguments),
    Simulate(simulate::SimulateArguments),
    Synth(synth::SynthArguments),
    Test(test::TestArguments),
    Watch(watch::WatchArguments),
    #[cfg(feature = "cluster")]
    Worker(cluster::WorkerArguments),
    #[cfg(feature = "cluster")]
    Workers(cluster::WorkersArguments),
}

const EXAMPLES: &str = "\
Examples:
  nbc new adder                             write a first program
  nbc run circuits/latch.nb                 compile, simulate and test a circuit of robots
  nbc play circuits/latch.nb                the same live, in a browser
  nbc library list                          the built-in robots
  nbc simulate ROBOT --schedule '00*10 11*10'

Exit status: 0 done and every test passed, 1 a test failed, 2 bad input or usage, 4 interrupted.";

/// Circuits made of soft robots: compile, simulate, evolve.
#[derive(Parser)]
#[command(name = "nbc", version, after_help = EXAMPLES, subcommand_required = true, arg_required_else_help = true)]
struct Cli {
    #[command(flatten)]
    global: context::GlobalArguments,
    #[command(subcommand)]
    command: Command,
}

pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Status {
    let arguments = options::files::with_named_files(arguments);
    let parsed = usage::with_negative_numbers(Cli::command())
        .try_get_matches_from(&arguments)
        .and_then(|found| Cli::from_arg_matches(&found));
    let cli = match parsed {
        Ok(cli) => cli,
        Err(told) => return usage::tell(&told, &arguments, Cli::command),
    };
    let mut context = Context::new(&cli.global, Cli::command);
    let outcome = threads::start(&context)
        .and_then(|()| cli.command.run(&mut context))
        .and_then(|status| context.flush().map(|()| status));
    outcome.unwrap_or_else(|failure| context.report(failure))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// The options that choose how a circuit becomes a swarm.
    const MAKING: [&str; 6] = ["circuit", "effort", "library", "objective", "runs", "swarm"];

    #[test]
    fn options_that_choose_how_a_circuit_is_made_are_the_same_in_every_command() {
        let mut makers = BTreeSet::new();
        for command in Cli::command().get_subcommands() {
            let options: BTreeSet<&str> = command.get_arguments().filter_map(clap::Arg::get_long).collect();
            let found: Vec<&str> = MAKING.into_iter().filter(|option| options.contains(option)).collect();
            let expected: &[&str] = match command.get_name() {
                // It evolves robots, or lists those of a run: a run is all that it knows.
                "evolve" | "library" | "export" => &found,
                // It has a swarm of its own, and a flag to measure it.
                "bench" => &["swarm"],
                // One robot, by its name in a library.
                "simulate" => &["library"],
                // A circuit without a program, whose cells need not be robots.
                "synth" => &["effort", "library", "objective"],
                _ if found.is_empty() => continue,
                name => {
                    makers.insert(name.to_owned());
                    &MAKING
                }
            };
            assert_eq!(found, expected, "{}", command.get_name());
        }
        let mut all = BTreeSet::from(["build", "draw", "run", "test", "watch"].map(str::to_owned));
        if cfg!(feature = "play") {
            all.insert("play".to_owned());
        }
        assert_eq!(makers, all);
    }

    #[test]
    fn the_manual_names_every_command_and_option() {
        fn check(command: &clap::Command, path: &str, manual: &str) {
            assert!(manual.contains(path), "docs/commands.md does not name `{path}`");
            for option in command.get_arguments().filter_map(clap::Arg::get_long) {
                assert!(manual.contains(&format!("--{option}")), "docs/commands.md does not name `{path} --{option}`");
            }
            command.get_subcommands().for_each(|inner| check(inner, &format!("{path} {}", inner.get_name()), manual));
        }
        let pages = ["commands", "gpu", "cluster"]
            .map(|page| std::fs::read_to_string(format!("{}/docs/{page}.md", env!("CARGO_MANIFEST_DIR"))).unwrap());
        check(&Cli::command(), "nbc", &pages.concat());
    }
}
