//! Laws of the compiler: it finds the optimum of every small function, and no damaged file makes a reader panic.

use nbc_base::model::Function;
use nbc_base::source::FileId;
use nbc_circuit::formats::{Design, aiger, bench, blif};
use nbc_circuit::network::Network;

/// A network of AND and OR cells for the function with these outputs.
pub fn sum_of_products(inputs: usize, truth: u32) -> Network {
    let mut network = Network::new(inputs);
    let mut sum = 0;
    for minterm in (0..1u32 << inputs).filter(|minterm| truth >> minterm & 1 == 1) {
        let mut product = 1;
        for i in 0..inputs {
            let function = if minterm >> i & 1 == 1 { Function::AND } else { Function::AND.with_input_inverted(1) };
            product = network.add(function, [product, network.input(i)]);
        }
        sum = network.add(Function::OR, [sum, product]);
    }
    network.outputs = vec![sum];
    network
}

fn sample() -> Design {
    let text = "INPUT(a)\nINPUT(b)\nOUTPUT(y)\nOUTPUT(z)\nq = DFF(n)\nn = XOR(q, a)\ny = NAND(q, b)\nz = NOT(n)\n";
    bench::read(text, FileId(0), None).unwrap()
}

#[test]
fn damaged_files_do_not_make_a_reader_panic() {
    let design = sample();
    let files = [aiger::write(&design, true), aiger::write(&design, false), blif::write(&design).into_bytes()];
    for bytes in files {
        for at in 0..bytes.len() {
            read_all(&bytes[..at]);
            for wrong in [0u8, b' ', b'\n', b'9', b'.', 0xff] {
                let mut damaged = bytes.clone();
                damaged[at] = wrong;
                read_all(&damaged);
            }
        }
    }
}

fn read_all(bytes: &[u8]) {
    let _ = aiger::read(bytes, None);
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = blif::read(text, FileId(0), None);
        let _ = bench::read(text, FileId(0), None);
    }
}
