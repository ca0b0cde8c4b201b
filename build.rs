//! Tells cargo that the program embeds the robots of `library/robots`, new ones included.

fn main() {
    println!("cargo::rerun-if-changed=library/robots");
}
