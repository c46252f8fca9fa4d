//! Arguments: mostly such as make sense, some that no host should pass.

use std::ffi::{CStr, CString};
use std::ptr;
use std::sync::LazyLock;

use fastrand::Rng;

/// Numbers that break what was not thought of.
const REALS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    f64::MIN,
    1e-13,
    1e300,
    -1e-300,
    f64::EPSILON,
    1e16,
];

/// Lengths that no list has; whoever believes them reads far outside of it.
const LENGTHS: [usize; 4] = [usize::MAX, isize::MAX as usize, 1 << 40, (1 << 32) + 1];

const TEXTS: [&CStr; 7] = [
    c"",
    c"unit",
    c"\xff\xfe\x80",
    c"%s%n%d%x",
    c"logAll",
    c"logStatusError",
    c"{00000000-0000-0000-0000-000000000000}",
];

/// Bytes of any kind, a few or many thousand, that stand for no text in most cases.
static BYTES: LazyLock<Vec<CString>> = LazyLock::new(|| {
    let mut rng = Rng::with_seed(8);
    let text = |length| std::iter::repeat_with(|| rng.u8(1..)).take(length).collect::<Vec<_>>();
    let texts = [1, 2, 3, 4, 5, 8, 13, 40, 255, 4096, 100_000].map(text);
    texts.into_iter().filter_map(|text| CString::new(text).ok()).collect()
});

/// True once in `n` times.
pub fn one_in(rng: &mut Rng, n: u32) -> bool {
    rng.u32(0..n) == 0
}

/// Any number: from the list, of ordinary size, or any pattern of bits.
pub fn real(rng: &mut Rng) -> f64 {
    match rng.u32(0..10) {
        0..=2 => REALS[rng.usize(0..REALS.len())],
        3 => f64::from_bits(rng.u64(..)),
        _ => 4.0 * rng.f64() - 2.0,
    }
}

/// Any whole number, mostly a small one.
pub fn integer(rng: &mut Rng) -> i32 {
    match rng.u32(0..8) {
        0 => rng.i32(..),
        1 => [i32::MIN, i32::MAX, -1][rng.usize(0..3)],
        _ => rng.i32(0..5),
    }
}

/// A length: mostly the real one.
pub fn length(rng: &mut Rng, real: usize) -> usize {
    match rng.u32(0..20) {
        0 => LENGTHS[rng.usize(0..LENGTHS.len())],
        1 => 0,
        2 => rng.usize(0..=real),
        _ => real,
    }
}

/// A pointer: mostly the real one, else null or misaligned by a byte.
pub fn pointer<T>(rng: &mut Rng, real: *const T) -> *const T {
    match rng.u32(0..30) {
        0 => ptr::null(),
        1 if align_of::<T>() > 1 => real.cast::<u8>().wrapping_add(1).cast(),
        _ => real,
    }
}

/// Like [`pointer`].
pub fn pointer_mut<T>(rng: &mut Rng, real: *mut T) -> *mut T {
    pointer(rng, real.cast_const()).cast_mut()
}

/// A text, or null.
pub fn text(rng: &mut Rng) -> *const std::ffi::c_char {
    match rng.u32(0..24) {
        0 | 1 => ptr::null(),
        2 => BYTES[rng.usize(0..BYTES.len())].as_ptr(),
        _ => TEXTS[rng.usize(0..TEXTS.len())].as_ptr(),
    }
}

/// Bytes, changed: flipped, cut, extended, or others altogether.
pub fn damage(rng: &mut Rng, bytes: &mut Vec<u8>) {
    match rng.u32(0..5) {
        0 => bytes.truncate(rng.usize(0..=bytes.len())),
        1 => bytes.extend(std::iter::repeat_with(|| rng.u8(..)).take(9).collect::<Vec<_>>()),
        2 => bytes.extend([0; 16]),
        3 => bytes.fill_with(|| rng.u8(..)),
        _ => {
            for _ in 0..rng.u32(1..4) {
                if let Some(at) = (!bytes.is_empty()).then(|| rng.usize(0..bytes.len())) {
                    bytes[at] ^= 1 << rng.u32(0..8);
                }
            }
        }
    }
}
