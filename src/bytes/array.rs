//! Arrays of any length that is known to the compiler, which serde itself does not cover: for
//! `#[serde(with = "bytes::array")]`.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes the elements one after the other.
///
/// # Errors
/// If one cannot be written.
pub fn serialize<S: Serializer, T: Serialize, const N: usize>(
    array: &[T; N],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut tuple = serializer.serialize_tuple(N)?;
    array.iter().try_for_each(|element| tuple.serialize_element(element))?;
    tuple.end()
}

/// Reads as many elements as the array has.
///
/// # Errors
/// If there are fewer, or one cannot be read.
pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de> + Copy, const N: usize>(
    deserializer: D,
) -> Result<[T; N], D::Error> {
    deserializer.deserialize_tuple(N, Elements(PhantomData))
}

struct Elements<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Copy, const N: usize> Visitor<'de> for Elements<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{N} elements")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<[T; N], A::Error> {
        let mut read = [None; N];
        for (found, place) in read.iter_mut().enumerate() {
            *place = Some(elements.next_element()?.ok_or_else(|| A::Error::invalid_length(found, &self))?);
        }
        // All are there; the error is for the compiler.
        let all: Option<Vec<T>> = read.into_iter().collect();
        all.and_then(|all| all.try_into().ok()).ok_or_else(|| A::Error::invalid_length(0, &self))
    }
}
