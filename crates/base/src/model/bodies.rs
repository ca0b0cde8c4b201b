//! Bodies as data in which each palette stands once, for `#[serde(with)]`.

use std::sync::Arc;

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

use super::{Body, Palette};

/// The palettes, and the rows of each body with the place of its palette.
#[derive(serde::Serialize, serde::Deserialize)]
struct Written(Vec<Arc<Palette>>, Vec<(usize, Vec<String>)>);

pub fn serialize<S: Serializer>(bodies: &[Body], serializer: S) -> Result<S::Ok, S::Error> {
    let mut written = Written(Vec::new(), Vec::new());
    for body in bodies {
        let known = written.0.iter().position(|palette| palette == body.palette());
        let place = known.unwrap_or_else(|| {
            written.0.push(Arc::clone(body.palette()));
            written.0.len() - 1
        });
        written.1.push((place, body.rows()));
    }
    written.serialize(serializer)
}

pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Body>, D::Error> {
    let Written(palettes, bodies) = Written::deserialize(deserializer)?;
    let body = |(palette, rows): (usize, Vec<String>)| {
        let palette = palettes.get(palette).ok_or_else(|| D::Error::custom("a body without a palette"))?;
        Body::parse(&rows, palette).map_err(D::Error::custom)
    };
    bodies.into_iter().map(body).collect()
}
