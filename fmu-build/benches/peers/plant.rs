//! Steps of the plant beside MuJoCo's of the same vehicle.
//!
//! With imposed rates the plant integrates three degrees of freedom, those of the base; MuJoCo always integrates
//! all six, and its joints keep their rates by torques computed in every stage. With torques, here none, both
//! integrate the same.

use std::ffi::{CString, c_char, c_int};
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use fmu_build::host::coupling::Pair;
use fmu_build::host::fmu::{Instance, Selection, Value};
use libloading::Library;
use uam::parameters::Actuation;
use uam::plant::{Inputs, Outputs};
use uam::scenarios::default_parameters;
use uam::variables::options::Choice;
use uam::{Parameters, Structure};

use crate::library::{function, open};
use crate::measure::{Candidate, Contest, fastest};

const STEP: f64 = 1e-3;
/// Free joints soon whip about, and small errors grow.
const STEPS: i32 = 300;
/// Steps of the reference per step.
const FINER: i32 = 128;
/// So many steps of MuJoCo may stand for one of the plant.
const FINER_STEPS: [i32; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Errors below this are as good as none \[m, rad\].
const NO_ERROR: f64 = 1e-10;
/// The motion, so many times in a round.
const TIMES: u32 = 10;
/// Rates of the joints, or none: they are free.
type Motion = Option<[f64; 3]>;
const IMPOSED: Motion = Some([0.4, -0.6, 0.5]);
/// Base and joints.
type Place = [f64; 6];

/// The vehicle as MuJoCo reads it. Integrators without effect hold the autopilot's integrals.
fn mjcf(parameters: &Parameters) -> String {
    let hinge = r#"<joint type="hinge" axis="0 -1 0"/>"#;
    let mut text = format!(
        r#"<mujoco><compiler angle="radian"/><option gravity="0 0 {}"><flag contact="disable" constraint="disable"/></option>
<worldbody><body><joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 0 1"/>{hinge}
<inertial pos="0 0 0" mass="{m}" diaginertia="{i} {i} {i}"/>"#,
        -parameters.gravity,
        m = parameters.uav.mass,
        i = parameters.uav.inertia
    );
    let mut place = (parameters.mount.x, parameters.mount.y);
    let links = &parameters.links[..Structure::DEFAULT.links];
    for link in links {
        let (com, mass, i) = (link.com, link.mass, link.inertia);
        let _ = write!(
            text,
            r#"<body pos="{} 0 {}">{hinge}<inertial pos="0 0 {}" mass="{mass}" diaginertia="{i} {i} {i}"/>"#,
            place.0, place.1, -com
        );
        place = (0.0, -link.length);
    }
    text + &"</body>".repeat(links.len() + 1)
        + r#"</worldbody><actuator><general joint="x" dyntype="integrator" gainprm="0"/>
<general joint="y" dyntype="integrator" gainprm="0"/></actuator></mujoco>"#
}

/// MuJoCo with the vehicle.
struct MuJoCo {
    start: unsafe extern "C" fn(*const f64, *const f64),
    run: unsafe extern "C" fn(c_int, f64, c_int),
    place: unsafe extern "C" fn(*mut f64),
    joints: [f64; 3],
    _library: Library,
}

impl MuJoCo {
    fn open(parameters: &Parameters, folder: &Path) -> Option<Self> {
        let library = open("mujoco")?;
        let path = folder.join("vehicle.xml");
        std::fs::write(&path, mjcf(parameters)).unwrap();
        let pilot = &parameters.autopilot;
        let mass = parameters.uav.mass + parameters.links[..3].iter().map(|link| link.mass).sum::<f64>();
        let mut law = vec![mass * parameters.gravity];
        law.extend([pilot.altitude, pilot.roll].iter().flat_map(|gains| [gains.kp, gains.ki, gains.kd]));
        let name = CString::new(path.to_str().unwrap()).unwrap();
        // SAFETY: the types are those in mujoco.c; the text and the numbers outlive the call.
        unsafe {
            let load: unsafe extern "C" fn(*const c_char, *const f64) -> c_int =
                function(&library, "peers_mujoco_load");
            assert_eq!(load(name.as_ptr(), law.as_ptr()), 0, "MuJoCo does not take {}", path.display());
            Some(Self {
                start: function(&library, "peers_mujoco_start"),
                run: function(&library, "peers_mujoco_run"),
                place: function(&library, "peers_mujoco_place"),
                joints: std::array::from_fn(|i| parameters.joints[i].start),
                _library: library,
            })
        }
    }

    /// The motion; where it ends, and how long that took \[s\].
    fn motion(&self, motion: &Motion, runge_kutta: bool, finer: i32) -> (Place, f64) {
        let mut place = Place::default();
        // SAFETY: the model has three joints, and the arrays as many numbers as it has coordinates.
        let elapsed = unsafe {
            (self.start)(self.joints.as_ptr(), motion.as_ref().map_or(std::ptr::null(), |rates| rates.as_ptr()));
            let begin = Instant::now();
            (self.run)(runge_kutta.into(), STEP / f64::from(finer), STEPS * finer);
            let elapsed = begin.elapsed();
            (self.place)(place.as_mut_ptr());
            elapsed
        };
        (place, elapsed.as_secs_f64())
    }
}

fn parameters(motion: &Motion) -> Parameters {
    let mut parameters = default_parameters(Structure::DEFAULT);
    if motion.is_none() {
        parameters.joints.iter_mut().for_each(|joint| joint.actuation = Actuation::Torque);
    }
    parameters
}

/// The motion by the library; where it ends, and how long that took \[s\].
fn by_library(motion: &Motion) -> (Place, f64) {
    let parameters = parameters(motion);
    let mut plant = uam::plant::new(Structure::DEFAULT, &parameters).unwrap();
    let (mut inputs, mut outputs) = (Inputs::default(), Outputs::default());
    inputs.rate_command[..3].copy_from_slice(&motion.unwrap_or_default());
    let begin = Instant::now();
    for n in 0..STEPS {
        plant.step(&inputs, f64::from(n) * STEP, STEP, &mut outputs).unwrap();
    }
    let elapsed = begin.elapsed().as_secs_f64();
    let mut place = Place::default();
    place[..3].copy_from_slice(outputs.pose.as_slice());
    place[3..].copy_from_slice(&outputs.position[..3]);
    (place, elapsed)
}

/// The motion by the FMU, with rates set before each step and the base's pose got after it; where it ends, and how
/// long that took \[s\].
fn by_fmu(plant: &mut Instance, motion: &Motion) -> (Place, f64) {
    let actuation = if motion.is_some() { Actuation::Rate } else { Actuation::Torque };
    let names = |of: &str| [1, 2, 3].map(|joint| format!("joint[{joint}].{of}"));
    for name in names("actuation") {
        plant.set_value(&name, Value::Integer(actuation.number())).unwrap();
    }
    let select = |names: &[String]| Selection::new(plant.description(), names.iter().map(String::as_str)).unwrap();
    let rates = select(&names("rate_command"));
    let pose = select(&["x", "y", "roll"].map(|axis| format!("base.{axis}")));
    let joints = select(&names("position"));
    let (mut given, mut seen, mut positions) = (rates.values(), pose.values(), joints.values());
    for (i, rate) in motion.unwrap_or_default().into_iter().enumerate() {
        assert!(rates.put(&mut given, i, Value::Real(rate)));
    }
    plant.initialize(0.0, f64::from(STEPS) * STEP).unwrap();
    let begin = Instant::now();
    for n in 0..STEPS {
        plant.set(&rates, &given).unwrap();
        plant.do_step(f64::from(n) * STEP, STEP).unwrap();
        plant.get(&pose, &mut seen).unwrap();
    }
    let elapsed = begin.elapsed().as_secs_f64();
    plant.get(&joints, &mut positions).unwrap();
    plant.reset().unwrap();
    let mut place = Place::default();
    place.iter_mut().zip(pose.numbers(&seen).chain(joints.numbers(&positions))).for_each(|(to, from)| *to = from);
    (place, elapsed)
}

fn distance(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Both kinds of motion.
pub fn contests(pair: &Pair, folder: &Path) -> Vec<Contest<'static>> {
    let imposed = contest("Plant step, imposed rates: 3 degrees of freedom beside MuJoCo's 6", IMPOSED, pair, folder);
    let free = contest("Plant step, joints driven by torques: 6 degrees of freedom", None, pair, folder);
    vec![imposed, free]
}

fn contest(title: &'static str, motion: Motion, pair: &Pair, folder: &Path) -> Contest<'static> {
    let mujoco = MuJoCo::open(&parameters(&motion), folder).map(std::rc::Rc::new);
    let reference = mujoco.as_ref().map(|mujoco| mujoco.motion(&motion, true, FINER).0);
    let error = |place: Place| reference.as_ref().map(|reference| distance(&place, reference));
    let mut instance = pair.plant.instantiate("plant").unwrap();
    let step = |mut run: Box<dyn FnMut() -> f64>| move || fastest(TIMES, &mut run) / f64::from(STEPS);
    let mut candidates = vec![
        Candidate::new("plant FMU through C", error(by_fmu(&mut instance, &motion).0), {
            step(Box::new(move || by_fmu(&mut instance, &motion).1))
        }),
        Candidate::new(
            "plant as a Rust library",
            error(by_library(&motion).0),
            step(Box::new(move || by_library(&motion).1)),
        ),
    ];
    let ours = candidates[0].error.unwrap_or_default().max(NO_ERROR);
    for mujoco in mujoco.iter() {
        let run_with = |runge_kutta: bool, finer: i32| error(mujoco.motion(&motion, runge_kutta, finer).0);
        let mut variants = vec![("MuJoCo, Euler".to_owned(), false, 1), ("MuJoCo, RK4".to_owned(), true, 1)];
        let as_good = FINER_STEPS.into_iter().find(|&finer| run_with(true, finer) <= Some(ours));
        if let Some(finer) = as_good.filter(|&finer| finer > 1) {
            variants.push((format!("MuJoCo, RK4, {finer} steps for one: no larger error"), true, finer));
        }
        for (name, runge_kutta, finer) in variants {
            let mujoco = std::rc::Rc::clone(mujoco);
            let error = run_with(runge_kutta, finer);
            let work = step(Box::new(move || mujoco.motion(&motion, runge_kutta, finer).1));
            candidates.push(Candidate::new(name, error, work));
        }
    }
    Contest { title, candidates }
}
