//! Tells cargo to rebuild when the robots in `library` change, because the program embeds these files.

fn main() {
    println!("cargo::rerun-if-changed=library/robots");
    println!("cargo::rerun-if-changed=library/three");
}
