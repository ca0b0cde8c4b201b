//! `nbc learn`: circuits from rows, the same for the same seed, which the program can use and test.

use crate::support::*;

fn rows(bits: u32, count: u64, function: impl Fn(u64) -> u64) -> String {
    let numbers = (0..count).map(|at| at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits));
    let lines: String = numbers.map(|number| format!("{number},{}\n", function(number))).collect();
    format!("x,y\n{lines}")
}

fn learned(bench: &Bench, arguments: &[&str]) -> Value {
    let ran = bench.ok(&[&["learn"], arguments, &["--format", "json"]].concat());
    serde_json::from_str(&ran.out).unwrap()
}

#[test]
fn what_can_be_recognized_is_exact_in_rows_that_were_held_out() {
    let bench = Bench::new();
    let exact = |name: &str, file: String, what: &str, most: u64| {
        bench.file(name, file);
        let found = learned(&bench, &[name, "--hold-out", "50"]);
        assert_eq!(found["held_out"]["accuracy"], 1.0, "{name}: {found}");
        assert!(found["bits"][0]["learned"].as_str().unwrap().contains(what), "{name}: {}", found["bits"]);
        assert!(found["ands"].as_u64().unwrap() <= most, "{name}: {}", found["ands"]);
    };
    exact("parity.csv", rows(16, 400, |x| u64::from((x & 0xa5f3).count_ones() % 2)), "the parity of 10 inputs", 27);
    exact("ones.csv", rows(12, 600, |x| u64::from(matches!(x.count_ones(), 3 | 7 | 8))), "the number of ones", 120);
    exact("carry.csv", rows(16, 600, |x| ((x >> 8) + (x & 255)) >> 8), "bit 8 of a sum", 80);
    exact("less.csv", rows(20, 600, |x| u64::from(x >> 10 < x & 1023)), "a comparison by `<`", 40);
    exact("middle.csv", rows(16, 600, |x| (((x >> 8) * (x & 255)) >> 8) & 1), "bit 8 of a product", 700);
    exact("root.csv", rows(16, 600, |x| x.isqrt() & 1), "bit 0 of a square root", 700);
}

#[test]
fn a_chain_is_recognized_in_any_order_of_its_columns() {
    let bench = Bench::new();
    // A comparison of two numbers whose bits are scattered over the input.
    let places = [9, 2, 14, 5, 0, 11, 7, 3, 12, 1, 15, 6, 10, 4, 13, 8];
    let word = |x: u64, from: usize| places[from..from + 8].iter().fold(0, |word, &bit| word << 1 | x >> bit & 1);
    bench.file("scattered.csv", rows(16, 4_000, |x| u64::from(word(x, 0) < word(x, 8))));
    let found = learned(&bench, &["scattered.csv"]);
    assert!(found["bits"][0]["learned"].as_str().unwrap().starts_with("a chain of "), "{}", found["bits"]);
    assert!(found["held_out"]["accuracy"].as_f64().unwrap() > 0.99, "{}", found["held_out"]);
}

#[test]
fn a_learned_circuit_is_a_program_that_says_where_it_is_from() {
    let bench = Bench::with("votes.csv", rows(9, 400, |x| u64::from(x.count_ones() > 4)));
    let ran = bench.ok("learn votes.csv -o majority.nb --seed 3");
    assert!(ran.out.starts_with("majority: 9 input bits, 1 output bit\n"), "{}", ran.out);
    assert!(ran.out.contains("held out: 100.00 % (80 of 80 rows)\n"), "{}", ran.out);
    let text = bench.read("majority.nb");
    assert!(text.contains(": nbc learn votes.csv --gates 5000 --hold-out 20 --seed 3\n"), "{text}");
    assert!(text.contains("//! 320 of 320 training rows right; 80 of 80 rows that were held out right\n"), "{text}");
    bench.ok("fmt --check majority.nb");
    bench.file("a.nb", "use \"majority.nb\"\n\ntest majority \"as counted\" from \"votes.csv\"\n");
    let tested = bench.run("test a.nb --logic");
    assert_eq!((tested.status, tested.err.as_str()), (0, ""), "{}", tested.out);
    // The other formats are read back as the same circuit.
    for name in ["majority.blif", "majority.aag", "majority.aig", "majority.pla"] {
        bench.ok(&["learn", "votes.csv", "-o", name, "--seed", "3"]);
        bench.file("b.nb", format!("use \"{name}\"\n\ntest majority from \"votes.csv\"\n"));
        bench.ok("test b.nb --logic");
    }
}

#[test]
fn a_number_of_few_values_may_be_learned_as_a_code() {
    let bench = Bench::new();
    // Six patterns of sixteen bits, of which each row has some wrong bits.
    let patterns: [u64; 6] = [0xf00f, 0x0ff0, 0xaaaa, 0x3c3c, 0xcc33, 0x8421];
    let wrong = |at: u64, of: u64| 1u64 << (at.wrapping_mul(of).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 60);
    let row = |at: u64| {
        let class = (at * 5 % 6) as usize;
        let noisy = patterns[class] ^ wrong(at, 3) ^ wrong(at, 7) ^ wrong(at, 11);
        format!("0x{noisy:04x},{class}\n")
    };
    let rows: String = (0..400).map(row).collect();
    bench.file("patterns.csv", format!("x,class\n{rows}"));
    let found = learned(&bench, &["patterns.csv", "--gates", "8000"]);
    let tried = |word: &str| {
        let tried = found["bits"][0]["tried"].as_array().unwrap();
        tried.iter().any(|tried| tried["method"].as_str().unwrap().contains(word))
    };
    assert!(tried("a code of 8 bits, 15 votes of tables each") && tried("a decision tree"), "{found}");
    assert!(found["held_out"]["accuracy"].as_f64().unwrap() > 0.9, "{}", found["held_out"]);
    let counts = found["confusion"]["counts"].as_array().unwrap();
    let sum: u64 = counts.iter().flat_map(|row| row.as_array().unwrap()).map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(sum, 80, "each row that was held out is counted");
}

#[test]
fn a_small_budget_gives_a_small_tree() {
    let bench = Bench::new();
    // The majority of eleven bits, in a form that no recognized function of so few gates has.
    bench.file("noisy.csv", rows(11, 1_500, |x| u64::from(x.count_ones() > 5) ^ u64::from(x % 13 == 5)));
    let found = learned(&bench, &["noisy.csv", "--gates", "12"]);
    assert!(found["ands"].as_u64().unwrap() <= 12, "{found}");
    assert!(found["bits"][0]["learned"].as_str().unwrap().contains("a decision tree"), "{}", found["bits"]);
    assert!(found["held_out"]["accuracy"].as_f64().unwrap() > 0.6, "{}", found["held_out"]);
    // What is learned again from all training rows may need more gates.
    bench.file("mixed.csv", rows(10, 1_000, |x| if x % 3 == 0 { x % 6 } else { (x * 7 + x % 11) % 6 }));
    for (file, gates) in [("noisy.csv", 60), ("mixed.csv", 12)] {
        let found = learned(&bench, &[file, "--gates", &gates.to_string()]);
        assert!(found["ands"].as_u64().unwrap() <= gates, "{found}");
    }
}

#[test]
fn confusions_are_a_picture_of_one_output_with_few_values() {
    let bench = Bench::with("remainder.csv", rows(8, 200, |x| x % 5));
    let ran = bench.run("learn remainder.csv --confusion remainder.svg");
    assert_eq!((ran.status, ran.err.as_str()), (0, "wrote remainder.svg\n"));
    let picture = bench.read("remainder.svg");
    assert!(
        picture.contains(">remainder: y</text>") && picture.contains(" of 40 rows that were held out"),
        "{picture}"
    );
    bench.file("square.csv", rows(8, 200, |x| x * x));
    let refused = |file: &str, says: &str| {
        let ran = bench.run(&["learn", "square.csv", "--confusion", file]);
        assert!(ran.status == 2 && ran.err.contains(says), "{}", ran.err);
    };
    refused("square.png", "`square` has no table of confusions");
    refused("square.txt", "expected a name that ends in .svg or .png");
}

#[test]
fn the_same_seed_gives_the_same_file() {
    let bench = Bench::new();
    // Noise, so that the choice of rows matters.
    bench.file("noise.csv", rows(10, 300, |x| (((x * x) >> 3) & 1) ^ u64::from(x % 7 == 3)));
    let file = |seed: &str| {
        bench.ok(&["learn", "noise.csv", "-o", "noise.blif", "--seed", seed]);
        bench.read("noise.blif")
    };
    let [one, two, again] = ["1", "2", "1"].map(file);
    assert!(one == again && one != two);
}

#[test]
fn rows_of_a_group_are_held_out_together() {
    let bench = Bench::new();
    // Each row is there twice: without groups, nearly all rows that are held out are known from their twins.
    let row = |at: u64| format!("{},{}\n", at * 37 % 512, at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 63).repeat(2);
    let rows: String = (0..300).map(row).collect();
    bench.file("twins.csv", format!("x,y\n{rows}"));
    let accuracy =
        |group: &str| learned(&bench, &["twins.csv", "--group", group])["held_out"]["accuracy"].as_f64().unwrap();
    let [alone, together] = ["1", "2"].map(accuracy);
    assert!(alone > 0.8 && together < 0.7, "{alone} {together}");
}

#[test]
fn open_outputs_are_chosen_and_rows_that_cannot_be_learned_from_are_refused() {
    let bench = Bench::with("open.pla", ".i 4\n.o 1\n11-- 1\n00-- 0\n01-- -\n10-- -\n");
    let found = learned(&bench, &["open.pla", "--hold-out", "0"]);
    assert_eq!((&found["ands"], &found["training"]["right"]), (&0.into(), &16.into()), "{found}");
    assert!(found.get("held_out").is_none());
    let refused = |arguments: &[&str], says: &str| {
        let ran = bench.run(&[&["learn"], arguments].concat());
        assert!(ran.status == 2 && ran.err.contains(says), "{arguments:?}: {}", ran.err);
    };
    bench.file("bad.csv", "a,b,q\n0,1,1\n0,x,1\n");
    refused(&["bad.csv"], "bad.csv:3:3");
    refused(&["gone.csv"], "gone.csv");
    refused(&["open.pla", "-o", "a.txt"], "unrecognized circuit format");
    bench.file("rows.txt", "");
    refused(&["rows.txt"], "unrecognized format of the rows in `rows.txt`; expected .csv or .pla");
    bench.file("one.csv", "a,q\n0,1\n");
    refused(&["one.csv", "--hold-out", "60"], "60 % of 1 row leave none to learn from");
    refused(&["one.csv", "--target", "p"], "the file has no columns for the output `p`");
    bench.file("wide.csv", rows(17, 20, |x| x & 1));
    refused(&["wide.csv", "-o", "wide.pla"], "PLA is written of at most 16 input bits");
}
