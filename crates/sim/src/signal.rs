//! The target width of each material in each env step (docs/physics.md 4 and 10).

use std::f64::consts::PI;

use crate::constants::Constants;
use nbc_base::model::{Drive, MaterialKind, Palette, Pattern};

/// The target widths of a palette's materials over time.
#[derive(Clone, Debug)]
pub struct Signals {
    /// Indexed by material code; code 0 has no target.
    signals: Vec<Signal>,
}

/// The target of a material, as a fraction of the rest width.
#[derive(Clone, Debug)]
enum Signal {
    /// The material is passive.
    Still,
    /// A sample for each env step of the period.
    Periodic { drive: Drive, clip: [f64; 2] },
    /// One of two, by whether a stimulus is present.
    Sensed { stimulus: usize, absent: f64, present: f64 },
}

impl Signals {
    /// The signals of a palette's materials, sampled and clipped.
    pub fn new(palette: &Palette, constants: &Constants) -> Self {
        let clip = |target: f64| target.clamp(constants.least_target, constants.greatest_target);
        let signal = |kind| match kind {
            MaterialKind::Rigid | MaterialKind::Soft => Signal::Still,
            // Computed on demand, because a period may be as long as a run.
            MaterialKind::Actuator(drive) => {
                Signal::Periodic { drive, clip: [constants.least_target, constants.greatest_target] }
            }
            MaterialKind::Sensor(response) => Signal::Sensed {
                stimulus: response.stimulus,
                absent: clip(response.absent),
                present: clip(response.present),
            },
        };
        let materials = palette.materials().iter().map(|material| signal(material.kind));
        Self { signals: std::iter::once(Signal::Still).chain(materials).collect() }
    }

    /// The target of a material in env step `env_step` (from 0) under a pattern; 1 for passive materials.
    pub fn target(&self, code: u8, env_step: u32, pattern: Pattern) -> f64 {
        match &self.signals[usize::from(code)] {
            Signal::Still => 1.0,
            Signal::Periodic { drive, clip: [least, greatest] } => sample(env_step, drive).clamp(*least, *greatest),
            Signal::Sensed { stimulus, absent, present } => {
                if pattern.has(*stimulus) {
                    *present
                } else {
                    *absent
                }
            }
        }
    }

    /// The number of codes, with code 0.
    #[cfg(feature = "gpu")]
    pub(crate) fn codes(&self) -> usize {
        self.signals.len()
    }

    /// The targets of all codes, code 0 first.
    pub fn targets(&self, env_step: u32, pattern: Pattern) -> impl Iterator<Item = f64> + '_ {
        (0..self.signals.len()).map(move |code| self.target(code as u8, env_step, pattern))
    }
}

/// A sine of `period` samples, both ends included, in env step `env_step` (docs/physics.md 10).
fn sample(env_step: u32, drive: &Drive) -> f64 {
    let Drive { period, phase, low, high } = *drive;
    let k = env_step % period.max(1);
    let angle = phase.to_radians() + 2.0 * PI * f64::from(k) / f64::from(period.saturating_sub(1).max(1));
    low + (libm::sin(angle) + 1.0) / 2.0 * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_signals_are_the_papers_to_the_last_bit() {
        let signals = Signals::new(&Palette::paper(), &Constants::default());
        for n in 0..200 {
            let k = f64::from(n % 84);
            let sine = 0.6 + (libm::sin(2.0 * PI * k / 83.0) + 1.0) / 2.0;
            let antiphase = 0.6 + (libm::sin(PI + 2.0 * PI * k / 83.0) + 1.0) / 2.0;
            let pattern = Pattern::PAIRS[2];
            assert_eq!(signals.target(3, n, pattern).to_bits(), sine.clamp(0.6, 1.6).to_bits());
            assert_eq!(signals.target(4, n, pattern).to_bits(), antiphase.clamp(0.6, 1.6).to_bits());
            assert_eq!([5, 6, 7, 8].map(|code| signals.target(code, n, pattern)), [0.6, 1.6, 1.6, 0.6]);
        }
    }

    #[test]
    fn targets_are_clipped() {
        let mut materials = Palette::paper().materials().to_vec();
        materials[4].kind = MaterialKind::Sensor(nbc_base::model::Response { stimulus: 0, absent: 9.0, present: -3.0 });
        let signals = Signals::new(&Palette::new(materials), &Constants::default());
        assert_eq!(signals.target(5, 0, Pattern::PAIRS[0]), 1.6);
        assert_eq!(signals.target(5, 0, Pattern::PAIRS[3]), 0.6);
    }
}
