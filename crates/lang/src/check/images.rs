//! Sets of images from files.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::check::fields::{self, Fields};
use crate::check::load::beside;
use crate::check::names::{Home, NameTable};
use crate::check::quantity;
use crate::check::wording;
use crate::check::world::ProgramFiles;
use crate::syntax::tree::{NameSyntax, RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{ImageFile, ImageSize, LabeledImage, NamedImages};
use nbc_base::source::{FileError, Span};

const MOST_IMAGES: u32 = 100_000;

#[derive(Clone, Copy)]
pub(crate) struct Stimuli<'a> {
    pub(crate) names: &'a NameTable,
    pub(crate) image_sizes: &'a BTreeMap<usize, ImageSize>,
}

impl Stimuli<'_> {
    pub(crate) fn resolve(self, name: &NameSyntax, home: Home) -> Result<(usize, Option<ImageSize>), Diagnostic> {
        let stimulus = self.names.resolve(name, home)?;
        Ok((stimulus, self.image_sizes.get(&stimulus).copied()))
    }
}

pub(crate) fn images(
    source: &RecordDeclaration,
    home: Home,
    stimuli: Stimuli<'_>,
    files: ProgramFiles<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<NamedImages> {
    let mut fields = Fields::new("images", source);
    let stimulus = fields.need("stimulus", "stimulus: digit", |value| {
        let name = fields::name(value, "stimulus")?;
        match stimuli.resolve(name, home)? {
            (stimulus, Some(size)) => Ok((stimulus, size)),
            (_, None) => Err(wording::no_image(name)),
        }
    });
    let from = fields.need("from", "from: \"digits.csv\"", |value| match &value.kind {
        ValueKind::Text(path) => Ok((path, value.span)),
        _ => Err(wording::wrong_kind(wording::PATH, value.span)),
    });
    let white = fields.read("white", None, |value| white(value).map(Some));
    let label = fields.read("label", None, |value| label(value).map(Some));
    let take = fields.read("take", None, |value| take(value).map(Some));
    let found = fields.finish();
    let is_sound = found.is_empty();
    faults.extend(found);
    let ((stimulus, size), (path, span)) = stimulus.zip(from).filter(|_| is_sound)?;
    let read = read(path, span, (size, white), files);
    let mut all = read.map_err(|fault| faults.push(fault)).ok()?;
    if let Some((label, place)) = label {
        let known = labels(&all);
        all.retain(|image| image.label.as_deref() == Some(label.as_str()));
        if all.is_empty() {
            faults.push(wording::no_label(&label, &known, place));
            return None;
        }
    }
    let count = all.len();
    let mut images: Vec<_> = all.into_iter().map(|labeled| Arc::new(labeled.image)).collect();
    if let Some((first, last, place)) = take {
        if last as usize > count {
            faults.push(wording::few_images(last, count, place));
            return None;
        }
        images.truncate(last as usize);
        images.drain(..first as usize - 1);
    }
    Some(NamedImages { name: source.name.text.clone(), stimulus, images })
}

fn read(
    path: &str,
    span: Span,
    (size, white): (ImageSize, Option<f64>),
    files: ProgramFiles<'_>,
) -> Result<Vec<LabeledImage>, Diagnostic> {
    let name = beside(&files.sources.file(span.file).name, path);
    let unreadable = |file: &str, error| wording::unreadable_value(file, &error, span);
    let bytes = files.world.read_bytes(&name).map_err(|error| unreadable(&name, error))?;
    let labels = match ImageFile::labels_beside(&name).map(|path| (files.world.read_bytes(&path), path)) {
        None | Some((Err(FileError::NotFound), _)) => None,
        Some((read, path)) => Some(read.map_err(|error| unreadable(&path, error))?),
    };
    let file = ImageFile { name: &name, bytes: &bytes, labels: labels.as_deref(), size, white };
    file.read().map_err(|error| wording::image_file(&name, &error, span))
}

fn labels(images: &[LabeledImage]) -> Vec<String> {
    const SHOWN: usize = 12;
    let mut labels: Vec<String> = images.iter().filter_map(|image| image.label.clone()).collect();
    labels.sort();
    labels.dedup();
    labels.truncate(SHOWN);
    labels
}

fn white(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(given) => quantity::within(quantity::bare(given)?, 0.001..=1e6, value.span),
        _ => Err(wording::wrong_kind(wording::NUMBER, value.span)),
    }
}

fn label(value: &ValueSyntax) -> Result<(String, Span), Diagnostic> {
    let text = match &value.kind {
        ValueKind::Quantity(number) if number.unit.is_none() => number.number.text.clone(),
        ValueKind::Text(text) => text.clone(),
        _ => fields::word(value, wording::LABEL)?.text.clone(),
    };
    Ok((text, value.span))
}

/// The first and the last image to take, from 1.
fn take(value: &ValueSyntax) -> Result<(u32, u32, Span), Diagnostic> {
    let whole = |number: f64| quantity::whole(number, 1..=MOST_IMAGES, value.span, "images");
    match &value.kind {
        ValueKind::Range(first, last) => {
            let (first, last) = (whole(quantity::bare(first)?)?, whole(quantity::bare(last)?)?);
            if first <= last {
                Ok((first, last, value.span))
            } else {
                Err(wording::descending(first.into(), last.into(), value.span))
            }
        }
        _ => Ok((1, quantity::count(value, 1..=MOST_IMAGES)?, value.span)),
    }
}
