//! The payload pick-up, with both units in this process: `cargo run --release --example couple`.

use std::error::Error;

use uam::coupling::{Schedule, Unit, in_process};
use uam::parameters::Resolution;
use uam::scenarios::find;

fn main() -> Result<(), Box<dyn Error>> {
    for (name, resolution) in
        [("minimum norm", Resolution::MinimumNorm), ("extended Jacobian", Resolution::ExtendedJacobian)]
    {
        let mut scenario = find("pick-up")?;
        scenario.parameters.ik.resolution = resolution;
        let mut coupling = in_process::pair(scenario.structure, &scenario.parameters)?;
        let schedule = Schedule::new(0.0, scenario.duration, scenario.step)?;
        let (pose, mut values) = coupling.plant.select(&["base.x", "base.roll"])?;
        let (mut right, mut roll) = (0.0_f64, 0.0_f64);
        coupling.run(&schedule, &mut |_time, _controller, plant| {
            plant.read(&pose, &mut values)?;
            right = right.max(values[0]);
            roll = roll.max(values[1].abs());
            Ok(())
        })?;
        println!("{name}: UAV up to {:.1} mm to the right, roll up to {:.2} degrees", 1e3 * right, roll.to_degrees());
    }
    Ok(())
}
