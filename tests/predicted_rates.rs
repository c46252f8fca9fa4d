//! What the controller says of how its prediction changes: derivatives of its outputs, against differences.

mod common;

use common::assert_close;
use uam::Structure;
use uam::control::{self, Inputs, Outputs};
use uam::parameters::defaults::default_parameters;
use uam::parameters::{BaseModel, Hold, Parameters};
use uam::variables::options::Choice;

const STEP: f64 = 2.5e-4;

/// The backward difference of order 2 of three values that follow each other.
fn difference<const D: usize>(values: [[f64; D]; 3]) -> Vec<f64> {
    let [a, b, c] = values;
    (0..D).map(|i| (3.0 * c[i] - 4.0 * b[i] + a[i]) / (2.0 * STEP)).collect()
}

/// Fast, and with a mount beside the centre of mass, so that everything moves.
fn hurried(base: BaseModel) -> Parameters {
    let mut parameters = default_parameters(Structure::DEFAULT);
    parameters.ik.base_model = base;
    parameters.ik.hold = Hold::FirstOrder;
    parameters.ik.sample_time = 0.02;
    parameters.mount.x = 0.04;
    parameters.reference.legs[0].start = 0.0;
    parameters.reference.legs[0].duration = 1.6;
    parameters.reference.legs[0].ramp = 0.2;
    parameters
}

/// Within an interval everything is smooth. In every model of the base the derivative of the end effector's place is
/// its velocity, and that of the UAV's velocity its acceleration.
#[test]
fn derivatives_of_the_prediction_are_those_of_its_outputs() {
    for (number, item) in (1..).zip(BaseModel::Full.items()) {
        let mut base = BaseModel::Full;
        base.choose(number);
        let (parameters, inputs) = (hurried(base), Inputs::default());
        let mut outputs = Outputs::default();
        let mut controller = control::new(Structure::DEFAULT, &parameters, &mut outputs).unwrap();
        let mut seen: Vec<([f64; 2], [f64; 3])> = Vec::new();
        for k in 0_u32..2280 {
            controller.step(&inputs, f64::from(k) * STEP, STEP, &mut outputs).unwrap();
            seen.push((outputs.predicted_end_effector.into(), outputs.predicted_velocity.into()));
        }
        let rates = controller.output_derivatives(2280.0 * STEP);
        let last: [_; 3] = std::array::from_fn(|i| seen[seen.len() - 3 + i]);
        let tip = difference(last.map(|(tip, _)| tip));
        let velocity = difference(last.map(|(_, velocity)| velocity));
        let fastest = velocity.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert_close(rates.predicted_end_effector.as_slice(), &tip, 1e-5, item.name);
        assert_close(rates.predicted_velocity.as_slice(), &velocity, 1e-4, item.name);
        assert!(fastest > 0.1, "{}: the UAV accelerates", item.name);
    }
}
