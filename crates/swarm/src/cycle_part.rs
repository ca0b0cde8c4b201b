//! A cycle of some robots of a swarm as plain data. Robots do not touch each other, so the parts of a swarm can be
//! simulated in different places at the same time.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use nbc_base::model::{Body, Fault, Pattern, Setting, bodies};
use nbc_sim::{Simulator, Snapshot, State};

/// Some robots of a swarm at the start of a cycle. Their states at its end depend on this alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CyclePart {
    pub setting: Setting,
    #[serde(with = "bodies")]
    pub bodies: Vec<Body>,
    #[serde(with = "starts")]
    pub starts: Vec<Snapshot>,
    pub patterns: Vec<Pattern>,
    /// The env steps of the cycle at whose end their states are read, in order. The last one ends the cycle.
    pub stops: Vec<u32>,
}

pub type PartStates = Vec<Vec<Snapshot>>;

impl CyclePart {
    pub fn simulate(&self, simulator: &Simulator) -> PartStates {
        let mut flock = simulator.flock(&self.setting, &self.bodies);
        self.starts.iter().enumerate().for_each(|(i, start)| flock.restore(i, start));
        let mut done = 0;
        let to_stop = |&stop: &u32| {
            flock.advance(&self.patterns, stop - done);
            done = stop;
            (0..flock.len()).map(|i| flock.snapshot(i)).collect()
        };
        self.stops.iter().map(to_stop).collect()
    }
}

/// A snapshot as data, with numbers as their bits: the places of a robot that failed need not be finite.
#[derive(Serialize, Deserialize)]
struct Written(Vec<u64>, u32, Option<Fault>);

impl Written {
    fn of(Snapshot { state, center, clock, fault }: &Snapshot) -> Self {
        let State { position, previous, velocity } = state;
        let numbers = [center].into_iter().chain(position).chain(previous).chain(velocity).flatten();
        Self(numbers.map(|number| number.to_bits()).collect(), *clock, *fault)
    }

    fn read(self) -> Option<Snapshot> {
        let Self(bits, clock, fault) = self;
        let places: Vec<[f64; 2]> = bits.as_chunks().0.iter().map(|place| place.map(f64::from_bits)).collect();
        let (&center, places) = places.split_first()?;
        let mut parts = places.chunks((places.len() / 3).max(1)).map(<[_]>::to_vec);
        let state = State { position: parts.next()?, previous: parts.next()?, velocity: parts.next()? };
        Some(Snapshot { state, center, clock, fault })
    }
}

mod starts {
    use super::*;

    pub fn serialize<S: Serializer>(starts: &[Snapshot], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(starts.iter().map(Written::of))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Snapshot>, D::Error> {
        let written = Vec::<Written>::deserialize(deserializer)?;
        let starts: Option<Vec<Snapshot>> = written.into_iter().map(Written::read).collect();
        starts.ok_or_else(|| D::Error::custom("a snapshot without places"))
    }
}

pub mod part_states {
    use super::*;

    #[derive(Serialize, Deserialize)]
    struct Stop(#[serde(with = "starts")] Vec<Snapshot>);

    pub fn serialize<S: Serializer>(states: &PartStates, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(states.iter().map(|stop| Stop(stop.clone())))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PartStates, D::Error> {
        Ok(Vec::<Stop>::deserialize(deserializer)?.into_iter().map(|stop| stop.0).collect())
    }
}
