//! The noise of a world for each robot (docs/physics.md 15). Each robot has a random stream of its own, so its noise
//! depends only on the world and the robot's number.

use std::sync::Arc;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::own_clock::OwnClock;
use nbc_base::model::{
    Body, CYCLE_STEPS, Drive, Material, MaterialKind, Palette, Response, Schedule, Spell, WorldNoise,
};

const DEAD: &str = "dead";

#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotNoise<'a> {
    noise: &'a WorldNoise,
    robot: u64,
}

#[derive(Clone, Copy)]
enum NoiseKind {
    Start,
    Missed,
    Dead,
    Clock,
}

impl<'a> RobotNoise<'a> {
    pub(crate) fn new(noise: &'a WorldNoise, robot: usize) -> Self {
        Self { noise, robot: robot as u64 }
    }

    fn rng(self, kind: NoiseKind) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(self.noise.seed);
        rng.set_stream(self.robot * 4 + kind as u64);
        rng
    }

    /// Voxels by which it starts to the right of its place.
    pub(crate) fn shift(self) -> f64 {
        if self.noise.start > 0.0 {
            self.noise.start * (2.0 * unit(&mut self.rng(NoiseKind::Start)) - 1.0)
        } else {
            0.0
        }
    }

    pub(crate) fn clock(self) -> OwnClock {
        let WorldNoise { phase, drift, .. } = *self.noise;
        if !self.noise.has_own_clocks() {
            return OwnClock::default();
        }
        let mut rng = self.rng(NoiseKind::Clock);
        let (ahead, faster) = (phase * unit(&mut rng), drift * (2.0 * unit(&mut rng) - 1.0));
        OwnClock { phase: (ahead * f64::from(CYCLE_STEPS)) as u32, rate: (faster * 1e6) as i32 }
    }

    /// Env steps of a cycle of its own after which it senses that its stimuli have changed, where others cause this.
    pub(crate) fn delay(self, cycle: usize) -> u32 {
        if self.noise.phase <= 0.0 || cycle == 0 {
            return 0;
        }
        let mut rng = self.rng(NoiseKind::Clock);
        // The first two numbers are those of its own clock.
        rng.set_word_pos(4 + 2 * cycle as u128);
        (self.noise.phase * unit(&mut rng) * f64::from(CYCLE_STEPS)) as u32
    }

    /// Whether the robot misses its stimuli in a cycle and keeps those of the cycle before. It never misses the first.
    pub(crate) fn misses(self, cycle: usize) -> bool {
        if self.noise.missed <= 0.0 || cycle == 0 {
            return false;
        }
        let mut rng = self.rng(NoiseKind::Missed);
        // A number takes two words of the stream.
        rng.set_word_pos(2 * cycle as u128);
        unit(&mut rng) < self.noise.missed
    }

    pub(crate) fn sensed(self, schedule: &Schedule) -> Schedule {
        if self.noise.missed <= 0.0 && self.noise.phase <= 0.0 {
            return schedule.clone();
        }
        let shown = schedule.spells.iter().map(|spell| (spell.steps as usize, Spell { steps: 0, ..spell.clone() }));
        let mut steps: Vec<Spell> = shown.flat_map(|(steps, shown)| std::iter::repeat_n(shown, steps)).collect();
        for start in (0..steps.len()).step_by(CYCLE_STEPS as usize) {
            let cycle = start / CYCLE_STEPS as usize;
            let late = if self.misses(cycle) { CYCLE_STEPS } else { self.delay(cycle) };
            if late > 0 {
                let (before, end) = (steps[start - 1].clone(), steps.len().min(start + late as usize));
                steps[start..end].fill(before);
            }
        }
        let spells = steps.chunk_by(|a, b| a == b);
        Schedule { spells: spells.map(|same| Spell { steps: same.len() as u32, ..same[0].clone() }).collect() }
    }

    pub(crate) fn worn(self, body: &Body) -> Body {
        let WorldNoise { weak, dead, .. } = *self.noise;
        if weak <= 0.0 && dead <= 0.0 {
            return body.clone();
        }
        let mut materials: Vec<Material> = body.palette().materials().iter().map(|own| weakened(own, weak)).collect();
        let mut codes = body.codes().to_vec();
        let mut rng = self.rng(NoiseKind::Dead);
        // A palette without room for another material has no dead voxels.
        let code = (materials.len() < Palette::MAX_MATERIALS).then_some(materials.len() as u8 + 1);
        for voxel in codes.iter_mut().filter(|voxel| is_active(body, **voxel)) {
            if unit(&mut rng) < dead {
                *voxel = code.unwrap_or(*voxel);
            }
        }
        if code.is_some_and(|code| codes.contains(&code)) {
            materials.push(dead_material());
        }
        Body::new(body.width(), body.height(), codes, Arc::new(Palette::new(materials)))
    }
}

fn unit(rng: &mut impl Rng) -> f64 {
    rng.random()
}

fn is_active(body: &Body, code: u8) -> bool {
    matches!(body.palette().kind(code), Some(MaterialKind::Actuator(_) | MaterialKind::Sensor(_)))
}

fn weakened(material: &Material, weak: f64) -> Material {
    let less = |width: f64| 1.0 + (width - 1.0) * (1.0 - weak);
    let kind = match material.kind {
        MaterialKind::Actuator(Drive { low, high, period, phase }) => {
            MaterialKind::Actuator(Drive { low: less(low), high: less(high), period, phase })
        }
        MaterialKind::Sensor(response @ Response { absent, present, .. }) => {
            MaterialKind::Sensor(Response { absent: less(absent), present: less(present), ..response })
        }
        other => other,
    };
    Material { name: material.name.clone(), kind }
}

fn dead_material() -> Material {
    let still = Drive { period: 1, phase: 0.0, low: 1.0, high: 1.0 };
    Material { name: DEAD.to_owned(), kind: MaterialKind::Actuator(still) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Pattern;

    const NOISE: WorldNoise =
        WorldNoise { start: 0.5, missed: 0.5, weak: 0.5, dead: 0.5, phase: 0.5, drift: 0.02, seed: 7 };

    fn robot(noise: &WorldNoise, robot: usize) -> RobotNoise<'_> {
        RobotNoise::new(noise, robot)
    }

    #[test]
    fn robots_start_to_either_side_within_the_bound() {
        let shifts: Vec<f64> = (0..100).map(|i| robot(&NOISE, i).shift()).collect();
        assert!(shifts.iter().all(|shift| shift.abs() <= 0.5));
        assert!(shifts.iter().any(|shift| *shift < -0.25) && shifts.iter().any(|shift| *shift > 0.25));
        assert_eq!(robot(&NOISE, 3).shift(), robot(&NOISE, 3).shift());
        assert_eq!(robot(&WorldNoise::default(), 3).shift(), 0.0);
    }

    #[test]
    fn clocks_are_ahead_and_drift_to_either_side_within_the_bounds() {
        let clocks: Vec<OwnClock> = (0..100).map(|i| robot(&NOISE, i).clock()).collect();
        assert!(clocks.iter().all(|clock| clock.phase < 42 && clock.rate.abs() <= 20_000));
        assert!(clocks.iter().any(|clock| clock.phase > 30 && clock.rate < 0));
        assert!(clocks.iter().any(|clock| clock.phase < 10 && clock.rate > 0));
        assert_eq!(robot(&WorldNoise::default(), 3).clock(), OwnClock::default());
    }

    #[test]
    fn about_half_of_the_cycles_are_missed_and_keep_the_stimuli_before() {
        let noise = WorldNoise { phase: 0.0, ..NOISE };
        let missed = (1..1000).filter(|&cycle| robot(&noise, 0).misses(cycle)).count();
        assert!((450..550).contains(&missed), "{missed}");
        let spell = |pair: usize| Spell::of(Pattern::PAIRS[pair], CYCLE_STEPS);
        let schedule = Schedule { spells: (0..100).map(|cycle| spell(cycle % 4)).collect() };
        let sensed = robot(&noise, 0).sensed(&schedule);
        assert_eq!(sensed.steps(), schedule.steps());
        let mut at = 0;
        let cycles: Vec<Pattern> =
            sensed.spells.iter().flat_map(|spell| vec![spell.pattern; (spell.steps / CYCLE_STEPS) as usize]).collect();
        while at < 100 {
            let expected = if robot(&noise, 0).misses(at) { cycles[at - 1] } else { Pattern::PAIRS[at % 4] };
            assert_eq!(cycles[at], expected, "cycle {at}");
            at += 1;
        }
        assert_eq!(robot(&WorldNoise::default(), 0).sensed(&schedule), schedule);
    }

    #[test]
    fn a_robot_with_its_own_phase_senses_each_change_within_a_cycle() {
        let noise = WorldNoise { missed: 0.0, ..NOISE };
        let spell = |pair: usize| Spell::of(Pattern::PAIRS[pair], 2 * CYCLE_STEPS);
        let schedule = Schedule { spells: (0..50).map(|spell_at| spell(spell_at % 4)).collect() };
        let sensed = robot(&noise, 0).sensed(&schedule);
        let mut end = 0;
        let late: Vec<u32> = (1..50)
            .zip(&sensed.spells)
            .map(|(i, spell)| {
                assert_eq!(spell.pattern, schedule.spells[i - 1].pattern);
                end += spell.steps;
                end - i as u32 * 2 * CYCLE_STEPS
            })
            .collect();
        assert!(late.iter().all(|&steps| steps < 42) && late.iter().any(|&steps| steps > 30));
        assert_eq!(sensed.steps(), schedule.steps());
    }

    #[test]
    fn active_voxels_weaken_or_die() {
        let body = Body::patchwork(10, 0);
        let worn = robot(&NOISE, 0).worn(&body);
        let pairs: Vec<(u8, u8)> = body.codes().iter().copied().zip(worn.codes().iter().copied()).collect();
        assert!(pairs.iter().all(|(own, now)| own == now || *now == 9 && *own > 2));
        let dead = pairs.iter().filter(|(_, now)| *now == 9).count();
        assert!((20..60).contains(&dead), "{dead}");
        let MaterialKind::Actuator(Drive { low, high, .. }) = worn.palette().kind(3).unwrap() else { panic!() };
        assert_eq!([low, high], [0.8, 1.3]);
        assert_eq!(robot(&WorldNoise::default(), 0).worn(&body), body);
        assert_ne!(worn, robot(&NOISE, 1).worn(&body), "each robot has its own dead voxels");
    }
}
