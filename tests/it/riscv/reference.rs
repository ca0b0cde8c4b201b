//! RV32I as its specification says it, an instruction at a time. Accesses need no alignment. A system instruction
//! halts.

use std::collections::BTreeMap;

/// What programs store here is their output.
pub const OUTPUT: u32 = 0x1000_0000;

/// Memory of bytes. What was not written has a value that its address determines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    written: BTreeMap<u32, u8>,
}

impl Memory {
    pub fn byte(&self, address: u32) -> u8 {
        let unwritten = || (address.wrapping_mul(0x9e37_79b1) >> 21) as u8;
        self.written.get(&address).copied().unwrap_or_else(unwritten)
    }

    pub fn set_byte(&mut self, address: u32, value: u8) {
        self.written.insert(address, value);
    }

    pub fn word(&self, address: u32) -> u32 {
        u32::from_le_bytes([0, 1, 2, 3].map(|at| self.byte(address.wrapping_add(at))))
    }

    pub fn set_word(&mut self, address: u32, value: u32) {
        for (at, byte) in (0..).zip(value.to_le_bytes()) {
            self.set_byte(address.wrapping_add(at), byte);
        }
    }
}

/// A machine between two instructions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reference {
    pub pc: u32,
    pub registers: [u32; 32],
    pub memory: Memory,
    pub halted: bool,
    /// The bytes that were stored at [`OUTPUT`].
    pub output: Vec<u8>,
}

fn bits(word: u32, low: u32, width: u32) -> u32 {
    word >> low & ((1 << width) - 1)
}

/// The immediates of the five formats, with sign.
fn immediate_i(word: u32) -> u32 {
    ((word as i32) >> 20) as u32
}

fn immediate_s(word: u32) -> u32 {
    immediate_i(word) & !0x1f | bits(word, 7, 5)
}

fn immediate_b(word: u32) -> u32 {
    immediate_s(word) & !0x801 | bits(word, 7, 1) << 11
}

fn immediate_u(word: u32) -> u32 {
    word & !0xfff
}

fn immediate_j(word: u32) -> u32 {
    immediate_i(word) & !0xf_f801 | word & 0xf_f000 | bits(word, 20, 1) << 11
}

impl Reference {
    /// Runs an instruction.
    ///
    /// # Panics
    /// When it is none of RV32I.
    pub fn run(&mut self) {
        let word = self.memory.word(self.pc);
        let (rd, rs1, rs2) = (bits(word, 7, 5) as usize, bits(word, 15, 5) as usize, bits(word, 20, 5) as usize);
        let (function, a, b) = (bits(word, 12, 3), self.registers[rs1], self.registers[rs2]);
        let next = self.pc.wrapping_add(4);
        let mut target = next;
        let result = match bits(word, 0, 7) {
            0b011_0111 => Some(immediate_u(word)),
            0b001_0111 => Some(self.pc.wrapping_add(immediate_u(word))),
            0b110_1111 => {
                target = self.pc.wrapping_add(immediate_j(word));
                Some(next)
            }
            0b110_0111 => {
                target = a.wrapping_add(immediate_i(word)) & !1;
                Some(next)
            }
            0b110_0011 => {
                if is_taken(function, a, b) {
                    target = self.pc.wrapping_add(immediate_b(word));
                }
                None
            }
            0b000_0011 => Some(self.load(function, a.wrapping_add(immediate_i(word)))),
            0b010_0011 => {
                let address = a.wrapping_add(immediate_s(word));
                for (at, byte) in (0..1 << function).zip(b.to_le_bytes()) {
                    self.memory.set_byte(address.wrapping_add(at), byte);
                }
                if address == OUTPUT {
                    self.output.push(b as u8);
                }
                None
            }
            // Bit 30 is part of the immediate, except in shifts to the right.
            0b001_0011 => Some(compute(function, function == 5 && bits(word, 30, 1) == 1, a, immediate_i(word))),
            0b011_0011 => Some(compute(function, bits(word, 30, 1) == 1, a, b)),
            0b000_1111 => None,
            0b111_0011 => {
                self.halted = true;
                return;
            }
            opcode => panic!("opcode {opcode:07b} of {word:08x} at {:08x}", self.pc),
        };
        if let Some(result) = result.filter(|_| rd != 0) {
            self.registers[rd] = result;
        }
        self.pc = target;
    }

    fn load(&self, function: u32, address: u32) -> u32 {
        let word = self.memory.word(address);
        match function {
            0b000 => i32::from(word as i8) as u32,
            0b001 => i32::from(word as i16) as u32,
            0b010 => word,
            0b100 => word & 0xff,
            0b101 => word & 0xffff,
            _ => panic!("load of function {function:03b}"),
        }
    }
}

fn compute(function: u32, other: bool, a: u32, b: u32) -> u32 {
    match (function, other) {
        (0b000, false) => a.wrapping_add(b),
        (0b000, true) => a.wrapping_sub(b),
        (0b001, _) => a << (b & 31),
        (0b010, _) => u32::from((a as i32) < b as i32),
        (0b011, _) => u32::from(a < b),
        (0b100, _) => a ^ b,
        (0b101, false) => a >> (b & 31),
        (0b101, true) => ((a as i32) >> (b & 31)) as u32,
        (0b110, _) => a | b,
        _ => a & b,
    }
}

fn is_taken(function: u32, a: u32, b: u32) -> bool {
    match function {
        0b000 => a == b,
        0b001 => a != b,
        0b100 => (a as i32) < b as i32,
        0b101 => a as i32 >= b as i32,
        0b110 => a < b,
        0b111 => a >= b,
        _ => panic!("branch of function {function:03b}"),
    }
}
