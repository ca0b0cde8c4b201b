//! A share of successes with its confidence interval.

use serde::Serialize;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(into = "Yield")]
pub struct Proportion {
    pub successes: usize,
    pub attempts: usize,
}

/// The quantile of the normal distribution for a two-sided interval of 95 %.
const Z: f64 = 1.959_963_984_540_054;

impl Proportion {
    /// The share of successes; 0 without attempts.
    pub fn share(&self) -> f64 {
        self.successes as f64 / self.attempts.max(1) as f64
    }

    /// The 95 % interval of Wilson (1927), "Probable inference, the law of succession, and statistical inference".
    pub fn interval(&self) -> [f64; 2] {
        if self.attempts == 0 {
            return [0.0, 1.0];
        }
        let (n, p, z2) = (self.attempts as f64, self.share(), Z * Z);
        let middle = p + z2 / (2.0 * n);
        let reach = Z * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
        [middle - reach, middle + reach].map(|end| (end / (1.0 + z2 / n)).clamp(0.0, 1.0))
    }
}

/// The worlds in which a test passes, and the 95 % interval of their share.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Yield {
    passed: usize,
    worlds: usize,
    share: f64,
    low: f64,
    high: f64,
}

impl From<Proportion> for Yield {
    fn from(proportion: Proportion) -> Self {
        let [low, high] = proportion.interval();
        Self { passed: proportion.successes, worlds: proportion.attempts, share: proportion.share(), low, high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(successes: usize, attempts: usize, expected: [f64; 2]) {
        let found = Proportion { successes, attempts }.interval();
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 5e-5, "{successes} of {attempts}: {found}, expected {expected}");
        }
    }

    #[test]
    fn intervals_are_wilsons() {
        // Newcombe (1998), "Two-sided confidence intervals for the single proportion", method 3.
        check(81, 263, [0.2553, 0.3662]);
        check(15, 148, [0.0624, 0.1605]);
        check(0, 20, [0.0, 0.1611]);
        check(1, 29, [0.0061, 0.1718]);
        check(20, 20, [0.8389, 1.0]);
        assert_eq!(Proportion::default().interval(), [0.0, 1.0]);
    }
}
