//! Files of images: rows of numbers as CSV, portable graymaps, PNG, and the files of MNIST.

use super::wording::ImageFileError;
use super::{Image, ImageSize};

#[derive(Clone, Debug, PartialEq)]
pub struct LabeledImage {
    pub label: Option<String>,
    pub image: Image,
}

#[derive(Clone, Copy, Debug)]
pub struct ImageFile<'a> {
    pub name: &'a str,
    pub bytes: &'a [u8],
    pub labels: Option<&'a [u8]>,
    pub size: ImageSize,
    /// The number of the file that stands for 1; without it, the greatest that its format has.
    pub white: Option<f64>,
}

const IDX_IMAGES: [u8; 4] = [0, 0, 8, 3];
const IDX_LABELS: [u8; 4] = [0, 0, 8, 1];
const IDX_HEADERS: [usize; 2] = [16, 8];

impl ImageFile<'_> {
    /// The path of the labels of MNIST's images; other files have no labels beside them.
    pub fn labels_beside(path: &str) -> Option<String> {
        path.contains("images-idx3").then(|| path.replace("images-idx3", "labels-idx1"))
    }

    pub fn read(&self) -> Result<Vec<LabeledImage>, ImageFileError> {
        let name = self.name.to_ascii_lowercase();
        let images = match name.rsplit(['.', '-']).next() {
            Some("csv") => self.csv()?,
            Some("pgm") => vec![self.pgm()?],
            Some("png") => vec![self.png()?],
            Some("ubyte" | "idx" | "idx3") => self.idx()?,
            _ => return Err(ImageFileError::Format),
        };
        if images.is_empty() { Err(ImageFileError::Empty) } else { Ok(images) }
    }

    fn image(&self, numbers: &[f64], white: f64, line: Option<usize>) -> Result<Image, ImageFileError> {
        let bad = numbers.iter().find(|number| !(0.0..=white).contains(*number));
        if let Some(bad) = bad {
            return Err(ImageFileError::Range { line, found: bad.to_string(), white: white.to_string() });
        }
        let pixels = numbers.iter().map(|number| number / white).collect();
        Image::new(self.size, pixels).map_err(ImageFileError::Image)
    }

    /// A line for each image: pixels as numbers, or as the bits of one, then a label. The first line may name columns.
    fn csv(&self) -> Result<Vec<LabeledImage>, ImageFileError> {
        let text = std::str::from_utf8(self.bytes).map_err(|_| ImageFileError::NotText)?;
        let lines = (1..).zip(text.lines()).map(|(line, text)| (line, text.split('#').next().unwrap_or("").trim()));
        let mut lines = lines.filter(|(_, text)| !text.is_empty()).peekable();
        let is_names = |text: &str| text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '"');
        let names = lines.next_if(|(_, text)| is_names(text)).map(|(_, text)| cells(text));
        let labels = names.and_then(|names| names.iter().position(|name| name.eq_ignore_ascii_case("label")));
        lines.map(|(line, text)| self.csv_row(line, cells(text), labels)).collect()
    }

    fn csv_row(
        &self,
        line: usize,
        mut cells: Vec<&str>,
        labels: Option<usize>,
    ) -> Result<LabeledImage, ImageFileError> {
        let (found, pixels) = (cells.len(), self.size.pixels());
        let are_bits = cells[0].starts_with("0x") || cells[0].starts_with("0b");
        let expected = if are_bits { 1 } else { pixels };
        let label = match found {
            _ if found == expected => None,
            _ if found == expected + 1 => Some(cells.remove(labels.unwrap_or(expected)).to_owned()),
            _ => return Err(ImageFileError::Row { line, found, expected }),
        };
        let value = |text: &str| ImageFileError::Value { line, text: text.to_owned() };
        if are_bits {
            let bits = bits(cells[0]).ok_or_else(|| value(cells[0]))?;
            if bits.len() != pixels {
                return Err(ImageFileError::Row { line, found: bits.len(), expected: pixels });
            }
            return Ok(LabeledImage { label, image: self.image(&bits, 1.0, Some(line))? });
        }
        let number = |text: &&str| text.parse::<f64>().map_err(|_| value(text));
        let numbers: Vec<f64> = cells.iter().map(number).collect::<Result<_, _>>()?;
        Ok(LabeledImage { label, image: self.image(&numbers, self.white.unwrap_or(1.0), Some(line))? })
    }

    fn pgm(&self) -> Result<LabeledImage, ImageFileError> {
        let mut words = Words { bytes: self.bytes, at: 0 };
        let damaged = |what| ImageFileError::Damaged { format: "PGM", what };
        let kind = words.next().ok_or(damaged("its head"))?;
        let mut head = || words.next().and_then(|word| std::str::from_utf8(word).ok()?.parse::<usize>().ok());
        let head = [head(), head(), head()];
        let [Some(columns), Some(rows), Some(greatest @ 1..=65535)] = head else { return Err(damaged("its head")) };
        self.check_size(ImageSize { rows, columns })?;
        let numbers: Vec<f64> = match kind {
            b"P2" => {
                let number = |word: &[u8]| std::str::from_utf8(word).ok()?.parse::<u16>().ok().map(f64::from);
                let numbers: Option<Vec<f64>> = words.by_ref().take(self.size.pixels()).map(number).collect();
                numbers.ok_or(damaged("a pixel"))?
            }
            b"P5" => {
                let wide = if greatest > 255 { 2 } else { 1 };
                // One blank ends the head.
                let bytes = self.bytes.get(words.at + 1..).unwrap_or(&[]).chunks_exact(wide).take(self.size.pixels());
                bytes.map(|bytes| bytes.iter().fold(0.0, |sum, &byte| sum * 256.0 + f64::from(byte))).collect()
            }
            _ => return Err(damaged("its head")),
        };
        if numbers.len() < self.size.pixels() {
            return Err(damaged("its pixels"));
        }
        Ok(LabeledImage { label: None, image: self.image(&numbers, self.white.unwrap_or(greatest as f64), None)? })
    }

    #[cfg(feature = "pictures")]
    fn png(&self) -> Result<LabeledImage, ImageFileError> {
        let (numbers, greatest) = super::png_file::gray(self.bytes, self.size)?;
        Ok(LabeledImage { label: None, image: self.image(&numbers, self.white.unwrap_or(greatest), None)? })
    }

    #[cfg(not(feature = "pictures"))]
    fn png(&self) -> Result<LabeledImage, ImageFileError> {
        Err(ImageFileError::NoPng)
    }

    /// The files of MNIST: bytes after a head of big-endian numbers.
    fn idx(&self) -> Result<Vec<LabeledImage>, ImageFileError> {
        let damaged = |what| ImageFileError::Damaged { format: "idx", what };
        let number = |bytes: &[u8], at: usize| {
            let word = bytes.get(at..at + 4)?;
            Some(word.iter().fold(0usize, |sum, &byte| sum << 8 | usize::from(byte)))
        };
        let head = [4, 8, 12].map(|at| number(self.bytes, at));
        let [Some(count), Some(rows), Some(columns)] = head else { return Err(damaged("its head")) };
        if !self.bytes.starts_with(&IDX_IMAGES) {
            return Err(damaged("its head"));
        }
        self.check_size(ImageSize { rows, columns })?;
        let pixels = self.bytes[IDX_HEADERS[0]..].chunks_exact(self.size.pixels());
        if pixels.len() != count {
            return Err(damaged("its pixels"));
        }
        let labels = match self.labels {
            Some(labels) if labels.starts_with(&IDX_LABELS) && labels.len() == IDX_HEADERS[1] + count => {
                Some(&labels[IDX_HEADERS[1]..])
            }
            Some(_) => return Err(damaged("its labels")),
            None => None,
        };
        let image = |(at, pixels): (usize, &[u8])| {
            let numbers: Vec<f64> = pixels.iter().map(|&byte| f64::from(byte)).collect();
            let label = labels.map(|labels| labels[at].to_string());
            Ok(LabeledImage { label, image: self.image(&numbers, self.white.unwrap_or(255.0), None)? })
        };
        pixels.enumerate().map(image).collect()
    }

    fn check_size(&self, found: ImageSize) -> Result<(), ImageFileError> {
        if found == self.size { Ok(()) } else { Err(ImageFileError::Size { found, expected: self.size }) }
    }
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(|cell| cell.trim().trim_matches('"')).collect()
}

fn bits(number: &str) -> Option<Vec<f64>> {
    let (digits, radix, each) = match number.strip_prefix("0x") {
        Some(digits) => (digits, 16, 4),
        None => (number.strip_prefix("0b")?, 2, 1),
    };
    let mut bits = Vec::with_capacity(digits.len() * each);
    for digit in digits.chars() {
        let digit = digit.to_digit(radix)?;
        bits.extend((0..each).rev().map(|bit| f64::from(digit >> bit & 1)));
    }
    Some(bits)
}

struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        while let Some(byte) = self.bytes.get(self.at) {
            if *byte == b'#' {
                while self.bytes.get(self.at).is_some_and(|byte| *byte != b'\n') {
                    self.at += 1;
                }
            } else if byte.is_ascii_whitespace() {
                self.at += 1;
            } else {
                let from = self.at;
                while self.bytes.get(self.at).is_some_and(|byte| !byte.is_ascii_whitespace()) {
                    self.at += 1;
                }
                return Some(&self.bytes[from..self.at]);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, bytes: &[u8], size: ImageSize, white: Option<f64>) -> Result<Vec<LabeledImage>, String> {
        ImageFile { name, bytes, labels: None, size, white }.read().map_err(|error| error.to_string())
    }

    fn check(name: &str, bytes: &[u8], white: Option<f64>, expected: &[(&[f64], Option<&str>)]) {
        let found = read(name, bytes, ImageSize::new(2, 2), white).unwrap();
        let found: Vec<(&[f64], Option<&str>)> =
            found.iter().map(|one| (one.image.pixels(), one.label.as_deref())).collect();
        assert_eq!(found, expected, "{name}");
    }

    #[test]
    fn images_are_read_from_rows() {
        let pixels: &[f64] = &[0.0, 0.5, 1.0, 0.25];
        check(
            "a.csv",
            b"# ink\n0, 8, 16, 4, zero\n\n16,16,0,0,1 # one\n",
            Some(16.0),
            &[(pixels, Some("zero")), (&[1.0, 1.0, 0.0, 0.0], Some("1"))],
        );
        check("a.csv", b"p0,p1,p2,p3\n0,0.5,1,0.25\n", None, &[(pixels, None)]);
        check("a.csv", b"Label,p0,p1,p2,p3\n7,0,127.5,255,63.75\n", Some(255.0), &[(pixels, Some("7"))]);
        check(
            "a.csv",
            b"pixels,digit\n0x6,3\n0b1000,4\n",
            None,
            &[(&[0.0, 1.0, 1.0, 0.0], Some("3")), (&[1.0, 0.0, 0.0, 0.0], Some("4"))],
        );
    }

    #[test]
    fn images_are_read_from_graymaps_and_from_the_files_of_mnist() {
        let pixels: &[f64] = &[0.0, 0.5, 1.0, 0.25];
        check("a.pgm", b"P2 # text\n2 2\n16\n0 8\n16 4\n", None, &[(pixels, None)]);
        check("a.pgm", b"P5 2 2 64\n\x00\x20\x40\x10", None, &[(pixels, None)]);
        check("a.pgm", b"P5 2 2 512\n\x00\x00\x01\x00\x02\x00\x00\x80", None, &[(pixels, None)]);
        let mut file = vec![0, 0, 8, 3, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2];
        file.extend([0, 255, 51, 0, 255, 0, 0, 0]);
        let labels = [0, 0, 8, 1, 0, 0, 0, 2, 5, 0];
        let read = ImageFile {
            name: "train-images-idx3-ubyte",
            bytes: &file,
            labels: Some(&labels),
            size: ImageSize::new(2, 2),
            white: None,
        };
        let found = read.read().unwrap();
        assert_eq!((found[0].image.pixels(), found[0].label.as_deref()), (&[0.0, 1.0, 0.2, 0.0][..], Some("5")));
        assert_eq!((found[1].image.pixels()[0], found[1].label.as_deref()), (1.0, Some("0")));
        assert!(ImageFile { labels: Some(&labels[..9]), ..read }.read().is_err());
        assert_eq!(ImageFile::labels_beside("a/train-images-idx3-ubyte").as_deref(), Some("a/train-labels-idx1-ubyte"));
    }

    #[cfg(feature = "pictures")]
    fn png(color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == png::ColorType::Indexed {
            encoder.set_palette(&[0, 0, 0, 255, 255, 255, 51, 51, 51][..]);
        }
        encoder.write_header().unwrap().write_image_data(data).unwrap();
        bytes
    }

    #[test]
    #[cfg(feature = "pictures")]
    fn images_are_read_from_png_as_gray() {
        use png::{BitDepth, ColorType};
        let check = |color, depth, data: &[u8], white, expected: [f64; 4]| {
            super::tests::check("a.PNG", &png(color, depth, data), white, &[(&expected, None)]);
        };
        check(ColorType::Grayscale, BitDepth::Eight, &[0, 255, 51, 0], None, [0.0, 1.0, 0.2, 0.0]);
        check(ColorType::Grayscale, BitDepth::Eight, &[0, 8, 16, 4], Some(16.0), [0.0, 0.5, 1.0, 0.25]);
        check(ColorType::Grayscale, BitDepth::One, &[0x40, 0x80], None, [0.0, 1.0, 1.0, 0.0]);
        check(ColorType::Grayscale, BitDepth::Sixteen, &[0, 0, 255, 255, 51, 51, 0, 0], None, [0.0, 1.0, 0.2, 0.0]);
        check(ColorType::Indexed, BitDepth::Eight, &[0, 1, 2, 0], None, [0.0, 1.0, 0.2, 0.0]);
        let colors = [255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255];
        check(ColorType::Rgb, BitDepth::Eight, &colors, None, [1.0, 0.29900000000000004, 0.587, 0.114]);
        let transparent = [255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 51, 0, 0, 0, 255];
        check(ColorType::Rgba, BitDepth::Eight, &transparent, None, [0.0, 1.0, 0.2, 0.0]);
        check(
            ColorType::GrayscaleAlpha,
            BitDepth::Eight,
            &[255, 0, 255, 255, 255, 51, 0, 255],
            None,
            [0.0, 1.0, 0.2, 0.0],
        );
        let whole = png(ColorType::Grayscale, BitDepth::Eight, &[0, 255, 51, 0]);
        let read = |bytes: &[u8], size| read("a.png", bytes, size, None).map(|_| ());
        let size = "its images have 2 rows and 2 columns, expected 3 and 2";
        assert_eq!(read(&whole, ImageSize::new(3, 2)), Err(size.to_owned()));
        let damaged = |what: &str| Err(format!("it is a damaged PNG file: {what} not complete"));
        assert_eq!(read(&whole[..20], ImageSize::new(2, 2)), damaged("its head is"));
        assert_eq!(read(&whole[..45], ImageSize::new(2, 2)), damaged("its pixels are"));
    }

    #[test]
    #[cfg(not(feature = "pictures"))]
    fn a_build_without_pictures_reads_no_png() {
        assert_eq!(
            read("a.png", b"", ImageSize::new(2, 2), None),
            Err("this program was built without PNG".to_owned())
        );
    }

    #[test]
    fn what_is_wrong_with_a_file_is_named() {
        let check = |name: &str, bytes: &[u8], expected: &str| {
            assert_eq!(read(name, bytes, ImageSize::new(2, 2), None), Err(expected.to_owned()));
        };
        check("a.txt", b"", "it has none of the formats of images");
        check("a.csv", b"# nothing\n", "it has no images");
        check("a.csv", b"0,1,0\n", "line 1: 3 values, expected 4 and perhaps a label");
        check("a.csv", b"0,1,0,x\n", "line 1: `x` is not a number");
        check("a.csv", b"0,1,0,16\n", "line 1: the pixel is 16, expected 0 to 1");
        check("a.csv", b"0x12,0\n", "line 1: 8 values, expected 4 and perhaps a label");
        check("a.pgm", b"P5 3 2 255\n123456", "its images have 2 rows and 3 columns, expected 2 and 2");
        check("a.pgm", b"P5 2 2 255\n123", "it is a damaged PGM file: its pixels are not complete");
        check("x-ubyte", b"", "it is a damaged idx file: its head is not complete");
    }
}
