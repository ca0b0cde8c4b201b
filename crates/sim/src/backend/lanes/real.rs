//! The number types of the kernel: one number, or one for each of several simulations.

use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// A number of the kernel. Every operation acts on each lane separately and rounds like IEEE double, without fused
/// multiply-add, so a lane has the same bits whatever is in the other lanes.
pub trait Real:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + AddAssign
    + SubAssign
    + std::fmt::Debug
    + 'static
{
    const LANES: usize;
    type Mask: Mask;
    fn splat(value: f64) -> Self;
    fn lane(&self, lane: usize) -> f64;
    fn set_lane(&mut self, lane: usize, value: f64);
    fn abs(self) -> Self;
    /// `self` if it is greater, else `other` (also for not-a-number).
    fn max(self, other: Self) -> Self;
    /// `self` if it is less, else `other` (also for not-a-number).
    fn min(self, other: Self) -> Self;
    fn below(self, other: Self) -> Self::Mask;
    fn at_most(self, other: Self) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// 1/sqrt(x) for positive x of single precision's range, root and quotient rounded to single precision.
    fn recip_sqrt_seed(self) -> Self;

    /// 1/sqrt(x) to a unit in the last place from its seed, by one cubic step: y + y e (1/2 + 3/8 e) with
    /// e = 1 - x y². Every step is exactly rounded, so the bits are the same on every machine.
    #[inline(always)]
    fn recip_sqrt_from(self, seed: Self) -> Self {
        let error = Self::splat(1.0) - self * (seed * seed);
        seed + (seed * error) * (Self::splat(0.5) + Self::splat(0.375) * error)
    }

    #[inline(always)]
    fn recip_sqrt(self) -> Self {
        self.recip_sqrt_from(self.recip_sqrt_seed())
    }
}

/// Methods that are compiled into their callers, with the vector instructions of those.
macro_rules! inlined {
    ($(fn $name:ident($($parameter:tt)*) $(-> $result:ty)? $body:block)*) => {
        $(
            #[inline(always)]
            fn $name($($parameter)*) $(-> $result)? $body
        )*
    };
}

/// Pasted, because a closure would be compiled without the vector instructions of the kernel.
macro_rules! operators {
    ([$($generics:tt)*] $vector:ty, |$one:ident, $other:ident| $add:expr, $sub:expr, $mul:expr) => {
        impl<$($generics)*> std::ops::Add for $vector {
            type Output = Self;

            inlined! { fn add(self, $other: Self) -> Self { let $one = self; $add } }
        }

        impl<$($generics)*> std::ops::Sub for $vector {
            type Output = Self;

            inlined! { fn sub(self, $other: Self) -> Self { let $one = self; $sub } }
        }

        impl<$($generics)*> std::ops::Mul for $vector {
            type Output = Self;

            inlined! { fn mul(self, $other: Self) -> Self { let $one = self; $mul } }
        }

        impl<$($generics)*> std::ops::AddAssign for $vector {
            inlined! { fn add_assign(&mut self, other: Self) { *self = *self + other; } }
        }

        impl<$($generics)*> std::ops::SubAssign for $vector {
            inlined! { fn sub_assign(&mut self, other: Self) { *self = *self - other; } }
        }
    };
}

pub(super) use {inlined, operators};

pub trait Mask: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// Lane i as bit i.
    fn bits(self) -> u32;
    fn from_bits(bits: u32) -> Self;
    fn or(self, other: Self) -> Self;
    fn and(self, other: Self) -> Self;

    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
}

impl Mask for bool {
    inlined! {
        fn bits(self) -> u32 { u32::from(self) }
        fn from_bits(bits: u32) -> Self { bits & 1 == 1 }
        fn or(self, other: Self) -> Self { self | other }
        fn and(self, other: Self) -> Self { self & other }
    }
}

impl Real for f64 {
    const LANES: usize = 1;

    type Mask = bool;

    inlined! {
        fn splat(value: f64) -> Self { value }
        fn lane(&self, _lane: usize) -> f64 { *self }
        fn set_lane(&mut self, _lane: usize, value: f64) { *self = value; }
        fn abs(self) -> Self { f64::abs(self) }
        fn max(self, other: Self) -> Self { if self > other { self } else { other } }
        fn min(self, other: Self) -> Self { if self < other { self } else { other } }
        fn below(self, other: Self) -> bool { self < other }
        fn at_most(self, other: Self) -> bool { self <= other }
        fn select(mask: bool, yes: Self, no: Self) -> Self { if mask { yes } else { no } }
        fn recip_sqrt_seed(self) -> Self { f64::from(1.0 / (self as f32).sqrt()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reciprocal_root_is_good_to_a_unit_in_the_last_place() {
        let mut x = 1e-6;
        while x < 10.0 {
            let exact = 1.0 / f64::sqrt(x);
            let ulps = (x.recip_sqrt().to_bits() as i64 - exact.to_bits() as i64).abs();
            assert!(ulps <= 2, "1/sqrt({x}) is {ulps} units off");
            x *= 1.000_317;
        }
    }
}
