//! Any text is read as a robot or rejected. A robot that is read is the same after writing and reading it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_base::source::Sources;
use nbc_session::store;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("robot.yaml", text);
    if let Ok(robot) = store::read_robot(sources.file(file)) {
        let printed = store::print_robot(&robot);
        let again = sources.add("again.yaml", printed.clone());
        let read = store::read_robot(sources.file(again)).expect("a printed robot can be read");
        assert_eq!(store::print_robot(&read), printed, "a robot survives its file");
    }
});
