//! The clocks of robots that count their own cycles (docs/physics.md 15).

use nbc_base::model::CYCLE_STEPS;

/// Env steps after which clocks that drift are set. In this time none drifts by more than one env step.
pub(crate) const WIND_STRIDE: u32 = 7;

const WHOLE: i64 = 1_000_000;

/// The clock of a robot, whose cycles are ahead of the world's and shorter or longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OwnClock {
    /// Env steps by which it is ahead at the start.
    pub phase: u32,
    /// Millionths by which it is faster.
    pub rate: i32,
}

impl OwnClock {
    /// What it shows at an env step of the world, from 0.
    pub(crate) fn at(self, env_step: u32) -> u32 {
        let wound = i64::from(env_step - env_step % WIND_STRIDE);
        let gained = (wound * i64::from(self.rate)).div_euclid(WHOLE);
        (i64::from(env_step + self.phase) + gained) as u32
    }

    pub(crate) fn ends_at(self, env_step: u32) -> bool {
        self.at(env_step) / CYCLE_STEPS > self.at(env_step - 1) / CYCLE_STEPS
    }

    /// Env steps of the world in `cycles` of its own.
    pub(crate) fn world_steps(self, cycles: usize) -> usize {
        let steps = cycles as i64 * i64::from(CYCLE_STEPS);
        (steps * WHOLE / (WHOLE + i64::from(self.rate))) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_is_ahead_and_gains_or_loses_without_going_back() {
        let common = OwnClock::default();
        assert!((0..500).all(|step| common.at(step) == step));
        for rate in [-100_000, -20_000, -1_000, 1_000, 20_000, 100_000] {
            let clock = OwnClock { phase: 30, rate };
            let shown: Vec<u32> = (0..84_001).map(|step| clock.at(step)).collect();
            assert!(shown.is_sorted());
            assert_eq!(shown[0], 30);
            assert_eq!(i64::from(shown[84_000]), 84_030 + 84 * i64::from(rate) / 1000);
            let ends = (1..=84_000).filter(|&step| clock.ends_at(step)).count() as u32;
            assert_eq!(ends, shown[84_000] / 84, "each cycle ends once");
        }
    }
}
