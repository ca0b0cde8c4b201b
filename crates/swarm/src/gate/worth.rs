//! The worth of margins: numbers between 0 and 1 in which one half means that the worst cycle stands still.

/// The margin, in voxels per cycle, that scores halfway between zero and infinite margin.
const HALF_MARGIN: f64 = 0.05;

pub(super) fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

pub(super) fn worth(margin: f64) -> f64 {
    if margin.is_infinite() { 1.0 } else { 0.5 + 0.5 * margin / (margin.abs() + HALF_MARGIN) }
}

#[cfg(test)]
pub(super) mod tests {
    use crate::holds::PatternHold;
    use nbc_base::model::{Behavior, Pattern};

    pub(crate) fn nand() -> Behavior {
        "RRRL".parse().unwrap()
    }

    pub(crate) fn hold(before: Option<usize>, pattern: usize, cycles: &[f64]) -> PatternHold {
        let pairs = Pattern::PAIRS;
        PatternHold { before: before.map(|i| pairs[i]), pattern: pairs[pattern], cycles: cycles.to_vec(), height: 0.0 }
    }
}
