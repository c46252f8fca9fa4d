//! A small unit for the tests of the C interface: an integrator that can fail in every way.

use std::fmt;

use crate::bytes::{Memory, Tape};
use crate::fmi::{CommunicationStep, Model};
use crate::memory;
use crate::options;
use crate::pass;
use crate::variables::Table;
use crate::variables::declare::declare;

options! {
    #[doc = " Sense of the integration."]
    pub enum Direction {
        #[doc = " A positive rate increases the position."]
        Up = "up",
        #[doc = " A positive rate decreases the position."]
        Down = "down",
    }
}

options! {
    #[doc = " What the next step does wrong."]
    pub enum Fault {
        #[doc = " Nothing."]
        None = "none",
        #[doc = " It returns an error."]
        Error = "error",
        #[doc = " It panics."]
        Panic = "panic",
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    Small,
    Large,
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Small => "small toy",
            Self::Large => "large toy",
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    pub time: f64,
    pub gain: f64,
    pub limit: f64,
    pub leak: f64,
    pub direction: Direction,
    pub rate: f64,
    pub hold: bool,
    pub fault: Fault,
    pub position: f64,
    pub speed: f64,
    pub held: bool,
    /// Of the position; on demand.
    pub square: f64,
    pub extra: f64,
    /// Derivative of the rate in the next step.
    pub push: f64,
}

/// Value references.
pub mod vr {
    pub const TIME: u32 = 0;
    pub const GAIN: u32 = 1;
    pub const LIMIT: u32 = 2;
    pub const LEAK: u32 = 3;
    pub const DIRECTION: u32 = 4;
    pub const RATE: u32 = 5;
    pub const HOLD: u32 = 6;
    pub const FAULT: u32 = 7;
    pub const POSITION: u32 = 8;
    pub const SPEED: u32 = 9;
    pub const HELD: u32 = 10;
    pub const SQUARE: u32 = 11;
    pub const COUNT: u32 = 12;
}

#[derive(Debug, Clone)]
pub struct Toy {
    position: f64,
}

memory!(Toy { position });

impl Model for Toy {
    const IDENTIFIER: &'static str = "toy";
    const DESCRIPTION: &'static str = "Integrator";

    type Structure = Size;
    type Data = Data;
    type Error = String;

    fn structures() -> impl Iterator<Item = Size> {
        [Size::Small, Size::Large].into_iter()
    }

    fn table(size: Size) -> Table<Data> {
        let mut table = Table::<Data>::default();
        declare! { table.independent(), Data;
            "time" [SECOND] "Time" |d, _| d.time;
        }
        declare! { table.fixed(), Data;
            "gain" [ONE > 0] "Gain, and position at the start" |d, _| d.gain;
            "limit" [ONE] "Largest gain" |d, _| d.limit;
        }
        declare! { table.tunable(), Data;
            "leak" [ONE >= 0] "Decay" |d, _| d.leak;
        }
        declare! { table.fixed(), Data;
            "direction" [choice] "Sense" |d, _| d.direction;
        }
        declare! { table.input(), Data;
            "rate" [METRE_PER_SECOND] "Rate" |d, _| d.rate, given_derivative(|d, _, slope| d.push = slope);
        }
        declare! { table.discrete_input(), Data;
            "hold" [bool] "Stand still" |d, _| d.hold;
            "fault" [choice] "Fail" |d, _| d.fault;
        }
        declare! { table.output(), Data;
            "position" [METRE] "Position" |d, _| d.position;
            "speed" [METRE_PER_SECOND] "Speed in the last step"
                |d, _| d.speed, derivative_of("position"), derivative(|_, _| 0.0);
        }
        declare! { table.discrete_output(), Data;
            "held" [bool] "Whether it stands still" |d, _| d.held;
        }
        declare! { table.output(), Data;
            "square" [ONE] "Square of the position" |d, _| d.square, on_demand();
        }
        if size == Size::Large {
            declare! { table.tunable(), Data;
                "extra" [ONE] "Only for large toys" |d, _| d.extra;
            }
        }
        table
    }

    fn start(_: Size) -> Data {
        Data {
            time: 0.0,
            gain: 1.0,
            limit: 100.0,
            leak: 0.0,
            direction: Direction::Up,
            rate: 0.0,
            hold: false,
            fault: Fault::None,
            position: 0.0,
            speed: 0.0,
            held: false,
            square: 0.0,
            extra: 0.0,
            push: 0.0,
        }
    }

    fn initialize(_: Size, data: &mut Data, _: f64) -> Result<Self, String> {
        data.position = data.gain;
        data.square = data.gain * data.gain;
        data.held = data.hold;
        if data.gain > data.limit {
            return Err(format!("gain = {} is above limit = {}", data.gain, data.limit));
        }
        Ok(Self { position: data.gain })
    }

    fn step(&mut self, data: &mut Data, step: CommunicationStep) -> Result<(), String> {
        match data.fault {
            Fault::None => {}
            Fault::Error => return Err("told to fail".to_owned()),
            Fault::Panic => panic!("told to panic: 100 % #1"),
        }
        let sign = if data.direction == Direction::Up { 1.0 } else { -1.0 };
        let moving = if data.hold { 0.0 } else { 1.0 };
        data.speed =
            moving * (sign * data.gain * (data.rate + 0.5 * data.push * step.size) - data.leak * self.position);
        self.position += data.speed * step.size;
        data.position = self.position;
        data.held = data.hold;
        data.push = 0.0;
        Ok(())
    }

    fn observe(&self, data: &mut Data) -> Result<(), String> {
        let square = self.position * self.position;
        if !square.is_finite() {
            return Err(format!("the square of {} is too large", self.position));
        }
        data.square = square;
        Ok(())
    }

    fn restore(_: Size, _: &Data, tape: &mut Tape<'_>) -> Result<Self, String> {
        let mut toy = Self { position: 0.0 };
        toy.pass(tape);
        tape.check().map_err(|error| error.to_string())?;
        Ok(toy)
    }

    fn pass_unnamed(data: &mut Data, tape: &mut Tape<'_>) {
        let push = &mut data.push;
        pass!(tape: push);
    }
}
