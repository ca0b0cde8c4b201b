//! Random whole programs that check, in any layout.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Names that look like bits, numbers or words of other languages.
const MEMBERS: [&str; 8] = ["x1", "X", "z0", "b0", "h1", "rest", "d", "x0"];

const OPERATORS: [&str; 6] = ["and", "or", "xor", "nand", "nor", "xnor"];

pub fn random_program(seed: u64) -> String {
    let random = ChaCha8Rng::seed_from_u64(seed);
    Writer { random, nets: Vec::new(), clocked: false }.program()
}

struct Writer {
    random: ChaCha8Rng,
    /// The nets that may be read, with their widths.
    nets: Vec<(String, u32)>,
    clocked: bool,
}

impl Writer {
    fn below(&mut self, most: u32) -> u32 {
        self.random.next_u32() % most
    }

    fn often(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }

    fn pick<'t>(&mut self, words: &[&'t str]) -> &'t str {
        words[self.below(words.len() as u32) as usize]
    }

    /// What may stand between two words where the end of a line means nothing.
    fn gap(&mut self) -> &'static str {
        self.pick(&[" ", " ", " ", " ", "  ", "\n", "\n   ", "\t", " // gap\n", "\n\n// gap\n", "\r\n"])
    }

    /// Words with such gaps between them.
    fn line(&mut self, words: &[&str]) -> String {
        let mut text = String::new();
        for (at, word) in words.iter().enumerate() {
            text += if at == 0 { "" } else { self.gap() };
            text += word;
        }
        text
    }

    fn spread(&mut self, text: &str) -> String {
        self.line(&text.split(' ').collect::<Vec<_>>())
    }

    /// The end of a line where it means something.
    fn end(&mut self) -> &'static str {
        self.pick(&["\n", "\n", "\n\n", "\n\n\n", " // behind\n", "\n  // before\n", "\r\n"])
    }

    fn integer(&mut self, value: u32) -> String {
        match self.below(4) {
            0 => format!("{value:#x}"),
            1 => format!("{value:#b}"),
            _ => value.to_string(),
        }
    }

    fn constant(&mut self, width: u32) -> String {
        let value = self.random.next_u32() & ((1u64 << width) - 1) as u32;
        match self.below(4) {
            0 => format!("{width}'d{value}"),
            1 => format!("{width}'h{value:x}"),
            2 => format!("{width}'d({value} + 0)"),
            _ => format!("{width}'b{value:0width$b}", width = width as usize),
        }
    }

    fn leaf(&mut self, width: u32) -> String {
        let fitting: Vec<(String, u32)> = self.nets.iter().filter(|(_, own)| *own >= width).cloned().collect();
        if fitting.is_empty() || self.often(15) {
            return self.constant(width);
        }
        let (name, own) = fitting[self.below(fitting.len() as u32) as usize].clone();
        if own == width {
            return name;
        }
        let low = self.below(own - width + 1);
        let [high, low] = [low + width - 1, low].map(|bit| self.integer(bit));
        if width == 1 { format!("{name}[{low}]") } else { format!("{name}[{high}..{low}]") }
    }

    /// An expression of this width, between brackets if it needs them.
    fn operand(&mut self, width: u32, depth: u32) -> String {
        if depth == 0 || self.often(20) {
            return self.leaf(width);
        }
        let below = depth - 1;
        match self.below(14) {
            0 | 1 => format!("({})", self.expression(width, below)),
            2 => {
                let inner = self.operand(width, below);
                self.line(&["not", &inner])
            }
            3 => {
                let values = self.operands(width, 2, below);
                format!("{}{values}", self.pick(&OPERATORS))
            }
            4 if width > 1 => {
                let high = 1 + self.below(width - 1);
                let [one, two] = [high, width - high].map(|part| self.expression(part, below));
                self.line(&["{", &one, ",", &two, "}"])
            }
            5 => {
                let inner = self.expression(1, below);
                let width = self.integer(width);
                self.line(&["{", &width, "{", &inner, "}", "}"])
            }
            6 | 7 => self.table(width, below),
            8 | 9 => self.matched(width, below),
            10 if width == 1 => {
                let own = 1 + self.below(4);
                let [one, two] = [0, 1].map(|_| self.operand(own, below));
                let sign = self.pick(&["==", "!=", "<", "<=", ">", ">="]);
                format!("({})", self.line(&[&one, sign, &two]))
            }
            11 if width == 1 => {
                let inner = self.expression(3, below);
                format!("{}({inner})", self.pick(&["any", "all"]))
            }
            12 => {
                let value = self.operand(width, below);
                let places = self.integer(1);
                format!("({})", self.line(&[&value, self.clone_pick(&["<<", ">>"]), &places]))
            }
            _ => {
                let value = self.operand(width, below);
                let number = self.below(2).to_string();
                format!("({})", self.line(&[&value, self.clone_pick(&["and", "+", "-", "*"]), &number]))
            }
        }
    }

    /// As [`Writer::pick`], while another value is made.
    fn clone_pick<'t>(&self, words: &[&'t str]) -> &'t str {
        let mut random = self.random.clone();
        words[random.next_u32() as usize % words.len()]
    }

    fn operands(&mut self, width: u32, count: u32, depth: u32) -> String {
        let values: Vec<String> = (0..count).map(|_| self.expression(width, depth)).collect();
        let mut words: Vec<&str> = values.iter().flat_map(|value| [value.as_str(), ","]).collect();
        if self.often(80) {
            words.pop();
        }
        self.line(&[&["("], &words[..], &[")"]].concat())
    }

    /// An expression of this width, without brackets around it.
    fn expression(&mut self, width: u32, depth: u32) -> String {
        let below = depth.saturating_sub(1);
        match self.below(5) {
            0 if depth > 0 => {
                let sign = self.pick(&["and", "or", "xor", "+", "-", "*"]);
                let values: Vec<String> = (0..3).map(|_| self.operand(width, below)).collect();
                self.line(&[&values[0], sign, &values[1], sign, &values[2]])
            }
            1 if depth > 0 => {
                let condition = self.expression(1, below);
                let [one, two] = [0, 1].map(|_| self.expression(width, below));
                self.line(&["if", &condition, "then", &one, "else", &two])
            }
            _ => self.operand(width, depth),
        }
    }

    /// What stands between two rows of a table.
    fn row_end(&mut self) -> &'static str {
        self.pick(&["\n", ", ", ",", ",\n", " ", "\n // row\n", ", // behind\n"])
    }

    fn rows(&mut self, rows: Vec<(String, String)>) -> String {
        let mut text = format!("{{{}", self.gap());
        for (at, (pattern, value)) in rows.iter().enumerate() {
            text += if at == 0 { "" } else { self.row_end() };
            text += pattern;
            text += self.clone_pick(&["", "", " ", "\n"]);
            text += ":";
            text += self.clone_pick(&["", " ", "\n"]);
            text += value;
        }
        text + self.clone_pick(&["", ",", "\n", " // last\n"]) + "}"
    }

    fn value(&mut self, width: u32, depth: u32) -> String {
        match self.below(4) {
            0 if width > 1 => format!("{:0width$b}", self.below(1 << width), width = width as usize),
            1 => self.below(2).to_string(),
            _ => self.expression(width, depth),
        }
    }

    fn table(&mut self, width: u32, depth: u32) -> String {
        let inputs = self.operands(1, 3, depth);
        let patterns = match self.below(3) {
            0 => vec![vec!["--0"], vec!["-01", "-11"]],
            1 => vec![vec!["0--"], vec!["10-"], vec!["11-"]],
            _ => vec![vec!["1-1"], vec!["-10", "-00"]],
        };
        let rows = self.cases(&patterns, |writer| writer.value(width, depth), width, depth);
        format!("table{inputs}{}{rows}", self.gap())
    }

    fn cases(&mut self, patterns: &[Vec<&str>], value: impl Fn(&mut Self) -> String, width: u32, depth: u32) -> String {
        let mut rows: Vec<_> = patterns.iter().map(|row| (self.spread(&row.join(" or ")), value(self))).collect();
        rows.push(("else".to_owned(), self.expression(width, depth)));
        self.rows(rows)
    }

    fn matched(&mut self, width: u32, depth: u32) -> String {
        let own = 2 + self.below(2);
        let input = self.operand(own, depth);
        let patterns = match self.below(3) {
            0 => vec![vec!["0x0", "0b1"], vec!["2"]],
            1 if own == 3 => vec![vec!["-1-"], vec!["-00", "101"]],
            1 => vec![vec!["-1"], vec!["-0"]],
            _ => vec![vec!["1", "3"]],
        };
        let rows = self.cases(&patterns, |writer| writer.expression(width, depth), width, depth);
        self.line(&["match", &input, &rows])
    }

    fn program(mut self) -> String {
        let mut parts = vec![self.enumeration(), self.main()];
        for part in 0..9 {
            if self.often(60) {
                parts.push(self.other(part));
            }
        }
        // The order of declarations does not matter.
        for at in (1..parts.len()).rev() {
            let other = self.below(at as u32 + 1) as usize;
            parts.swap(at, other);
        }
        let mut text = String::new();
        for part in parts {
            text += &part;
            text += self.end();
        }
        text
    }

    fn enumeration(&mut self) -> String {
        self.spread(&format!("enum state {{ {} , }}", MEMBERS.join(" , ")))
    }

    /// A circuit with ports `a[4]`, `s: state` and `clk`, and outputs of several widths.
    fn main(&mut self) -> String {
        self.nets = [("a", 4), ("s", 3)].map(|(name, width)| (name.to_owned(), width)).to_vec();
        self.clocked = self.often(50);
        let mut lines = Vec::new();
        for at in 0..1 + self.below(4) {
            let (name, width) = (format!("n{at}"), 1 + self.below(4));
            let value = self.expression(width, 3);
            if self.often(40) {
                lines.push(self.line(&["net", &format!("{name}[{width}]")]));
            }
            lines.push(self.line(&[&name, "=", &value]));
            self.nets.push((name, width));
        }
        if self.often(40) {
            lines.extend(self.array());
        }
        if self.often(40) {
            lines.push(self.loop_());
        }
        if self.often(30) {
            let [one, two] = [0, 1].map(|_| self.expression(1, 2));
            lines.push("net c, d".to_owned());
            let values = self.line(&["{", &one, ",", &two, "}"]);
            lines.push(self.line(&["{", "c", ",", "d", "}", "=", &values]));
            self.nets.extend([("c".to_owned(), 1), ("d".to_owned(), 1)]);
        }
        if self.clocked {
            // They may depend on the register and on the outputs.
            let known = self.nets.len();
            self.nets.extend([("r", 3), ("q", 1), ("p", 3)].map(|(name, width)| (name.to_owned(), width)));
            let [data, enable] = [3, 1].map(|width| self.expression(width, 2));
            self.nets.truncate(known);
            let call = self.line(&[&data, ",", "clk", ",", "enable:", &enable]);
            let start = self.integer(5);
            lines.push("net r[3]".to_owned());
            lines.push(self.line(&["r", "=", &format!("register[start = {start}]({call})")]));
            self.nets.push(("r".to_owned(), 3));
        }
        for (output, width) in [("q", 1), ("p", 3)] {
            let (mut target, mut value) = (output.to_owned(), self.expression(width, 3));
            if self.often(20) {
                // A register has its own start.
                target = format!("{output} init {}", self.integer(1));
                value = self.line(&["a[0]", "nand", "a[1]"]);
                if width > 1 {
                    value = format!("{{{width}{{{value}}}}}");
                }
            }
            lines.push(self.line(&[&target, "=", &value]));
        }
        for at in (1..lines.len()).rev() {
            let other = self.below(at as u32 + 1) as usize;
            lines.swap(at, other);
        }
        let four = self.integer(4);
        let mut text = self.line(&["circuit", "main", "(", &format!("a[{four}]"), ",", "s: state", ",", "clk", ")"]);
        text += &self.line(&["", "->", "(", "q", ",", "p:", "state", ")", "{"]);
        for line in lines {
            text += self.end();
            text += &line;
        }
        text + self.end() + "}"
    }

    fn array(&mut self) -> Vec<String> {
        let [address, data] = [1, 2].map(|width| self.expression(width, 1));
        let enable = self.expression(1, 1);
        let index = if self.often(50) { self.matched(1, 1) } else { format!("{{{address}}}") };
        let two = self.integer(2);
        let call = self.line(&[&data, ",", "clk", ",", "enable:", &enable]);
        let value = format!("register({call})");
        let lines = vec![format!("net m[{two}][2]"), self.line(&[&format!("m[{index}]"), "=", &value])];
        self.nets.push(("m[0]".to_owned(), 2));
        lines
    }

    fn loop_(&mut self) -> String {
        let values: Vec<String> = (0..2).map(|_| self.operand(4, 1)).collect();
        let three = self.integer(3);
        let value = self.line(&["v[i]", self.clone_pick(&OPERATORS), "w[i]"]);
        let (head, rest) = (self.spread(&format!("if i < {three} {{ t[i] =")), self.spread("} else { t[i] = 0 }"));
        let loop_ = self.line(&["for i in 0..4 {", &head, &value, &rest, "}"]);
        self.nets.push(("t".to_owned(), 4));
        let end = self.end();
        format!("net t[4]{end}v = {} w = {}{end}{loop_}", values[0], values[1])
    }

    fn row(&mut self) -> String {
        let a = match self.below(3) {
            0 => format!("{:04b}", self.below(16)),
            1 => self.constant(4).replace(" + 0", "").replace(['(', ')'], ""),
            _ => self.integer(9),
        };
        let row = [a.as_str(), self.pick(&MEMBERS), self.pick(&["0", "^"]), "|", "-", "-"];
        row.join(self.pick(&[" ", "  ", "\t"])) + self.pick(&["", "", " for 3 cycles"])
    }

    fn other(&mut self, part: u32) -> String {
        match part {
            0 => {
                let mut text = "test main \"rows\" {\n a s clk|q p".to_owned();
                for _ in 0..1 + self.below(3) {
                    text += self.end();
                    text += &self.row();
                }
                if self.often(40) {
                    text += &format!("\nrepeat {} {{{}{}\n}}", self.integer(2), self.end(), self.row());
                }
                text + "\n}"
            }
            1 => self.spread("circuit other ( a , b = 0x1 ) -> ( q ) {") + " q = a and b }",
            2 => {
                let five = self.integer(5);
                self.line(&["let", "five", "=", &five, "+", "0b1"])
            }
            3 => {
                let mut text = self.line(&["prove", "main", "\"title\"", "{"]);
                self.nets = vec![("a".to_owned(), 4), ("p".to_owned(), 3), ("q".to_owned(), 1)];
                for _ in 0..2 {
                    let [condition, value] = [0, 1].map(|_| self.expression(1, 2));
                    text += self.end();
                    text += &self.line(&["always", &condition, "=>", &value]);
                }
                text + "\n}"
            }
            4 => self.spread("material hard { kind : rigid }"),
            5 => self.spread("world ice { friction: 40% , gravity: 0x1 }"),
            6 => {
                let head = self.spread("schedule sweep ( s1 , s2 ) {");
                self.line(&[&head, "0 1 for 0xa cycles", "1 1 for 9 steps", "}"])
            }
            7 => self.spread("test main for all inputs against main"),
            _ => self.spread("evolution runs { from: gates , box: 5 x 0x5 seed: 1..0x3 }"),
        }
    }
}
