//! Puts the page that live exports are made of into the program, if the variable `NBC_LIVE_PAGE` names it: `.ci/site`
//! makes it as `out/site/alone.html`. Without it, exported pages are recordings.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-env-changed=NBC_LIVE_PAGE");
    println!("cargo::rerun-if-changed=build.rs");
    let text = env::var("NBC_LIVE_PAGE").map(|path| {
        println!("cargo::rerun-if-changed={path}");
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("NBC_LIVE_PAGE: cannot read `{path}`: {error}"))
    });
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join("live.html");
    fs::write(out, text.unwrap_or_default()).expect("cargo's folder can be written");
}
