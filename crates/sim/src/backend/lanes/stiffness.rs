//! The stiffness of a batch's springs: one number if all lanes have the same body, else one per lane.

use crate::backend::lanes::real::{Mask, Real};

/// A spring's stiffness in every lane, in kilograms per substep squared; zero in lanes without the spring.
pub trait Stiffness<R: Real>: Copy + Send + Sync + std::fmt::Debug + 'static {
    fn none() -> Self;
    fn value(&self) -> R;
    fn set_lane(&mut self, lane: usize, stiffness: f64);
    fn mask(&self, mask: R::Mask) -> R::Mask;
}

#[derive(Clone, Copy, Debug)]
pub struct Common(f64);

#[derive(Clone, Copy, Debug)]
pub struct Own<R>(R);

impl<R: Real> Stiffness<R> for Common {
    fn none() -> Self {
        Self(0.0)
    }

    #[inline(always)]
    fn value(&self) -> R {
        R::splat(self.0)
    }

    fn set_lane(&mut self, lane: usize, stiffness: f64) {
        assert!(lane == 0 || self.0 == stiffness, "lanes of one body have the same springs");
        self.0 = stiffness;
    }

    #[inline(always)]
    fn mask(&self, mask: R::Mask) -> R::Mask {
        if self.0 > 0.0 { mask } else { R::Mask::from_bits(0) }
    }
}

impl<R: Real> Stiffness<R> for Own<R> {
    fn none() -> Self {
        Self(R::splat(0.0))
    }

    #[inline(always)]
    fn value(&self) -> R {
        self.0
    }

    fn set_lane(&mut self, lane: usize, stiffness: f64) {
        self.0.set_lane(lane, stiffness);
    }

    #[inline(always)]
    fn mask(&self, mask: R::Mask) -> R::Mask {
        mask.and(R::splat(0.0).below(self.0))
    }
}
