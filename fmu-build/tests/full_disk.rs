//! What becomes of a file when the disk is full: a limit on the size of files is as good.
//!
//! The limit is one of the whole process, so this test has a program of its own.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::fs;

use fmu_build::host::record::{Recording, write_csv};

/// No file of this process may have more bytes, and trying is an error instead of the end.
fn limit_files(bytes: libc::rlim_t) {
    let limit = libc::rlimit { rlim_cur: bytes, rlim_max: libc::RLIM_INFINITY };
    // SAFETY: the limit lives through the call; nothing here handles the signal.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
        libc::setrlimit(libc::RLIMIT_FSIZE, &raw const limit);
    }
}

#[test]
fn a_table_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("4.3a.csv");
    let rows = |rows: u32| {
        let mut recording = Recording::new(["base.x"], 0);
        (0..rows).for_each(|n| recording.push(f64::from(n), [0.1 * f64::from(n)]));
        recording
    };
    write_csv(&path, &[("", &rows(3))], 1).unwrap();
    let before = fs::read(&path).unwrap();

    limit_files(10_000);
    let error = write_csv(&path, &[("", &rows(100_000))], 1).unwrap_err().to_string();
    limit_files(libc::RLIM_INFINITY);
    assert!(error.contains("4.3a.csv") && error.contains("write"), "{error}");
    assert_eq!(fs::read(&path).unwrap(), before);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is left over");
}
