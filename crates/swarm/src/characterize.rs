//! The character of a robot as a gate, measured over switches of its inputs (docs/physics.md 14).

use std::collections::BTreeSet;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::holds::{HoldPlan, PatternHold, holds};
use crate::noise::RobotNoise;
use nbc_base::model::{
    Behavior, Body, Character, Direction, Fault, Pattern, PhysicsWorld, Robot, Setting, Trajectory, Transition, Trial,
};
use nbc_sim::Simulator;

const SEED: u64 = 0x6e62_6373;
/// Clocks tried, from the shortest on, in cycles.
const CLOCKS: std::ops::RangeInclusive<u32> = 1..=8;
/// Cycles by which a hold of a random sequence may exceed the clock, because the output must also stay correct.
const SLACK: u32 = 3;
/// Ground columns by which starts differ: each has other roundings in the first contacts (docs/physics.md 12).
const STARTS: [usize; 2] = [0, 1];
const LANES: usize = 8;
/// Switches of a random sequence; the first hold is a start.
const SWITCHES: usize = 64;
const FIRST_SWITCHES: usize = 8;
/// In cycles; several, so that a switch happens at different moments.
const SETTLE_BEFORE: [u32; 2] = [6, 9];
/// Cycles after it. A settle time of one more means that the output was wrong until the end.
const SETTLE_AFTER: u32 = 12;
/// Ground voxels: room to walk for the longest sequence in both directions.
const WORLD: usize = 4000;
/// A body whose height in a pattern falls below this fraction of its height in its first hold has toppled.
const TOPPLED: f64 = 0.7;

/// The clock is the smallest number of cycles (from 1 to 8) such that in 1,024 random switches, held for that many to
/// three cycles more, no output was wrong from that cycle of a hold on. If there is none, it is the one with the fewest
/// wrong holds.
pub fn characterize(simulator: &Simulator, body: &Body, behavior: Behavior) -> Result<Character, Fault> {
    let probe = Probe::new(simulator, body, behavior);
    let tally = probe.best_clock(SWITCHES)?;
    let (settle, toppled) = probe.settle()?;
    Ok(tally.character(settle, toppled))
}

/// As the characterization of a robot, but over an eighth of the switches and without settle times.
pub fn sketch(simulator: &Simulator, body: &Body, behavior: Behavior) -> Result<Character, Fault> {
    let tally = Probe::new(simulator, body, behavior).best_clock(FIRST_SWITCHES)?;
    Ok(tally.character(Vec::new(), false))
}

/// The smallest clock of at most `most` cycles whose first, cheap sequences have no errors, with their margin.
pub fn screen(simulator: &Simulator, body: &Body, behavior: Behavior, most: u32) -> Result<Option<(u32, f64)>, Fault> {
    let probe = Probe::new(simulator, body, behavior);
    for clock in 1..=most {
        if let Some(tally) = probe.random(clock, FIRST_SWITCHES, 1)? {
            return Ok(Some((clock, tally.margin)));
        }
    }
    Ok(None)
}

/// Share of wrong switches at the robot's clock in the first, cheap sequences; all if a simulation fails.
pub(super) fn errors_in(simulator: &Simulator, robot: &Robot, world: &PhysicsWorld) -> f64 {
    let probe = Probe { world: *world, ..Probe::new(simulator, &robot.body, robot.behavior) };
    let clock = robot.character.clock + world.lateness();
    let tally = probe.random(clock, FIRST_SWITCHES, u32::MAX);
    tally.map_or(1.0, |tally| tally.map_or(1.0, |tally| tally.error_rate()))
}

struct Probe<'a> {
    simulator: &'a Simulator,
    setting: Setting,
    body: &'a Body,
    behavior: Behavior,
    world: PhysicsWorld,
}

#[derive(Clone, Debug, PartialEq)]
struct Tally {
    clock: u32,
    switches: u32,
    /// Holds after a switch with a wrong output in the clock's cycle or later.
    wrong: u32,
    /// Cycles of holds whose correct output is the same as in the previous hold.
    quiet: u32,
    glitches: u32,
    margin: f64,
    toppled: bool,
}

impl Tally {
    fn character(self, settle: Vec<Transition>, toppled: bool) -> Character {
        Character {
            clock: self.clock,
            switches: self.switches,
            error_rate: self.error_rate(),
            glitch_rate: f64::from(self.glitches) / f64::from(self.quiet.max(1)),
            margin: self.margin,
            topples: self.toppled || toppled,
            settle,
            radius: None,
        }
    }

    /// The wrong switches with which a tally of that many switches in each sequence has no fewer errors than this one.
    fn matched_by(&self, switches: usize) -> u32 {
        let all = (switches * LANES * STARTS.len()) as u32;
        (self.wrong * all).div_ceil(self.switches)
    }

    fn error_rate(&self) -> f64 {
        f64::from(self.wrong) / f64::from(self.switches.max(1))
    }

    fn count(&mut self, hold: &PatternHold, behavior: Behavior) {
        let Some(before) = hold.before else { return };
        let right = behavior.direction(hold.pattern);
        let is_wrong = |displacement: &&f64| Direction::of(**displacement) != right;
        let asked = &hold.cycles[self.clock as usize - 1..];
        self.switches += 1;
        self.wrong += u32::from(asked.iter().any(|displacement| is_wrong(&displacement)));
        self.margin = hold.rightward(behavior).skip(self.clock as usize - 1).fold(self.margin, f64::min);
        if behavior.direction(before) == right {
            self.quiet += hold.cycles.len() as u32;
            self.glitches += hold.cycles.iter().filter(is_wrong).count() as u32;
        }
    }
}

impl<'a> Probe<'a> {
    fn new(simulator: &'a Simulator, body: &'a Body, behavior: Behavior) -> Self {
        let start_x = Some(WORLD / 2 - body.width() / 2);
        let setting = Setting { world_width: WORLD, start_x, ..Setting::default() };
        Self { simulator, setting, body, behavior, world: PhysicsWorld::default() }
    }

    fn run(&self, plans: &[HoldPlan], start: usize) -> Result<Vec<Vec<PatternHold>>, Fault> {
        let noise = |robot| RobotNoise::new(&self.world.noise, robot);
        let body = noise(0).worn(self.body);
        let trial =
            |(i, plan): (usize, &HoldPlan)| Trial { body: body.clone(), schedule: noise(i).sensed(&plan.schedule()) };
        let trials: Vec<Trial> = plans.iter().enumerate().map(trial).collect();
        let start_x = self.setting.start_x.map(|x| x + start);
        let PhysicsWorld { factors, ground, .. } = self.world;
        let ground = ground.on(self.setting.world_width);
        let setting = Setting { shift: noise(0).shift(), factors, ground, start_x, ..self.setting };
        let found = |(plan, trajectory): (&HoldPlan, Trajectory)| match trajectory.fault {
            Some(fault) => Err(fault),
            None => Ok(holds(plan, &trajectory)),
        };
        plans.iter().zip(self.simulator.run_trials(&setting, &trials)).map(found).collect()
    }

    /// Random sequences at the smallest clock without errors, or at the one with the fewest errors. A clock that fails
    /// in short sequences is not tried in ones of that many switches unless all fail.
    fn best_clock(&self, switches: usize) -> Result<Tally, Fault> {
        let mut best: Option<Tally> = None;
        for clock in CLOCKS {
            let too_many = |switches| best.as_ref().map_or(u32::MAX, |best| best.matched_by(switches));
            let mut tally = self.random(clock, FIRST_SWITCHES, too_many(FIRST_SWITCHES))?;
            if switches > FIRST_SWITCHES && tally.as_ref().is_some_and(|tally| tally.wrong == 0) {
                tally = self.random(clock, switches, too_many(switches))?;
            }
            match tally {
                Some(tally) if tally.wrong == 0 => return Ok(tally),
                Some(tally) => best = Some(tally),
                None => {}
            }
        }
        let best = best.expect("there are clocks");
        if best.switches as usize >= switches * LANES {
            return Ok(best);
        }
        Ok(self.random(best.clock, switches, u32::MAX)?.expect("any number of errors is accepted"))
    }

    fn random(&self, clock: u32, switches: usize, too_many: u32) -> Result<Option<Tally>, Fault> {
        let mut rng = ChaCha8Rng::seed_from_u64(SEED);
        rng.set_stream(u64::from(clock));
        let plans: Vec<HoldPlan> = (0..LANES)
            .map(|_| HoldPlan::random(self.behavior.stimuli(), switches + 1, clock..=clock + SLACK, &mut rng))
            .collect();
        let (margin, toppled) = (f64::INFINITY, false);
        let mut tally = Tally { clock, switches: 0, wrong: 0, quiet: 0, glitches: 0, margin, toppled };
        for start in STARTS {
            for holds in self.run(&plans, start)? {
                holds.iter().for_each(|hold| tally.count(hold, self.behavior));
                tally.toppled |= has_toppled(&holds);
            }
            if tally.wrong >= too_many {
                return Ok(None);
            }
        }
        Ok(Some(tally))
    }

    fn settle(&self) -> Result<(Vec<Transition>, bool), Fault> {
        let stimuli = self.behavior.stimuli();
        let pairs: Vec<(Pattern, Pattern)> = Pattern::all(stimuli)
            .flat_map(|from| Pattern::all(stimuli).map(move |to| (from, to)))
            .filter(|(from, to)| from != to)
            .collect();
        let plan = |&(from, to): &_, before| HoldPlan(vec![(from, before), (to, SETTLE_AFTER)]);
        let plans: Vec<HoldPlan> =
            SETTLE_BEFORE.iter().flat_map(|&before| pairs.iter().map(move |pair| plan(pair, before))).collect();
        let runs = STARTS.map(|start| self.run(&plans, start)).into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        let cycles =
            |place: usize| runs.iter().skip(place).step_by(pairs.len()).map(|holds| self.settled(&holds[1])).max();
        let transition =
            |(place, &(from, to)): (usize, &_)| Transition { stimuli, from, to, cycles: cycles(place).unwrap_or(0) };
        Ok((pairs.iter().enumerate().map(transition).collect(), runs.iter().any(|holds| has_toppled(holds))))
    }

    fn settled(&self, hold: &PatternHold) -> u32 {
        let right = self.behavior.direction(hold.pattern);
        let last_wrong = hold.cycles.iter().rposition(|&displacement| Direction::of(displacement) != right);
        last_wrong.map_or(1, |cycle| cycle as u32 + 2)
    }
}

fn has_toppled(holds: &[PatternHold]) -> bool {
    let patterns: BTreeSet<Pattern> = holds.iter().map(|hold| hold.pattern).collect();
    patterns.into_iter().any(|pattern| {
        let mut heights = holds.iter().filter(|hold| hold.pattern == pattern).map(|hold| hold.height);
        heights.next().is_some_and(|first| heights.next_back().is_some_and(|last| last < TOPPLED * first))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Schedule;

    fn nand() -> Behavior {
        "RRRL".parse().unwrap()
    }

    fn hold(before: usize, pattern: usize, cycles: &[f64]) -> PatternHold {
        let pairs = Pattern::PAIRS;
        PatternHold { before: Some(pairs[before]), pattern: pairs[pattern], cycles: cycles.to_vec(), height: 2.0 }
    }

    fn tally(clock: u32, holds: &[PatternHold]) -> Tally {
        let (margin, toppled) = (f64::INFINITY, false);
        let mut tally = Tally { clock, switches: 0, wrong: 0, quiet: 0, glitches: 0, margin, toppled };
        holds.iter().for_each(|hold| tally.count(hold, nand()));
        tally
    }

    #[test]
    fn a_hold_is_wrong_when_any_cycle_from_the_clock_on_is() {
        let holds = [hold(0, 3, &[0.5, -0.1, -0.2]), hold(3, 0, &[-0.5, 0.3, -0.1, 0.3]), hold(0, 3, &[-0.4, 0.1])];
        let found = |clock| {
            let Tally { switches, wrong, margin, .. } = tally(clock, &holds);
            (switches, wrong, margin)
        };
        assert_eq!(found(1), (3, 3, -0.5));
        assert_eq!(found(2), (3, 2, -0.1), "an isolated wrong cycle in steady state counts");
        let start = PatternHold { before: None, ..hold(0, 3, &[9.0]) };
        assert_eq!(tally(1, &[start]).switches, 0, "a fresh start is no switch");
    }

    #[test]
    fn a_search_for_a_clock_ends_where_it_has_no_fewer_errors() {
        let with = |wrong, switches| Tally { wrong, switches, ..tally(2, &[]) };
        let all = |switches: usize| (switches * LANES * STARTS.len()) as u32;
        assert_eq!(with(5, all(8)).matched_by(8), 5);
        assert_eq!([with(1, all(64)).matched_by(8), with(9, all(64)).matched_by(8)], [1, 2]);
        assert_eq!(with(3, all(8)).matched_by(64), 24);
        let body = Body::parse(&["343", "563"], &nbc_base::model::Palette::paper()).unwrap();
        let simulator = Simulator::default();
        let probe = Probe::new(&simulator, &body, nand());
        let whole = probe.random(1, FIRST_SWITCHES, u32::MAX).unwrap().unwrap();
        assert!(whole.wrong > 0 && whole.switches == all(FIRST_SWITCHES));
        assert_eq!(probe.random(1, FIRST_SWITCHES, whole.wrong).unwrap(), None);
        assert_eq!(probe.random(1, FIRST_SWITCHES, whole.wrong + 1).unwrap(), Some(whole));
    }

    #[test]
    fn every_switch_is_wrong_in_a_world_in_which_the_robot_fails() {
        // The `and_5x5` of the library.
        let rows = ["55573", "55777", "26520", "36200", "33333"];
        let body = Body::parse(&rows, &nbc_base::model::Palette::paper()).unwrap();
        let factors = nbc_base::model::WorldFactors { stiffness: 10.0, ..Default::default() };
        let stiff = PhysicsWorld { factors, ..PhysicsWorld::default() };
        let simulator = Simulator::default();
        let probe = Probe { world: stiff, ..Probe::new(&simulator, &body, nand()) };
        assert!(probe.random(1, FIRST_SWITCHES, u32::MAX).is_err());
        let (senses, held) = (vec![crate::StimulusSource::Constant(false); 2], vec![Vec::new(); 2]);
        let member = crate::PlainMember { body: body.clone(), clock: 1, senses, start: false, held };
        let robot = Robot { behavior: nand(), ..member.nameless().robot };
        assert_eq!(errors_in(&simulator, &robot, &stiff), 1.0);
    }

    #[test]
    fn glitches_are_wrong_cycles_where_the_output_should_not_change() {
        let stays = hold(1, 2, &[-0.2, 0.1, 0.1]);
        let changes = hold(2, 3, &[0.2, 0.1, -0.1]);
        let Tally { quiet, glitches, .. } = tally(2, &[stays, changes]);
        assert_eq!((quiet, glitches), (3, 1));
    }

    #[test]
    fn a_body_has_toppled_when_it_stays_low_in_a_pattern_that_it_stood_in() {
        let at = |pattern, height| PatternHold { height, ..hold(0, pattern, &[0.1]) };
        assert!(has_toppled(&[at(3, 2.0), at(1, 1.9), at(3, 1.3)]));
        assert!(!has_toppled(&[at(3, 2.0), at(1, 1.2), at(3, 1.5)]), "low in another pattern is no fall");
    }

    #[test]
    fn all_twelve_switches_are_timed_and_a_wrong_end_shows() {
        let body = Body::parse(&["343", "563"], &nbc_base::model::Palette::paper()).unwrap();
        let (simulator, setting) = (Simulator::default(), Setting::default());
        let fixed = simulator.run_trials(
            &setting,
            &[Trial { body: body.clone(), schedule: Schedule::constant(Pattern::PAIRS[0], 840) }],
        );
        let walks_right = Direction::of(fixed[0].com_x[840] - fixed[0].com_x[0]) == Direction::Right;
        // With the opposite direction, the output is never correct.
        let contrary: Behavior = if walks_right { "LLLL" } else { "RRRR" }.parse().unwrap();
        let (settle, _) = Probe::new(&simulator, &body, contrary).settle().unwrap();
        let pairs: std::collections::BTreeSet<_> =
            settle.iter().map(|transition| (transition.from.number(2), transition.to.number(2))).collect();
        assert!(pairs.len() == 12 && pairs.iter().all(|(from, to)| from != to));
        let back: Vec<u32> = settle.iter().filter(|t| t.to == Pattern::PAIRS[0]).map(|t| t.cycles).collect();
        assert_eq!(back, [SETTLE_AFTER + 1; 3], "wrong to the end");
        let probe = Probe::new(&simulator, &body, contrary);
        let settled = |cycles: &[f64]| probe.settled(&PatternHold { cycles: cycles.to_vec(), ..hold(1, 0, &[]) });
        let sign = if walks_right { -1.0 } else { 1.0 };
        assert_eq!([settled(&[sign; 4]), settled(&[-sign, sign, -sign, sign])], [1, 4]);
    }
}
