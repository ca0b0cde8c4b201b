//! How much the worlds of a sample vary.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::wording::{does_not_vary, no_amount, variation_amount};
use super::{PhysicsWorld, WorldFactors, WorldNoise};

/// The largest changes of a sample of worlds. A factor varies to either side by a share of itself; noise is added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(into = "BTreeMap<String, f64>", try_from = "BTreeMap<String, f64>")]
pub struct Variation {
    /// The changes of the quantities, in the order of [`Variation::NAMES`].
    amounts: [f64; COUNT],
}

const COUNT: usize = 12;

/// The number of these that are factors; the others are noise.
const FACTORS: usize = 6;

impl Variation {
    pub const NAMES: [&str; COUNT] = [
        "friction",
        "gravity",
        "stiffness",
        "drag",
        "damping",
        "swelling",
        "start",
        "missed",
        "weak",
        "dead",
        "phase",
        "drift",
    ];

    /// The word for no change but that of the seed, from which noise is drawn.
    pub const SEED: &str = "seed";

    /// The word for all factors.
    pub const ALL: &str = "all";

    /// The numbers that [`Variation::world`] needs for one world.
    pub const DRAWS: usize = COUNT;

    pub fn most(name: &str) -> f64 {
        match name {
            "start" => WorldNoise::MOST_START,
            "missed" | "weak" | "dead" | "phase" => 1.0,
            "drift" => WorldNoise::MOST_DRIFT,
            _ => 0.9,
        }
    }

    pub fn of(amount: impl FnMut(&'static str) -> f64) -> Self {
        Self { amounts: Self::NAMES.map(amount) }
    }

    pub fn is_factor(name: &str) -> bool {
        Self::NAMES[..FACTORS].contains(&name)
    }

    /// The amount of all factors that vary, if it is the same and there is no noise.
    pub fn common(&self) -> Option<f64> {
        let (factors, noise) = (&self.amounts[..FACTORS], &self.amounts[FACTORS..]);
        let mut varied = factors.iter().filter(|amount| **amount > 0.0);
        let first = *varied.next()?;
        (varied.all(|amount| *amount == first) && noise.iter().all(|amount| *amount == 0.0)).then_some(first)
    }

    pub fn quantities(&self) -> String {
        let varied: Vec<&str> = Self::NAMES
            .into_iter()
            .zip(self.amounts)
            .filter(|(_, amount)| *amount > 0.0)
            .map(|(name, _)| name)
            .collect();
        if varied == Self::NAMES[..FACTORS] { "all factors".to_owned() } else { varied.join(", ") }
    }

    /// The text that [`Variation::from_str`] reads.
    pub fn changes(&self) -> String {
        self.words("=", "%").join(",")
    }

    /// Each change with a sign between its name and its amount.
    fn words(&self, sign: &str, percent: &str) -> Vec<String> {
        let changes = Self::NAMES.iter().zip(self.amounts).filter(|(_, amount)| *amount > 0.0);
        let word = |(name, amount): (&&str, f64)| match *name {
            "start" => format!("{name}{sign}{}", rounded(amount)),
            _ => format!("{name}{sign}{}{percent}", rounded(amount * 100.0)),
        };
        changes.map(word).collect()
    }

    fn place(name: &str) -> Result<usize, String> {
        Self::NAMES.iter().position(|known| *known == name).ok_or_else(|| does_not_vary(name, &Self::NAMES))
    }

    /// All changes times a number, but none above its largest.
    pub fn times(&self, scale: f64) -> Self {
        let mut amounts = self.amounts;
        for (amount, name) in amounts.iter_mut().zip(Self::NAMES) {
            *amount = (*amount * scale).min(Self::most(name));
        }
        Self { amounts }
    }

    /// A world that differs from another by these numbers, which are from -1 to 1: a factor changes by its number times
    /// its largest change; noise grows by the size of its number.
    pub fn world(&self, around: &PhysicsWorld, draws: [f64; COUNT], seed: u64) -> PhysicsWorld {
        let mut changes = self.amounts;
        for (i, (change, draw)) in changes.iter_mut().zip(draws).enumerate() {
            *change *= if i < FACTORS { draw } else { draw.abs() };
        }
        let [friction, gravity, stiffness, drag, damping, swelling, start, missed, weak, dead, phase, drift] = changes;
        let [least, most] = [*WorldFactors::RANGE.start(), *WorldFactors::RANGE.end()];
        let factor = |own: f64, change: f64| (own * (1.0 + change)).clamp(least, most);
        let (own, noise) = (around.factors, around.noise);
        PhysicsWorld {
            factors: WorldFactors {
                friction: factor(own.friction, friction),
                gravity: factor(own.gravity, gravity),
                stiffness: factor(own.stiffness, stiffness),
                drag: factor(own.drag, drag),
                damping: factor(own.damping, damping),
                swelling: factor(own.swelling, swelling),
            },
            noise: WorldNoise {
                start: (noise.start + start).min(WorldNoise::MOST_START),
                missed: (noise.missed + missed).min(1.0),
                weak: (noise.weak + weak).min(1.0),
                dead: (noise.dead + dead).min(1.0),
                phase: (noise.phase + phase).min(1.0),
                drift: (noise.drift + drift).min(WorldNoise::MOST_DRIFT),
                seed,
            },
            ..*around
        }
    }
}

impl From<Variation> for BTreeMap<String, f64> {
    fn from(variation: Variation) -> Self {
        Variation::NAMES.iter().map(|name| (*name).to_owned()).zip(variation.amounts).collect()
    }
}

impl TryFrom<BTreeMap<String, f64>> for Variation {
    type Error = String;

    fn try_from(changes: BTreeMap<String, f64>) -> Result<Self, String> {
        let mut variation = Self::default();
        for (name, amount) in changes {
            let place = Self::place(&name)?;
            if !(0.0..=Self::most(&name)).contains(&amount) {
                return Err(variation_amount(&name, &amount.to_string(), Self::most(&name)));
            }
            variation.amounts[place] = amount;
        }
        Ok(variation)
    }
}

impl FromStr for Variation {
    type Err = String;

    /// Reads `friction=10%,start=0.2`. All factors are `all=10%`, or `10%` by itself; `seed` is no change.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut amounts = [0.0; COUNT];
        if text == Self::SEED {
            return Ok(Self::default());
        }
        if text.ends_with('%') && !text.contains('=') {
            return format!("{}={text}", Self::ALL).parse();
        }
        for part in text.split(',') {
            let (name, amount) = part.split_once('=').ok_or_else(|| no_amount(part))?;
            if name.trim() == Self::ALL {
                amounts[..FACTORS].fill(read_amount(Self::ALL, amount.trim())?);
                continue;
            }
            amounts[Self::place(name.trim())?] = read_amount(name.trim(), amount.trim())?;
        }
        Ok(Self { amounts })
    }
}

fn read_amount(name: &str, text: &str) -> Result<f64, String> {
    let number = match text.strip_suffix('%') {
        Some(percent) => percent.parse::<f64>().map(|percent| percent / 100.0),
        None => text.parse(),
    };
    let is_possible = |amount: &f64| (0.0..=Variation::most(name)).contains(amount);
    number.ok().filter(is_possible).ok_or_else(|| variation_amount(name, text, Variation::most(name)))
}

impl fmt::Display for Variation {
    /// The quantities that vary: `friction 10 %, start 0.2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = self.words(" ", " %");
        if words.is_empty() { f.write_str(Self::SEED) } else { f.write_str(&words.join(", ")) }
    }
}

/// A number without the digits that only rounding brings.
fn rounded(number: f64) -> f64 {
    (number * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variations_are_read_and_shown() {
        let found: Variation = "friction=10%,start=0.2".parse().unwrap();
        assert_eq!(found.amounts[..7], [0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2]);
        assert_eq!(found.to_string(), "friction 10 %, start 0.2");
        assert_eq!(found.changes(), "friction=10%,start=0.2");
        assert_eq!(found.times(3.0).to_string(), "friction 30 %, start 0.6");
        assert_eq!(found.times(20.0).amounts[0], 0.9, "a factor stays positive");
        let text = serde_json::to_string(&found).unwrap();
        assert_eq!(serde_json::from_str::<Variation>(&text).unwrap(), found);
        for wrong in [r#"{"friction": 0.95}"#, r#"{"speed": 0.1}"#] {
            assert!(serde_json::from_str::<Variation>(wrong).is_err(), "{wrong}");
        }
        let all: Variation = "all=20%".parse().unwrap();
        assert_eq!((all.common(), found.common()), (Some(0.2), None));
        assert_eq!([all.quantities(), found.quantities()], ["all factors", "friction, start"]);
        for wrong in ["friction", "fiction=1%", "friction=95%", "friction=-1%", "missed=x", ""] {
            assert!(wrong.parse::<Variation>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn factors_vary_to_both_sides_and_noise_grows() {
        let all: Variation = "friction=50%,missed=10%".parse().unwrap();
        let paper = PhysicsWorld::default();
        let low = all.world(&paper, [-1.0; COUNT], 7);
        assert_eq!((low.factors.friction, low.factors.gravity), (0.5, 1.0));
        assert_eq!((low.noise.missed, low.noise.seed), (0.1, 7));
        assert_eq!(all.world(&low, [-1.0; COUNT], 7).factors.friction, 0.25, "around another world");
        assert!(all.times(99.0).world(&low, [1.0; COUNT], 7).is_possible());
    }
}
