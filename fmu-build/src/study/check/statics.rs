//! Where everything is while the vehicle stands still, and how heavy it is.

use uam::mechanics::dynamics::{Dynamics, State};
use uam::mechanics::momentum::Twist;
use uam::mechanics::planar::{Vec2, perp, vec2};
use uam::parameters::{BaseModel, Parameters, Structure};

/// The vehicle at its start, upright and at rest; axes of the UAV frame, places from the UAV's centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Statics {
    /// Mass of the whole system \[kg\].
    pub mass: f64,
    /// Mass of what the UAV carries \[kg\].
    pub carried_mass: f64,
    /// Moment of inertia of the whole system about its centre of mass \[kg m2\].
    pub inertia: f64,
    /// First moment of what the UAV carries about the UAV's centre of mass \[kg m\].
    pub first: Vec2,
    /// For each link, first moment about its joint of what lies outboard of that \[kg m\].
    pub outboard: Vec<Vec2>,
    /// For each link, velocity of the end effector per rate of its joint: the columns of its Jacobian \[m\].
    pub jacobian: Vec<Vec2>,
    /// Place of the end effector \[m\].
    pub end_effector: Vec2,
    /// Where the last link points.
    pub direction: Vec2,
}

impl Statics {
    /// At the start, with or without the payload in the hand.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn at_start(structure: Structure, parameters: &Parameters, held: bool) -> uam::Result<Self> {
        uam::for_coordinates!(structure, N => Self::of::<N>(structure, parameters, held))
    }

    fn of<const N: usize>(structure: Structure, parameters: &Parameters, held: bool) -> uam::Result<Self> {
        let dynamics = Dynamics::<N>::new(structure, parameters, BaseModel::Full)?;
        let empty = dynamics.start(parameters).state;
        let node = dynamics.situation(State { held, ..empty }).node;
        let (posture, matrix) = (&node.posture, &node.matrix);
        // A moment alone turns the whole about its centre of mass.
        let spin = matrix.base_response(Twist { linear: vec2(0.0, 0.0), angular: 1.0 }).angular;
        Ok(Self {
            mass: matrix.mass,
            carried_mass: matrix.mass - parameters.uav.mass,
            inertia: 1.0 / spin,
            first: matrix.first,
            outboard: (0..structure.links).map(|i| matrix.outboard_first(i)).collect(),
            jacobian: posture.joint[..structure.links].iter().map(|joint| perp(posture.end_effector - joint)).collect(),
            end_effector: posture.end_effector,
            direction: posture.direction[structure.links - 1],
        })
    }
}
