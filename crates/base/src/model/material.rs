//! Materials of voxels, and their response to time and stimuli.

use serde::{Deserialize, Serialize};

use super::wording::{foreign_field, material_number, missing_field};
use super::{ImageSize, Pattern};

/// A declared material: a name and a response.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "Record", into = "Record")]
pub struct Material {
    /// The name in the program, unique in its palette.
    pub name: String,
    pub kind: MaterialKind,
}

/// The response of a material (docs/physics.md 3 and 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialKind {
    /// Passive and stiff: keeps its shape.
    Rigid,
    /// Passive and compliant: bends with its neighbors.
    Soft,
    Actuator(Drive),
    /// Swells or shrinks with a stimulus, or with an image at its place.
    Sensor(Response),
}

/// The sine that drives an actuator (docs/physics.md 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Samples of one period, in env steps. Both ends are samples, so the last and the first have the same phase.
    pub period: u32,
    /// The phase at the start of the clock, in degrees.
    pub phase: f64,
    /// Smallest width, as a fraction of the rest width.
    pub low: f64,
    /// Largest width, as a fraction of the rest width.
    pub high: f64,
}

/// The response of a sensor to its stimulus (docs/physics.md 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// The stimulus it senses, counted from 0.
    pub stimulus: usize,
    /// The size of the image it senses, if its stimulus is one. Its width is then between those for absent
    /// and present, by the value of the image at its place.
    pub image: Option<ImageSize>,
    /// Width while the stimulus is absent, as a fraction of the rest width.
    pub absent: f64,
    /// Width while the stimulus is present, as a fraction of the rest width.
    pub present: f64,
}

impl Response {
    /// The response to a stimulus that is present or absent everywhere.
    pub fn of(stimulus: usize, absent: f64, present: f64) -> Self {
        Self { stimulus, image: None, absent, present }
    }

    pub fn width(&self, value: f64) -> f64 {
        if value >= 1.0 { self.present } else { self.absent + value * (self.present - self.absent) }
    }
}

impl MaterialKind {
    /// The bits of its numbers, which have a total order.
    pub(super) fn bits(&self) -> (u8, u64, [u64; 3]) {
        match *self {
            Self::Rigid => (0, 0, [0; 3]),
            Self::Soft => (1, 0, [0; 3]),
            Self::Actuator(Drive { period, phase, low, high }) => {
                (2, period.into(), [phase, low, high].map(f64::to_bits))
            }
            Self::Sensor(Response { stimulus, image, absent, present }) => {
                let image = image.map_or(0, |size| (size.rows as u64) << 32 | size.columns as u64);
                (3, stimulus as u64, [absent.to_bits(), present.to_bits(), image])
            }
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Rigid | Self::Soft => true,
            Self::Actuator(Drive { phase, low, high, .. }) => {
                [phase, low, high].iter().all(|number| number.is_finite())
            }
            Self::Sensor(Response { absent, present, .. }) => absent.is_finite() && present.is_finite(),
        }
    }
}

/// A material as data: one flat mapping with the language's fields, in their order.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a mapping with the fields of a material")]
struct Record {
    name: String,
    kind: Word,
    /// Of an actuator, in env steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    period: Option<u32>,
    /// Of an actuator, in degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
    /// Least and greatest width of an actuator.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    range: Option<[f64; 2]>,
    /// Of a sensor, counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    stimulus: Option<usize>,
    /// Rows and columns of the image that a sensor senses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    image: Option<ImageSize>,
    /// Width of a sensor without its stimulus.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    absent: Option<f64>,
    /// Width of a sensor with its stimulus.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    present: Option<f64>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
enum Word {
    Rigid,
    Soft,
    Actuator,
    Sensor,
}

impl From<Material> for Record {
    fn from(material: Material) -> Self {
        let mut record = Self {
            name: material.name,
            kind: Word::Rigid,
            period: None,
            phase: None,
            range: None,
            stimulus: None,
            image: None,
            absent: None,
            present: None,
        };
        match material.kind {
            MaterialKind::Rigid => {}
            MaterialKind::Soft => record.kind = Word::Soft,
            MaterialKind::Actuator(Drive { period, phase, low, high }) => {
                record.kind = Word::Actuator;
                (record.period, record.phase, record.range) = (Some(period), Some(phase), Some([low, high]));
            }
            MaterialKind::Sensor(Response { stimulus, image, absent, present }) => {
                record.kind = Word::Sensor;
                (record.stimulus, record.image) = (image.is_none().then_some(stimulus + 1), image);
                (record.absent, record.present) = (Some(absent), Some(present));
            }
        }
        record
    }
}

impl TryFrom<Record> for Material {
    type Error = String;

    fn try_from(record: Record) -> Result<Self, String> {
        let kind = match record.kind {
            Word::Rigid => MaterialKind::Rigid,
            Word::Soft => MaterialKind::Soft,
            Word::Actuator => {
                let [low, high] = record.need("range", record.range)?;
                let (period, phase) = (record.need("period", record.period)?, record.need("phase", record.phase)?);
                MaterialKind::Actuator(Drive { period, phase, low, high })
            }
            Word::Sensor => MaterialKind::Sensor(Response {
                stimulus: match record.image {
                    Some(_) => 0,
                    None => record.need("stimulus", record.stimulus)?.wrapping_sub(1),
                },
                image: record.image,
                absent: record.need("absent", record.absent)?,
                present: record.need("present", record.present)?,
            }),
        };
        record.refuse_foreign()?;
        record.check_numbers()?;
        Ok(Self { name: record.name, kind })
    }
}

impl Record {
    fn need<T>(&self, field: &'static str, value: Option<T>) -> Result<T, String> {
        value.ok_or_else(|| missing_field(&self.name, field))
    }

    fn refuse_foreign(&self) -> Result<(), String> {
        let (drives, senses) = (matches!(self.kind, Word::Actuator), matches!(self.kind, Word::Sensor));
        let fields = [
            ("period", self.period.is_some() && !drives),
            ("phase", self.phase.is_some() && !drives),
            ("range", self.range.is_some() && !drives),
            ("stimulus", self.stimulus.is_some() && (!senses || self.image.is_some())),
            ("image", self.image.is_some() && !senses),
            ("absent", self.absent.is_some() && !senses),
            ("present", self.present.is_some() && !senses),
        ];
        match fields.into_iter().find(|(_, foreign)| *foreign) {
            Some((field, _)) => Err(foreign_field(&self.name, field)),
            None => Ok(()),
        }
    }

    fn check_numbers(&self) -> Result<(), String> {
        let bad = |field, found: String, expected: &str| Err(material_number(&self.name, field, &found, expected));
        if let Some(period) = self.period.filter(|period| !(1..=MAX_PERIOD).contains(period)) {
            return bad("period", period.to_string(), &format!("1 to {MAX_PERIOD} env steps"));
        }
        if let Some(phase) = self.phase.filter(|phase| !phase.is_finite()) {
            return bad("phase", phase.to_string(), "a finite number of degrees");
        }
        if let Some([low, high]) = self.range.filter(|[low, high]| !(is_width(*low) && is_width(*high) && low <= high))
        {
            return bad("range", format!("[{low:?}, {high:?}]"), "widths from 0.6 to 1.6, the smallest first");
        }
        if let Some(stimulus) = self.stimulus.filter(|stimulus| !(1..=Pattern::MAX_STIMULI).contains(stimulus)) {
            return bad("stimulus", stimulus.to_string(), &format!("1 to {}", Pattern::MAX_STIMULI));
        }
        if let Some(ImageSize { rows, columns }) = self.image.filter(|size| !size.is_valid()) {
            return bad(
                "image",
                format!("[{rows}, {columns}]"),
                &format!("1 to {} rows and columns", ImageSize::MAX_SIDE),
            );
        }
        for (field, width) in [("absent", self.absent), ("present", self.present)] {
            if let Some(width) = width.filter(|width| !is_width(*width)) {
                return bad(field, format!("{width:?}"), "a width from 0.6 to 1.6");
            }
        }
        Ok(())
    }
}

/// The longest period of an actuator, in env steps.
const MAX_PERIOD: u32 = 100_000_000;

/// Whether a voxel can have this width, as a fraction of its rest width (docs/physics.md 3).
fn is_width(width: f64) -> bool {
    (0.6..=1.6).contains(&width)
}
