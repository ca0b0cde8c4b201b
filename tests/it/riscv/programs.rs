//! The programs of `circuits/riscv/`, which a compiler for C made, run as in the reference.

use super::machine::Machine;
use super::reference::Reference;
use crate::support::*;

const PROGRAMS: [(&str, &str); 4] = [
    ("hello", "I am a swarm of robots.\n"),
    ("sort", "-65 -7 -4 2 15 31 35 89 92 93 "),
    ("crc32", "CBF43926"),
    ("primes", "2 3 5 7 11 13 17 19 23 29 31 37 41 43 47 "),
];

const MOST_CLOCKS: usize = 400_000;

fn words(name: &str) -> Vec<u32> {
    let text = fs::read_to_string(format!("circuits/riscv/{name}.hex")).unwrap();
    text.lines().map(|line| u32::from_str_radix(line, 16).unwrap()).collect()
}

#[test]
fn programs_write_what_they_should() {
    let mut machine = Machine::new();
    let mut references = vec![Reference::default(); PROGRAMS.len()];
    for (lane, (name, _)) in PROGRAMS.iter().enumerate() {
        for (address, word) in (0..).step_by(4).zip(words(name)) {
            machine.lanes[lane].memory.set_word(address, word);
            references[lane].memory.set_word(address, word);
        }
    }
    let mut clocks = vec![0; PROGRAMS.len()];
    for clock in 1..=MOST_CLOCKS {
        machine.clock(PROGRAMS.len());
        for (clocks, outside) in clocks.iter_mut().zip(&machine.lanes) {
            if outside.halted && *clocks == 0 {
                *clocks = clock;
            }
        }
        if clocks.iter().all(|&clocks| clocks > 0) {
            break;
        }
    }
    for (lane, (name, expected)) in PROGRAMS.iter().enumerate() {
        let (outside, reference) = (&machine.lanes[lane], &mut references[lane]);
        let mut instructions = 0;
        while !reference.halted {
            reference.run();
            instructions += 1;
        }
        println!("{name}: {instructions} instructions, {} clocks", clocks[lane]);
        assert!(outside.halted, "{name} ends");
        assert_eq!(String::from_utf8_lossy(&outside.output), *expected, "{name}");
        assert_eq!(outside.output, reference.output, "{name}");
        assert_eq!(outside.registers, reference.registers, "{name}");
        assert_eq!(outside.memory, reference.memory, "{name}");
    }
}
