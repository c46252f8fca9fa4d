//! Rigid-body mechanics of the plane: vehicle, kinematics, momentum, and the laws of motion that stand on them.

pub mod dynamics;
pub mod kinematics;
pub mod momentum;
pub mod planar;
pub mod vehicle;
