//! The binary message that shows a page the swarm; docs/play-protocol.md has its layout.

use crate::history::{LoggedCycle, Poses};

pub(super) struct SwarmFrame<'a, L> {
    pub(super) number: u32,
    pub(super) frames: u32,
    /// Cycles done at this moment, the earliest to go back to, and the last of the log.
    pub(super) now: u32,
    pub(super) first: u32,
    pub(super) last: u32,
    pub(super) pace: f32,
    pub(super) runs: bool,
    /// The cycles that the page does not know yet, and the number of the first.
    pub(super) logged: (u32, L),
    /// The robots' centers of mass and leftmost points at the start, in voxels of the world.
    pub(super) starts: &'a [[f64; 2]],
    pub(super) poses: &'a [Poses],
    pub(super) view: &'a [usize],
}

impl<'a, L: ExactSizeIterator<Item = &'a LoggedCycle>> SwarmFrame<'a, L> {
    pub(super) fn encode(self) -> Vec<u8> {
        let (first_logged, log) = self.logged;
        let mut bytes = vec![1, self.frames as u8];
        bytes.extend((self.starts.len() as u16).to_le_bytes());
        for number in [self.now, self.first, self.last] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(self.pace.to_le_bytes());
        bytes.extend([u8::from(self.runs), self.number as u8, 0, 0]);
        bytes.extend(first_logged.to_le_bytes());
        bytes.extend((log.len() as u16).to_le_bytes());
        bytes.extend((self.view.len() as u16).to_le_bytes());
        for cycle in log {
            for bits in [&cycle.inputs, &cycle.bits, &cycle.outputs] {
                bytes.extend(packed(bits));
            }
            for (x, [start, _]) in cycle.com_x.iter().zip(self.starts) {
                bytes.extend(((x - start) as f32).to_le_bytes());
            }
            bytes.extend((cycle.flips.len() as u16).to_le_bytes());
            bytes.extend(cycle.flips.iter().flatten().flat_map(|number| number.to_le_bytes()));
        }
        for &robot in self.view {
            let (poses, [_, left]) = (&self.poses[robot], self.starts[robot]);
            bytes.extend((robot as u16).to_le_bytes());
            bytes.extend((poses.points as u16).to_le_bytes());
            bytes.extend(((poses.origin - left) as f32).to_le_bytes());
            bytes.extend(poses.frames.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes
    }
}

/// Bits from the lowest bit of the first byte on.
fn packed(bits: &[bool]) -> impl Iterator<Item = u8> {
    bits.chunks(8).map(|byte| byte.iter().rev().fold(0, |byte, &bit| byte << 1 | u8::from(bit)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_fill_bytes_from_the_lowest_bit_on() {
        let bits = [true, false, false, false, false, false, false, true, true];
        assert_eq!(packed(&bits).collect::<Vec<u8>>(), [0x81, 1]);
        assert_eq!(packed(&[]).count(), 0);
    }

    #[test]
    fn a_message_has_the_documented_layout() {
        let cycles = [LoggedCycle {
            inputs: vec![true, false],
            bits: vec![true],
            outputs: vec![false, true],
            com_x: vec![12.5],
            flips: vec![[0, 40]],
        }];
        let poses = Poses { points: 1, origin: 11.0, frames: vec![100, -1] };
        let frame = SwarmFrame {
            number: 258,
            frames: 1,
            now: 3,
            first: 0,
            last: 4,
            pace: 4.0,
            runs: true,
            logged: (3, cycles.iter()),
            starts: &[[10.0, 8.0]],
            poses: &[poses],
            view: &[0],
        };
        let expected = [
            vec![1, 1, 1, 0, 3, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 128, 64, 1, 2, 0, 0, 3, 0, 0, 0, 1, 0, 1, 0],
            vec![1, 1, 2, 0, 0, 32, 64, 1, 0, 0, 0, 40, 0],
            vec![0, 0, 1, 0, 0, 0, 64, 64, 100, 0, 255, 255],
        ];
        assert_eq!(frame.encode(), expected.concat());
    }
}
