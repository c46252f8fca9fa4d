//! States through the C interface.

use std::collections::BTreeSet;

use super::*;
use crate::fmi::hash::fnv1a;
use crate::fmi::v2::c_types::FmuState;

fn get(toy: &host::Component, state: &mut FmuState) -> c_int {
    // SAFETY: the handle is good, and the state has a place.
    unsafe { fmi2GetFMUstate(toy.handle, state) }
}

fn set(toy: &host::Component, state: FmuState) -> c_int {
    // SAFETY: states are looked up, not read.
    unsafe { fmi2SetFMUstate(toy.handle, state) }
}

fn free(toy: &host::Component, state: &mut FmuState) -> c_int {
    // SAFETY: states are looked up, not read.
    unsafe { fmi2FreeFMUstate(toy.handle, state) }
}

fn saved(toy: &host::Component) -> FmuState {
    let mut state = null_mut();
    assert_eq!(get(toy, &mut state), OK);
    assert!(!state.is_null());
    state
}

fn serialized(toy: &host::Component, state: FmuState) -> Vec<c_char> {
    let mut size = 0;
    // SAFETY: the bytes have the size that the unit asks for.
    unsafe {
        assert_eq!(fmi2SerializedFMUstateSize(toy.handle, state, &raw mut size), OK);
        let mut bytes = vec![0x55; size];
        assert_eq!(fmi2SerializeFMUstate(toy.handle, state, bytes.as_mut_ptr(), size), OK);
        bytes
    }
}

fn deserialize(toy: &host::Component, bytes: &[c_char]) -> (c_int, FmuState) {
    let mut state = null_mut();
    // SAFETY: as many bytes as said.
    let status = unsafe { fmi2DeSerializeFMUstate(toy.handle, bytes.as_ptr(), bytes.len(), &raw mut state) };
    (status, state)
}

#[test]
fn a_state_takes_an_instance_back_and_another_one_there() {
    let host = Host::new();
    let (toy, other) = (host.running(), host.instantiate());
    toy.set_real(&[vr::RATE], &[2.0]);
    toy.step(0.0, 0.5);
    let mut state = saved(&toy);
    toy.set_real(&[vr::RATE], &[7.0]);
    toy.step(0.5, 0.5);
    let bytes = serialized(&toy, state);
    for toy in [&toy, &other] {
        assert_eq!(set(toy, state), OK);
        assert_eq!((toy.real(vr::TIME), toy.real(vr::POSITION), toy.real(vr::RATE)), (0.5, 2.0, 2.0));
        assert_eq!(toy.step(0.5, 1.0), OK);
        assert_eq!(toy.real(vr::POSITION), 4.0);
    }
    assert_eq!(free(&toy, &mut state), OK);
    assert!(state.is_null());

    let fresh = host.instantiate();
    let (status, state) = deserialize(&fresh, &bytes);
    assert_eq!((status, set(&fresh, state)), (OK, OK));
    assert_eq!(fresh.step(0.5, 1.0), OK);
    assert_eq!(fresh.real(vr::POSITION), 4.0);
    assert_eq!(host.messages(), []);
}

#[test]
fn a_state_revives_an_instance_whose_step_failed() {
    let host = Host::new();
    let toy = host.running();
    let state = saved(&toy);
    for fault in [2.0, 3.0] {
        toy.set_real(&[vr::FAULT], &[fault]);
        assert_eq!(toy.step(0.0, 1.0), ERROR);
        assert_eq!(set(&toy, state), OK);
        assert_eq!(toy.step(0.0, 1.0), OK);
        assert_eq!(set(&toy, state), OK);
    }
}

#[test]
fn a_state_that_is_there_is_overwritten() {
    let host = Host::new();
    let toy = host.running();
    let mut state = saved(&toy);
    let first = state;
    toy.set_real(&[vr::RATE], &[1.0]);
    toy.step(0.0, 1.0);
    assert_eq!(get(&toy, &mut state), OK);
    assert_eq!(state, first);
    let bytes = serialized(&toy, state);
    toy.reset();
    assert_eq!(set(&toy, state), OK);
    assert_eq!(toy.real(vr::POSITION), 2.0);

    toy.step(1.0, 1.0);
    assert_eq!(get(&toy, &mut state), OK);
    // SAFETY: as many bytes as said.
    unsafe { assert_eq!(fmi2DeSerializeFMUstate(toy.handle, bytes.as_ptr(), bytes.len(), &raw mut state), OK) };
    assert_eq!((state, set(&toy, state)), (first, OK));
    assert_eq!(toy.real(vr::POSITION), 2.0);
    assert_eq!(free(&toy, &mut state), OK);
}

#[test]
fn what_is_no_state_is_refused() {
    let host = Host::new();
    let toy = host.running();
    let mut state = saved(&toy);
    let mut freed = state;
    // SAFETY: states are looked up, not read.
    unsafe {
        assert_eq!(fmi2FreeFMUstate(toy.handle, null_mut()), OK);
        assert_eq!(fmi2FreeFMUstate(toy.handle, &mut null_mut()), OK);
    }
    assert_eq!(free(&toy, &mut state), OK);
    assert_eq!(free(&toy, &mut state), OK, "null by now");

    let mut garbage = [0x5a_u64; 8];
    let nonsense = std::ptr::without_provenance_mut(12345);
    for strange in [freed, (&raw mut garbage).cast(), nonsense, toy.handle] {
        let mut place = strange;
        assert_eq!(set(&toy, strange), ERROR);
        assert_eq!(get(&toy, &mut place), ERROR);
        assert_eq!(free(&toy, &mut place), ERROR);
        assert_eq!(place, strange);
        assert!(host.last().text.contains("FMUstate is no state of this unit"), "{}", host.last().text);
    }
    assert_eq!(set(&toy, null_mut()), ERROR);
    assert_eq!(free(&toy, &mut freed), ERROR);
    // SAFETY: null and odd places are not written.
    unsafe {
        assert_eq!(fmi2GetFMUstate(toy.handle, null_mut()), ERROR);
        assert_eq!(fmi2GetFMUstate(toy.handle, (&raw mut garbage).cast::<u8>().wrapping_add(1).cast()), ERROR);
    }
    assert_eq!(toy.step(0.0, 1.0), OK);
}

#[test]
fn states_of_other_structures_and_units_are_refused() {
    let host = Host::new();
    let toy = host.running();
    let large = host.instantiate_with(&CString::new(Identity::<Toy>::of(Size::Large).guid().to_string()).unwrap());
    let state = saved(&large);
    assert_eq!(set(&toy, state), ERROR);
    let expected = "FMUstate belongs to an instance with large toy, but this one has small toy";
    assert!(host.last().text.ends_with(expected), "{}", host.last().text);
    let (status, none) = deserialize(&toy, &serialized(&large, state));
    assert_eq!((status, none), (ERROR, null_mut()));
    assert!(host.last().text.contains("serializedState is a state of large toy"), "{}", host.last().text);

    let mut strange = crate::fmi::v2::states::keep(7_i32, 0);
    assert_eq!(set(&toy, strange), ERROR);
    assert_eq!(free(&toy, &mut strange), ERROR);
    assert!(crate::fmi::v2::states::free::<i32>(strange));
}

#[test]
fn states_end_with_the_instance_that_gave_them() {
    let host = Host::new();
    let (toy, other) = (host.running(), host.running());
    let state = saved(&toy);
    assert_eq!(set(&other, state), OK);
    drop(toy);
    assert_eq!(set(&other, state), ERROR);
    assert_eq!(other.step(0.0, 1.0), OK);
}

#[test]
fn bytes_need_room_and_may_have_more() {
    let host = Host::new();
    let toy = host.running();
    let state = saved(&toy);
    let mut bytes = serialized(&toy, state);
    let size = bytes.len();
    // SAFETY: the bytes have at least the size that is said.
    unsafe {
        assert_eq!(fmi2SerializeFMUstate(toy.handle, state, bytes.as_mut_ptr(), size - 1), ERROR);
        assert!(host.last().text.contains(&format!("size must be at least {size}")), "{}", host.last().text);
        assert_eq!(fmi2SerializeFMUstate(toy.handle, state, null_mut(), size), ERROR);
        assert_eq!(fmi2SerializeFMUstate(toy.handle, state, bytes.as_mut_ptr(), usize::MAX), ERROR);
        assert_eq!(fmi2SerializedFMUstateSize(toy.handle, state, null_mut()), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(toy.handle, null(), size, &mut null_mut()), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(toy.handle, bytes.as_ptr(), usize::MAX, &mut null_mut()), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(toy.handle, bytes.as_ptr(), size, null_mut()), ERROR);

        for more in [1, 9, 1 << 16, 1 << 24] {
            bytes.clear();
            bytes.resize(size + more, 0x55);
            assert_eq!(fmi2SerializeFMUstate(toy.handle, state, bytes.as_mut_ptr(), bytes.len()), OK, "{more}");
            assert!(bytes[size..].iter().all(|byte| *byte == 0));
            assert_eq!(deserialize(&toy, &bytes).0, OK, "{more}");
        }
    }
    *bytes.last_mut().unwrap() = 1;
    assert_eq!(deserialize(&toy, &bytes).0, ERROR);
}

/// Bytes whose title is `edit` of the right one, otherwise undamaged: how they are refused.
fn refused(toy: &host::Component, host: &Host, edit: impl Fn(&str) -> String) -> String {
    let bytes: Vec<u8> = serialized(toy, saved(toy)).into_iter().map(i8::cast_unsigned).collect();
    let title = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    let mut edited = edit(str::from_utf8(&bytes[..title]).unwrap()).into_bytes();
    edited.extend(&bytes[title..bytes.len() - 8]);
    edited.extend(fnv1a(&edited).to_le_bytes());
    let edited: Vec<c_char> = edited.into_iter().map(u8::cast_signed).collect();
    assert_eq!(deserialize(toy, &edited).0, ERROR);
    host.last().text
}

/// Bytes with the right checksum that this unit did not write: the message says what they are.
#[test]
fn bytes_of_others_are_known_for_what_they_are() {
    let host = Host::new();
    let toy = host.running();
    let title = |text: &str| text.split(", ").map(str::to_owned).collect::<Vec<_>>();

    let said = refused(&toy, &host, |right| format!("{}, format 1, {}", title(right)[0], title(right)[2]));
    let old = "a state that another version of this unit wrote";
    assert!(said.contains(old) && said.contains("\"FMI 2.0 state, format 1, toy"), "{said}");
    let said = refused(&toy, &host, |right| right.replace(&format!(" {} ", env!("CARGO_PKG_VERSION")), " 0.0.7 "));
    assert!(said.contains(old) && said.contains("toy 0.0.7 {"), "{said}");
    let unknown = "{01234567-89ab-4cde-8f01-23456789abcd}";
    let said = refused(&toy, &host, |right| right.replace(host::guid().to_str().unwrap(), unknown));
    assert!(said.contains(old) && said.contains(unknown), "{said}");

    let large = Identity::<Toy>::of(Size::Large).guid().to_string();
    let said = refused(&toy, &host, |right| right.replace(host::guid().to_str().unwrap(), &large));
    assert!(said.contains("a state of large toy, but this is small toy"), "{said}");
    let said = refused(&toy, &host, |right| right.replace(" toy ", " uam_plant "));
    assert!(said.contains("a state of the unit uam_plant, but this is toy"), "{said}");
    let said = refused(&toy, &host, |_| "PNG".to_owned());
    assert!(said.contains("no state of an FMU of this kind") && said.contains("\"PNG"), "{said}");
}

#[test]
fn damaged_bytes_are_refused_wherever_the_damage_is() {
    let host = Host::new();
    let toy = host.running();
    let bytes = serialized(&toy, saved(&toy));
    for length in 0..bytes.len() {
        assert_eq!(deserialize(&toy, &bytes[..length]).0, ERROR, "{length}");
    }
    let mut reasons = BTreeSet::new();
    for position in 0..bytes.len() {
        for bit in 0..8 {
            let mut wrong = bytes.clone();
            wrong[position] ^= (1_u8 << bit).cast_signed();
            assert_eq!(deserialize(&toy, &wrong).0, ERROR, "{position}");
            let said = host.last().text;
            reasons.insert(said.contains("damaged"));
            assert!(said.contains("damaged") || said.contains("must begin with"), "{said}");
            host.clear();
        }
    }
    assert_eq!(reasons, BTreeSet::from([false, true]));
    assert_eq!(toy.step(0.0, 1.0), OK);
}

#[test]
fn many_threads_save_and_go_back() {
    let host = Host::new();
    let toy = host.running();
    let state = saved(&toy).addr();
    std::thread::scope(|scope| {
        for rate in 0..8 {
            scope.spawn(move || {
                let host = Host::new();
                let toy = host.running();
                toy.set_real(&[vr::RATE], &[f64::from(rate)]);
                let mut own = null_mut();
                for n in 0..100 {
                    assert_eq!(toy.step(f64::from(n), 1.0), OK);
                    assert_eq!(get(&toy, &mut own), OK);
                    assert_eq!(set(&toy, std::ptr::without_provenance_mut(state)), OK);
                    assert_eq!(toy.real(vr::TIME), 0.0);
                    assert_eq!(set(&toy, own), OK);
                }
                assert_eq!(toy.real(vr::POSITION), 1.0 + 100.0 * f64::from(rate));
                assert_eq!(free(&toy, &mut own), OK);
            });
        }
    });
}
