//! Development: from a network to a valid body (docs/physics.md 11).

use std::sync::Arc;

use crate::evolve::{Undeveloped, cppn};
use nbc_base::model::{Body, Genotype, LEAST_ACTUATORS, MaterialKind, Palette, Rules};

/// The body of a network: at each place the code with the highest score, the first of equals.
/// Panics when the network has an output for a code that the palette lacks.
pub fn phenotype(genotype: &Genotype, palette: &Arc<Palette>, rules: Rules, width: usize, height: usize) -> Body {
    let maps = cppn::scores(genotype, rules, width, height);
    let best = |place: usize| {
        let mut best: Option<(u8, f64)> = None;
        for map in &maps {
            if best.is_none_or(|(_, score)| map.scores[place] > score) {
                best = Some((map.code, map.scores[place]));
            }
        }
        best.map_or(0, |(code, _)| code)
    };
    Body::new(width, height, (0..width * height).map(best).collect(), Arc::clone(palette))
}

/// Whether a body is valid: at least three actuators, and in one piece.
pub fn validate(body: &Body) -> Result<(), Undeveloped> {
    let is_actuator = |code: &&u8| matches!(body.palette().kind(**code), Some(MaterialKind::Actuator(_)));
    let found = body.codes().iter().filter(is_actuator).count();
    if found < LEAST_ACTUATORS {
        Err(Undeveloped::FewActuators { found, least: LEAST_ACTUATORS })
    } else if !body.is_connected() {
        Err(Undeveloped::Apart)
    } else {
        Ok(())
    }
}

pub fn develop(
    genotype: &Genotype,
    palette: &Arc<Palette>,
    rules: Rules,
    width: usize,
    height: usize,
) -> Result<Body, Undeveloped> {
    let body = phenotype(genotype, palette, rules, width, height);
    validate(&body).map(|()| body)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::evolve::mutate;
    use nbc_base::model::MutationWeights;

    fn check(rows: &[&str], expected: Result<(), Undeveloped>) {
        assert_eq!(validate(&Body::parse(rows, &Palette::paper()).unwrap()), expected);
    }

    #[test]
    fn a_body_needs_three_actuators_in_one_piece() {
        check(&["333"], Ok(()));
        check(&["341", "200"], Err(Undeveloped::FewActuators { found: 2, least: 3 }));
        check(&["330", "003"], Err(Undeveloped::Apart));
    }

    #[test]
    fn the_start_is_empty() {
        let body = phenotype(&cppn::start(8, Rules::PAPER), &Palette::paper(), Rules::PAPER, 5, 5);
        assert!(body.codes().iter().all(|&code| code == 0), "equal scores give the first code");
    }

    proptest! {
        #[test]
        fn development_gives_connected_bodies_or_a_reason(seed: u64, times in 0..120usize, code: bool) {
            let rules = if code { Rules::CODE } else { Rules::PAPER };
            let palette = Palette::paper();
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let mut genotype = cppn::start(8, rules);
            for _ in 0..times {
                mutate::mutate(&mut genotype, &MutationWeights::default(), rules, &mut rng);
            }
            let body = phenotype(&genotype, &palette, rules, 6, 4);
            let actuators = body.codes().iter().filter(|&&code| code == 3 || code == 4).count();
            match develop(&genotype, &palette, rules, 6, 4) {
                Ok(developed) => prop_assert!(developed == body && body.is_connected() && actuators >= 3),
                Err(Undeveloped::FewActuators { found, .. }) => prop_assert!(found == actuators && found < 3),
                Err(Undeveloped::Apart) => prop_assert!(!body.is_connected()),
            }
        }
    }
}
