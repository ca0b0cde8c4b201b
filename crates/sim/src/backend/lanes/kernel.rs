//! The kernels: one step, compiled for each instruction set and number of lanes, chosen when the program runs.
//!
//! Two files of this crate have `unsafe` code: this one, and `opencl/card.rs` with the calls of a device's driver. Here
//! it is for vector types of an instruction set, and for calls of functions compiled for it. A vector is created only
//! inside [`Kernel::batch`], after checking that the processor has the instructions.
#![allow(unsafe_code, reason = "vectors of an instruction set that is asked for when the program runs")]

use crate::backend::lanes::batch::{Batch, Ground};
use crate::backend::lanes::lane_batch::LaneBatch;
use crate::backend::lanes::real::Real;
use crate::backend::lanes::step::env_step;
use crate::backend::lanes::stiffness::{Common, Own, Stiffness};
#[cfg(not(any(target_arch = "x86_64", target_family = "wasm")))]
use crate::backend::lanes::vector::Eight;
use crate::backend::lanes::vector::Four;
use crate::lattice::Lattice;
use crate::meter::Part;
use crate::state::State;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// SSE2 on x86-64, NEON on ARM, that which WebAssembly was compiled for.
    Baseline,
    /// AVX2 of x86-64: four numbers in a register.
    Avx2,
    /// AVX-512 F, DQ and VL of x86-64: eight numbers in a register.
    Avx512,
}

/// An instruction set, and the number of lanes. Every kernel gives the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    set: InstructionSet,
    lanes: usize,
}

impl Default for Kernel {
    fn default() -> Self {
        let set = InstructionSet::best();
        Self { set, lanes: set.most_lanes() }
    }
}

impl InstructionSet {
    /// The sets that this processor has, plainest first.
    pub fn available() -> Vec<Self> {
        [Self::Baseline, Self::Avx2, Self::Avx512].into_iter().filter(|set| set.is_available()).collect()
    }

    pub fn best() -> Self {
        Self::available().pop().expect("the baseline is always there")
    }

    fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// More would be several vectors, or not fit into the registers that engines of WebAssembly give to a function.
    fn most_lanes(self) -> usize {
        let by_vector = cfg!(any(target_arch = "x86_64", target_family = "wasm"));
        if by_vector && self != Self::Avx512 { 4 } else { 8 }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        }
    }
}

impl Kernel {
    pub const WIDTHS: [usize; 3] = [1, 4, 8];

    pub const SCALAR: Self = Self { set: InstructionSet::Baseline, lanes: 1 };

    /// `None` when the processor lacks the instructions, or so many lanes are several vectors, which are no faster.
    /// Panics unless `lanes` is 1, 4 or 8.
    pub fn new(set: InstructionSet, lanes: usize) -> Option<Self> {
        assert!(Self::WIDTHS.contains(&lanes), "kernels have 1, 4 or 8 lanes");
        (set.is_available() && lanes <= set.most_lanes()).then_some(Self { set, lanes })
    }

    /// A kernel whether the processor has its instructions or not, to reason about.
    #[cfg(test)]
    pub(crate) fn of(set: InstructionSet, lanes: usize) -> Self {
        Self { set, lanes }
    }

    /// Per voxel of any robot: 100 for eight different bodies with AVX-512 (docs/performance.md). `alike`: one body.
    pub(crate) fn cost(self, robots: usize, alike: bool) -> u64 {
        let (different, same) = match (self.set, robots) {
            (_, 1) => (51, 51),
            (InstructionSet::Avx512, 5..) => (100, 86),
            (InstructionSet::Avx512 | InstructionSet::Avx2, _) => (83, 72),
            (InstructionSet::Baseline, ..=4) => (152, 126),
            (InstructionSet::Baseline, _) => (304, 252),
        };
        if alike { same } else { different }
    }

    pub fn lanes(self) -> usize {
        self.lanes
    }

    pub fn set(self) -> InstructionSet {
        self.set
    }

    /// In no more lanes than needed. `alike` means that all have the same body.
    pub(crate) fn batch(self, robots: &[(&Lattice, &State)], alike: bool, ground: Ground<'_>) -> Box<dyn LaneBatch> {
        assert!(robots.len() <= self.lanes, "a robot for each lane at most");
        match (self.set, robots.len(), alike) {
            (_, 1, _) => layout::<f64, Common>(robots, ground, env_step),
            #[cfg(target_arch = "x86_64")]
            (InstructionSet::Avx512, 5.., true) => x86::avx512_8::<Common>(robots, ground),
            #[cfg(target_arch = "x86_64")]
            (InstructionSet::Avx512, 5.., false) => x86::avx512_8::<Own<_>>(robots, ground),
            #[cfg(target_arch = "x86_64")]
            (InstructionSet::Avx512 | InstructionSet::Avx2, _, true) => x86::avx2_4::<Common>(robots, ground),
            #[cfg(target_arch = "x86_64")]
            (InstructionSet::Avx512 | InstructionSet::Avx2, _, false) => x86::avx2_4::<Own<_>>(robots, ground),
            #[cfg(not(any(target_arch = "x86_64", target_family = "wasm")))]
            (_, 5.., true) => layout::<Eight, Common>(robots, ground, env_step),
            #[cfg(not(any(target_arch = "x86_64", target_family = "wasm")))]
            (_, 5.., false) => layout::<Eight, Own<_>>(robots, ground, env_step),
            (_, _, true) => layout::<Four, Common>(robots, ground, env_step),
            (_, _, false) => layout::<Four, Own<_>>(robots, ground, env_step),
        }
    }
}

fn layout<R: Real, K: Stiffness<R>>(
    robots: &[(&Lattice, &State)],
    ground: Ground<'_>,
    step: fn(&mut Batch<R, K>),
) -> Box<dyn LaneBatch> {
    let mut batch = Batch::<R, K>::new(robots, ground, step);
    batch.lap(Part::Bookkeeping);
    Box::new(batch)
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::*;

    use super::layout;
    use crate::backend::lanes::batch::{Batch, Ground};
    use crate::backend::lanes::lane_batch::LaneBatch;
    use crate::backend::lanes::real::{Mask, Real, inlined, operators};
    use crate::backend::lanes::step::env_step;
    use crate::backend::lanes::stiffness::Stiffness;
    use crate::lattice::Lattice;
    use crate::state::State;

    #[derive(Clone, Copy, Debug)]
    #[repr(transparent)]
    pub struct Avx512(__m512d);

    #[derive(Clone, Copy, Debug)]
    #[repr(transparent)]
    pub struct Avx2(__m256d);

    /// The comparison results of four lanes: all bits of a lane set, or none.
    #[derive(Clone, Copy, Debug)]
    pub struct Avx2Mask(__m256d);

    /// Eight lanes with AVX-512 instructions, which must be available.
    pub fn avx512_8<K: Stiffness<Avx512>>(robots: &[(&Lattice, &State)], ground: Ground<'_>) -> Box<dyn LaneBatch> {
        #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2")]
        fn step<K: Stiffness<Avx512>>(batch: &mut Batch<Avx512, K>) {
            env_step(batch);
        }
        // SAFETY: a kernel of this set is made only where the processor has it.
        layout::<Avx512, K>(robots, ground, |batch| unsafe { step(batch) })
    }

    /// Four lanes with AVX2 instructions, which must be available.
    pub fn avx2_4<K: Stiffness<Avx2>>(robots: &[(&Lattice, &State)], ground: Ground<'_>) -> Box<dyn LaneBatch> {
        #[target_feature(enable = "avx2")]
        fn step<K: Stiffness<Avx2>>(batch: &mut Batch<Avx2, K>) {
            env_step(batch);
        }
        // SAFETY: a kernel of this set is made only where the processor has it.
        layout::<Avx2, K>(robots, ground, |batch| unsafe { step(batch) })
    }

    // SAFETY: a vector of this type exists only where the processor has its instructions; so below.
    operators!(
        [] Avx512, |a, b|
        Self(unsafe { _mm512_add_pd(a.0, b.0) }),
        Self(unsafe { _mm512_sub_pd(a.0, b.0) }),
        Self(unsafe { _mm512_mul_pd(a.0, b.0) })
    );
    operators!(
        [] Avx2, |a, b|
        Self(unsafe { _mm256_add_pd(a.0, b.0) }),
        Self(unsafe { _mm256_sub_pd(a.0, b.0) }),
        Self(unsafe { _mm256_mul_pd(a.0, b.0) })
    );
    macro_rules! lane_access {
        () => {
            #[inline(always)]
            fn lane(&self, lane: usize) -> f64 {
                assert!(lane < Self::LANES, "the lane exists");
                // SAFETY: a vector is an array of doubles, and the lane is one of them.
                unsafe { *(&raw const self.0).cast::<f64>().add(lane) }
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, value: f64) {
                assert!(lane < Self::LANES, "the lane exists");
                // SAFETY: as above.
                unsafe { *(&raw mut self.0).cast::<f64>().add(lane) = value }
            }
        };
    }

    impl Mask for u8 {
        inlined! {
            fn bits(self) -> u32 { u32::from(self) }
            fn from_bits(bits: u32) -> Self { bits as u8 }
            fn or(self, other: Self) -> Self { self | other }
            fn and(self, other: Self) -> Self { self & other }
        }
    }

    impl Real for Avx512 {
        const LANES: usize = 8;

        type Mask = u8;

        lane_access!();

        inlined! {
            fn splat(value: f64) -> Self { Self(unsafe { _mm512_set1_pd(value) }) }
            fn abs(self) -> Self { Self(unsafe { _mm512_abs_pd(self.0) }) }
            fn max(self, other: Self) -> Self { Self(unsafe { _mm512_max_pd(self.0, other.0) }) }
            fn min(self, other: Self) -> Self { Self(unsafe { _mm512_min_pd(self.0, other.0) }) }
            fn below(self, other: Self) -> u8 { unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) } }
            fn at_most(self, other: Self) -> u8 { unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0) } }
            fn select(mask: u8, yes: Self, no: Self) -> Self {
                Self(unsafe { _mm512_mask_blend_pd(mask, no.0, yes.0) })
            }
        }

        #[inline(always)]
        fn recip_sqrt_seed(self) -> Self {
            Self(unsafe {
                let root = _mm256_sqrt_ps(_mm512_cvtpd_ps(self.0));
                _mm512_cvtps_pd(_mm256_div_ps(_mm256_set1_ps(1.0), root))
            })
        }
    }

    impl Mask for Avx2Mask {
        #[inline(always)]
        fn bits(self) -> u32 {
            unsafe { _mm256_movemask_pd(self.0) as u32 }
        }

        #[inline(always)]
        fn from_bits(bits: u32) -> Self {
            let lane = |i: u32| if bits >> i & 1 == 1 { -1 } else { 0 };
            Self(unsafe { _mm256_castsi256_pd(_mm256_setr_epi64x(lane(0), lane(1), lane(2), lane(3))) })
        }

        #[inline(always)]
        fn or(self, other: Self) -> Self {
            Self(unsafe { _mm256_or_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn and(self, other: Self) -> Self {
            Self(unsafe { _mm256_and_pd(self.0, other.0) })
        }
    }

    impl Real for Avx2 {
        const LANES: usize = 4;

        type Mask = Avx2Mask;

        lane_access!();

        inlined! {
            fn splat(value: f64) -> Self { Self(unsafe { _mm256_set1_pd(value) }) }
            fn abs(self) -> Self { Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) }) }
            fn max(self, other: Self) -> Self { Self(unsafe { _mm256_max_pd(self.0, other.0) }) }
            fn min(self, other: Self) -> Self { Self(unsafe { _mm256_min_pd(self.0, other.0) }) }
            fn below(self, other: Self) -> Avx2Mask {
                Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) })
            }
            fn at_most(self, other: Self) -> Avx2Mask {
                Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0) })
            }
            fn select(mask: Avx2Mask, yes: Self, no: Self) -> Self {
                Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0) })
            }
        }

        #[inline(always)]
        fn recip_sqrt_seed(self) -> Self {
            Self(unsafe {
                let root = _mm_sqrt_ps(_mm256_cvtpd_ps(self.0));
                _mm256_cvtps_pd(_mm_div_ps(_mm_set1_ps(1.0), root))
            })
        }
    }
}
