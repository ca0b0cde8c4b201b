//! The target width of each channel of a body in each env step (docs/physics.md 4 and 10).

use std::f64::consts::PI;

use crate::constants::Constants;
use crate::grid::Grid;
use nbc_base::model::{Body, Drive, MaterialKind, Palette, Response, Spell};

/// One for each material and for each voxel that senses an image, because what these sense depends on their places.
#[derive(Clone, Debug)]
pub struct Signals {
    /// Indexed by channel: first the material codes, of which code 0 has no target.
    signals: Vec<Signal>,
}

/// The target of a channel, as a fraction of the rest width.
#[derive(Clone, Copy, Debug)]
enum Signal {
    Still,
    Periodic { drive: Drive, clip: [f64; 2] },
    Sensed(Response),
    // By the value of an image over a place in a box: row and column, height and width.
    Seen { response: Response, place: [usize; 2], size: [usize; 2] },
}

impl Signals {
    pub fn new(palette: &Palette, constants: &Constants) -> Self {
        let signal = |kind| match kind {
            MaterialKind::Rigid | MaterialKind::Soft => Signal::Still,
            // Computed on demand, because a period may be as long as a run.
            MaterialKind::Actuator(drive) => {
                Signal::Periodic { drive, clip: [constants.least_target, constants.greatest_target] }
            }
            // Each voxel that senses an image has a channel of its own.
            MaterialKind::Sensor(Response { image: Some(_), .. }) => Signal::Still,
            MaterialKind::Sensor(response) => Signal::Sensed(clipped(response, constants)),
        };
        let materials = palette.materials().iter().map(|material| signal(material.kind));
        Self { signals: std::iter::once(Signal::Still).chain(materials).collect() }
    }

    pub fn of(mut self, body: &Body, constants: &Constants) -> Self {
        let size = [body.height(), body.width()];
        let seen = Grid::seeing(body).map(|(place, response)| {
            let response = clipped(response, constants);
            Signal::Seen { response, place, size }
        });
        self.signals.extend(seen);
        self
    }

    /// In env step `env_step` (from 0) under the stimuli of a spell; 1 for channels that nothing drives.
    pub fn target(&self, channel: usize, env_step: u32, spell: &Spell) -> f64 {
        match &self.signals[channel] {
            Signal::Still => 1.0,
            Signal::Periodic { drive, clip: [least, greatest] } => sample(env_step, drive).clamp(*least, *greatest),
            Signal::Sensed(response) => response.width(spell.value(response.stimulus)),
            Signal::Seen { response, place, size } => response.width(spell.value_over(*place, *size)),
        }
    }

    #[cfg(feature = "gpu")]
    pub(crate) fn channels(&self) -> usize {
        self.signals.len()
    }

    #[cfg(feature = "gpu")]
    pub(crate) fn is_of_body(&self) -> bool {
        self.signals.iter().any(|signal| matches!(signal, Signal::Seen { .. }))
    }

    pub fn targets<'a>(&'a self, env_step: u32, spell: &'a Spell) -> impl Iterator<Item = f64> + 'a {
        (0..self.signals.len()).map(move |channel| self.target(channel, env_step, spell))
    }
}

fn clipped(response: Response, constants: &Constants) -> Response {
    let clip = |target: f64| target.clamp(constants.least_target, constants.greatest_target);
    Response { absent: clip(response.absent), present: clip(response.present), ..response }
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
    use std::sync::Arc;

    use super::*;
    use nbc_base::model::{Image, ImageSize, Material, Pattern};

    #[test]
    fn the_papers_signals_are_the_papers_to_the_last_bit() {
        let signals = Signals::new(&Palette::paper(), &Constants::default());
        for n in 0..200 {
            let k = f64::from(n % 84);
            let sine = 0.6 + (libm::sin(2.0 * PI * k / 83.0) + 1.0) / 2.0;
            let antiphase = 0.6 + (libm::sin(PI + 2.0 * PI * k / 83.0) + 1.0) / 2.0;
            let spell = Spell::of(Pattern::PAIRS[2], 1);
            assert_eq!(signals.target(3, n, &spell).to_bits(), sine.clamp(0.6, 1.6).to_bits());
            assert_eq!(signals.target(4, n, &spell).to_bits(), antiphase.clamp(0.6, 1.6).to_bits());
            assert_eq!([5, 6, 7, 8].map(|code| signals.target(code, n, &spell)), [0.6, 1.6, 1.6, 0.6]);
        }
    }

    #[test]
    fn targets_are_clipped() {
        let mut materials = Palette::paper().materials().to_vec();
        materials[4].kind = MaterialKind::Sensor(Response::of(0, 9.0, -3.0));
        let signals = Signals::new(&Palette::new(materials), &Constants::default());
        assert_eq!(signals.target(5, 0, &Spell::of(Pattern::PAIRS[0], 1)), 1.6);
        assert_eq!(signals.target(5, 0, &Spell::of(Pattern::PAIRS[3], 1)), 0.6);
    }

    #[test]
    fn each_voxel_that_sees_has_the_target_of_its_place() {
        let mut materials = Palette::paper().materials().to_vec();
        let dark = Response { image: Some(ImageSize::new(2, 2)), ..Response::of(0, 1.6, 0.6) };
        materials.push(Material { name: "dark".to_owned(), kind: MaterialKind::Sensor(dark) });
        let body = Body::parse(&["93", "99"], &Arc::new(Palette::new(materials))).unwrap();
        let signals = Signals::new(body.palette(), &Constants::default()).of(&body, &Constants::default());
        let image = Image::new(ImageSize::new(2, 2), vec![0.0, 1.0, 1.0, 0.25]).unwrap();
        let spell = Spell { image: Some(Arc::new(image)), ..Spell::of(Pattern::default(), 1) };
        let targets: Vec<f64> = signals.targets(0, &spell).collect();
        assert_eq!(targets[9..], [1.0, 1.6, 0.6, 1.6 - 0.25]);
        let unseen: Vec<f64> = signals.targets(0, &Spell::of(Pattern::PAIRS[3], 1)).collect();
        assert_eq!(unseen[9..], [1.0, 1.6, 1.6, 1.6]);
        let grid = Grid::from(&body);
        assert_eq!(grid.channels(), targets.len());
    }
}
