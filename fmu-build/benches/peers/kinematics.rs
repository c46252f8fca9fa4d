//! Inverse kinematics of the free-floating arm, without limits, beside what Pinocchio offers for it: centroidal
//! map, frame Jacobian, and the solution of the generalized Jacobian that follows from both.
//!
//! The library's functions for the same, from joint angles to rates, stand beside it. A step of the controller does more:
//! it evaluates the path, predicts base and momentum, and watches limits.

use std::ffi::c_int;
use std::time::Instant;

use fmu_build::host::coupling::Pair;
use fmu_build::host::fmu::{Instance, Selection, Value};
use libloading::Library;
use uam::control::{Inputs, Outputs, Problem, Response, Task};
use uam::mechanics::dynamics::{Dynamics, Node, State};
use uam::mechanics::momentum::Twist;
use uam::mechanics::planar::{Rotation, vec2};
use uam::parameters::{BaseModel, Discretization, PathAxes, Resolution};
use uam::scenarios::default_parameters;
use uam::variables::options::Choice;
use uam::{Parameters, Structure};

use crate::library::{function, open};
use crate::measure::{Candidate, Contest, fastest};

const STEP: f64 = 1e-3;
/// The reaching motion of the pick-up.
const STEPS: u32 = 1500;
/// So many times in a round.
const TIMES: u32 = 10;
/// Pinocchio turns all joints by this much from one solution to the next \[rad\].
const TURN: f64 = 1e-6;
/// Velocity of the end effector for which the answer is checked \[m/s\].
const WANTED: [f64; 2] = [0.1, -0.2];

type Rates = unsafe extern "C" fn(*const f64, *const f64, *const f64, f64, c_int, *mut f64);

struct Pinocchio {
    rates: Rates,
    coordinates: [f64; 6],
    _library: Library,
}

impl Pinocchio {
    fn open(parameters: &Parameters) -> Option<Self> {
        let library = open("pinocchio")?;
        let uav = [parameters.uav.mass, parameters.uav.inertia];
        let mount = [parameters.mount.x, parameters.mount.y];
        let links: Vec<f64> =
            parameters.links[..3].iter().flat_map(|link| [link.mass, link.length, link.com, link.inertia]).collect();
        let mut coordinates = [0.0; 6];
        coordinates[3..].iter_mut().zip(&parameters.joints).for_each(|(to, joint)| *to = joint.start);
        // SAFETY: the types are those in pinocchio.cpp; the arrays have as many numbers as it reads.
        let rates = unsafe {
            let load: unsafe extern "C" fn(*const f64, *const f64, *const f64, c_int) =
                function(&library, "peers_pinocchio_load");
            load(uav.as_ptr(), mount.as_ptr(), links.as_ptr(), 3);
            function(&library, "peers_pinocchio_rates")
        };
        Some(Self { rates, coordinates, _library: library })
    }

    /// Solves so many times; the mean of the answers.
    fn solve(&self, turn: f64, times: u32) -> [f64; 3] {
        let mut rates = [0.0; 3];
        let momentum = [0.0; 3];
        // SAFETY: see `open`.
        unsafe {
            (self.rates)(
                self.coordinates.as_ptr(),
                momentum.as_ptr(),
                WANTED.as_ptr(),
                turn,
                times as c_int,
                rates.as_mut_ptr(),
            );
        }
        rates
    }
}

/// The same by the library's own functions: generalized Jacobian from joint angles, and its solution.
struct Ours {
    dynamics: Dynamics<3>,
    start: State<3>,
}

impl Ours {
    fn new(parameters: &Parameters) -> Self {
        let dynamics = Dynamics::new(Structure::DEFAULT, parameters, BaseModel::Full).unwrap();
        Self { dynamics, start: dynamics.start(parameters).state }
    }

    /// Like [`Pinocchio::solve`].
    fn solve(&self, turn: f64, times: u32) -> [f64; 3] {
        let (vehicle, mut q, mut sum) = (&self.dynamics.vehicle, self.start.position, self.start.rate);
        let mut node = Node::new(vehicle, &q, false, &sum);
        let (target, reach) = (vec2(WANTED[0], WANTED[1]), vehicle.reach());
        for _ in 0..times {
            q.add_scalar_mut(turn);
            node.take(vehicle, &q, false, &self.start.rate);
            let response = Response::new(&self.dynamics, &node, Rotation::NONE, Twist::ZERO, false);
            let problem = Problem {
                path: response.jacobian,
                velocity: target - response.end_effector_free,
                interval: 1e-3,
                caution: 0.0,
                moment: Task { row: response.carried, value: 0.0 },
            };
            sum += problem.resolve(PathAxes::Both, false, reach).rate;
        }
        (sum / f64::from(times)).into()
    }
}

/// By how much the end effector of the plant misses the wanted velocity with these rates \[m/s\].
fn error(rates: [f64; 3], pair: &Pair) -> f64 {
    let mut plant = pair.plant.instantiate("plant").unwrap();
    for (i, rate) in rates.into_iter().enumerate() {
        plant.set_value(&format!("joint[{}].rate_command", i + 1), Value::Real(rate)).unwrap();
    }
    plant.initialize(0.0, 1.0).unwrap();
    plant.do_step(0.0, 1e-8).unwrap();
    let miss = ["end_effector.vx", "end_effector.vy"].into_iter().zip(WANTED).map(|(name, wanted)| {
        let Value::Real(found) = plant.value(name).unwrap() else { panic!("{name} is a real number") };
        (found - wanted).abs()
    });
    miss.fold(0.0, f64::max)
}

/// Time of one solution \[s\].
fn timed(solve: impl Fn(f64, u32) -> [f64; 3]) -> f64 {
    fastest(TIMES, || {
        let begin = Instant::now();
        std::hint::black_box(solve(TURN, STEPS));
        begin.elapsed().as_secs_f64() / f64::from(STEPS)
    })
}

fn parameters() -> Parameters {
    let mut parameters = default_parameters(Structure::DEFAULT);
    parameters.ik.discretization = Discretization::Euler;
    parameters.ik.resolution = Resolution::MinimumNorm;
    parameters
}

/// Steps of a controller of the library with these parameters: time of one \[s\].
pub fn by_library(parameters: &Parameters) -> f64 {
    let mut outputs = Outputs::default();
    let mut controller = uam::control::new(Structure::DEFAULT, parameters, &mut outputs).unwrap();
    let inputs = Inputs::default();
    let begin = Instant::now();
    for n in 0..STEPS {
        controller.step(&inputs, f64::from(n) * STEP, STEP, &mut outputs).unwrap();
    }
    begin.elapsed().as_secs_f64() / f64::from(STEPS)
}

/// Steps of a controller that is set up, each with the rates that it gives: time of one \[s\].
pub fn by_fmu(controller: &mut Instance) -> f64 {
    let names = [1, 2, 3].map(|joint| format!("joint[{joint}].rate_command"));
    let rates = Selection::new(controller.description(), names.iter().map(String::as_str)).unwrap();
    let mut seen = rates.values();
    controller.initialize(0.0, f64::from(STEPS) * STEP).unwrap();
    let begin = Instant::now();
    for n in 0..STEPS {
        controller.do_step(f64::from(n) * STEP, STEP).unwrap();
        controller.get(&rates, &mut seen).unwrap();
    }
    let elapsed = begin.elapsed().as_secs_f64();
    controller.reset().unwrap();
    elapsed / f64::from(STEPS)
}

pub fn contest(pair: &Pair) -> Contest<'static> {
    let parameters = parameters();
    let pinocchio = Pinocchio::open(&parameters);
    let mut instance = pair.controller.instantiate("controller").unwrap();
    let ours = Ours::new(&parameters);
    let mut candidates = vec![
        Candidate::new(
            "Jacobian and solution alone, as a Rust library",
            Some(error(ours.solve(0.0, 1), pair)),
            move || timed(|turn, times| ours.solve(turn, times)),
        ),
        Candidate::new("controller as a Rust library", None, move || fastest(TIMES, || by_library(&parameters))),
        Candidate::new("controller FMU through C", None, move || {
            fastest(TIMES, || {
                choose(&mut instance, Discretization::Euler, Resolution::MinimumNorm);
                by_fmu(&mut instance)
            })
        }),
    ];
    if let Some(pinocchio) = pinocchio {
        let error = error(pinocchio.solve(0.0, 1), pair);
        candidates.push(Candidate::new("Pinocchio, ccrba + frame Jacobian + solve", Some(error), move || {
            timed(|turn, times| pinocchio.solve(turn, times))
        }));
    }
    Contest { title: "Inverse kinematics, 3 links, minimum norm, euler, no limits", candidates }
}

/// Chooses the method of a controller.
pub fn choose(controller: &mut Instance, discretization: Discretization, resolution: Resolution) {
    controller.set_value("ik.discretization", Value::Integer(discretization.number())).unwrap();
    controller.set_value("ik.resolution", Value::Integer(resolution.number())).unwrap();
}
