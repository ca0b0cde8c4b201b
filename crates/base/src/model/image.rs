//! Images: stimuli whose value varies over the body.

use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

use serde::{Deserialize, Serialize};

use super::ImageSize;
use super::wording::{image_pixels, image_size, pixel_range, ragged_image};

/// The values of a stimulus over a body, from 0 for absent to 1 for present: rows of pixels, row 0 on top.
/// Images are equal when their values are, to the bit.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Vec<Vec<f64>>", into = "Vec<Vec<f64>>")]
pub struct Image {
    size: ImageSize,
    pixels: Vec<f64>,
}

impl Image {
    pub fn new(size: ImageSize, pixels: Vec<f64>) -> Result<Self, String> {
        let ImageSize { rows, columns } = size;
        if !size.is_valid() {
            return Err(image_size(rows, columns));
        }
        if pixels.len() != size.pixels() {
            return Err(image_pixels(pixels.len(), rows, columns));
        }
        match pixels.iter().position(|pixel| !(0.0..=1.0).contains(pixel)) {
            Some(at) => Err(pixel_range(at / columns + 1, at % columns + 1, pixels[at])),
            None => Ok(Self { size, pixels }),
        }
    }

    pub fn size(&self) -> ImageSize {
        self.size
    }

    pub fn pixels(&self) -> &[f64] {
        &self.pixels
    }

    /// The value over a place of a body, whose box the image covers: the mean of the pixels over the place, by area.
    /// On a body of its own size it is the pixel at the place.
    pub fn over(&self, [row, column]: [usize; 2], [height, width]: [usize; 2]) -> f64 {
        assert!(row < height && column < width, "a place is inside its box");
        // The place and the pixels in units in which both have whole sides.
        let parts = |at: usize, of: usize, pixels: usize| {
            let (from, to) = (at * pixels, (at + 1) * pixels);
            let share = move |pixel: usize| (pixel, to.min((pixel + 1) * of) - from.max(pixel * of));
            (from / of..to.div_ceil(of)).map(share)
        };
        let ImageSize { rows, columns } = self.size;
        let area = rows * columns;
        let mut sum = 0.0;
        for (y, high) in parts(row, height, rows) {
            for (x, wide) in parts(column, width, columns) {
                let pixel = self.pixels[y * columns + x];
                if high * wide == area {
                    return pixel;
                }
                sum += pixel * (high * wide) as f64;
            }
        }
        sum / area as f64
    }

    fn key(&self) -> (ImageSize, impl Iterator<Item = u64>) {
        (self.size, self.pixels.iter().map(|pixel| pixel.to_bits()))
    }
}

impl TryFrom<Vec<Vec<f64>>> for Image {
    type Error = String;

    fn try_from(rows: Vec<Vec<f64>>) -> Result<Self, String> {
        let columns = rows.first().map_or(0, Vec::len);
        match rows.iter().position(|row| row.len() != columns) {
            Some(row) => Err(ragged_image(row + 1, rows[row].len(), columns)),
            None => Self::new(ImageSize::new(rows.len(), columns), rows.concat()),
        }
    }
}

impl From<Image> for Vec<Vec<f64>> {
    fn from(image: Image) -> Self {
        image.pixels.chunks(image.size.columns).map(<[f64]>::to_vec).collect()
    }
}

impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Image {}

impl PartialOrd for Image {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Image {
    fn cmp(&self, other: &Self) -> Ordering {
        let (own, others) = (self.key(), other.key());
        own.0.cmp(&others.0).then_with(|| own.1.cmp(others.1))
    }
}

impl Hash for Image {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let (size, bits) = self.key();
        size.hash(state);
        bits.for_each(|bits| bits.hash(state));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(rows: &[&[f64]]) -> Image {
        Image::try_from(rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_body_of_the_images_size_senses_its_pixels_to_the_bit() {
        let values: Vec<f64> = (0..49).map(|at| f64::from(at) / 48.0).collect();
        let image = Image::new(ImageSize::new(7, 7), values.clone()).unwrap();
        let sensed: Vec<f64> = (0..49).map(|at| image.over([at / 7, at % 7], [7, 7])).collect();
        assert!(sensed.iter().zip(&values).all(|(one, other)| one.to_bits() == other.to_bits()));
    }

    #[test]
    fn a_body_of_another_size_senses_the_mean_of_what_lies_over_it() {
        let image = image(&[&[0.0, 1.0, 0.5], &[1.0, 0.0, 0.5]]);
        let over = |box_: [usize; 2]| -> Vec<f64> {
            (0..box_[0] * box_[1]).map(|at| image.over([at / box_[1], at % box_[1]], box_)).collect()
        };
        assert_eq!(over([1, 1]), [0.5]);
        assert_eq!(over([1, 3]), [0.5, 0.5, 0.5]);
        assert_eq!(over([2, 1]), [0.5, 0.5]);
        // Two columns of one and a half pixels each.
        assert_eq!(over([2, 2]), [0.5 / 1.5, 1.0 / 1.5, 1.0 / 1.5, 0.5 / 1.5]);
        // A larger body: each pixel covers four voxels.
        assert_eq!(over([4, 6])[..6], [0.0, 0.0, 1.0, 1.0, 0.5, 0.5]);
    }

    #[test]
    fn invalid_images_are_refused() {
        let check = |rows: Vec<Vec<f64>>, expected: &str| {
            assert_eq!(Image::try_from(rows), Err(expected.to_owned()));
        };
        check(vec![], "the image has 0 rows and 0 columns, expected 1 to 256 of each");
        check(vec![vec![0.0], vec![]], "row 2 has 0 pixels, expected 1 as in row 1");
        check(vec![vec![0.0, 1.5]], "row 1, column 2: the pixel is 1.5, expected 0 to 1");
        check(vec![vec![f64::NAN]], "row 1, column 1: the pixel is NaN, expected 0 to 1");
    }
}
