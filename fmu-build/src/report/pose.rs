//! Where everything is at one row of a recording, for drawings.

use uam::mechanics::planar::{Rotation, Vec2, vec2};
use uam::parameters::Balance;
use uam::scenarios::Scenario;

use crate::host::record::{NotRecorded, Recording};

/// Points of the vehicle in the inertial frame \[m\].
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// The UAV's centre of mass.
    pub base: Vec2,
    /// Its roll \[rad\].
    pub roll: f64,
    /// First joint, next joints, end effector.
    pub joints: Vec<Vec2>,
    /// The counterweight, if there is one.
    pub counterweight: Option<Vec2>,
    /// The centre of mass of the balance element, if there is one; it turns about that of the UAV.
    pub balance_element: Option<Vec2>,
    /// The place of a held payload.
    pub hand: Vec2,
    /// Whether it is held.
    pub attached: bool,
}

impl Pose {
    /// The vehicle at a row of the recording of a scenario.
    ///
    /// # Errors
    /// If the recording lacks the position of a part.
    pub fn at(scenario: &Scenario, recording: &Recording, row: usize) -> Result<Self, NotRecorded> {
        let value = |name: &str| Ok(recording.column(name)?.get(row).copied().unwrap_or_default());
        let parameters = &scenario.parameters;
        let (base, roll) = (vec2(value("base.x")?, value("base.y")?), value("base.roll")?);
        let body = Rotation::by(roll);
        let mut angle = roll;
        let mut joints = vec![base + body.apply(vec2(parameters.mount.x, parameters.mount.y))];
        let mut hand = joints[0];
        for (i, link) in parameters.links.iter().take(scenario.structure.links).enumerate() {
            angle += value(&format!("joint[{}].position", i + 1))?;
            let from = joints[i];
            let along = Rotation::by(angle).down();
            hand = from + parameters.payload.com * along;
            joints.push(from + link.length * along);
        }
        let (mut counterweight, mut balance_element) = (None, None);
        match scenario.structure.balance {
            Balance::None => {}
            Balance::Counterweight => {
                let place = vec2(value("counterweight.position")?, parameters.counterweight.height);
                counterweight = Some(base + body.apply(place));
            }
            Balance::Element => {
                let along = Rotation::by(roll + value("balance_element.position")?).down();
                balance_element = Some(base + parameters.balance_element.com * along);
            }
        }
        let attached = value("payload.attached")? > 0.5;
        Ok(Self { base, roll, joints, counterweight, balance_element, hand, attached })
    }

    /// Where the payload is taken over, if it ever is.
    ///
    /// # Errors
    /// As [`Pose::at`].
    pub fn capture(scenario: &Scenario, recording: &Recording) -> Result<Option<Vec2>, NotRecorded> {
        let row = recording.column("payload.attached")?.iter().position(|&attached| attached > 0.5);
        row.map(|row| Ok(Self::at(scenario, recording, row)?.hand)).transpose()
    }
}

#[cfg(test)]
mod tests {
    use uam::scenarios;

    use super::*;

    #[test]
    fn the_drawn_arm_ends_where_geometry_says() {
        let scenario = &scenarios::find("4.3a").unwrap();
        let names = [
            "base.x",
            "base.y",
            "base.roll",
            "joint[1].position",
            "joint[2].position",
            "joint[3].position",
            "payload.attached",
        ];
        let mut recording = Recording::new(names, 2);
        recording.push(0.0, [0.0; 7]);
        let quarter = std::f64::consts::FRAC_PI_2;
        recording.push(1.0, [1.0, 2.0, quarter, 0.0, 0.0, quarter, 1.0]);
        let hanging = Pose::at(scenario, &recording, 0).unwrap();
        assert!((hanging.joints[3] - vec2(0.0, -0.39)).norm() < 1e-12);
        // Rolled to the left by a quarter turn, the arm points right, and its last link up.
        let turned = Pose::at(scenario, &recording, 1).unwrap();
        assert!((turned.joints[3] - vec2(1.26, 2.13)).norm() < 1e-12);
        assert!(turned.attached);
        assert_eq!(Pose::capture(scenario, &recording), Ok(Some(turned.hand)));
    }
}
