//! Every instruction of RV32I with random and with extreme operands, against the reference.

use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::machine::Machine;
use super::reference::Reference;
use nbc_circuit::waves::LANES;

/// Instructions by name: the bits that are fixed, and those that may be anything.
const INSTRUCTIONS: [(&str, u32, u32); 40] = [
    ("lui", 0x37, 0xffff_ff80),
    ("auipc", 0x17, 0xffff_ff80),
    ("jal", 0x6f, 0xffff_ff80),
    ("jalr", 0x67, 0xffff_8f80),
    ("beq", 0x0063, 0xffff_8f80),
    ("bne", 0x1063, 0xffff_8f80),
    ("blt", 0x4063, 0xffff_8f80),
    ("bge", 0x5063, 0xffff_8f80),
    ("bltu", 0x6063, 0xffff_8f80),
    ("bgeu", 0x7063, 0xffff_8f80),
    ("lb", 0x0003, 0xffff_8f80),
    ("lh", 0x1003, 0xffff_8f80),
    ("lw", 0x2003, 0xffff_8f80),
    ("lbu", 0x4003, 0xffff_8f80),
    ("lhu", 0x5003, 0xffff_8f80),
    ("sb", 0x0023, 0xffff_8f80),
    ("sh", 0x1023, 0xffff_8f80),
    ("sw", 0x2023, 0xffff_8f80),
    ("addi", 0x0013, 0xffff_8f80),
    ("slti", 0x2013, 0xffff_8f80),
    ("sltiu", 0x3013, 0xffff_8f80),
    ("xori", 0x4013, 0xffff_8f80),
    ("ori", 0x6013, 0xffff_8f80),
    ("andi", 0x7013, 0xffff_8f80),
    ("slli", 0x1013, 0x01ff_8f80),
    ("srli", 0x5013, 0x01ff_8f80),
    ("srai", 0x4000_5013, 0x01ff_8f80),
    ("add", 0x0033, 0x01ff_8f80),
    ("sub", 0x4000_0033, 0x01ff_8f80),
    ("sll", 0x1033, 0x01ff_8f80),
    ("slt", 0x2033, 0x01ff_8f80),
    ("sltu", 0x3033, 0x01ff_8f80),
    ("xor", 0x4033, 0x01ff_8f80),
    ("srl", 0x5033, 0x01ff_8f80),
    ("sra", 0x4000_5033, 0x01ff_8f80),
    ("or", 0x6033, 0x01ff_8f80),
    ("and", 0x7033, 0x01ff_8f80),
    ("fence", 0x000f, 0xffff_8f80),
    ("ecall", 0x0073, 0),
    ("ebreak", 0x0010_0073, 0),
];

/// Instructions that each lane runs.
const ROUNDS: usize = 4;

/// A word that may be one of the extreme ones.
fn operand(random: &mut ChaCha8Rng) -> u32 {
    const EXTREMES: [u32; 8] = [0, 1, 2, 31, 32, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff];
    match random.random_range(0..3) {
        0 => *EXTREMES.choose(random).unwrap(),
        1 => random.random_range(0..40),
        _ => random.random(),
    }
}

/// Gives a machine and its reference an instruction, and registers of which some are equal.
fn prepare(word: u32, machine: &mut super::machine::Outside, reference: &mut Reference, random: &mut ChaCha8Rng) {
    reference.memory.set_word(reference.pc, word);
    machine.memory.set_word(reference.pc, word);
    for register in 1..32 {
        reference.registers[register] = operand(random);
    }
    if random.random_range(0..4) == 0 {
        reference.registers.copy_within(1..16, 16);
    }
    machine.registers = reference.registers;
}

/// The clocks of an instruction: those of two passes or of three.
fn clocks(word: u32) -> usize {
    let prepares = match (word >> 2 & 31, word >> 12 & 7) {
        (0b00000 | 0b01000 | 0b11000 | 0b11100, _) => true,
        (0b00100 | 0b01100, function) => matches!(function, 1 | 2 | 3 | 5),
        _ => false,
    };
    if prepares { 96 } else { 64 }
}

/// Runs random instructions of these kinds in all lanes, and compares everything outside after each.
fn check(kinds: &[(&str, u32, u32)], rounds: usize, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut machine = Machine::new();
    let mut references = vec![Reference::default(); LANES];
    // The first pass executes a load to x0, and its last clock sends the address of the first instruction.
    (0..32).for_each(|_| machine.clock(LANES));
    let mut left = vec![(0, 0, ""); LANES];
    while left.iter().any(|&(_, round, _)| round <= rounds) {
        for (lane, (clocks_left, round, name)) in left.iter_mut().enumerate() {
            let (outside, reference) = (&mut machine.lanes[lane], &mut references[lane]);
            if *clocks_left == 0 {
                if *round > 0 {
                    let before = reference.clone();
                    reference.run();
                    let what = || format!("{name} {:08x} of {before:x?}", before.memory.word(before.pc));
                    assert_eq!(outside.registers, reference.registers, "{}", what());
                    assert_eq!(outside.memory, reference.memory, "{}", what());
                    assert_eq!(outside.halted, reference.halted, "{}", what());
                }
                if !reference.halted {
                    assert_eq!(outside.address, reference.pc, "pc after {name}");
                    // The first instruction jumps, so that addresses are anything.
                    let (kind, fixed, free) = if *round == 0 {
                        ("jalr", 0x67, 0xfff0_0000 | 0x7 << 15)
                    } else {
                        *kinds.choose(&mut random).unwrap()
                    };
                    let word = fixed | random.random::<u32>() & free;
                    prepare(word, outside, reference, &mut random);
                    (*clocks_left, *name) = (clocks(word), kind);
                } else {
                    *clocks_left = 96;
                }
                *round += 1;
            }
            *clocks_left -= 1;
        }
        machine.clock(LANES);
    }
}

#[test]
fn every_instruction_does_what_the_specification_says() {
    for (seed, kind) in (0..).zip(INSTRUCTIONS) {
        check(&[kind], ROUNDS, seed);
    }
}

#[test]
fn instructions_leave_nothing_behind_for_others() {
    check(&INSTRUCTIONS[..38], 100, 99);
}
