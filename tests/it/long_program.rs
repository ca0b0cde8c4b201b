//! A program of ten thousand lines, for what must stay quick.

pub fn long_program() -> String {
    let mut text =
        String::from("circuit c0(a, b, v[8]) -> (q, w[8]) {\n    q = (a nand b) xor v[0]\n    w = not v\n}\n");
    let mut lines = 4;
    for at in 1.. {
        text += &format!(
            "
circuit c{at}(a, b, v[8]) -> (q, w[8]) {{
    // The outputs of the previous circuit, and one of its own.
    (t, x) = c{before}(a, b, v)
    u      = if a then t and not b else nand(t, v[3], b)
    y      = table(a, b, t) {{ 00-: 1, 011: 0, else: 1 }}
    w      = x + {{4'b1010, v[7..4]}}
    q      = (y xor u) or any(v)
}}

test c{at} \"row {at}\" {{
    a b v       | q
    0 1 8'd{value:<3}   | -
    1 0 8'hff   | -
}}
",
            before = at / 2,
            value = at % 256,
        );
        lines += 15;
        if lines >= 10_000 {
            break;
        }
    }
    assert!(text.lines().count() >= 10_000);
    text
}
