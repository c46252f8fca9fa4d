//! With least_squares a rate changes by no more than its acceleration limit times the interval just past, and no
//! coordinate leaves its stops as long as no step was longer than the sample time and all steps before.

use super::{Check, Now};
use crate::case::Case;
use uam::Parameters;
use uam::parameters::Balance;

/// What rounding may add, as a share.
const ROUNDING: f64 = 1e-12;

/// The first plan is made before any step is known, for this long \[s\].
const FIRST: f64 = 1e-3;

pub struct Stops<'a> {
    case: &'a Case,
    before: Vec<f64>,
    /// How long the rates have been the same \[s\].
    held: f64,
    /// Where each coordinate has been inside, or is on its way back.
    room: Vec<[f64; 2]>,
    /// The longest step so far \[s\].
    longest: f64,
    /// Whether a step was longer than could be known.
    surprised: bool,
}

/// Rate \[rad/s, m/s\], acceleration \[rad/s2, m/s2\], and stops \[rad, m\] of a coordinate.
struct Limit {
    rate: f64,
    acceleration: f64,
    stops: [f64; 2],
}

impl<'a> Stops<'a> {
    pub fn of(case: &'a Case) -> Self {
        Self {
            case,
            before: Vec::new(),
            held: case.steps.sample_time.max(FIRST),
            room: Vec::new(),
            longest: case.steps.sample_time,
            surprised: false,
        }
    }

    fn change(&mut self, now: &Now<'_>, limits: &[Limit]) -> Result<(), String> {
        self.held = match self.case.steps.per_plan {
            _ if now.count == 0 => self.held,
            Some(1) => now.size,
            Some(steps) => now.size * steps as f64,
            None => self.held + now.size,
        };
        let rates = now.seen.rates();
        for (i, limit) in limits.iter().enumerate() {
            let change = (rates[i] - self.before[i]).abs();
            let most = limit.acceleration * self.held;
            if change > most + ROUNDING * (most + limit.rate) {
                return Err(format!("rate {} changes by {change:?}, {most:?} are allowed", i + 1));
            }
        }
        if rates != self.before {
            self.held = 0.0;
            self.before.copy_from_slice(rates);
        }
        Ok(())
    }

    fn stay(&mut self, now: &Now<'_>, limits: &[Limit]) -> Result<(), String> {
        for (i, (limit, room)) in limits.iter().zip(&mut self.room).enumerate() {
            let position = now.seen.positions()[i];
            let slack = ROUNDING * (1.0 + room[0].abs().max(room[1].abs()));
            if position < room[0] - slack || position > room[1] + slack {
                let past = (room[0] - position).max(position - room[1]);
                return Err(format!("coordinate {} is {past:e} past {room:?}", i + 1));
            }
            // Who comes back from outside does not go there again.
            room[0] = room[0].max(position.min(limit.stops[0]));
            room[1] = room[1].min(position.max(limit.stops[1]));
        }
        Ok(())
    }
}

impl Check for Stops<'_> {
    fn name(&self) -> &'static str {
        "stops"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let limits = limits(self.case, self.case.parameters_after(now.count));
        if now.count == 0 {
            self.before = vec![0.0; now.seen.rates().len()];
            let positions = now.seen.positions();
            let room =
                |(limit, position): (&Limit, &f64)| [limit.stops[0].min(*position), limit.stops[1].max(*position)];
            self.room = limits.iter().zip(positions).map(room).collect();
        }
        self.change(now, &limits)?;
        self.surprised |= now.size > self.longest;
        self.longest = self.longest.max(now.size);
        if self.surprised { Ok(()) } else { self.stay(now, &limits) }
    }
}

fn limits(case: &Case, p: &Parameters) -> Vec<Limit> {
    let joints = p.joints[..case.structure.links].iter().map(|joint| Limit {
        rate: joint.rate_limit,
        acceleration: joint.acceleration_limit,
        stops: [joint.lower, joint.upper],
    });
    let weight = &p.counterweight;
    let weight = (case.structure.balance == Balance::Counterweight).then(|| Limit {
        rate: weight.rate_limit,
        acceleration: weight.acceleration_limit,
        stops: [-weight.stroke, weight.stroke],
    });
    joints.chain(weight).collect()
}
