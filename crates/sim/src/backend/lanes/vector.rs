//! Lanes as plain arrays: the portable form, which compilers translate to the vectors of the target.

use std::array::from_fn;

use crate::backend::lanes::real::{Mask, Real, inlined, operators};

pub type Four = Lanes<4>;
#[cfg(not(any(target_arch = "x86_64", target_family = "wasm")))]
pub type Eight = Lanes<8>;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Lanes<const N: usize>([f64; N]);

#[derive(Clone, Copy, Debug)]
pub struct LaneMask<const N: usize>([bool; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        Self(from_fn(|i| operation(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn compare(self, other: Self, relation: impl Fn(f64, f64) -> bool) -> LaneMask<N> {
        LaneMask(from_fn(|i| relation(self.0[i], other.0[i])))
    }
}

operators!([const N: usize] Lanes<N>, |a, b| a.zip(b, |x, y| x + y), a.zip(b, |x, y| x - y), a.zip(b, |x, y| x * y));

impl<const N: usize> Mask for LaneMask<N> {
    inlined! {
        fn bits(self) -> u32 { self.0.iter().enumerate().fold(0, |bits, (i, &lane)| bits | u32::from(lane) << i) }
        fn from_bits(bits: u32) -> Self { Self(from_fn(|i| bits >> i & 1 == 1)) }
        fn or(self, other: Self) -> Self { Self(from_fn(|i| self.0[i] | other.0[i])) }
        fn and(self, other: Self) -> Self { Self(from_fn(|i| self.0[i] & other.0[i])) }
    }
}

impl<const N: usize> Real for Lanes<N> {
    const LANES: usize = N;

    type Mask = LaneMask<N>;

    inlined! {
        fn splat(value: f64) -> Self { Self([value; N]) }
        fn lane(&self, lane: usize) -> f64 { self.0[lane] }
        fn set_lane(&mut self, lane: usize, value: f64) { self.0[lane] = value; }
        fn abs(self) -> Self { Self(from_fn(|i| self.0[i].abs())) }
        fn max(self, other: Self) -> Self { self.zip(other, |a, b| if a > b { a } else { b }) }
        fn min(self, other: Self) -> Self { self.zip(other, |a, b| if a < b { a } else { b }) }
        fn below(self, other: Self) -> LaneMask<N> { self.compare(other, |a, b| a < b) }
        fn at_most(self, other: Self) -> LaneMask<N> { self.compare(other, |a, b| a <= b) }
        fn select(mask: LaneMask<N>, yes: Self, no: Self) -> Self {
            Self(from_fn(|i| if mask.0[i] { yes.0[i] } else { no.0[i] }))
        }
        fn recip_sqrt_seed(self) -> Self { Self(from_fn(|i| f64::from(1.0 / (self.0[i] as f32).sqrt()))) }
    }
}
