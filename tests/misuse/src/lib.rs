//! What programs have in common that play long random runs on the C functions of the built FMUs: loading a unit, sharing
//! numbered pieces of work out among threads, and a fingerprint of the answers.

#![allow(clippy::expect_used, reason = "a test may fail like a test")]

pub mod crowd;
pub mod digest;
pub mod environment;
pub mod functions;
pub mod host;
pub mod unit;
pub mod watch;
