//! Where the paper's text and its authors' code differ, and which of them a run follows.

use serde::{Deserialize, Serialize};

/// A matter in which the paper's text and its authors' code differ (docs/physics.md 11).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Matter {
    /// The sensors that the archive counts.
    Sensors,
    /// What a hidden node with several targets gives to each.
    Targets,
    /// The input of an axis that is one voxel long.
    Depth,
    /// The map of an output that an earlier output reads.
    Outputs,
    /// Whether an output's activation may change.
    Sigmoid,
    /// What adding a link does if none can be added.
    Links,
    /// The activations of hidden nodes.
    Activations,
    /// What becomes of a mutation whose body is invalid.
    Repair,
}

impl Matter {
    pub const WORDS: [(&str, Self); 8] = [
        ("sensors", Self::Sensors),
        ("targets", Self::Targets),
        ("depth", Self::Depth),
        ("outputs", Self::Outputs),
        ("sigmoid", Self::Sigmoid),
        ("links", Self::Links),
        ("activations", Self::Activations),
        ("repair", Self::Repair),
    ];
}

/// The matters in which a run follows the authors' code, by default in none; in all others the paper's text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Written", into = "Written")]
pub struct Rules([bool; Matter::WORDS.len()]);

impl Rules {
    pub const PAPER: Self = Self([false; Matter::WORDS.len()]);
    pub const CODE: Self = Self([true; Matter::WORDS.len()]);

    pub fn follow_code(self, matter: Matter) -> bool {
        self.0[matter as usize]
    }

    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(std::array::from_fn(|matter| self.0[matter] || other.0[matter]))
    }
}

impl From<Matter> for Rules {
    fn from(matter: Matter) -> Self {
        Self(std::array::from_fn(|at| at == matter as usize))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    All(Source),
    Some(Vec<Matter>),
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Source {
    Paper,
    Code,
}

impl From<Rules> for Written {
    fn from(rules: Rules) -> Self {
        match rules {
            Rules::PAPER => Self::All(Source::Paper),
            Rules::CODE => Self::All(Source::Code),
            _ => {
                let matters = Matter::WORDS.iter().map(|&(_, matter)| matter);
                Self::Some(matters.filter(|&matter| rules.follow_code(matter)).collect())
            }
        }
    }
}

impl From<Written> for Rules {
    fn from(written: Written) -> Self {
        match written {
            Written::All(Source::Paper) => Self::PAPER,
            Written::All(Source::Code) => Self::CODE,
            Written::Some(matters) => matters.into_iter().map(Self::from).fold(Self::PAPER, Self::and),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_written_as_one_word_or_as_a_list() {
        let check = |rules: Rules, text: &str| {
            assert_eq!(serde_json::to_string(&rules).unwrap(), text);
            assert_eq!(serde_json::from_str::<Rules>(text).unwrap(), rules);
        };
        check(Rules::PAPER, r#""paper""#);
        check(Rules::CODE, r#""code""#);
        check(Rules::from(Matter::Repair).and(Matter::Sensors.into()), r#"["sensors","repair"]"#);
        assert!(serde_json::from_str::<Rules>(r#"["colors"]"#).is_err());
    }

    #[test]
    fn each_matter_has_the_place_of_its_word() {
        for (at, (word, matter)) in Matter::WORDS.into_iter().enumerate() {
            assert_eq!(matter as usize, at);
            assert_eq!(serde_json::to_value(matter).unwrap(), word);
        }
        let all = Matter::WORDS.into_iter().map(|(_, matter)| Rules::from(matter)).fold(Rules::PAPER, Rules::and);
        assert_eq!(all, Rules::CODE);
    }
}
