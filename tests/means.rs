//! Mean wrenches and torques over a step, against the change of momentum of what they act on: sums over
//! bodies, and Simpson's rule along the step for all that varies within it.

mod common;

use common::model::{self, Body, Part, cross};
use common::random::{Random, any_mode};
use common::run::Run;
use common::{assert_close, cases, simpson};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;
use uam::parameters::Balance;
use uam::plant::Outputs;

const STEP: f64 = 1e-3;
const PARTS: usize = 20;
const SIZE: f64 = STEP * PARTS as f64;

/// What happens at the beginning of the step, besides a jump of the rates.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Event {
    Nothing,
    /// The payload is and stays in the gripper.
    Holding,
    Capture,
    Release,
}

/// A step with all that an observer needs.
struct Observed {
    /// The motion just before it.
    before: Run,
    /// At its end.
    end: Run,
    /// Right after its jumps, and from there to the end.
    nodes: Vec<Outputs>,
}

fn observe(seed: u64, mode: AutopilotMode, event: Event) -> Observed {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = mode;
    let mut before = Run::new(structure, parameters.clone());
    // Always in contact: the force has no kink.
    parameters.support.stiffness = 20.0;
    parameters.support.height = before.model.payload(&before.model.coordinates(&before.outputs)).y + 0.3;
    before = Run::new(structure, parameters);
    before.inputs = random.inputs(structure);
    before.inputs.grasp = matches!(event, Event::Holding | Event::Release);
    before.steps(10, 0.01);

    let mut end = before.clone();
    random.new_rates(structure, &mut end.inputs);
    random.new_slopes(structure, &mut end.inputs);
    end.inputs.grasp = matches!(event, Event::Holding | Event::Capture);
    let start = end.clone();
    let at = |t: f64| {
        let mut run = start.clone();
        run.step(t);
        run
    };
    let nodes = (0..=PARTS).map(|i| at(i as f64 * STEP).outputs).collect();
    Observed { before, end: at(SIZE), nodes }
}

impl Observed {
    /// The bodies of the end among `which`, at both ends. A payload that is captured was at rest before, one
    /// that is released is no more part of it.
    fn ends(&self, which: impl Fn(Part) -> bool) -> [Vec<Body>; 2] {
        let held = self.end.outputs.attached;
        let captured = held && !self.before.outputs.attached;
        let pick = |outputs: &Outputs| -> Vec<Body> {
            let bodies = self.end.model.observed(outputs, held);
            bodies.into_iter().filter(|body| which(body.part)).collect()
        };
        let mut first = pick(&self.before.outputs);
        for body in first.iter_mut().filter(|body| captured && body.part == Part::Payload) {
            body.velocity = Vector2::zeros();
        }
        [first, pick(&self.end.outputs)]
    }

    /// Impulse of weight and outer loads on some bodies with moments about a moving point, less the integral
    /// of (velocity of the point) x (momentum), then the change of momentum about the point.
    ///
    /// The loads on the end effector count if the last link is one of the bodies.
    fn balance(
        &self,
        which: impl Fn(Part) -> bool + Copy,
        point: impl Fn(&Run, &Outputs) -> Vector2<f64>,
    ) -> [Vector3<f64>; 2] {
        let (run, model) = (&self.end, &self.end.model);
        let load = |o: &Outputs| {
            let about = point(run, o);
            let (at, speed) = (model.coordinates(o), model.speed(o));
            let velocity = common::derivative(|s| {
                let mut moved = o.clone();
                let to = at.moved(&speed, s);
                moved.pose = to.pose;
                moved.position[..to.q.len()].copy_from_slice(&to.q);
                point(run, &moved)
            });
            let bodies: Vec<Body> = model.observed(o, o.attached).into_iter().filter(|b| which(b.part)).collect();
            let push = if o.attached { model.parameters.support.stiffness * model.pressed(o) } else { 0.0 };
            let support = Vector2::new(0.0, push);
            let loaded = f64::from(which(Part::Link(model.structure.links - 1)));
            let force = (run.inputs.load.tip_force + support) * loaded;
            let moment = (run.inputs.load.tip_torque
                + cross(model.end_effector(&at) - about, run.inputs.load.tip_force)
                + cross(model.payload(&at) - about, support))
                * loaded
                + model::weight_moment(&bodies, model.gravity(), about)
                - cross(velocity, model::momentum(&bodies));
            Vector3::new(force.x, force.y - model::mass(&bodies) * model.gravity(), moment)
        };
        let impulse = simpson(&self.nodes.iter().map(load).collect::<Vec<_>>(), STEP);
        let [first, last] = self.ends(which);
        let about = [point(run, &self.before.outputs), point(run, &self.end.outputs)];
        let p = model::momentum(&last) - model::momentum(&first);
        let k = model::angular_momentum(&last, about[1]) - model::angular_momentum(&first, about[0]);
        [impulse, Vector3::new(p.x, p.y, k)]
    }
}

fn events() -> impl Strategy<Value = Event> {
    prop_oneof![Just(Event::Nothing), Just(Event::Holding), Just(Event::Capture), Just(Event::Release)]
}

proptest! {
    #![proptest_config(cases(48))]

    /// What the base carries obeys Newton and Euler: change of momentum = outer impulse - transmitted wrench.
    #[test]
    fn transmitted_wrench(seed: u64, mode in any_mode(), event in events()) {
        let observed = observe(seed, mode, event);
        let [impulse, change] = observed.balance(|part| part != Part::Uav, |_, o| o.pose.xy());
        let o = &observed.end.outputs;
        let found = [o.transmitted_force.x, o.transmitted_force.y, o.transmitted_moment];
        assert_close(&found, ((impulse - change) / SIZE).as_slice(), 1e-8, "wrench");
    }

    /// What a joint or the balance element's motor moves obeys Euler about its axis: change of K = motor's
    /// impulse + outer impulse.
    #[test]
    fn torques(seed: u64, mode in any_mode(), event in events()) {
        let observed = observe(seed, mode, event);
        let model = &observed.end.model;
        for i in (0..model.structure.coordinates()).filter(|&i| !model.slides(i)) {
            let axis = |run: &Run, o: &Outputs| run.model.axis(&run.model.coordinates(o), i);
            let [impulse, change] = observed.balance(|part| part.is_moved_by(i, model.structure), axis);
            let found = observed.end.outputs.effort[i];
            assert_close(&[found], &[(change - impulse).z / SIZE], 1e-8, "torque");
        }
    }

    /// Along the UAV's x axis, which turns with the roll, the counterweight obeys Newton:
    /// d(p . x)/dt = (force of its motor) + weight . x + roll rate * (p . y).
    #[test]
    fn force_on_the_counterweight(seed: u64, mode in any_mode(), event in events()) {
        let observed = observe(seed, mode, event);
        let model = &observed.end.model;
        let i = model.structure.links;
        prop_assume!(model.slides(i));
        let momentum = |o: &Outputs| {
            let bodies = model.observed(o, false);
            model::momentum(&bodies.into_iter().filter(|b| b.part == Part::Counterweight).collect::<Vec<_>>())
        };
        let axis = |o: &Outputs| Vector2::new(o.pose.z.cos(), o.pose.z.sin());
        let along = |o: &Outputs| momentum(o).dot(&axis(o));
        let weight = model.parameters.counterweight.mass * model.gravity();
        let load = |o: &Outputs| o.velocity.z * cross(axis(o), momentum(o)) - weight * o.pose.z.sin();
        let impulse = simpson(&observed.nodes.iter().map(load).collect::<Vec<_>>(), STEP);
        let change = along(&observed.end.outputs) - along(&observed.before.outputs);
        assert_close(&[observed.end.outputs.effort[i]], &[(change - impulse) / SIZE], 1e-8, "force");
    }

    /// The payload obeys Newton: its force on the arm is weight + support - change of momentum.
    #[test]
    fn payload_force(seed: u64, mode in any_mode(), event in events()) {
        let observed = observe(seed, mode, event);
        let o = &observed.end.outputs;
        let expected = if o.attached {
            let model = &observed.end.model;
            let mass = model.parameters.payload.mass;
            let push: Vec<f64> =
                observed.nodes.iter().map(|o| model.parameters.support.stiffness * model.pressed(o)).collect();
            let [first, last] = observed.ends(|part| part == Part::Payload);
            let change = model::momentum(&last) - model::momentum(&first);
            Vector2::new(0.0, -mass * model.gravity()) + (Vector2::new(0.0, simpson(&push, STEP)) - change) / SIZE
        } else {
            Vector2::zeros()
        };
        assert_close(o.payload_force.as_slice(), expected.as_slice(), 1e-8, "force");
    }

    /// Means add up: over a whole step they are the average of those over its parts.
    #[test]
    fn means_average(seed: u64, mode in any_mode(), event in events()) {
        let observed = observe(seed, mode, event);
        let means = |o: &Outputs| {
            let control = if mode == AutopilotMode::Ideal { [o.thrust, o.torque] } else { [0.0; 2] };
            let force = [o.transmitted_force.x, o.transmitted_force.y, o.transmitted_moment];
            nalgebra::DVector::from_vec([&control[..], &force, &o.effort].concat())
        };
        let mut run = observed.before.clone();
        run.inputs = observed.end.inputs.clone();
        let slope = run.inputs.acceleration_command;
        let mut sum = means(&run.outputs) * 0.0;
        // The instant of the jumps is a step of its own, too short for means: its impulse goes to the next.
        for size in [0.0, 1e-13, 0.005, 0.015 - 1e-13] {
            let shown = means(&run.outputs);
            run.step(size);
            if size < 1e-9 {
                assert_eq!(means(&run.outputs), shown);
            } else {
                sum += means(&run.outputs) * size;
            }
            for (rate, slope) in run.inputs.rate_command.iter_mut().zip(slope) {
                *rate += slope * size;
            }
        }
        assert_close((sum / SIZE).as_slice(), means(&observed.end.outputs).as_slice(), 1e-8, "mean");
    }
}

/// A vehicle at rest that hovers in balance: every torque carries the weight outboard, in closed form, and a
/// step changes nothing about the initial outputs.
#[test]
fn at_rest_the_means_are_the_static_loads() {
    let structure = uam::Structure::new(2, Balance::Counterweight).unwrap();
    let mut p = uam::parameters::defaults::default_parameters(structure);
    (p.joints[0].start, p.joints[1].start) = (0.3, 0.4);
    p.autopilot.mode = AutopilotMode::Ideal;
    let mut run = Run::new(structure, p);
    let (a, b) = (0.3_f64.sin(), 0.7_f64.sin());
    let outer = 9.81 * 0.065 * b;
    let expected = [9.81 * (0.065 * a + 0.13 * a) + outer, outer];
    let total = expected[0];
    for _ in 0..2 {
        let o = &run.outputs;
        assert_close(&o.effort[..2], &expected, 1e-12, "joint torques");
        assert_close(&[o.transmitted_moment, o.torque], &[-total, total], 1e-12, "moment");
        assert_close(o.transmitted_force.as_slice(), &[0.0, -9.81 * 4.2], 1e-11, "force");
        assert_close(&[o.thrust], &[9.81 * 6.2], 1e-11, "thrust");
        run.step(0.01);
    }
}
