//! Tells cargo to rebuild when `library/robots` changes, because the program embeds these files.

fn main() {
    println!("cargo::rerun-if-changed=library/robots");
}
