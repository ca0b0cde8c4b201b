//! Swarms of long tests are kept, and go on with the same bits.

use nbc_session::store::SwarmCheckpoint;
use nbc_session::{Checked, Observer, RunEnd, SwarmKeeper, TestCase, TestRun};
use nbc_swarm::{KeptSwarm, SwarmTask};

use crate::support::*;

const TEXT: &str = "circuit toggle(go, clk) -> (q, p) { q = register(q xor go, clk)\n p = q nand go }\n\
                    test toggle {\n go clk | q p\n 1 ^ | 1 0\n 0 ^ | 1 1\n 1 ^ | 0 1\n}\n";

/// Keeps a swarm in memory, and stops after so many cycles.
#[derive(Default)]
struct MemoryKeeper {
    task: Option<SwarmTask>,
    kept: Option<KeptSwarm>,
    cycles: u64,
    stop_after: u64,
}

impl Observer for MemoryKeeper {
    fn progress(&mut self, done: u64, _: u64) {
        self.cycles = done;
    }

    fn is_cancelled(&self) -> bool {
        self.cycles == self.stop_after
    }

    fn keeper(&mut self) -> Option<&mut dyn SwarmKeeper> {
        Some(self)
    }
}

impl SwarmKeeper for MemoryKeeper {
    fn begin(&mut self, task: &SwarmTask) -> Option<KeptSwarm> {
        self.task = Some(task.clone());
        self.kept.clone()
    }

    fn is_due(&mut self) -> bool {
        false
    }

    fn keep(&mut self, kept: &KeptSwarm) {
        self.kept = Some(kept.clone());
    }

    fn end(&mut self) {
        self.kept = None;
    }
}

fn case(checked: &Checked) -> TestCase {
    checked.cases(&checked.program.tests[0], &in_physics()).unwrap().remove(0)
}

fn bits(run: &TestRun) -> Vec<Vec<bool>> {
    run.swarm.as_ref().unwrap().trace.cycles.iter().map(|cycle| cycle.bits.clone()).collect()
}

#[test]
fn a_kept_swarm_goes_on_with_the_same_bits() {
    let (session, checked) = session_of(TEXT);
    let whole = session.run_case(case(&checked), &mut ());
    assert!(whole.verdict.passed && whole.end == RunEnd::Complete);
    let mut keeper = MemoryKeeper { stop_after: 9, ..MemoryKeeper::default() };
    let part = session.run_case(case(&checked), &mut keeper);
    assert_eq!((part.end, keeper.kept.as_ref().unwrap().cycles()), (RunEnd::Cancelled, 9));
    keeper.stop_after = 21;
    session.run_case(case(&checked), &mut keeper);
    assert_eq!(keeper.kept.as_ref().unwrap().cycles(), 21);
    keeper.stop_after = 0;
    let rest = session.run_case(case(&checked), &mut keeper);
    assert_eq!(bits(&rest), bits(&whole));
    assert_eq!(rest.verdict, whole.verdict);
    assert!(keeper.kept.is_none(), "nothing is left after the end");
}

#[test]
fn a_file_of_a_swarm_belongs_to_its_test() {
    let (session, checked) = session_of(TEXT);
    let mut keeper = MemoryKeeper { stop_after: 5, ..MemoryKeeper::default() };
    session.run_case(case(&checked), &mut keeper);
    let (task, kept) = (keeper.task.take().unwrap(), keeper.kept.take().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("test.swarm");
    assert_eq!(SwarmCheckpoint::open(&path, &task), Ok(None));
    SwarmCheckpoint::new(&task, kept.clone()).save(&path).unwrap();
    assert_eq!(SwarmCheckpoint::open(&path, &task).unwrap().unwrap().swarm, kept);
    let mut other = task.clone();
    other.conditions.inputs[0][0] = !other.conditions.inputs[0][0];
    let error = SwarmCheckpoint::open(&path, &other).unwrap_err();
    assert!(error.message.ends_with("belongs to another swarm or other rows"), "{}", error.message);
    let mut bytes = fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).unwrap();
    let error = SwarmCheckpoint::open(&path, &task).unwrap_err();
    assert!(error.message.ends_with("is damaged: its checksum does not match"), "{}", error.message);
    fs::write(&path, "nbc-checkpoint 2 0 0\n\n").unwrap();
    assert!(SwarmCheckpoint::open(&path, &task).is_err());
}

#[test]
fn a_command_goes_on_with_a_kept_swarm() {
    let bench = Bench::new();
    let rows = TEXT.replace(" 1 ^ | 1 0\n", " 1 ^ | 1 0\n repeat 4 {\n 1 ^ | - -\n 1 ^ | 1 0\n }\n");
    bench.file("a.nb", &rows);
    let whole = bench.ok("test a.nb --physics --format json");
    let arguments = ["test", "a.nb", "--physics", "--format", "json", "--checkpoints", "kept/deep"];
    let kept = bench.path().join("kept/deep/test-1.swarm");
    // The first cycles, as the program would have kept them.
    let (session, checked) = session_of(rows);
    let mut keeper = MemoryKeeper { stop_after: 30, ..MemoryKeeper::default() };
    session.run_case(case(&checked), &mut keeper);
    fs::create_dir_all(kept.parent().unwrap()).unwrap();
    SwarmCheckpoint::new(&keeper.task.unwrap(), keeper.kept.unwrap()).save(&kept).unwrap();
    let rest = bench.run(&arguments);
    assert_eq!((rest.status, &rest.out), (0, &whole.out), "{}", rest.err);
    assert!(!kept.exists(), "nothing is left of a test that is done");
}
