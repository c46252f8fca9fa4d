//! Thesis chapter 2: following a path although the base moves, with ever more of its motion predicted.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::{Scenario, default_parameters};
use crate::autopilot::{AutopilotMode, Gains};
use crate::parameters::{BaseModel, Parameters, Resolution, Structure};
use crate::reference::{Leg, Profile, ReferenceKind};

/// Altitude and roll gains of a hover control.
type HoverGains = [Gains; 2];

/// Table 1.2.
const RIGID: HoverGains = [Gains { kp: 1000.0, ki: 500.0, kd: 500.0 }, Gains { kp: 600.0, ki: 500.0, kd: 30.0 }];
/// Table 2.2.
const SOFT: HoverGains = [Gains { kp: 37.0, ki: 8.0, kd: 18.0 }, Gains { kp: 40.0, ki: 35.0, kd: 9.0 }];

/// Folded, and out of balance: the arm's centre of mass is to the left of the UAV's.
const FOLDED: [f64; 2] = [-1.4, 2.8];
/// The arm's centre of mass is below the UAV's.
const BALANCED: [f64; 2] = [-0.32, 2.228];

/// Grasp time of a run without payload \[s\].
const NEVER: f64 = 1e9;

/// There and back on a straight line, with constant acceleration in the ramps.
#[derive(Clone, Copy)]
struct ThereAndBack {
    /// To the right and upwards \[m\].
    way: [f64; 2],
    /// Time for each way \[s\].
    each: f64,
    /// Time for each ramp \[s\].
    ramp: f64,
}

/// The path of 2.1.
const LONG: ThereAndBack = ThereAndBack { way: [0.08, -0.15], each: 5.0, ramp: 0.5 };
/// The path of 2.2 and of the first half of 2.3.
const SLOW: ThereAndBack = ThereAndBack { way: [0.05, -0.12], each: 5.0, ramp: 0.5 };
/// The path of the second half of 2.3, of 2.4 and of 2.5.
const FAST: ThereAndBack = ThereAndBack { way: [0.05, -0.12], each: 1.5, ramp: 0.1 };

/// A payload that hangs at the end effector from some time on, without support.
#[derive(Clone, Copy)]
struct Load {
    /// Mass \[kg\].
    mass: f64,
    /// When it is taken \[s\].
    time: f64,
}

/// A run with two links, mounted at the UAV's centre of mass.
struct TwoLinks {
    id: &'static str,
    title: &'static str,
    start: [f64; 2],
    base_model: BaseModel,
    /// Nothing: ideal control.
    gains: Option<HoverGains>,
    path: ThereAndBack,
    load: Option<Load>,
    duration: f64,
}

const TWO_LINKS: [TwoLinks; 9] = [
    TwoLinks {
        id: "2.1a",
        title: "A base that slides only, predicted and real: followed",
        start: FOLDED,
        base_model: BaseModel::Ideal,
        gains: None,
        path: LONG,
        load: None,
        duration: 10.0,
    },
    TwoLinks {
        id: "2.1b",
        title: "2.1a with rigid PID: the thrust tilts, the UAV drifts left",
        start: FOLDED,
        base_model: BaseModel::Ideal,
        gains: Some(RIGID),
        path: LONG,
        load: None,
        duration: 10.0,
    },
    TwoLinks {
        id: "2.2a",
        title: "The tilting thrust predicted, rigid PID: followed",
        start: BALANCED,
        base_model: BaseModel::HorizontalThrust,
        gains: Some(RIGID),
        path: SLOW,
        load: None,
        duration: 15.0,
    },
    TwoLinks {
        id: "2.2b",
        title: "2.2a with 0.9 kg from 5 s on: the UAV sinks, and the end effector with it",
        start: BALANCED,
        base_model: BaseModel::HorizontalThrust,
        gains: Some(RIGID),
        path: SLOW,
        load: Some(Load { mass: 0.9, time: 5.0 }),
        duration: 15.0,
    },
    TwoLinks {
        id: "2.3a",
        title: "2.2b with the altitude predicted, too: followed within 0.3 mm vertically",
        start: BALANCED,
        base_model: BaseModel::VerticalThrust,
        gains: Some(RIGID),
        path: SLOW,
        load: Some(Load { mass: 0.9, time: 5.0 }),
        duration: 15.0,
    },
    TwoLinks {
        id: "2.3b",
        title: "2.3a three times as fast: more roll, less way of the UAV",
        start: BALANCED,
        base_model: BaseModel::VerticalThrust,
        gains: Some(RIGID),
        path: FAST,
        load: Some(Load { mass: 0.9, time: 1.5 }),
        duration: 5.0,
    },
    TwoLinks {
        id: "2.4a",
        title: "2.3b with soft PID and 0.3 kg: centimetres of error",
        start: BALANCED,
        base_model: BaseModel::VerticalThrust,
        gains: Some(SOFT),
        path: FAST,
        load: Some(Load { mass: 0.3, time: 1.5 }),
        duration: 3.0,
    },
    TwoLinks {
        id: "2.4b",
        title: "2.4a with the arm's vertical momentum predicted: better vertically only",
        start: BALANCED,
        base_model: BaseModel::Translating,
        gains: Some(SOFT),
        path: FAST,
        load: Some(Load { mass: 0.3, time: 1.5 }),
        duration: 3.0,
    },
    TwoLinks {
        id: "2.5a",
        title: "Soft PID and 0.25 kg, everything predicted: followed, past two singular configurations",
        start: BALANCED,
        base_model: BaseModel::Full,
        gains: Some(SOFT),
        path: FAST,
        load: Some(Load { mass: 0.25, time: 1.5 }),
        duration: 8.0,
    },
];

/// The scenarios of chapter 2.
pub(super) fn scenarios() -> impl Iterator<Item = Scenario> {
    TWO_LINKS.iter().map(TwoLinks::scenario).chain([circle()])
}

impl TwoLinks {
    fn scenario(&self) -> Scenario {
        let structure = Structure { links: 2, counterweight: false };
        let mut parameters = default_parameters(structure);
        for (joint, start) in parameters.joints.iter_mut().zip(self.start) {
            joint.start = start;
        }
        parameters.ik.base_model = self.base_model;
        match self.gains {
            None => parameters.autopilot.mode = AutopilotMode::Ideal,
            Some(gains) => hover(&mut parameters, gains),
        }
        let ThereAndBack { way: [dx, dy], each, ramp } = self.path;
        let leg = |start, sign: f64| Leg {
            start,
            duration: each,
            ramp,
            dx: sign * dx,
            dy: sign * dy,
            profile: Profile::Trapezoidal,
        };
        parameters.reference.legs = [leg(0.0, 1.0), leg(each, -1.0), Leg::NONE, Leg::NONE];
        hang(&mut parameters, self.load);
        Scenario::new(self.id, self.title, structure, parameters, self.duration)
    }
}

/// 2.5b: three links, mounted beside the UAV's centre of mass.
fn circle() -> Scenario {
    let structure = Structure { links: 3, counterweight: false };
    let mut parameters = default_parameters(structure);
    parameters.mount.x = 0.065;
    for (joint, start) in parameters.joints.iter_mut().zip([-FRAC_PI_4, FRAC_PI_4, FRAC_PI_4]) {
        joint.start = start;
    }
    parameters.ik.resolution = Resolution::MinimumNorm;
    hover(&mut parameters, SOFT);
    hang(&mut parameters, None);
    parameters.reference.kind = ReferenceKind::Circle;
    parameters.reference.circle.diameter = 0.1;
    parameters.reference.circle.duration = 10.0;
    parameters.reference.circle.start_angle = -FRAC_PI_2;
    let title = "Three links on a circle, mounted beside the centre: everything predicted";
    Scenario::new("2.5b", title, structure, parameters, 10.0)
}

fn hover(parameters: &mut Parameters, [altitude, roll]: HoverGains) {
    (parameters.autopilot.altitude, parameters.autopilot.roll) = (altitude, roll);
}

/// Hangs a load to the arm, or none. There is no support.
fn hang(parameters: &mut Parameters, load: Option<Load>) {
    let Load { mass, time } = load.unwrap_or(Load { mass: 0.0, time: NEVER });
    (parameters.payload.mass, parameters.payload.grasp_time) = (mass, time);
    parameters.support.stiffness = 0.0;
}
