//! Says which sequence was being played when a unit crashes or hangs.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Most threads that can be watched.
pub const THREADS: usize = 64;

/// A thread that has nothing to do.
const IDLE: u64 = u64::MAX;

/// Longest time that one sequence may take. Two hundred thousand internal steps, at most, in each of forty
/// calls are a few seconds.
const LONGEST: Duration = Duration::from_secs(60);

/// The sequence that each thread is playing.
static NOW: [AtomicU64; THREADS] = [const { AtomicU64::new(IDLE) }; THREADS];

/// Notes what a thread begins to play; nothing if it has finished.
pub fn playing(thread: usize, sequence: Option<u64>) {
    NOW[thread].store(sequence.unwrap_or(IDLE), Ordering::Relaxed);
}

/// From now on a crash or a hang ends the program with the numbers of the sequences.
pub fn begin() {
    #[cfg(unix)]
    for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGILL, libc::SIGFPE, libc::SIGABRT] {
        // SAFETY: the handler calls nothing that a signal handler must not call.
        unsafe { libc::signal(signal, crashed as *const () as libc::sighandler_t) };
    }
    std::thread::spawn(|| {
        loop {
            let before = NOW.each_ref().map(|now| now.load(Ordering::Relaxed));
            std::thread::sleep(LONGEST);
            for (now, before) in NOW.iter().zip(before) {
                if before != IDLE && now.load(Ordering::Relaxed) == before {
                    eprintln!("error: sequence {before} takes more than {LONGEST:?}; --only {before} repeats it");
                    std::process::exit(1);
                }
            }
        }
    });
}

#[cfg(unix)]
extern "C" fn crashed(_: libc::c_int) {
    say(b"error: the program crashed while it played one of these sequences; --only NUMBER repeats one:");
    for now in &NOW {
        let mut number = now.load(Ordering::Relaxed);
        if number == IDLE {
            continue;
        }
        let mut digits = [b' '; 21];
        for place in digits.iter_mut().rev() {
            *place = b'0' + u8::try_from(number % 10).unwrap_or(0);
            number /= 10;
            if number == 0 {
                break;
            }
        }
        say(&digits);
    }
    say(b"\n");
    // SAFETY: ends the process, as the standard allows in a handler.
    unsafe { libc::_exit(1) };
}

#[cfg(unix)]
fn say(text: &[u8]) {
    // SAFETY: the text is as long as it says. Nothing can be done if standard error is closed.
    unsafe { libc::write(2, text.as_ptr().cast(), text.len()) };
}
