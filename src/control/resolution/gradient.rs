//! The moment of weight is kept small: beside the path, rates down the gradient of the squared horizontal
//! distance between the UAV's centre of mass and that of what it carries (thesis 3.1, (3.5) to (3.7)).

use nalgebra::SVector;

use crate::mechanics::dynamics::Situation;
use crate::mechanics::vehicle::Vehicle;

/// The rates that the joints would rather have: `gain` \[rad/(m2 s)\] times the gradient.
pub(super) fn preferred<const N: usize>(vehicle: &Vehicle<N>, situation: &Situation<N>, gain: f64) -> SVector<f64, N> {
    let Situation { rotation, node, .. } = situation;
    let mass = node.matrix.mass - vehicle.uav_mass;
    if mass <= 0.0 {
        return SVector::zeros();
    }
    let distance = rotation.apply(node.matrix.first).x / mass;
    SVector::from_fn(|i, _| {
        // A joint moves first moments just as it gives momentum.
        let change = rotation.apply(node.matrix.columns[i].linear).x / mass;
        gain * 2.0 * distance * change * vehicle.revolute[i]
    })
}
