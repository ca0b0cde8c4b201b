//! A body under evaluation, with what is known of how it walks.

use crate::distance::walks::Walks;
use crate::evaluation::EvaluationTask;
use nbc_base::model::{Body, Fault, MaterialKind, Pattern};
use nbc_sim::Snapshot;

pub(super) struct Trail {
    /// Where it was at the start and after each stretch, in voxels.
    pub places: Vec<f64>,
    pub fault: Option<Fault>,
    pub state: Snapshot,
}

pub(super) struct Walker {
    pub body: Body,
    pub sensed: Vec<Pattern>,
    pub walks: Walks,
    pub trail: Option<Trail>,
}

impl Walker {
    pub fn new(body: Body) -> Self {
        Self { sensed: sensed_patterns(&body), body, walks: Walks::default(), trail: None }
    }

    pub fn senses(&self, pattern: Pattern) -> Pattern {
        self.sensed[pattern.number(self.sensed.len().ilog2() as usize)]
    }

    pub fn stretches_done(&self) -> usize {
        self.trail.as_ref().map_or(0, |trail| trail.places.len() - 1)
    }

    pub fn different(&self) -> Vec<Pattern> {
        let mut different = self.sensed.clone();
        different.sort_unstable();
        different.dedup();
        different
    }

    /// Of its parent under a pattern that it tells apart: the smallest, if the parent tells more apart.
    pub fn expected(&self, task: &EvaluationTask, pattern: Pattern) -> Option<f64> {
        let same = self.sensed.iter().zip(task.expected.as_deref()?).filter(|(own, _)| **own == pattern);
        same.map(|(_, &moved)| moved).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    pub fn with(&self, known: &[Option<f64>], pattern: Pattern, moved: f64) -> Vec<Option<f64>> {
        let each = self.sensed.iter().zip(known);
        each.map(|(&own, &known)| if own == pattern { Some(moved) } else { known }).collect()
    }
}

fn sensed_patterns(body: &Body) -> Vec<Pattern> {
    let palette = body.palette();
    let mut sensed = vec![false; palette.inputs()];
    for &code in body.codes() {
        // A fourth stimulus is always absent.
        if let Some(MaterialKind::Sensor(response)) = palette.kind(code)
            && response.image.is_none()
            && let Some(sensed) = sensed.get_mut(response.stimulus)
        {
            *sensed = true;
        }
    }
    let of_pattern = |pattern: Pattern| Pattern::of(sensed.iter().enumerate().map(|(i, &on)| on && pattern.has(i)));
    Pattern::all(palette.inputs()).map(of_pattern).collect()
}

#[cfg(test)]
mod tests {
    use nbc_base::model::Palette;

    use super::*;

    #[test]
    fn a_body_of_three_senses_has_eight_patterns() {
        let body = |rows: &[&str]| Body::parse(rows, &Palette::three()).unwrap();
        let patterns =
            |body: Body| sensed_patterns(&body).iter().map(|one| one.digits(3)).collect::<Vec<_>>().join(" ");
        assert_eq!(patterns(body(&["3a4", "373"])), "000 001 000 001 100 101 100 101");
        assert_eq!(Walker::new(body(&["3a4", "576"])).different().len(), 8);
    }
}
