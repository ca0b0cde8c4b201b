//! The syntax tree: declarations as written, with unresolved names. Expressions and sizes are stored in arenas,
//! children before parents, so that deep nesting needs no deep stack.

use nbc_base::model::Relation;
use nbc_base::source::Span;

/// A file's declarations and its comments, both in order of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// The declarations that could be parsed.
    pub declarations: Vec<Declaration>,
    /// The parts that could not be parsed, and that are missing in the declarations.
    pub broken: Vec<BrokenSyntax>,
    /// The places of all comments, each from its `//` to the end of its line.
    pub comments: Vec<Span>,
}

/// A part that could not be parsed: a declaration, or a statement, field or row of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrokenSyntax {
    /// The place of the part that is missing.
    pub span: Span,
    /// The place of the declaration that it belongs to.
    pub declaration: Span,
}

/// A declaration with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// From its keyword to its last character.
    pub span: Span,
    /// The declaration itself.
    pub kind: DeclarationKind,
}

/// A declaration, by its keyword.
#[derive(Clone, Debug, PartialEq)]
pub enum DeclarationKind {
    /// `use "file.nb"`
    Use(Text),
    /// `stimulus s1, s2`
    Stimulus(Vec<NameSyntax>),
    /// `material`, `evolution`, `library`, `swarm`, `world`: a name and a record.
    Record(RecordDeclaration),
    /// `schedule`
    Schedule(ScheduleSyntax),
    /// `simulate`
    Simulate(Simulate),
    /// `circuit` or `environment`
    Circuit(CircuitSyntax),
    /// `enum phase { fetch, execute }`
    Enumeration(EnumerationSyntax),
    /// `let n = 8`
    Let(LetSyntax),
    /// `file program = "hello.hex"`
    File(FileSyntax),
    /// `test`
    Test(Test),
}

/// A name with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameSyntax {
    /// The name as written.
    pub text: String,
    /// The place of the name in the source.
    pub span: Span,
}

/// A text in quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The text between the quotes.
    pub text: String,
    /// The place, including the quotes.
    pub span: Span,
}

/// `enum phase: gray { fetch, execute }`
#[derive(Clone, Debug, PartialEq)]
pub struct EnumerationSyntax {
    /// The name of the enumeration.
    pub name: NameSyntax,
    /// The word that says how its members get values.
    pub encoding: Option<NameSyntax>,
    /// The members in order of text.
    pub members: Vec<MemberSyntax>,
}

/// A member of an enumeration: `fetch` or `load = 5'b00000`
#[derive(Clone, Debug, PartialEq)]
pub struct MemberSyntax {
    /// The name of the member.
    pub name: NameSyntax,
    /// The constant that is its value, as written.
    pub value: Option<NameSyntax>,
}

/// `let n = 8`
#[derive(Clone, Debug, PartialEq)]
pub struct LetSyntax {
    /// The name of the integer.
    pub name: NameSyntax,
    /// The integer, in an arena of its own.
    pub sizes: Vec<SizeSyntax>,
}

/// `file program = "hello.hex"`
#[derive(Clone, Debug, PartialEq)]
pub struct FileSyntax {
    /// What memories and the command line call the file.
    pub name: NameSyntax,
    /// The file unless the command line names another.
    pub path: Text,
}

/// The keyword of a declaration that is a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RecordKeyword {
    /// `material`
    Material,
    /// `evolution`
    Evolution,
    /// `library`
    Library,
    /// `swarm`
    Swarm,
    /// `world`
    World,
}

impl RecordKeyword {
    /// The keyword as written.
    pub fn word(self) -> &'static str {
        match self {
            Self::Material => "material",
            Self::Evolution => "evolution",
            Self::Library => "library",
            Self::Swarm => "swarm",
            Self::World => "world",
        }
    }
}

/// A declaration that is a name and a record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordDeclaration {
    /// The word that begins the declaration.
    pub keyword: RecordKeyword,
    /// The name that is declared.
    pub name: NameSyntax,
    /// The fields in braces after the name.
    pub record: RecordSyntax,
}

/// Fields in braces: `{ name: value, … }`.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordSyntax {
    /// The fields in order of text.
    pub fields: Vec<Field>,
    /// The place, including the braces.
    pub span: Span,
}

impl RecordSyntax {
    /// The first field of that name.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name.text == name)
    }
}

/// A field of a record: `name: value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The word before the colon.
    pub name: NameSyntax,
    /// What is after the colon.
    pub value: ValueSyntax,
}

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueSyntax {
    /// A number, a word, a list or another form.
    pub kind: ValueKind,
    /// The place of the value in the source.
    pub span: Span,
}

/// The forms of the value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueKind {
    /// `{ name: value, … }`
    Record(RecordSyntax),
    /// `[value, …]`
    List(Vec<ValueSyntax>),
    /// `"text"`
    Text(String),
    /// `84 steps`
    Quantity(Quantity),
    /// `0.6..1.6`
    Range(Quantity, Quantity),
    /// `5 x 5`
    Product(Number, Number),
    /// `voxels in 4 bins`
    Bins(NameSyntax, Number),
    /// `pareto(8)`
    Applied(NameSyntax, Vec<ValueSyntax>),
    /// A word, or a circuit with its parameters.
    Instance(InstanceSyntax),
}

/// A number as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// The digits, with sign and point.
    pub text: String,
    /// The place of the number in the source.
    pub span: Span,
}

/// A number with its unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The digits and what they are worth.
    pub number: Number,
    /// The word or sign after the number, such as `cycles` or `%`.
    pub unit: Option<NameSyntax>,
}

impl Quantity {
    /// The place of the number and its unit.
    pub fn span(&self) -> Span {
        self.unit.as_ref().map_or(self.number.span, |unit| self.number.span.to(unit.span))
    }
}

/// A circuit's name with values for its parameters, which are sizes of the surrounding arena.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceSyntax {
    /// The name of the circuit.
    pub name: NameSyntax,
    /// The values in brackets, in order of text.
    pub arguments: Vec<Argument>,
    /// The sizes of the parameters, if the instance is not inside a circuit.
    pub sizes: Vec<SizeSyntax>,
}

/// `schedule sweep(s1, s2) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct ScheduleSyntax {
    /// The name of the schedule.
    pub name: NameSyntax,
    /// The stimuli, one for each column of the spells.
    pub columns: Vec<NameSyntax>,
    /// The spells in order of time.
    pub spells: Vec<SpellSyntax>,
}

/// `0 1 for 10 cycles`
#[derive(Clone, Debug, PartialEq)]
pub struct SpellSyntax {
    /// The values, one for each column.
    pub cells: Vec<NameSyntax>,
    /// The time for which the values stay, such as `10 cycles`.
    pub length: Quantity,
    /// The place of the spell in the source.
    pub span: Span,
}

/// `simulate latch with …`
#[derive(Clone, Debug, PartialEq)]
pub struct Simulate {
    /// The name of the swarm to simulate.
    pub swarm: NameSyntax,
    /// The world after `in`, if it is given: `in slippery`.
    pub world: Option<NameSyntax>,
    /// The inputs of the swarm over time.
    pub with: With,
}

/// The inputs of a simulation over time.
#[derive(Clone, Debug, PartialEq)]
pub enum With {
    /// `with sweep`
    Named(NameSyntax),
    /// `with schedule (d, e) { … }`
    Spells {
        /// The input ports.
        columns: Vec<NameSyntax>,
        /// The spells in order of time.
        spells: Vec<SpellSyntax>,
    },
}

/// `test latch "…" …`
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// The circuit to test, with values for its parameters.
    pub circuit: InstanceSyntax,
    /// The text after the circuit that tells tests apart.
    pub title: Option<Text>,
    /// The environment after `with`, if it is given.
    pub environment: Option<NameSyntax>,
    /// The worlds after `in`: `in slippery` or `in [paper, worn]`.
    pub worlds: Vec<NameSyntax>,
    /// What the circuit must do.
    pub kind: TestKind,
}

/// What a tested circuit must do.
#[derive(Clone, Debug, PartialEq)]
pub enum TestKind {
    /// The rows of a table: inputs and expected outputs.
    Table(TestTable),
    /// `for all inputs against other`
    Against(InstanceSyntax),
    /// `for all inputs { … }`
    Reference(Box<BodySyntax>),
}

/// The rows of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestTable {
    /// The names of the columns before the bar.
    pub inputs: Vec<NameSyntax>,
    /// The names of the columns after the bar.
    pub outputs: Vec<NameSyntax>,
    /// The rows in order of time.
    pub rows: Vec<TestItem>,
    /// The place of the header.
    pub header: Span,
}

/// A row of a test, or rows that are repeated.
#[derive(Clone, Debug, PartialEq)]
pub enum TestItem {
    /// One row.
    Row(Box<TestRowSyntax>),
    /// `repeat 32 { … }`
    Repeat {
        /// The number of times.
        times: Number,
        /// What is repeated.
        rows: Vec<TestItem>,
        /// The place, including the braces.
        span: Span,
    },
}

impl TestItem {
    /// The place in the source.
    pub fn span(&self) -> Span {
        match self {
            Self::Row(row) => row.span,
            Self::Repeat { span, .. } => *span,
        }
    }
}

/// `until ready, at most 100 rows`
#[derive(Clone, Debug, PartialEq)]
pub struct UntilSyntax {
    /// The output that ends the repetition.
    pub output: NameSyntax,
    /// The value that it must have; 1 if it is not given.
    pub value: Option<NameSyntax>,
    /// The most rows.
    pub most: Number,
}

/// One row of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestRowSyntax {
    /// The values before the bar.
    pub inputs: Vec<NameSyntax>,
    /// The bars; a valid row has one.
    pub bars: Vec<Span>,
    /// The values after the bar.
    pub outputs: Vec<NameSyntax>,
    /// The hold of this row, if it sets one.
    pub hold: Option<Quantity>,
    /// When the repetition of this row ends, if it is repeated.
    pub until: Option<UntilSyntax>,
    /// The place of the row in the source.
    pub span: Span,
}

/// `circuit half_adder(a, b) -> (s, c) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitSyntax {
    /// Whether it is the environment of circuits, and not one itself.
    pub is_environment: bool,
    /// The name of the circuit.
    pub name: NameSyntax,
    /// The width parameters in brackets.
    pub parameters: Vec<ParameterSyntax>,
    /// The input ports, before the arrow.
    pub inputs: Vec<Port>,
    /// The output ports, after the arrow.
    pub outputs: Vec<Port>,
    /// The body; it also has the sizes of the ports.
    pub body: BodySyntax,
}

/// Statements and the arenas they point into.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodySyntax {
    /// The statements in order of text.
    pub statements: Vec<StatementSyntax>,
    /// The expressions, children before parents.
    pub expressions: Vec<ExpressionSyntax>,
    /// The sizes, children before parents.
    pub sizes: Vec<SizeSyntax>,
}

/// The place of an expression in [`BodySyntax::expressions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExpressionSyntaxId(pub u32);

/// The place of a size in [`BodySyntax::sizes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeSyntaxId(pub u32);

/// `n` or `start = 0` in a circuit's parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSyntax {
    /// The name of the parameter.
    pub name: NameSyntax,
    /// The value if an instance gives none.
    pub default: Option<SizeSyntaxId>,
}

/// A port or another net with its width: `a`, `a[8]` or `r[32][8]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// The name of the net.
    pub name: NameSyntax,
    /// The number of words, if it is an array.
    pub words: Option<SizeSyntaxId>,
    /// The width in bits, if it is given; of an array, that of a word.
    pub width: Option<SizeSyntaxId>,
    /// The enumeration of its values: `state: phase`.
    pub members: Option<NameSyntax>,
    /// The value of an input that a call leaves out: `enable = 1`.
    pub absent: Option<SizeSyntaxId>,
    /// The file with the first contents of a memory: `init program`.
    pub contents: Option<NameSyntax>,
}

impl Port {
    /// A net of one bit, or of the width that is given.
    pub fn new(name: NameSyntax, width: Option<SizeSyntaxId>) -> Self {
        Self { name, words: None, width, members: None, absent: None, contents: None }
    }
}

/// A statement with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementSyntax {
    /// A driver, nets, or a loop.
    pub kind: StatementKind,
    /// The place of the statement in the source.
    pub span: Span,
}

/// A statement of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum StatementKind {
    /// `q init 0 = nand(s, nq)`
    Drive {
        /// What is driven, left of the `=`.
        targets: Vec<TargetSyntax>,
        /// How the targets are written.
        grouping: Grouping,
        /// The driver.
        value: ExpressionSyntaxId,
    },
    /// `net c[9]`
    Nets(Vec<Port>),
    /// `for i in 0..8 { … }`
    For {
        /// The loop's variable.
        variable: NameSyntax,
        /// Its first value.
        from: SizeSyntaxId,
        /// One more than its last value.
        to: SizeSyntaxId,
        /// The repeated statements.
        statements: Vec<StatementSyntax>,
    },
    /// `let n = 8`
    Let {
        /// The name of the integer.
        name: NameSyntax,
        /// The integer.
        value: SizeSyntaxId,
    },
    /// `if n == 1 { … } else { … }`
    If {
        /// The left integer.
        left: SizeSyntaxId,
        /// How it must compare with the right one.
        comparison: Relation,
        /// The right integer.
        right: SizeSyntaxId,
        /// The statements if it does.
        then: Vec<StatementSyntax>,
        /// The statements if it does not; those after `else if` are one statement.
        otherwise: Vec<StatementSyntax>,
        /// The places of both blocks.
        blocks: [Span; 2],
    },
}

/// How the targets of a drive are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// `a = …`
    Single,
    /// `(a, b) = …`: the outputs of a call.
    Outputs,
    /// `{a, b} = …`: the parts of a value.
    Joined,
}

/// The left side of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetSyntax {
    /// The net that is driven, or `_`.
    pub name: NameSyntax,
    /// The bits or the word, if not the whole net is driven.
    pub index: Option<Index>,
    /// The bits of the word.
    pub second: Option<Index>,
    /// The value before the first cycle, if it is given: `init 0`.
    pub start: Option<SizeSyntaxId>,
    /// The place of the target in the source.
    pub span: Span,
}

/// The bits of a net: `[3]` or `[3..0]`; the word of an array: `[3]` or `[address]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// What selects.
    pub kind: IndexKind,
    /// The place, including the brackets.
    pub span: Span,
}

/// What selects bits or a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndexKind {
    /// `[3]`
    One(SizeSyntaxId),
    /// `[3..0]`: the highest and the lowest.
    Slice(SizeSyntaxId, SizeSyntaxId),
    /// `[{a, b}]`: a value that is no integer.
    Value(ExpressionSyntaxId),
}

/// An integer with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeSyntax {
    /// A number, a name or an operation.
    pub kind: SizeSyntaxKind,
    /// The place of the integer in the source.
    pub span: Span,
}

/// An integer: a number, a name, or an operation on others.
#[derive(Clone, Debug, PartialEq)]
pub enum SizeSyntaxKind {
    /// A number, as its digits.
    Literal(String),
    /// A parameter or loop variable.
    Name(String),
    /// `log2(n)`
    Log2(SizeSyntaxId),
    /// `(n)`
    Group(SizeSyntaxId),
    /// `n + 1`
    Binary(nbc_base::model::SizeOperator, SizeSyntaxId, SizeSyntaxId),
}

/// A parameter given to a circuit: `8` or `start = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// The name of the parameter, if it is given.
    pub name: Option<NameSyntax>,
    /// The value for the parameter.
    pub value: SizeSyntaxId,
    /// The place of the argument in the source.
    pub span: Span,
}

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionSyntax {
    /// A literal, a net, a call or another form.
    pub kind: ExpressionSyntaxKind,
    /// The place of the expression in the source.
    pub span: Span,
}

/// An expression: a constant, a net, or what is made of other expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionSyntaxKind {
    /// Digits without a width.
    Digits(String),
    /// `4'b1010`
    Constant {
        /// The width: a literal or a parameter.
        width: SizeSyntaxId,
        /// `b`, `d` or `h`.
        base: char,
        /// The digits in that base.
        digits: String,
    },
    /// `n'd(i + 1)`
    Computed {
        /// The width: a literal or a parameter.
        width: SizeSyntaxId,
        /// The integer before it gets its width.
        value: SizeSyntaxId,
    },
    /// `a`, `a[3]`, `a[3..0]`
    Net {
        /// The net whose bits are taken.
        name: NameSyntax,
        /// The bits or the word, if not the whole net is read.
        index: Option<Index>,
        /// The bits of the word.
        second: Option<Index>,
    },
    /// `add[8](a, b)`
    Call {
        /// The circuit.
        name: NameSyntax,
        /// The parameters given.
        arguments: Vec<Argument>,
        /// The operands between the parentheses.
        operands: Vec<OperandSyntax>,
    },
    /// `(a)`
    Group(ExpressionSyntaxId),
    /// `{a, b}`
    Concatenation(Vec<ExpressionSyntaxId>),
    /// `{4{a, b}}`
    Repetition {
        /// The number of repetitions.
        count: SizeSyntaxId,
        /// The repeated value.
        values: Vec<ExpressionSyntaxId>,
    },
    /// `not a`
    Not(ExpressionSyntaxId),
    /// `a and b`
    Infix {
        /// The word or sign between the operands.
        operator: Infix,
        /// The place of the operator.
        place: Span,
        /// The left operand.
        left: ExpressionSyntaxId,
        /// The right operand.
        right: ExpressionSyntaxId,
    },
    /// `nand(a, b, c)`
    Operation {
        /// The operation.
        operator: nbc_base::model::Operator,
        /// The expressions between the operators.
        operands: Vec<ExpressionSyntaxId>,
    },
    /// `if c then a else b`
    Choice {
        /// The expression after `if`.
        condition: ExpressionSyntaxId,
        /// The value if it is 1.
        then: ExpressionSyntaxId,
        /// The value if it is 0.
        otherwise: ExpressionSyntaxId,
    },
    /// `table(a, b) { 00: 1, else: 0 }` or `match a { 0: 1, else: 0 }`
    Table {
        /// Whether it is written with `match`, which has one input.
        is_match: bool,
        /// The expressions whose bits select the row.
        inputs: Vec<ExpressionSyntaxId>,
        /// The rows in order of text.
        rows: Vec<TableRowSyntax>,
    },
}

/// An operand of a call: `a` or `enable: a`
#[derive(Clone, Debug, PartialEq)]
pub struct OperandSyntax {
    /// The port, if it is named.
    pub name: Option<NameSyntax>,
    /// The value for it.
    pub value: ExpressionSyntaxId,
}

/// `0-1: 1`, `load or store: 1` or `else: 0`
#[derive(Clone, Debug, PartialEq)]
pub struct TableRowSyntax {
    /// The patterns; none is `else`.
    pub patterns: Vec<NameSyntax>,
    /// What the row shows.
    pub output: TableOutputSyntax,
    /// The place of the row.
    pub span: Span,
}

/// The output of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum TableOutputSyntax {
    /// `0-1`
    Bits(NameSyntax),
    /// The value of an expression.
    Value(ExpressionSyntaxId),
}

/// The operators between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infix {
    /// A bitwise operation.
    Bitwise(nbc_base::model::Operator),
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `<<`
    ShiftLeft,
    /// `>>`
    ShiftRight,
    /// A comparison.
    Compare(Relation),
}

impl Infix {
    /// The operators written as symbols, but for the comparisons.
    const SIGNS: [(Self, &'static str); 5] = [
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::ShiftLeft, "<<"),
        (Self::ShiftRight, ">>"),
    ];

    /// The notation of the language.
    pub fn word(self) -> &'static str {
        match self {
            Self::Bitwise(operator) => operator.word(),
            Self::Compare(relation) => relation.sign(),
            _ => Self::SIGNS.iter().find(|(infix, _)| *infix == self).expect("every sign has its word").1,
        }
    }

    /// The operator with that symbol, if there is one.
    pub fn of_sign(sign: &str) -> Option<Self> {
        let known = Self::SIGNS.iter().find(|(_, known)| *known == sign).map(|(infix, _)| *infix);
        known.or_else(|| Relation::parse(sign).map(Self::Compare))
    }

    /// The precedence: 1 is the loosest.
    pub fn precedence(self) -> u8 {
        use nbc_base::model::Operator;
        match self {
            Self::Bitwise(Operator::Or | Operator::Nor) => 1,
            Self::Bitwise(Operator::Xor | Operator::Xnor) => 2,
            Self::Bitwise(_) => 3,
            Self::ShiftLeft | Self::ShiftRight => 5,
            Self::Add | Self::Subtract => 6,
            Self::Multiply => 7,
            Self::Compare(_) => 4,
        }
    }

    /// Whether `a op b op c` is unambiguous if it follows `before`, which has the same precedence.
    pub(crate) fn chains_after(self, before: Self) -> bool {
        use nbc_base::model::Operator;
        match self {
            Self::Add | Self::Subtract | Self::Multiply => true,
            Self::Bitwise(Operator::And | Operator::Or | Operator::Xor) => self == before,
            _ => false,
        }
    }
}
