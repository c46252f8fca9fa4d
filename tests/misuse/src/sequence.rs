//! One random sequence of calls, legal and illegal, on one instance.

use crate::functions::Component;
use crate::hostile::one_in;
use crate::player::{Player, Stage, Tally};
use crate::unit::Unit;

/// What sequences came to.
#[derive(Debug, Clone, Copy, Default)]
pub struct Outcome {
    /// Fingerprint of all answers.
    pub digest: u64,
    pub tally: Tally,
}

impl Outcome {
    /// Of both, in any order.
    pub fn and(self, other: Self) -> Self {
        Self { digest: self.digest ^ other.digest, tally: self.tally.and(other.tally) }
    }
}

/// Plays the sequence of this seed.
///
/// # Errors
/// What a unit did that it must not do.
pub fn play(unit: &Unit, stranger: Component, expected: &[u64], seed: u64) -> Result<Outcome, String> {
    let mut player = Player::new(unit, stranger, seed);
    player.instantiate()?;
    for _ in 0..player.rng.u32(1..40) {
        if player.rng.bool() { player.next_as_usual() } else { player.anything() }?;
    }
    player.end(expected)?;
    Ok(Outcome { digest: player.digest.value(), tally: player.tally })
}

impl Player<'_> {
    /// The call that a well-behaved host makes next.
    fn next_as_usual(&mut self) -> Result<(), String> {
        match self.stage {
            Stage::Instantiated if self.rng.bool() => self.set_real(true),
            Stage::Instantiated => self.enter_initialization(),
            Stage::Initialization if self.rng.bool() => self.set_real(true),
            Stage::Initialization => self.exit_initialization(),
            Stage::Running if one_in(&mut self.rng, 3) => self.set_real(true),
            Stage::Running => {
                let size = [1e-3, 1e-3, 1e-2, 2e-2][self.rng.usize(0..4)];
                self.do_step(self.time, size)
            }
            Stage::Terminated | Stage::Failed => self.reset(),
        }
    }

    /// Any call with any arguments.
    fn anything(&mut self) -> Result<(), String> {
        match self.rng.u32(0..34) {
            0 => self.set_debug_logging(),
            1 => self.setup_experiment(),
            2 => self.enter_initialization(),
            3 => self.exit_initialization(),
            4 => self.terminate(),
            5 => self.reset(),
            6 | 7 => self.get_real(),
            8 => self.get_integer(),
            9 => self.get_boolean(),
            10 | 11 => self.set_real(false),
            12 => self.set_integer(),
            13 => self.set_boolean(),
            14 => self.get_string(),
            15 => self.set_string(),
            16 | 17 => {
                let (from, size) = self.odd_step();
                self.do_step(from, size)
            }
            18 => self.cancel_step(),
            19 => self.statuses(),
            20 | 21 => self.set_input_derivatives(),
            22 => self.get_output_derivatives(),
            23 => self.get_directional_derivative(),
            24 | 25 => self.get_state(),
            26 | 27 => self.set_state(),
            28 => self.free_state(),
            29 => self.state_size(),
            30 | 31 => self.serialize_state(),
            _ => self.deserialize_state(),
        }
    }
}
