//! `--images`: the images that a body is shown.

use std::path::PathBuf;

use clap::Args;

use crate::cli::Failure;
use crate::cli::source_path::source_path;
use crate::cli::wording;
use nbc_base::model::{Body, NamedImages, NamedSchedule, Pattern, Schedule};
use nbc_session::store::DiskWorld;
use nbc_session::{Session, read_image_schedule, read_schedule};

#[derive(Args)]
pub(in crate::cli) struct ImagesArguments {
    /// For bodies that see: the source file (.nb) with the sets of images that the schedule names, as in
    /// `zeros*250steps`
    #[arg(long, value_name = "FILE")]
    images: Option<PathBuf>,
}

pub(in crate::cli) struct ShownSchedule {
    pub(in crate::cli) schedule: Schedule,
    pub(in crate::cli) shown: Vec<String>,
}

impl ImagesArguments {
    pub(in crate::cli) fn is_given(&self) -> bool {
        self.images.is_some()
    }

    /// `None` if there is no text and the bodies do not see.
    pub(in crate::cli) fn schedule<'a>(
        &self,
        text: Option<&str>,
        bodies: impl IntoIterator<Item = &'a Body> + Clone,
    ) -> Result<Option<ShownSchedule>, Failure> {
        let size = bodies.clone().into_iter().find_map(|body| body.palette().image());
        match (size, &self.images, text) {
            (Some(size), Some(file), Some(text)) => {
                let checked = Session::new(DiskWorld).open(source_path(file)?)?;
                let images = &checked.program.images;
                Ok(Some(ShownSchedule::of_images(read_image_schedule("--schedule", text, images, size)?, images)))
            }
            (Some(size), ..) => Err(wording::no_images(size).into()),
            (None, Some(_), _) => Err(wording::nothing_sees().into()),
            (None, None, None) => Ok(None),
            (None, None, Some(text)) => {
                let stimuli = bodies.into_iter().map(|body| body.palette().stimuli()).fold(2, usize::max);
                let schedule = read_schedule("--schedule", text, stimuli)?;
                let shown = schedule.spells.iter().map(|spell| spell.pattern.digits(stimuli)).collect();
                Ok(Some(ShownSchedule { schedule, shown }))
            }
        }
    }
}

impl ShownSchedule {
    /// Each image has the name of its set and its number in it.
    fn of_images(schedule: NamedSchedule, images: &[NamedImages]) -> Self {
        let NamedSchedule { schedule, sets, .. } = schedule;
        let mut shown = vec![String::new(); schedule.spells.len()];
        for (number, name) in sets.iter().enumerate() {
            let pattern: Pattern = Schedule::of_set(number);
            let length = images.iter().find(|set| set.name == *name).map_or(1, |set| set.images.len());
            let own = schedule.spells.iter().zip(&mut shown).filter(|(spell, _)| spell.pattern == pattern);
            // Each entry shows the whole set.
            own.enumerate().for_each(|(at, (_, shown))| *shown = format!("{name} {}", at % length + 1));
        }
        Self { schedule, shown }
    }
}
