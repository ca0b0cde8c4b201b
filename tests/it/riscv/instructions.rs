//! Every instruction of RV32I with random and with extreme operands, against the reference.

use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::machine::Machine;
use super::reference::Reference;
use nbc_circuit::waves::LANES;

/// Instructions by name, with the bits that are fixed; below, the bits that may be anything.
const INSTRUCTIONS: &str = "lui 37, auipc 17, jal 6f, jalr 67, beq 63, bne 1063, blt 4063, bge 5063, bltu 6063, \
    bgeu 7063, lb 3, lh 1003, lw 2003, lbu 4003, lhu 5003, sb 23, sh 1023, sw 2023, addi 13, slti 2013, sltiu 3013, \
    xori 4013, ori 6013, andi 7013, slli 1013, srli 5013, srai 40005013, add 33, sub 40000033, sll 1033, slt 2033, \
    sltu 3033, xor 4033, srl 5033, sra 40005033, or 6033, and 7033, fence f, ecall 73, ebreak 100073";

fn instructions() -> Vec<(&'static str, u32, u32)> {
    let one = |text: &'static str| {
        let (name, fixed) = text.trim().split_once(' ').unwrap();
        let free = match name {
            "lui" | "auipc" | "jal" => 0xffff_ff80,
            "slli" | "srli" | "srai" | "add" | "sub" | "sll" | "slt" | "sltu" | "xor" | "srl" | "sra" | "or"
            | "and" => 0x01ff_8f80,
            "ecall" | "ebreak" => 0,
            _ => 0xffff_8f80,
        };
        (name, u32::from_str_radix(fixed, 16).unwrap(), free)
    };
    INSTRUCTIONS.split(',').map(one).collect()
}

const ROUNDS: usize = 4;

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
    for (seed, kind) in (0..).zip(instructions()) {
        check(&[kind], ROUNDS, seed);
    }
}

#[test]
fn instructions_leave_nothing_behind_for_others() {
    check(&instructions()[..38], 100, 99);
}
