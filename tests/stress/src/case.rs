//! One random coupling: all that is chosen of it, before anything runs.

use std::fmt;

use uam::autopilot::AutopilotMode;
use uam::mechanics::planar::{Rotation, Vec2};
use uam::parameters::{Actuation, Balance, Discretization, Resolution};
use uam::scenarios::{Extent, Scenario};
use uam::variables::options::Choice;
use uam::variables::{Kind, Variability};
use uam::{Parameters, Structure};

use crate::draw::clock::Steps;
use crate::draw::limits::Limits;
use crate::draw::path::Path;
use crate::draw::start::Start;
use crate::draw::{self, Draw};

/// Each run takes at least so long \[s\], and so many steps.
const LEAST: (f64, usize) = (2.0, 1000);

/// How long the reference rests at the end of the runs in which it does \[s\], with some reserve.
const REST: f64 = 4.2;

/// Parameters that change while the units run.
pub struct Change {
    /// Before which step.
    pub step: usize,
    /// Their names and new values.
    pub values: Vec<(String, f64)>,
    /// Whether laws change that the plan before relied upon.
    pub of_laws: bool,
    /// All parameters from then on.
    pub parameters: Parameters,
}

/// A way there and back.
#[derive(Debug, Clone, Copy)]
pub struct Back {
    /// Before which step the states are saved.
    pub step: usize,
    /// After how many steps they are restored.
    pub count: usize,
    /// Whether they are bytes in between.
    pub through_bytes: bool,
}

/// A random coupling.
pub struct Case {
    /// What it follows from.
    pub seed: u64,
    /// Likewise.
    pub number: u64,
    /// Links and what balances them.
    pub structure: Structure,
    /// All parameters that are known here.
    pub parameters: Parameters,
    /// Others, by their names, where a unit has them.
    pub others: Vec<(&'static str, f64)>,
    /// What is special about the start.
    pub start: Start,
    /// How tight the limits are.
    pub limits: Limits,
    /// What is followed.
    pub path: Path,
    /// When the units communicate.
    pub steps: Steps,
    /// Parameters that change on the way.
    pub change: Option<Change>,
    /// How the units go back to a state.
    pub back: Option<Back>,
    /// Whether all of it is run again.
    pub again: bool,
    /// Whether it is compared with a run on an even clock, if it is not on one.
    pub compared: bool,
}

impl Case {
    /// The coupling of this number.
    pub fn draw(seed: u64, number: u64) -> Self {
        let draw = &mut Draw::new((seed << 40) ^ number);
        let links = draw.weighed(&[(1, 1), (2, 2), (5, 3), (2, 4), (1, 5), (1, 6)]);
        let balance = draw.weighed(&[(4, Balance::None), (1, Balance::Counterweight), (1, Balance::Element)]);
        let structure = Structure { links, balance };
        let mut p = draw::vehicle::draw(draw, structure);
        let start = draw::start::draw(draw, structure, &mut p);
        draw::method::draw(draw, structure, &mut p);
        let others = draw::method::damping(draw);
        let limits = draw::limits::draw(draw, structure, &mut p);
        let rest = if draw.percent(8) { REST } else { 0.0 };
        let duration = if rest > 0.0 { rest + draw.between(0.6, 2.5) } else { LEAST.0 };
        let steps = draw::clock::draw(draw, duration, LEAST.1);
        p.ik.sample_time = steps.sample_time;
        let duration = steps.steps.iter().map(|(_, size)| size).sum::<f64>();
        let path = draw::path::draw(draw, structure, &mut p, duration, rest);
        payload(draw, structure, &mut p, duration);
        let count = steps.steps.len();
        let back = draw.percent(25).then(|| {
            let (step, there) = (draw.below(count - 60), 1 + draw.below(60));
            Back { step, count: there, through_bytes: draw.percent(50) }
        });
        let (again, compared) = (draw.percent(5), draw.percent(15));
        let change = if draw.percent(15) { change(draw, structure, &p, count) } else { None };
        Self {
            seed,
            number,
            structure,
            parameters: p,
            others,
            start,
            limits,
            path,
            steps,
            change,
            back,
            again,
            compared,
        }
    }

    /// The same case with what the controller promises nothing about: every fifth has a joint driven by a torque that
    /// nobody gives, every seventh an autopilot outside that is not there.
    pub fn varied(mut self) -> Self {
        if self.number.is_multiple_of(5) {
            self.others.push(("joint[1].actuation", f64::from(Actuation::Torque.number())));
        }
        if self.number.is_multiple_of(7) {
            self.others.push(("autopilot.mode", f64::from(AutopilotMode::External.number())));
        }
        self
    }

    /// Where the end effector is at the start \[m\].
    pub fn origin(&self) -> Vec2 {
        end_effector(self.structure, &self.parameters)
    }

    /// Largest acceleration of the wanted motion, on a grid \[m/s2\].
    pub fn path_acceleration(&self) -> f64 {
        let duration: f64 = self.steps.steps.iter().map(|(_, size)| size).sum();
        (0..2000)
            .map(|n| self.parameters.reference.at(duration * f64::from(n) / 2000.0).acceleration.norm())
            .fold(0.0, f64::max)
    }

    /// Length of the stretched arm \[m\].
    pub fn reach(&self) -> f64 {
        self.parameters.links[..self.structure.links].iter().map(|link| link.length).sum()
    }

    /// The same case once more, to be changed.
    pub fn again(&self) -> Self {
        Self::draw(self.seed, self.number)
    }

    /// Names and values of all parameters.
    pub fn values(&self) -> Vec<(String, f64)> {
        let table = Parameters::table(self.structure);
        let values = table.variables().iter().map(|variable| {
            let value = match variable.kind {
                Kind::Real { at, .. } => *at.get(&self.parameters),
                Kind::Boolean { at } => f64::from(u8::from(*at.get(&self.parameters))),
                Kind::Enumeration { at } => f64::from(at.get(&self.parameters).number()),
            };
            (variable.name.clone(), value)
        });
        values.chain(self.others.iter().map(|(name, value)| ((*name).to_owned(), *value))).collect()
    }

    /// The parameters after so many steps.
    pub fn parameters_after(&self, steps: usize) -> &Parameters {
        match &self.change {
            Some(change) if steps > change.step => &change.parameters,
            _ => &self.parameters,
        }
    }

    /// Whether plans are made for what is at the end of the interval.
    pub fn is_exact(&self) -> bool {
        self.parameters.ik.discretization == Discretization::Exact
    }

    /// Whether limits of acceleration and position count.
    pub fn has_stops(&self) -> bool {
        self.parameters.ik.resolution == Resolution::LeastSquares
    }

    /// Whether the method asks for no moment on the UAV.
    pub fn cancels_moment(&self) -> bool {
        use Resolution::{AccelerationLevel, ExtendedJacobian, LeastSquares};
        matches!(self.parameters.ik.resolution, ExtendedJacobian | LeastSquares | AccelerationLevel)
    }

    /// The whole as a file that other programs read, behind a comment with what such files do not hold.
    pub fn describe(&self) -> String {
        let Steps { step, steps, .. } = &self.steps;
        let scenario = Scenario {
            id: format!("stress-{}", self.number),
            title: self.to_string(),
            structure: self.structure,
            parameters: self.parameters.clone(),
            duration: steps.iter().map(|(_, size)| size).sum(),
            step: *step,
        };
        let mut text = format!("# {self}\n# start time: {:?} s\n", self.steps.start());
        let first: Vec<_> = steps.iter().take(8).map(|(_, size)| size).collect();
        text += &format!("# first steps: {first:?} s\n");
        for (name, value) in &self.others {
            text += &format!("# {name} = {value:?}, if there is such a parameter\n");
        }
        if let Some(external) = &self.path.external {
            text += &format!("# reference from outside, given at the beginning of each step: {external:?}\n");
        }
        if let Some(Change { step, values, .. }) = &self.change {
            text += &format!("# before step {step}: {values:?}\n");
        }
        if let Some(Back { step, count, .. }) = self.back {
            text += &format!("# before step {step} the states are saved; after {count} steps all goes back to there\n");
        }
        text + &scenario.write(Extent::Changes)
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ik = &self.parameters.ik;
        let (resolution, hold) = (ik.resolution.name(), ik.hold.name());
        let (discretization, base) = (ik.discretization.name(), ik.base_model.name());
        write!(f, "{}, {resolution}, {discretization}, {hold}, {base}, ", self.structure)?;
        let kind = self.parameters.reference.kind.name();
        let jumps =
            if self.path.external.as_ref().is_some_and(draw::path::External::jumps) { " with jumps" } else { "" };
        let rests = if self.path.at_rest.is_finite() { ", then rest" } else { "" };
        write!(f, "{kind}{jumps}{rests}, {:?} start, {:?} limits, ", self.start, self.limits)?;
        let Steps { clock, step, steps, sample_time, .. } = &self.steps;
        write!(f, "{} steps {} of {} ms, sample time {} ms", steps.len(), clock.name(), 1e3 * step, 1e3 * sample_time)
    }
}

/// Where the end effector is at the start \[m\].
fn end_effector(structure: Structure, p: &Parameters) -> Vec2 {
    let mut angle = 0.0;
    let mut place = Vec2::new(p.mount.x, p.mount.y);
    for (link, joint) in p.links.iter().zip(&p.joints).take(structure.links) {
        angle += joint.start;
        place += Rotation::by(angle).down() * link.length;
    }
    place
}

/// Mostly none; otherwise held from the start or taken over on the way, from a support or out of nothing.
fn payload(draw: &mut Draw, structure: Structure, p: &mut Parameters, duration: f64) {
    let last = structure.links - 1;
    p.payload.com = p.links[last].length;
    p.payload.grasp_time = match draw.below(8) {
        0 => -1.0,
        1 | 2 => draw.between(0.0, duration),
        _ => 2.0 * duration,
    };
    p.support.stiffness = if draw.percent(50) { 0.0 } else { draw.scale(200.0, 5000.0) };
    if p.support.stiffness > 0.0 {
        let there = end_effector(structure, p) + p.reference.at(p.payload.grasp_time).displacement;
        p.support.height = there.y + p.payload.mass * p.gravity / p.support.stiffness;
    }
}

/// Other values of up to three tunable parameters. Limits are only loosened: tighter ones cannot hold at once.
fn change(draw: &mut Draw, structure: Structure, p: &Parameters, steps: usize) -> Option<Change> {
    let table = Parameters::table(structure);
    let tunable: Vec<_> =
        table.variables().iter().filter(|variable| variable.variability == Variability::Tunable).collect();
    let mut copy = p.clone();
    let mut values = Vec::new();
    for _ in 0..1 + draw.below(3) {
        let variable = tunable[draw.below(tunable.len())];
        let Kind::Real { at, .. } = variable.kind else { continue };
        let factor = if variable.name.ends_with("limit") { draw.between(1.0, 2.0) } else { draw.between(0.8, 1.25) };
        let value = at.get_mut(&mut copy);
        *value *= factor;
        values.push((variable.name.clone(), *value));
    }
    let of_laws = values.iter().any(|(name, _)| name.starts_with("autopilot"));
    (!values.is_empty()).then(|| Change { step: 1 + draw.below(steps - 1), values, of_laws, parameters: copy })
}
