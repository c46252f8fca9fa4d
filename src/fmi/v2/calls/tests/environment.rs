//! The host's floating-point environment: nothing depends on it, and nothing changes it.

use super::*;
use crate::fmi::environment::processor::{read, write};

/// Settings without raised flags.
#[cfg(target_arch = "x86_64")]
mod settings {
    /// MXCSR: usual; up, down, towards zero; tiny numbers are zero; all traps; all at once.
    pub const ALL: [u32; 7] = [0x1f80, 0x5f80, 0x3f80, 0x7f80, 0x9fc0, 0x0000, 0xe040];
}
#[cfg(target_arch = "aarch64")]
mod settings {
    /// FPCR and FPSR, likewise.
    pub const ALL: [[u64; 2]; 7] =
        [[0, 0], [1 << 22, 0], [2 << 22, 0], [3 << 22, 0], [3 << 24, 0], [0x9f00, 0], [0x9f00 | 0xf << 22, 0]];
}
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod settings {
    pub const ALL: [(); 1] = [()];
}

/// Runs `call` of a unit in each setting; it must be in force afterwards, without a flag.
fn in_each<R: PartialEq + std::fmt::Debug>(what: &str, call: impl Fn() -> R) -> R {
    let results = settings::ALL.map(|setting| {
        let usual = read();
        write(setting);
        let before = read();
        let result = call();
        let after = read();
        write(usual);
        assert_eq!(before, after, "{what} in {setting:x?}");
        result
    });
    let [first, others @ ..] = results;
    assert!(others.iter().all(|other| *other == first), "{what}: {first:?}, {others:?}");
    first
}

#[test]
fn every_call_is_the_same_in_every_environment_and_leaves_it_as_it_was() {
    let host = Host::new();
    let guid = host::guid();
    let callbacks = host.callbacks();
    // SAFETY: texts end with a zero, handles are good, all answers have a place.
    unsafe {
        for (guid, comes) in [(guid.as_c_str(), true), (c"none", false)] {
            in_each("fmi2Instantiate", || {
                let toy = fmi2Instantiate(c"toy".as_ptr(), 1, guid.as_ptr(), null(), &raw const *callbacks, 0, 1);
                assert_eq!(!toy.is_null(), comes);
                fmi2FreeInstance(toy);
            });
        }
        let (toy, failing, panicking) = (host.instantiate(), host.running(), host.running());
        failing.set_real(&[vr::FAULT], &[2.0]);
        panicking.set_real(&[vr::FAULT], &[3.0]);
        let all = c"logAll".as_ptr();
        in_each("fmi2SetDebugLogging", || fmi2SetDebugLogging(toy.handle, 1, 1, &raw const all));
        let milestones = in_each("initialization", || {
            let start = [fmi2Reset(toy.handle), fmi2SetupExperiment(toy.handle, 0, 0.0, 0.1, 1, 7.3)];
            [start, [fmi2EnterInitializationMode(toy.handle), fmi2ExitInitializationMode(toy.handle)]]
        });
        assert_eq!(milestones, [[OK; 2]; 2]);

        toy.set_real(&[vr::RATE, vr::LEAK], &[1.0 / 3.0, 0.7]);
        let mut begin = null_mut();
        assert_eq!(fmi2GetFMUstate(toy.handle, &raw mut begin), OK);
        let position = in_each("steps and states", || {
            let (mut position, mut size, mut bytes) = (0_f64, 0, [0; 1000]);
            let [from, step] = [0.1, 0.001];
            let mut status = fmi2SetFMUstate(toy.handle, begin);
            status |= fmi2DoStep(toy.handle, from, step, 1);
            status |= fmi2GetReal(toy.handle, &vr::POSITION, 1, &raw mut position);
            status |= fmi2SerializedFMUstateSize(toy.handle, begin, &raw mut size);
            status |= fmi2SerializeFMUstate(toy.handle, begin, bytes.as_mut_ptr(), bytes.len());
            status |= fmi2DeSerializeFMUstate(toy.handle, bytes.as_ptr(), bytes.len(), &mut begin.clone());
            (status, position.to_bits())
        });
        assert_eq!(position, (OK, (1.0 + (1.0 / 3.0 - 0.7) * 0.001_f64).to_bits()));
        for (what, broken) in [("an error", &failing), ("a panic", &panicking)] {
            assert_eq!(in_each(what, || fmi2DoStep(broken.handle, 0.0, 1.0, 1)), ERROR);
        }
        in_each("fmi2GetEventIndicators", || fmi2GetEventIndicators(toy.handle, null_mut(), 0));
        in_each("fmi2CancelStep", || fmi2CancelStep(toy.handle));
    }
}
