//! Thesis 4.3: the payload pick-up of the start values, in its variants.

use super::{PICK_UP_DURATION, Scenario, default_parameters};
use crate::parameters::{Parameters, Resolution, Structure};

/// The scenarios of 4.3.
pub(super) fn scenarios() -> impl Iterator<Item = Scenario> {
    let scenario = |id: &str, title: &str, change: &dyn Fn(&mut Parameters)| {
        let mut parameters = default_parameters(Structure::DEFAULT);
        change(&mut parameters);
        Scenario::new(id, title, Structure::DEFAULT, parameters, PICK_UP_DURATION)
    };
    let minimum_norm = |parameters: &mut Parameters| parameters.ik.resolution = Resolution::MinimumNorm;
    let stiff_roll_rate = |parameters: &mut Parameters| parameters.autopilot.roll.kd = 9.0;
    [
        scenario("4.3a", "Pick-up with the smallest joint rates: the UAV swings", &minimum_norm),
        scenario("4.3b", "Pick-up without moment on the UAV (extended Jacobian): the UAV keeps still", &|_| {}),
        scenario(
            "4.3c-minimum-norm",
            "4.3a with roll kd = 9: growing swings, the arm leaves its workspace",
            &|parameters| {
                minimum_norm(parameters);
                stiff_roll_rate(parameters);
            },
        ),
        scenario("4.3c-extended-jacobian", "4.3b with roll kd = 9: no difference", &stiff_roll_rate),
    ]
    .into_iter()
}
