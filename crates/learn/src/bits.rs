//! Sets of rows: a bit for each row, in words.

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bits {
    words: Vec<u64>,
    rows: usize,
}

impl Bits {
    pub fn all(rows: usize, bit: bool) -> Self {
        let mut bits = Self { words: vec![if bit { u64::MAX } else { 0 }; rows.div_ceil(64)], rows };
        bits.trim();
        bits
    }

    pub fn of(bits: impl IntoIterator<Item = bool>) -> Self {
        let (mut words, mut rows) = (Vec::new(), 0);
        for bit in bits {
            if rows % 64 == 0 {
                words.push(0);
            }
            words[rows / 64] |= u64::from(bit) << (rows % 64);
            rows += 1;
        }
        Self { words, rows }
    }

    fn trim(&mut self) {
        if !self.rows.is_multiple_of(64)
            && let Some(last) = self.words.last_mut()
        {
            *last &= (1 << (self.rows % 64)) - 1;
        }
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    pub fn get(&self, row: usize) -> bool {
        self.words[row / 64] >> (row % 64) & 1 == 1
    }

    pub fn count(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    pub fn count_and(&self, other: &Self) -> usize {
        self.words.iter().zip(&other.words).map(|(one, two)| (one & two).count_ones() as usize).sum()
    }

    pub fn count_and_3(&self, two: &Self, three: &Self) -> usize {
        let words = self.words.iter().zip(&two.words).zip(&three.words);
        words.map(|((one, two), three)| (one & two & three).count_ones() as usize).sum()
    }

    pub fn ones(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(at, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                let bit = rest.trailing_zeros() as usize;
                (rest != 0).then(|| {
                    rest &= rest - 1;
                    at * 64 + bit
                })
            })
        })
    }

    fn with(&self, other: &Self, operation: impl Fn(u64, u64) -> u64) -> Self {
        let words = self.words.iter().zip(&other.words).map(|(&one, &two)| operation(one, two)).collect();
        let mut bits = Self { words, rows: self.rows };
        bits.trim();
        bits
    }

    pub fn and(&self, other: &Self) -> Self {
        self.with(other, |one, two| one & two)
    }

    pub fn and_not(&self, other: &Self) -> Self {
        self.with(other, |one, two| one & !two)
    }

    pub fn or(&self, other: &Self) -> Self {
        self.with(other, |one, two| one | two)
    }

    pub fn xor(&self, other: &Self) -> Self {
        self.with(other, |one, two| one ^ two)
    }

    pub fn not(&self) -> Self {
        self.with(self, |one, _| !one)
    }

    pub fn pick(&self, picked: &[usize]) -> Self {
        Self::of(picked.iter().map(|&row| self.get(row)))
    }
}
