//! Clocks of hosts: even ones, and those that the arithmetic of hosts, error control or real time make of them.

use super::Draw;

/// How the lengths of communication steps come about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Clock {
    /// Number times step.
    Even,
    /// Half of the steps 1 ns shorter.
    Shorter,
    /// Half of the steps 1 ns longer.
    Longer,
    /// Times are sums in single precision.
    SingleSum,
    /// Times are products in single precision; the host gives the step itself as its length.
    Single,
    /// Number times step, from a start time so large that the times are rounded.
    Late,
    /// Times rounded to whole microseconds.
    Microseconds,
    /// Times rounded to whole nanoseconds.
    Nanoseconds,
    /// One step and twice that, in turn.
    Alternating,
    /// Half to one and a half of a step, at random.
    Jittered,
    /// 0.1 to 20 ms at random.
    Random,
}

impl Clock {
    /// How it is called in a report.
    pub fn name(self) -> &'static str {
        match self {
            Self::Even => "even",
            Self::Shorter => "1 ns shorter",
            Self::Longer => "1 ns longer",
            Self::SingleSum => "float32 sums",
            Self::Single => "float32 times",
            Self::Late => "late start",
            Self::Microseconds => "in us",
            Self::Nanoseconds => "in ns",
            Self::Alternating => "h and 2 h",
            Self::Jittered => "h +- 50 %",
            Self::Random => "0.1 to 20 ms",
        }
    }
}

/// The communication steps of a run.
pub struct Steps {
    /// How they come about.
    pub clock: Clock,
    /// The step that is meant \[s\].
    pub step: f64,
    /// Beginning, for the host, and length of each \[s\].
    pub steps: Vec<(f64, f64)>,
    /// The controller's sample time \[s\].
    pub sample_time: f64,
    /// How many steps there are from plan to plan, if that is known; the first plan is made at the start.
    pub per_plan: Option<usize>,
}

impl Steps {
    /// Even ones that take as long, with a plan for each, as often as here.
    pub fn even(&self) -> Self {
        let step = if self.per_plan == Some(1) { self.step } else { self.sample_time };
        let count = (self.steps.iter().map(|(_, size)| size).sum::<f64>() / step).ceil() as usize;
        let steps = (0..count).map(|n| (n as f64 * step, step)).collect();
        Self { clock: Clock::Even, step, steps, sample_time: step, per_plan: Some(1) }
    }

    /// When the host begins \[s\].
    pub fn start(&self) -> f64 {
        self.steps[0].0
    }
}

/// Steps for at least `duration` \[s\], and at least so many.
pub fn draw(draw: &mut Draw, duration: f64, least: usize) -> Steps {
    let clock = draw.weighed(&[
        (30, Clock::Even),
        (6, Clock::Shorter),
        (4, Clock::Longer),
        (4, Clock::SingleSum),
        (4, Clock::Single),
        (6, Clock::Late),
        (3, Clock::Microseconds),
        (3, Clock::Nanoseconds),
        (7, Clock::Alternating),
        (7, Clock::Jittered),
        (5, Clock::Random),
    ]);
    // Long steps are seldom: each takes as long as many short ones, and a run has at least a thousand.
    let step = match clock {
        Clock::Random => 2e-3,
        Clock::Microseconds | Clock::Nanoseconds => {
            draw.weighed(&[(4, 1.0 / 600.0), (4, 1.0 / 1024.0), (2, 1.0 / 300.0)])
        }
        Clock::Alternating | Clock::Jittered => draw.weighed(&[(8, 1e-3), (10, 2e-3), (2, 5e-3), (1, 1e-2)]),
        _ => draw.weighed(&[(1, 5e-4), (12, 1e-3), (26, 2e-3), (4, 5e-3), (3, 1e-2), (1, 2e-2)]),
    };
    let start = match clock {
        Clock::Late => draw.one_of(&[1e3, 1e6, 1.7e9, 2e9]),
        Clock::Even if draw.percent(20) => draw.one_of(&[-3.0, 0.5]),
        _ => 0.0,
    };
    let steps = lengths(draw, clock, step, start, duration, least);
    let shortest = steps.iter().map(|(_, size)| *size).fold(f64::INFINITY, f64::min);
    let longest = steps.iter().map(|(_, size)| *size).fold(0.0, f64::max);
    // Several steps to a plan; one; or every point, as the steps are longer than the sample time.
    let (sample_time, per_plan) = match (clock, draw.below(10)) {
        (Clock::Even, 0) => {
            let steps = draw.one_of(&[2, 3, 5]);
            (step * steps as f64, Some(steps))
        }
        (Clock::Even, 1 | 2) => (1e-3_f64.min(step), Some(1)),
        (Clock::Even, _) => (step, Some(1)),
        (_, 0..5) => (longest, (2.0 * shortest > 1.01 * longest).then_some(1)),
        _ => (shortest.min(1e-3), Some(1)),
    };
    Steps { clock, step, steps, sample_time, per_plan }
}

fn lengths(draw: &mut Draw, clock: Clock, step: f64, start: f64, duration: f64, least: usize) -> Vec<(f64, f64)> {
    let mut steps = Vec::with_capacity(least.max((duration / step) as usize + 2));
    let mut now = start;
    while steps.len() < least || now < start + duration {
        let n = steps.len() as f64;
        let next = (n + 1.0) * step;
        let (from, size) = match clock {
            Clock::Even => (start + n * step, step),
            Clock::Shorter => (now, if draw.percent(50) { step - 1e-9 } else { step }),
            Clock::Longer => (now, if draw.percent(50) { step + 1e-9 } else { step }),
            Clock::SingleSum => (now, f64::from(now as f32 + step as f32) - now),
            Clock::Single => (f64::from((n * step) as f32), step),
            Clock::Late => (now, (start + next) - now),
            Clock::Microseconds => (now, (next * 1e6).round() / 1e6 - now),
            Clock::Nanoseconds => (now, (next * 1e9).round() / 1e9 - now),
            Clock::Alternating => (now, if steps.len() % 2 == 0 { step } else { 2.0 * step }),
            Clock::Jittered => (now, step * draw.between(0.5, 1.5)),
            Clock::Random => (now, draw.scale(1e-4, 2e-2)),
        };
        steps.push((from, size));
        now = if clock == Clock::Even || clock == Clock::Single { start + next } else { from + size };
    }
    steps
}
