//! Portable network graphics as gray values.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, Transformations};

use super::ImageSize;
use super::wording::ImageFileError;

/// The weights of red, green and blue in gray, in thousandths (ITU-R BT.601).
const WEIGHTS: [u32; 3] = [299, 587, 114];

/// The gray values of a picture of that size, row by row from the top, and the greatest value that its format has.
pub(super) fn gray(bytes: &[u8], size: ImageSize) -> Result<(Vec<f64>, f64), ImageFileError> {
    let damaged = |what| ImageFileError::Damaged { format: "PNG", what };
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|_| damaged("its head"))?;
    // The size limits what the pixels take in memory.
    let (columns, rows) = reader.info().size();
    let found = ImageSize::new(rows as usize, columns as usize);
    if found != size {
        return Err(ImageFileError::Size { found, expected: size });
    }
    let mut buffer = vec![0; reader.output_buffer_size().ok_or(damaged("its head"))?];
    reader.next_frame(&mut buffer).map_err(|_| damaged("its pixels"))?;
    let (color, depth) = reader.output_color_type();
    let (wide, white) = if depth == BitDepth::Sixteen { (2, 65535) } else { (1, 255) };
    let samples: Vec<u32> =
        buffer.chunks_exact(wide).map(|bytes| bytes.iter().fold(0, |sum, &byte| sum << 8 | u32::from(byte))).collect();
    let luma = |colors: &[u32]| {
        let sum: u64 = WEIGHTS.iter().zip(colors).map(|(&weight, &color)| u64::from(weight) * u64::from(color)).sum();
        sum as f64 / 1000.0
    };
    let over_black = |value: f64, alpha: u32| value * (f64::from(alpha) / f64::from(white));
    let value = |sample: &[u32]| match *sample {
        [gray] => f64::from(gray),
        [gray, alpha] => over_black(f64::from(gray), alpha),
        [ref colors @ .., alpha] if color == ColorType::Rgba => over_black(luma(colors), alpha),
        ref colors => luma(colors),
    };
    Ok((samples.chunks_exact(color.samples()).map(value).collect(), f64::from(white)))
}
