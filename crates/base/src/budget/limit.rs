//! All limits of what texts from outside make, with their names; docs/limits.md has the same table.

macro_rules! limits {
    ($($name:ident = $most:expr, $things:literal, $scope:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Limit {
            $($name,)*
        }

        impl Limit {
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            pub const fn most(self) -> u64 {
                match self {
                    $(Self::$name => $most,)*
                }
            }

            pub const fn things(self) -> &'static str {
                match self {
                    $(Self::$name => $things,)*
                }
            }

            pub const fn scope(self) -> &'static str {
                match self {
                    $(Self::$name => $scope,)*
                }
            }
        }
    };
}

/// What a cycle counts beside its input bits in [`Limit::CycleBits`].
pub const CYCLE_BITS: u64 = 64;

limits! {
    SourceBytes = 8 << 20, "bytes", "of a source file";
    ProgramBytes = 16 << 20, "bytes", "of all source files of a program";
    Files = 256, "files", "of a program";
    Uses = 64, "levels", "of files that use each other";
    Words = 2_000_000, "words and signs", "of a declaration";
    NameBytes = 4096, "bytes", "of a name";
    Nesting = 64, "levels", "of brackets and `if`";
    Hierarchy = 200, "levels", "of circuits that contain each other";
    Width = 1 << 20, "bits", "of a net";
    TableRows = 4096, "rows", "of a truth table";
    TableBits = 64, "input bits", "of a truth table";
    Statements = 1_000_000, "statements and turns of loops", "of all circuits";
    Modules = 100_000, "circuits", "of a program, one for each choice of parameters";
    Instances = 1_000_000, "calls of circuits", "of a circuit, and of all circuits as written";
    Cells = 1_000_000, "cells", "of a circuit";
    Nets = 4_000_000, "bits of nets and gates", "of a circuit, and of all circuits as written";
    NetNameBytes = 256 << 20, "bytes of names of nets", "of a circuit, and of all circuits as written";
    Steps = 1 << 26, "steps to build circuits", "of a program: a bit of a value is one, a part of an expression 16";
    LoopSteps = 1 << 24, "steps to find loops without a start value", "of a program; after these, no loop is warned of";
    MemoryWords = 1 << 22, "words of memories", "of the environments of a program";
    TriedBits = 16, "input bits", "of a test over all inputs";
    Rows = 200_000, "rows of tests", "over all tests and worlds of a program, repeated ones counted each time";
    RowBits = 1 << 26, "bits in rows of tests", "over all tests and worlds of a program";
    LearnedBits = 1 << 16, "input bits times output bits", "of a circuit that is learned";
    Repetitions = 1_000_000, "repetitions", "of a row until an output has a value";
    PropertySteps = 1_000, "steps", "within which a property says that something happens";
    SwarmGates = 400_000, "gates", "of a circuit that is to be a swarm, before it is mapped";
    Robots = 100_000, "robots", "of a swarm";
    CycleBits = 1 << 28, "bits over all cycles", "of a test or a simulation: its inputs, and 64 more a cycle";
    RobotBytes = 1 << 20, "bytes", "of a robot file";
    RobotTextBytes = 4 << 20, "bytes of texts", "of a robot file, those of aliases counted each time";
    RobotNesting = 64, "levels", "of brackets in a robot file";
    CircuitFileBytes = 256 << 20, "bytes", "of a circuit file for `nbc synth`; for `use`, as of a source file";
    FileNameBytes = 1000, "bytes", "of a name in a circuit file";
    FilePins = 16_000_000, "nets and pins of gates", "of a BLIF, .bench or PLA file, those of models counted each time";
    ModelBytes = 512 << 20, "bytes", "of the models of a BLIF file, roughly, those inside others counted each time";
    AigerVariables = 4_000_000, "variables", "of an AIGER file";
    AigerPorts = 1_000_000, "inputs, and as many latches,", "of an AIGER file";
    VerilogFiles = 4096, "paths", "in quotes in Verilog files, which are looked for";
    VerilogBytes = 8 << 20, "bytes", "of the files that Verilog files name in quotes";
    ProgressBytes = 256 << 20, "bytes", "of the progress of an evolution run";
    CheckpointBytes = 1 << 30, "bytes", "of a checkpoint";
    PageMessage = 1 << 20, "bytes", "of a message of a page of `nbc play`";
    PageJobs = 4, "long requests", "of a page at once";
    PageSeconds = 600, "seconds", "of a long request of a page";
    PageRobots = 2000, "robots", "of a swarm on a page";
    PageRows = 65_536, "rows", "of a test that a page lists";
    PageRowBits = 4 << 20, "bits", "in the rows of a test that a page lists";
}
