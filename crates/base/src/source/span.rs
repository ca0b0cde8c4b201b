//! Places in the source.

/// A file's number in [`super::Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A half-open range of bytes of one source file; twelve bytes, so that every node of a tree can carry one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    pub file: FileId,
    pub start: u32,
    pub end: u32,
}

impl Span {
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        let narrow = |offset: usize| u32::try_from(offset).expect("source files are smaller than 4 GiB");
        Self { file, start: narrow(start), end: narrow(end) }
    }

    pub fn to(self, other: Self) -> Self {
        assert_eq!(self.file, other.file, "a span covers one file only");
        Self { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// Where it is if what was at `from` is at `to`.
    pub fn moved(self, from: Self, to: Self) -> Self {
        let moved = |place: u32| place.wrapping_sub(from.start).wrapping_add(to.start);
        Self { file: to.file, start: moved(self.start), end: moved(self.end) }
    }

    pub fn is_in(self, whole: Self) -> bool {
        self.file == whole.file && whole.start <= self.start && self.end <= whole.end
    }

    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}
