//! Values as bytes and back, exactly: every bit of a number survives, whatever it stands for.
//!
//! A [`Tape`] is recorded or played; what has a [`Memory`] passes it by in both cases, number by number, so
//! that the two can never differ. What is recorded is not readable without knowing of what; who keeps bytes
//! adds what tells them from others.

use nalgebra::SMatrix;

use crate::error::{Error, Result};
use crate::options::Choice;

/// Something that changes in the course of a run.
pub trait Memory {
    /// Records all that it remembers on a tape, or takes all of it from there.
    fn pass(&mut self, tape: &mut Tape<'_>);
}

/// Bytes that are being written, or read from the front.
pub struct Tape<'a> {
    direction: Direction<'a>,
    fault: Option<&'static str>,
}

enum Direction<'a> {
    Recording(&'a mut Vec<u8>),
    Playing(&'a [u8]),
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
            Direction::Recording(_) => true,
            Direction::Playing(bytes) => bytes.is_empty(),
        }
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
        }
    }

    #[inline(never)]
    fn numbers(&mut self, values: &mut [f64]) {
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
        let number = usize::try_from(choice.number() - 1).unwrap_or_default();
        let number = self.alternative(number, choice.items().len());
        choice.choose(i32::try_from(number + 1).unwrap_or_default());
    }

    /// Passes one of several values.
    pub fn one_of<T: Copy + PartialEq>(&mut self, value: &mut T, all: &[T]) {
        let number = all.iter().position(|other| other == value).unwrap_or_default();
        if let Some(found) = all.get(self.alternative(number, all.len())) {
            *value = *found;
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
        *self = tape.alternative(usize::from(*self), 2) == 1;
    }
}

impl<const R: usize, const C: usize> Memory for SMatrix<f64, R, C> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        tape.numbers(self.as_mut_slice());
    }
}

impl<T: Memory, const N: usize> Memory for [T; N] {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        self.iter_mut().for_each(|element| element.pass(tape));
    }
}

impl<T: Memory + Default> Memory for Option<T> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        let mut is_there = self.is_some();
        is_there.pass(tape);
        if is_there {
            self.get_or_insert_default().pass(tape);
        } else {
            *self = None;
        }
    }
}

/// Says that a structure remembers all of its fields.
#[macro_export]
macro_rules! memory {
    ($type:ident $(<$n:ident>)? { $($field:ident),+ $(,)? }) => {
        impl $(<const $n: usize>)? $crate::bytes::Memory for $type $(<$n>)? {
            fn pass(&mut self, tape: &mut $crate::bytes::Tape<'_>) {
                // Without "..": none can be forgotten.
                let Self { $($field),+ } = self;
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
