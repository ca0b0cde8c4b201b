//! What a body needs of the images of a schedule: each pixel is covered in turn.

use std::sync::Arc;

use crate::recognition::Recognition;
use crate::report::{OcclusionMap, Scheme, Svg, draw_occlusion};
use nbc_base::model::{Body, Image, ImageOrder, ImageSize, MaterialKind, Schedule, Spell};
use nbc_swarm::image_displacements;

/// Shows images to the first body of a recognition, with each pixel covered in turn.
#[derive(Debug)]
pub struct Occlusion {
    recognition: Recognition,
    size: ImageSize,
    mean: Vec<f64>,
    /// Distance in the right direction before each uncovered image, in voxels.
    plain: Vec<f64>,
    losses: Vec<Option<f64>>,
}

impl Occlusion {
    pub fn of(recognition: Recognition) -> Self {
        let images: Vec<&Image> =
            recognition.schedule.schedule.spells.iter().filter_map(|spell| spell.image.as_deref()).collect();
        let size = images.first().expect("a set has images").size();
        let mean = mean(images.iter().copied(), size.pixels());
        let mut occlusion = Self { recognition, size, mean, plain: Vec::new(), losses: Vec::new() };
        occlusion.plain = occlusion.distances(None);
        occlusion
    }

    pub fn progress(&self) -> (u64, u64) {
        (self.losses.len() as u64, self.mean.len() as u64)
    }

    pub fn advance(&mut self) -> bool {
        let pixel = self.losses.len();
        let body = &self.recognition.elites[0].1.body;
        let loss = senses(body, self.size, pixel).then(|| {
            let covered = self.distances(Some(pixel));
            let lost = self.plain.iter().zip(&covered).map(|(plain, covered)| plain - covered);
            lost.sum::<f64>() / self.plain.len() as f64
        });
        self.losses.push(loss);
        self.losses.len() < self.mean.len()
    }

    /// A simulation that failed counts as 0.
    fn distances(&self, covered: Option<usize>) -> Vec<f64> {
        let Recognition { simulator, evolution, schedule, elites, .. } = &self.recognition;
        let (_, elite) = &elites[0];
        let cover = |spell: &Spell| {
            let image = spell.image.as_deref().expect("a schedule with sets shows images");
            let mut pixels = image.pixels().to_vec();
            if let Some(pixel) = covered {
                pixels[pixel] = self.mean[pixel];
            }
            let image = Image::new(self.size, pixels).expect("means of pixels are pixels");
            Spell { image: Some(Arc::new(image)), ..spell.clone() }
        };
        let spells: Vec<Spell> = schedule.schedule.spells.iter().map(cover).collect();
        let signs: Vec<f64> = spells.iter().map(|spell| elite.behavior.direction(spell.pattern).sign()).collect();
        let (shown, body) = (Schedule { spells }, std::slice::from_ref(&elite.body));
        let walked = image_displacements(simulator, &evolution.world, ImageOrder::Apart, &shown, body);
        walked.into_iter().flatten().zip(signs).map(|(moved, sign)| moved.unwrap_or(0.0) * sign).collect()
    }

    pub fn draw(&self, scheme: Scheme) -> Svg {
        let Recognition { evolution, schedule, elites, .. } = &self.recognition;
        let set = |(number, name): (usize, &String)| {
            let pattern = Schedule::of_set(number);
            let own = schedule.schedule.spells.iter().filter(|spell| spell.pattern == pattern);
            (name.clone(), mean(own.filter_map(|spell| spell.image.as_deref()), self.mean.len()))
        };
        let sets: Vec<(String, Vec<f64>)> = schedule.sets.iter().enumerate().map(set).collect();
        let title = format!("{}: what its best body needs of {}", evolution.name, schedule.name);
        let body = &elites[0].1.body;
        let map = OcclusionMap { title: &title, body, size: self.size, losses: &self.losses, sets: &sets };
        draw_occlusion(&map, scheme)
    }
}

fn mean<'a>(images: impl Iterator<Item = &'a Image>, pixels: usize) -> Vec<f64> {
    let (mut sum, mut count) = (vec![0.0; pixels], 0.0);
    for image in images {
        count += 1.0;
        sum.iter_mut().zip(image.pixels()).for_each(|(sum, pixel)| *sum += pixel);
    }
    sum.into_iter().map(|sum: f64| if count > 0.0 { (sum / count).clamp(0.0, 1.0) } else { 0.0 }).collect()
}

fn senses(body: &Body, size: ImageSize, pixel: usize) -> bool {
    let mut pixels = vec![0.0; size.pixels()];
    pixels[pixel] = 1.0;
    let image = Image::new(size, pixels).expect("one pixel is an image");
    let sees = |code: u8| match body.palette().kind(code) {
        Some(MaterialKind::Sensor(response)) => response.image.is_some(),
        _ => false,
    };
    let (width, height) = (body.width(), body.height());
    let place = |at: usize| image.over([at / width, at % width], [height, width]);
    body.codes().iter().enumerate().any(|(at, &code)| sees(code) && place(at) > 0.0)
}
