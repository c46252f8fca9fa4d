//! Compiles the one function that Rust cannot define: the logger with C's variable arguments.

fn main() {
    println!("cargo::rerun-if-changed=src/fmu/logger.c");
    cc::Build::new().file("src/fmu/logger.c").warnings_into_errors(true).compile("fmu_build_logger");
}
