//! What no host should do, and what happens then.

use super::*;
use crate::bytes::{Memory, Tape};
use crate::fmi::v2::calls;

/// Instantiates with a text for the name and any type and GUID; the message if that is refused.
fn refusal(name: Option<&CStr>, fmu_type: c_int, guid: Option<&CStr>) -> String {
    let host = Host::new();
    let pointer = |text: Option<&CStr>| text.map_or(null(), CStr::as_ptr);
    let callbacks = host.callbacks();
    // SAFETY: all texts outlive the call.
    let handle =
        unsafe { fmi2Instantiate(pointer(name), fmu_type, pointer(guid), null(), &raw const *callbacks, 0, 0) };
    assert!(handle.is_null());
    assert_eq!(host.messages().len(), 1);
    host.last().text
}

#[test]
fn a_wrong_instantiation_is_null_with_a_reason() {
    let (name, right) = (Some(c"name"), host::guid());
    let guid = Some(right.as_c_str());
    assert_eq!(refusal(None, 1, guid), "fmi2Instantiate: instanceName does not point to anything usable");
    assert_eq!(refusal(name, 0, guid), "fmi2Instantiate: fmuType must be 1 (co-simulation), but is 0");
    assert_eq!(refusal(name, -1, guid), "fmi2Instantiate: fmuType must be 1 (co-simulation), but is -1");
    assert_eq!(refusal(name, 1, None), "fmi2Instantiate: fmuGUID does not point to anything usable");
    let wrong = refusal(name, 1, Some(c"{another}"));
    assert!(wrong.contains("\"{another}\"") && wrong.contains(right.to_str().unwrap()), "{wrong}");
    assert!(refusal(name, 1, Some(c"\xff\xfe")).contains('\u{fffd}'));
}

#[test]
fn names_and_callbacks_may_be_missing_or_odd() {
    let guid = host::guid();
    let host = Host::new();
    let callbacks = host.callbacks();
    // SAFETY: all texts outlive the call.
    unsafe {
        let silent = fmi2Instantiate(c"silent".as_ptr(), 1, guid.as_ptr(), null(), null(), 7, 7);
        assert_eq!(fmi2DoStep(silent, 0.0, 1.0, 0), ERROR);
        fmi2FreeInstance(silent);
        assert!(fmi2Instantiate(null(), 1, null(), null(), null(), 0, 0).is_null());

        let odd = fmi2Instantiate(c"50 % \xff".as_ptr(), 1, guid.as_ptr(), null(), &raw const *callbacks, 0, 0);
        assert_eq!(fmi2DoStep(odd, 0.0, 1.0, 0), ERROR);
        assert_eq!(host.last().instance, "50 % \u{fffd}");
        fmi2FreeInstance(odd);

        let nameless = fmi2Instantiate(c"".as_ptr(), 1, guid.as_ptr(), null(), &raw const *callbacks, 0, TRUE);
        assert_eq!((host.last().instance.as_str(), host.last().category.as_str()), ("toy", "logStatusWarning"));
        fmi2FreeInstance(nameless);
    }
}

#[test]
fn handles_that_are_none_are_errors() {
    let mut memory = [0_u64; 64];
    let odd = (&raw mut memory).cast::<u8>().wrapping_add(1).cast();
    for handle in [null_mut(), (&raw mut memory).cast(), odd] {
        // SAFETY: null, or readable memory.
        unsafe {
            assert_eq!(fmi2DoStep(handle, 0.0, 1.0, 0), ERROR);
            assert_eq!(fmi2Reset(handle), ERROR);
            assert_eq!(fmi2SetDebugLogging(handle, 1, 0, null()), ERROR);
            assert_eq!(fmi2GetReal(handle, null(), 0, null_mut()), ERROR);
            fmi2FreeInstance(handle);
        }
    }
}

#[test]
fn handles_of_another_unit_are_errors() {
    #[derive(Clone)]
    struct Other;

    impl Memory for Other {
        fn pass(&mut self, _: &mut Tape<'_>) {}
    }

    impl crate::fmi::Model for Other {
        const IDENTIFIER: &'static str = "other";
        const DESCRIPTION: &'static str = "Nothing";
        type Structure = u8;
        type Data = ();
        type Error = String;

        fn structures() -> impl Iterator<Item = u8> {
            std::iter::once(0)
        }
        fn table(_: u8) -> crate::variables::Table<()> {
            crate::variables::Table::default()
        }
        fn start(_: u8) {}
        fn initialize(_: u8, (): &mut (), _: f64) -> Result<Self, String> {
            Ok(Self)
        }
        fn step(&mut self, (): &mut (), _: crate::fmi::CommunicationStep) -> Result<(), String> {
            Ok(())
        }
        fn restore(_: u8, (): &(), _: &mut Tape<'_>) -> Result<Self, String> {
            Ok(Self)
        }
    }

    let host = Host::new();
    let toy = host.instantiate();
    // SAFETY: readable memory.
    unsafe {
        assert_eq!(calls::reset::<Other>(toy.handle) as c_int, ERROR);
        calls::free_instance::<Other>(toy.handle);
    }
    assert_eq!(toy.reset(), OK);
}

#[test]
fn lists_are_checked_before_they_are_read() {
    let host = Host::new();
    let toy = host.running();
    let mut value = [0.0_f64; 2];
    let c = toy.handle;
    // SAFETY: lists that are too long or have no place are not read.
    unsafe {
        assert_eq!(fmi2GetReal(c, &vr::GAIN, usize::MAX, value.as_mut_ptr()), ERROR);
        assert!(host.last().text.contains("vr must be a list of at most 65536"), "{}", host.last().text);
        assert_eq!(fmi2SetReal(c, &vr::RATE, 65537, value.as_ptr()), ERROR);
        assert_eq!(fmi2GetReal(c, null(), 1, value.as_mut_ptr()), ERROR);
        assert_eq!(host.last().text, "fmi2GetReal: vr does not point to anything usable");
        assert_eq!(fmi2GetReal(c, &vr::GAIN, 1, null_mut()), ERROR);
        assert_eq!(host.last().text, "fmi2GetReal: value does not point to anything usable");
        assert_eq!(fmi2SetReal(c, &vr::RATE, 1, value.as_ptr().cast::<u8>().wrapping_add(1).cast()), ERROR);
        assert_eq!(fmi2GetReal(c, null(), 0, null_mut()), OK);
        assert_eq!(fmi2SetBoolean(c, null(), 0, null()), OK);

        assert_eq!(fmi2SetDebugLogging(c, 1, usize::MAX, &c"logAll".as_ptr()), ERROR);
        assert_eq!(fmi2SetDebugLogging(c, 1, 1, null()), ERROR);
        assert_eq!(fmi2SetDebugLogging(c, 1, 1, &null()), OK);
        assert_eq!(fmi2SetDebugLogging(c, 1, 1, &c"\xff".as_ptr()), OK);
    }
    assert_eq!(toy.step(0.0, 1.0), OK);
}

/// Some hosts ask for the same variable for each of its uses.
#[test]
fn a_variable_may_be_named_more_often_than_there_are_variables() {
    let host = Host::new();
    let toy = host.running();
    let references = [vr::GAIN; 10 * vr::COUNT as usize];
    toy.set_real(&[vr::RATE; 100], &[7.0; 100]);
    let mut values = [0.0; 10 * vr::COUNT as usize];
    // SAFETY: as many values as references.
    assert_eq!(unsafe { fmi2GetReal(toy.handle, references.as_ptr(), references.len(), values.as_mut_ptr()) }, OK);
    assert_eq!(values, [1.0; 10 * vr::COUNT as usize]);
}

#[test]
fn wrong_references_and_types_are_errors_that_name_them() {
    let host = Host::new();
    let toy = host.running();
    let c = toy.handle;
    let (mut number, mut text) = (0, null());
    // SAFETY: all lists have one element.
    unsafe {
        assert_eq!(fmi2SetReal(c, &u32::MAX, 1, &1.0), ERROR);
        assert!(host.last().text.contains("4294967295"), "{}", host.last().text);
        assert_eq!(fmi2GetInteger(c, &vr::GAIN, 1, &raw mut number), ERROR);
        assert_eq!(host.last().text, "fmi2GetInteger: gain is of type Real, not Integer or Enumeration");
        assert_eq!(fmi2GetBoolean(c, &vr::DIRECTION, 1, &raw mut number), ERROR);
        assert_eq!(fmi2GetString(c, &vr::GAIN, 1, &raw mut text), ERROR);
        assert_eq!(fmi2SetString(c, &vr::GAIN, 1, &c"1".as_ptr()), ERROR);
        assert_eq!(host.last().text, "fmi2SetString: gain is of type Real, not String");
    }
}

#[test]
fn ten_thousand_instances_come_and_go() {
    let host = Host::new();
    for _ in 0..10_000 {
        drop(host.instantiate());
    }
    assert_eq!(host.messages(), []);
}
