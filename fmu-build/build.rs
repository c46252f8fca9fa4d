//! Compiles the one function that Rust cannot define: the logger with C's variable arguments.

fn main() {
    println!("cargo::rerun-if-changed=src/host/fmu/logger.c");
    cc::Build::new().file("src/host/fmu/logger.c").warnings_into_errors(true).compile("fmu_build_logger");
}
