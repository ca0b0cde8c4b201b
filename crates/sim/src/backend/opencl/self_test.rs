//! The self-test of a device: bodies of every box of the paper, compared with this processor to the last bit.

use crate::backend::Backend;
use nbc_base::model::{Body, Fault, Pattern, Schedule, Setting, Trajectory, Trial};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SelfTest {
    sides: &'static [usize],
    bodies: usize,
    /// Env steps under each of two patterns.
    steps: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoxComparison {
    pub side: usize,
    pub trials: usize,
    pub different: usize,
}

impl SelfTest {
    pub const QUICK: Self = Self { sides: &[3], bodies: 9, steps: 6 };

    pub const FULL: Self = Self { sides: &[5, 7, 10], bodies: 24, steps: 84 };

    pub fn compare(self, device: &dyn Backend, processor: &dyn Backend) -> Vec<BoxComparison> {
        self.sides.iter().map(|&side| self.judge(device, processor, side)).collect()
    }

    fn judge(self, device: &dyn Backend, processor: &dyn Backend, side: usize) -> BoxComparison {
        let trials: Vec<Trial> = (0..self.bodies).map(|body| self.trial(side, body)).collect();
        let [found, expected] = [device, processor].map(|backend| backend.run_trials(&Setting::default(), &trials));
        let different = found.iter().zip(&expected).filter(|(found, expected)| bits(found) != bits(expected)).count();
        BoxComparison { side, trials: trials.len(), different }
    }

    fn trial(self, side: usize, body: usize) -> Trial {
        let whole = Body::patchwork(side, body);
        let holes =
            |place: usize, code: u8| if body % 2 == 1 && (place * 7 + body).is_multiple_of(5) { 0 } else { code };
        let codes = whole.codes().iter().enumerate().map(|(place, &code)| holes(place, code)).collect();
        let spells = [Pattern::PAIRS[body % 4], Pattern::PAIRS[(body + 1 + body / 4) % 4]];
        let mut schedule = Schedule::constant(spells[0], self.steps);
        schedule.spells.extend(Schedule::constant(spells[1], self.steps).spells);
        Trial { body: Body::new(side, side, codes, whole.palette().clone()), schedule }
    }
}

fn bits(trajectory: &Trajectory) -> (Vec<u64>, Option<Fault>) {
    let numbers = trajectory.com_x.iter().chain(&trajectory.com_y);
    (numbers.map(|number| number.to_bits()).collect(), trajectory.fault)
}
