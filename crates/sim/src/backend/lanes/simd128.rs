//! Lanes of WebAssembly's vectors of 128 bits, two numbers in each. Engines translate these one by one, so that several
//! stand side by side.

#![expect(clippy::redundant_closure, reason = "functions of an instruction set are no values of `Fn`")]

use core::arch::wasm32::*;
use std::array::from_fn;

use crate::backend::lanes::real::{Mask, Real, inlined, operators};

pub type Four = Pairs<2>;

#[derive(Clone, Copy, Debug)]
pub struct Pairs<const N: usize>([v128; N]);

#[derive(Clone, Copy, Debug)]
pub struct PairMask<const N: usize>([v128; N]);

impl<const N: usize> Pairs<N> {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(v128, v128) -> v128) -> Self {
        Self(from_fn(|i| operation(self.0[i], other.0[i])))
    }
}

operators!(
    [const N: usize] Pairs<N>, |a, b|
    a.zip(b, |x, y| f64x2_add(x, y)),
    a.zip(b, |x, y| f64x2_sub(x, y)),
    a.zip(b, |x, y| f64x2_mul(x, y))
);

impl<const N: usize> Mask for PairMask<N> {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.iter().enumerate().fold(0, |bits, (i, &pair)| bits | u32::from(i64x2_bitmask(pair)) << (2 * i))
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        let lane = |i: usize| if bits >> i & 1 == 1 { -1 } else { 0 };
        Self(from_fn(|i| i64x2(lane(2 * i), lane(2 * i + 1))))
    }

    inlined! {
        fn or(self, other: Self) -> Self { Self(from_fn(|i| v128_or(self.0[i], other.0[i]))) }
        fn and(self, other: Self) -> Self { Self(from_fn(|i| v128_and(self.0[i], other.0[i]))) }
        fn any(self) -> bool {
            v128_any_true(self.0.into_iter().reduce(|a, b| v128_or(a, b)).expect("there are lanes"))
        }
    }
}

impl<const N: usize> Real for Pairs<N> {
    const LANES: usize = 2 * N;

    type Mask = PairMask<N>;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([f64x2_splat(value); N])
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        let pair = self.0[lane / 2];
        if lane.is_multiple_of(2) { f64x2_extract_lane::<0>(pair) } else { f64x2_extract_lane::<1>(pair) }
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        let pair = &mut self.0[lane / 2];
        *pair = match lane.is_multiple_of(2) {
            true => f64x2_replace_lane::<0>(*pair, value),
            false => f64x2_replace_lane::<1>(*pair, value),
        };
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(|pair| f64x2_abs(pair)))
    }

    // The pseudo-maximum of b and a is a where b < a, else b; so that of not-a-number is the other, as it must be.
    inlined! {
        fn max(self, other: Self) -> Self { self.zip(other, |a, b| f64x2_pmax(b, a)) }
        fn min(self, other: Self) -> Self { self.zip(other, |a, b| f64x2_pmin(b, a)) }
        fn below(self, other: Self) -> PairMask<N> { PairMask(self.zip(other, |a, b| f64x2_lt(a, b)).0) }
        fn at_most(self, other: Self) -> PairMask<N> { PairMask(self.zip(other, |a, b| f64x2_le(a, b)).0) }
        fn select(mask: PairMask<N>, yes: Self, no: Self) -> Self {
            Self(from_fn(|i| v128_bitselect(yes.0[i], no.0[i], mask.0[i])))
        }
    }

    #[inline(always)]
    fn recip_sqrt_seed(self) -> Self {
        let mut seeds = self.0;
        // Four numbers of single precision fill a vector.
        for pairs in seeds.chunks_exact_mut(2) {
            let (low, high) = (f32x4_demote_f64x2_zero(pairs[0]), f32x4_demote_f64x2_zero(pairs[1]));
            let four = f32x4_div(f32x4_splat(1.0), f32x4_sqrt(i64x2_shuffle::<0, 2>(low, high)));
            pairs[0] = f64x2_promote_low_f32x4(four);
            pairs[1] = f64x2_promote_low_f32x4(i64x2_shuffle::<1, 1>(four, four));
        }
        Self(seeds)
    }
}
