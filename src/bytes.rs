//! Values as bytes and back, exactly: every bit of a number survives, whatever it stands for.
//!
//! A [`Tape`] is recorded or played; what has a [`Memory`] passes it by in both cases, number by number, so
//! that the two can never differ. What is recorded is not readable without knowing of what; who keeps bytes
//! adds what tells them from others: a third kind of tape takes down names and kinds of all that passes.

use std::fmt::{Debug, Write};

use nalgebra::SMatrix;

use crate::error::{Error, Result};
use crate::variables::options::Choice;

/// Something that changes in the course of a run.
pub trait Memory {
    /// Records all that it remembers on a tape, or takes all of it from there.
    fn pass(&mut self, tape: &mut Tape<'_>);
}

/// Bytes that are being written, or read from the front; or words that say how such bytes are laid out.
pub struct Tape<'a> {
    direction: Direction<'a>,
    fault: Option<&'static str>,
}

enum Direction<'a> {
    Recording(&'a mut Vec<u8>),
    Playing(&'a [u8]),
    Describing(&'a mut String),
}

impl<'a> Tape<'a> {
    /// Everything that passes is appended to `bytes`.
    pub fn recording(bytes: &'a mut Vec<u8>) -> Self {
        Self { direction: Direction::Recording(bytes), fault: None }
    }

    /// Everything that passes is taken off the front of `bytes`.
    #[must_use]
    pub fn playing(bytes: &'a [u8]) -> Self {
        Self { direction: Direction::Playing(bytes), fault: None }
    }

    /// Names and kinds of everything that passes are appended to `words`, also of what may be missing; the values
    /// count for nothing.
    pub fn describing(words: &'a mut String) -> Self {
        Self { direction: Direction::Describing(words), fault: None }
    }

    /// Whether all that has passed could be played.
    ///
    /// # Errors
    /// If the bytes were too few, or did not stand for what passed. That is then not to be used.
    pub fn check(&self) -> Result<()> {
        self.fault.map_or(Ok(()), |fault| Err(Error::Bytes(fault)))
    }

    /// Whether there is nothing more to play.
    #[must_use]
    pub fn is_at_its_end(&self) -> bool {
        match &self.direction {
            Direction::Recording(_) | Direction::Describing(_) => true,
            Direction::Playing(bytes) => bytes.is_empty(),
        }
    }

    /// Says what passes next: for descriptions only.
    #[inline(never)]
    pub fn name(&mut self, name: &str) {
        if let Direction::Describing(words) = &mut self.direction {
            words.push_str(name);
            words.push(' ');
        }
    }

    /// Says how many of it there are.
    #[inline(never)]
    fn count(&mut self, count: usize) {
        if let Direction::Describing(words) = &mut self.direction {
            // Writing to a string cannot fail.
            let _ = write!(words, "{count} ");
        }
    }

    fn describes(&self) -> bool {
        matches!(self.direction, Direction::Describing(_))
    }

    // One copy each: the callers are many, and none is in a hurry.

    #[inline(never)]
    fn word(&mut self, value: &mut u64) {
        match &mut self.direction {
            Direction::Recording(bytes) => bytes.extend(value.to_le_bytes()),
            Direction::Playing(bytes) => match bytes.split_first_chunk() {
                Some((word, rest)) => (*value, *bytes) = (u64::from_le_bytes(*word), rest),
                None => self.fault = Some("they end too early"),
            },
            Direction::Describing(words) => words.push_str("word "),
        }
    }

    #[inline(never)]
    fn numbers(&mut self, values: &mut [f64]) {
        self.name("real");
        for value in values {
            let mut bits = value.to_bits();
            self.word(&mut bits);
            *value = f64::from_bits(bits);
        }
    }

    /// Passes the number of an alternative, counted from 0, out of `count`; returns the one that counts.
    #[inline(never)]
    fn alternative(&mut self, number: usize, count: usize) -> usize {
        let mut word = number as u64;
        self.word(&mut word);
        match usize::try_from(word) {
            Ok(number) if number < count => number,
            _ => {
                self.fault = Some("a number stands for no alternative");
                number
            }
        }
    }

    /// Passes a value out of a closed set.
    pub fn choice(&mut self, choice: &mut dyn Choice) {
        choice.items().iter().for_each(|item| self.name(item.name));
        let number = usize::try_from(choice.number() - 1).unwrap_or_default();
        let number = self.alternative(number, choice.items().len());
        choice.choose(i32::try_from(number + 1).unwrap_or_default());
    }

    /// Passes one of several values.
    pub fn one_of<T: Copy + PartialEq + Debug>(&mut self, value: &mut T, all: &[T]) {
        if self.describes() {
            self.name(&format!("{all:?}"));
        }
        let number = all.iter().position(|other| other == value).unwrap_or_default();
        if let Some(found) = all.get(self.alternative(number, all.len())) {
            *value = *found;
        }
    }

    /// Passes what is there or not, as something else decides that the bytes need not tell.
    pub fn settled<T: Memory + Default>(&mut self, value: &mut Option<T>) {
        self.name("settled");
        if self.describes() {
            value.get_or_insert_default();
        }
        if let Some(value) = value {
            value.pass(self);
        }
    }
}

impl Memory for f64 {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.numbers(std::slice::from_mut(self));
    }
}

impl Memory for u64 {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.word(self);
    }
}

impl Memory for bool {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.name("truth");
        *self = tape.alternative(usize::from(*self), 2) == 1;
    }
}

impl<const R: usize, const C: usize> Memory for SMatrix<f64, R, C> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        [R, C].into_iter().for_each(|count| tape.count(count));
        tape.numbers(self.as_mut_slice());
    }
}

impl<T: Memory, const N: usize> Memory for [T; N] {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.count(N);
        self.iter_mut().for_each(|element| element.pass(tape));
    }
}

impl<T: Memory> Memory for Box<T> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        self.as_mut().pass(tape);
    }
}

impl<T: Memory + Default> Memory for Option<T> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.name("perhaps");
        let mut is_there = self.is_some();
        is_there.pass(tape);
        if is_there || tape.describes() {
            self.get_or_insert_default().pass(tape);
        } else {
            *self = None;
        }
    }
}

/// Passes variables by a tape, after their names.
#[macro_export]
macro_rules! pass {
    ($tape:ident: $($variable:ident),+ $(,)?) => {
        $tape.name(concat!($(stringify!($variable), " "),+));
        $($crate::bytes::Memory::pass($variable, $tape);)+
    };
}

/// Says that a structure remembers all of its fields.
#[macro_export]
macro_rules! memory {
    ($type:ident $(<$n:ident>)? { $($field:ident),+ $(,)? }) => {
        impl $(<const $n: usize>)? $crate::bytes::Memory for $type $(<$n>)? {
            fn pass(&mut self, tape: &mut $crate::bytes::Tape<'_>) {
                // Without "..": none can be forgotten.
                let Self { $($field),+ } = self;
                tape.name(concat!(stringify!($type), $(" ", stringify!($field)),+));
                $($crate::bytes::Memory::pass($field, tape);)+
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Sample<const N: usize> {
        number: f64,
        count: u64,
        truth: bool,
        matrix: SMatrix<f64, N, 2>,
        list: [f64; 3],
        there: Option<f64>,
        missing: Option<f64>,
    }

    memory!(Sample<N> { number, count, truth, matrix, list, there, missing });

    fn sample() -> Sample<2> {
        Sample {
            number: -0.0,
            count: u64::MAX,
            truth: true,
            matrix: SMatrix::from_column_slice(&[1.0, f64::MIN_POSITIVE / 2.0, f64::NEG_INFINITY, 0.1]),
            list: [f64::MAX, 1e-300, 3.0],
            there: Some(5.0),
            missing: None,
        }
    }

    fn recorded(mut value: impl Memory) -> Vec<u8> {
        let mut bytes = Vec::new();
        value.pass(&mut Tape::recording(&mut bytes));
        bytes
    }

    #[test]
    fn every_bit_comes_back() {
        let bytes = recorded(sample());
        let mut back = Sample::<2> {
            number: 0.0,
            count: 0,
            truth: false,
            matrix: SMatrix::zeros(),
            list: [0.0; 3],
            there: None,
            missing: Some(1.0),
        };
        let mut tape = Tape::playing(&bytes);
        back.pass(&mut tape);
        assert_eq!(tape.check(), Ok(()));
        assert!(tape.is_at_its_end());
        assert_eq!(back, sample());
        assert!(back.number.is_sign_negative());

        let mut nan = f64::from_bits(0x7ff8_dead_beef_0001);
        let bytes = recorded(nan);
        nan.pass(&mut Tape::playing(&bytes));
        assert_eq!(nan.to_bits(), 0x7ff8_dead_beef_0001);
    }

    fn described(mut value: impl Memory) -> String {
        let mut words = String::new();
        value.pass(&mut Tape::describing(&mut words));
        words
    }

    /// A description depends on the type and never on the value.
    #[test]
    fn a_description_is_that_of_the_type() {
        let words = described(sample());
        let other = Sample { number: f64::NAN, truth: false, there: None, missing: Some(7.0), ..sample() };
        assert_eq!(described(other), words);
        let names = ["Sample", "number", "count", "truth", "matrix", "list", "there", "missing"];
        let mut rest = words.as_str();
        for name in names {
            rest = rest.split_once(&format!("{name} ")).unwrap_or_else(|| panic!("no {name} in {words}")).1;
        }
    }

    /// Whatever changes the meaning of the bytes changes the description, also where their number stays the same.
    #[test]
    fn every_change_of_a_layout_changes_its_description() {
        macro_rules! variant {
            ($($field:ident: $type:ty),+) => {{
                #[derive(Default)]
                struct Sample { $($field: $type),+ }
                memory!(Sample { $($field),+ });
                described(Sample::default())
            }};
        }
        let variants = [
            variant!(a: f64, b: f64),
            variant!(b: f64, a: f64),
            variant!(a: f64, c: f64),
            variant!(a: f64, b: u64),
            variant!(a: f64, b: bool),
            variant!(a: f64),
            variant!(a: f64, b: f64, c: f64),
            variant!(a: [f64; 2]),
            variant!(a: [f64; 3]),
            variant!(a: SMatrix<f64, 2, 1>),
            variant!(a: SMatrix<f64, 1, 2>),
            variant!(a: Option<f64>),
            variant!(a: Option<Option<f64>>),
            variant!(a: Option<bool>),
        ];
        for (i, one) in variants.iter().enumerate() {
            assert!(variants[..i].iter().all(|other| other != one), "{one}");
        }

        let words = |all: &[&str]| {
            let mut words = String::new();
            Tape::describing(&mut words).one_of(&mut { all[0] }, all);
            words
        };
        assert_ne!(words(&["up", "down"]), words(&["down", "up"]));
        assert_ne!(words(&["up", "down"]), words(&["up", "over"]));
    }

    #[test]
    fn bytes_that_are_missing_are_noticed() {
        let bytes = recorded(sample());
        for length in 0..bytes.len() {
            let mut back = Sample { missing: Some(1.0), ..sample() };
            let mut tape = Tape::playing(&bytes[..length]);
            back.pass(&mut tape);
            assert!(tape.check().is_err(), "{length}");
        }
    }

    #[test]
    fn what_stands_for_nothing_is_noticed() {
        let bytes = recorded(2_u64);
        let mut tape = Tape::playing(&bytes);
        let mut truth = true;
        truth.pass(&mut tape);
        assert!(tape.check().is_err());
        assert!(truth, "unchanged");
    }
}
