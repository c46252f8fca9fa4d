//! The vehicle as a list of rigid bodies, straight from the conventions: roll counter-clockwise, link i at
//! the absolute angle roll + q_1 + ... + q_i pointing along (sin, -cos) of it. Velocities are differences of
//! positions; there are no Jacobians and no momentum matrices here.

use nalgebra::{Vector2, Vector3};
use uam::parameters::Balance;
use uam::plant::Outputs;
use uam::{Parameters, Structure};

use super::derivative;

/// What a body belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Part {
    Uav,
    Link(usize),
    Counterweight,
    BalanceElement,
    Payload,
}

/// A rigid body in motion, inertial frame.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    pub part: Part,
    pub mass: f64,
    pub inertia: f64,
    pub place: Vector2<f64>,
    pub velocity: Vector2<f64>,
    pub spin: f64,
}

/// Generalized coordinates: pose of the UAV, then joints, then what balances the arm.
#[derive(Debug, Clone)]
pub struct Coordinates {
    pub pose: Vector3<f64>,
    pub q: Vec<f64>,
}

#[derive(Debug, Clone)]
pub struct Model {
    pub structure: Structure,
    pub parameters: Parameters,
}

pub fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

impl Model {
    /// Joints 1 to n, then the end effector.
    pub fn joints(&self, at: &Coordinates) -> Vec<Vector2<f64>> {
        let (mut place, mut angle) = (self.in_uav(at, self.parameters.mount.x, self.parameters.mount.y), at.pose.z);
        let mut joints = vec![place];
        for i in 0..self.structure.links {
            angle += at.q[i];
            place += self.parameters.links[i].length * Vector2::new(angle.sin(), -angle.cos());
            joints.push(place);
        }
        joints
    }

    /// Whether this coordinate is that of a counterweight.
    pub fn slides(&self, coordinate: usize) -> bool {
        coordinate == self.structure.links && self.structure.balance == Balance::Counterweight
    }

    /// The axis about which this coordinate turns.
    pub fn axis(&self, at: &Coordinates, coordinate: usize) -> Vector2<f64> {
        if coordinate == self.structure.links { at.pose.xy() } else { self.joints(at)[coordinate] }
    }

    pub fn end_effector(&self, at: &Coordinates) -> Vector2<f64> {
        self.joints(at)[self.structure.links]
    }

    pub fn payload(&self, at: &Coordinates) -> Vector2<f64> {
        self.on_link(at, self.structure.links - 1, self.parameters.payload.com)
    }

    fn in_uav(&self, at: &Coordinates, x: f64, y: f64) -> Vector2<f64> {
        let (sin, cos) = at.pose.z.sin_cos();
        Vector2::new(at.pose.x + x * cos - y * sin, at.pose.y + x * sin + y * cos)
    }

    fn on_link(&self, at: &Coordinates, link: usize, distance: f64) -> Vector2<f64> {
        let angle = at.pose.z + at.q[..=link].iter().sum::<f64>();
        self.joints(at)[link] + distance * Vector2::new(angle.sin(), -angle.cos())
    }

    /// Centre of mass of a part.
    fn place(&self, part: Part, at: &Coordinates) -> Vector2<f64> {
        match part {
            Part::Uav => at.pose.xy(),
            Part::Link(i) => self.on_link(at, i, self.parameters.links[i].com),
            Part::Counterweight => self.in_uav(at, at.q[self.structure.links], self.parameters.counterweight.height),
            Part::BalanceElement => {
                let angle = at.pose.z + at.q[self.structure.links];
                at.pose.xy() + self.parameters.balance_element.com * Vector2::new(angle.sin(), -angle.cos())
            }
            Part::Payload => self.payload(at),
        }
    }

    fn parts(&self, held: bool) -> Vec<(Part, f64, f64)> {
        let p = &self.parameters;
        let mut parts = vec![(Part::Uav, p.uav.mass, p.uav.inertia)];
        parts.extend((0..self.structure.links).map(|i| (Part::Link(i), p.links[i].mass, p.links[i].inertia)));
        match self.structure.balance {
            Balance::None => {}
            Balance::Counterweight => parts.push((Part::Counterweight, p.counterweight.mass, p.counterweight.inertia)),
            Balance::Element => {
                parts.push((Part::BalanceElement, p.balance_element.mass, p.balance_element.inertia));
            }
        }
        if held {
            parts.push((Part::Payload, p.payload.mass, 0.0));
        }
        parts
    }

    /// All bodies, with velocities by differences along the motion `at` + s * `speed`.
    pub fn bodies(&self, at: &Coordinates, speed: &Coordinates, held: bool) -> Vec<Body> {
        let body = |(part, mass, inertia)| Body {
            part,
            mass,
            inertia,
            place: self.place(part, at),
            velocity: derivative(|s| self.place(part, &at.moved(speed, s))),
            spin: match part {
                Part::Link(i) => speed.pose.z + speed.q[..=i].iter().sum::<f64>(),
                Part::BalanceElement => speed.pose.z + speed.q[self.structure.links],
                _ => speed.pose.z,
            },
        };
        self.parts(held).into_iter().map(body).collect()
    }

    /// Velocity of the point that `point` computes.
    pub fn velocity_of(
        &self,
        at: &Coordinates,
        speed: &Coordinates,
        point: impl Fn(&Self, &Coordinates) -> Vector2<f64>,
    ) -> Vector2<f64> {
        derivative(|s| point(self, &at.moved(speed, s)))
    }

    pub fn gravity(&self) -> f64 {
        self.parameters.gravity
    }

    /// Kinetic energy, energy of weight and energy of the support.
    pub fn energy(&self, outputs: &Outputs) -> f64 {
        let bodies = self.observed(outputs, outputs.attached);
        let moving: f64 = bodies
            .iter()
            .map(|b| {
                0.5 * b.mass * b.velocity.norm_squared()
                    + 0.5 * b.inertia * b.spin * b.spin
                    + b.mass * self.gravity() * b.place.y
            })
            .sum();
        let pressed = if outputs.attached { self.pressed(outputs) } else { 0.0 };
        moving + 0.5 * self.parameters.support.stiffness * pressed * pressed
    }

    /// How far the held payload presses the support in.
    pub fn pressed(&self, outputs: &Outputs) -> f64 {
        (self.parameters.support.height - self.payload(&self.coordinates(outputs)).y).max(0.0)
    }

    pub fn coordinates(&self, outputs: &Outputs) -> Coordinates {
        Coordinates { pose: outputs.pose, q: outputs.position[..self.structure.coordinates()].to_vec() }
    }

    pub fn speed(&self, outputs: &Outputs) -> Coordinates {
        Coordinates { pose: outputs.velocity, q: outputs.rate[..self.structure.coordinates()].to_vec() }
    }

    /// All bodies as observed, with the payload if `held`.
    pub fn observed(&self, outputs: &Outputs, held: bool) -> Vec<Body> {
        self.bodies(&self.coordinates(outputs), &self.speed(outputs), held)
    }
}

impl Coordinates {
    pub fn moved(&self, speed: &Self, s: f64) -> Self {
        Self { pose: self.pose + speed.pose * s, q: self.q.iter().zip(&speed.q).map(|(q, v)| q + v * s).collect() }
    }
}

pub fn mass(bodies: &[Body]) -> f64 {
    bodies.iter().map(|b| b.mass).sum()
}

pub fn center_of_mass(bodies: &[Body]) -> Vector2<f64> {
    bodies.iter().map(|b| b.place * b.mass).sum::<Vector2<f64>>() / mass(bodies)
}

pub fn momentum(bodies: &[Body]) -> Vector2<f64> {
    bodies.iter().map(|b| b.velocity * b.mass).sum()
}

/// Angular momentum of absolute velocities about the point `about`.
pub fn angular_momentum(bodies: &[Body], about: Vector2<f64>) -> f64 {
    bodies.iter().map(|b| cross(b.place - about, b.velocity) * b.mass + b.inertia * b.spin).sum()
}

/// Moment of the weights about the point `about`.
pub fn weight_moment(bodies: &[Body], gravity: f64, about: Vector2<f64>) -> f64 {
    bodies.iter().map(|b| -(b.place - about).x * b.mass * gravity).sum()
}

impl Part {
    /// Whether this coordinate moves this part on the UAV.
    pub fn is_moved_by(self, coordinate: usize, structure: Structure) -> bool {
        match self {
            Self::Uav => false,
            Self::Link(i) => i >= coordinate,
            Self::Payload => coordinate < structure.links,
            Self::Counterweight | Self::BalanceElement => coordinate == structure.links,
        }
    }
}
