//! The mass properties of an aerial manipulator with `N` coordinates, ready for the equations of motion.
//!
//! Coordinates: the joint angles of `links` revolute links from the UAV outwards and, if something balances
//! the arm, its position as the last coordinate.

use crate::error::{Error, Result};
use crate::mechanics::planar::{Vec2, vec2};
use crate::parameters::{Balance, Parameters, Structure};

/// Mass moments of a body about its own joint, along the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass \[kg\].
    pub mass: f64,
    /// First moment: mass times distance of the centre of mass from the joint \[kg m\].
    pub first: f64,
    /// Second moment: moment of inertia about the joint \[kg m2\].
    pub second: f64,
}

impl Body {
    const NOTHING: Self = Self { mass: 0.0, first: 0.0, second: 0.0 };

    /// A body with a centre of mass at distance `com` from the joint, and `inertia` about it.
    fn new(mass: f64, com: f64, inertia: f64) -> Self {
        Self { mass, first: mass * com, second: inertia + mass * com * com }
    }

    /// This body with `other` fixed to it.
    fn with(self, other: Self) -> Self {
        Self { mass: self.mass + other.mass, first: self.first + other.first, second: self.second + other.second }
    }
}

/// The links and what follows from them and all other masses for sums over the vehicle.
#[derive(Debug, Clone, Copy)]
pub struct Masses<const N: usize> {
    /// The links.
    pub links: [Body; N],
    /// The augmented links: each with the mass of all links outboard of it placed at its tip.
    pub augmented: [Body; N],
    /// Mass of the whole system \[kg\].
    pub whole: f64,
    /// Inverse mass of the whole system \[1/kg\].
    pub inverse_mass: f64,
}

impl<const N: usize> Masses<N> {
    #[inline(never)]
    fn new(links: [Body; N], length: &[f64; N], others: f64) -> Self {
        let (mut augmented, mut outboard) = (links, 0.0);
        for (body, length) in augmented.iter_mut().zip(length).rev() {
            let mass = body.mass;
            *body = body.with(Body::new(outboard, *length, 0.0));
            outboard += mass;
        }
        let whole = outboard + others;
        Self { links, augmented, whole, inverse_mass: 1.0 / whole }
    }
}

/// A counterweight that slides along the UAV's x axis without turning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about its own centre of mass \[kg m2\].
    pub inertia: f64,
    /// Height in the UAV frame \[m\].
    pub height: f64,
}

/// What balances the arm, as the last coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Balancer {
    /// Slides.
    Counterweight(Slider),
    /// Turns about the UAV's centre of mass.
    Element(Body),
}

/// Constants of an aerial manipulator with `N` coordinates.
#[derive(Debug, Clone, Copy)]
pub struct Vehicle<const N: usize> {
    /// Number of revolute links of the arm: `N`, or `N - 1` if something balances it.
    pub links: usize,
    /// 1 for a joint of the arm, 0 for what balances it.
    ///
    /// In sums over the arm its place is taken by a link without mass, length and joint: loops over all `N`
    /// then have a length that the compiler knows, which halves their cost.
    pub revolute: [f64; N],
    /// Acceleration of gravity \[m/s2\].
    pub gravity: f64,
    /// Mass of the UAV alone \[kg\].
    pub uav_mass: f64,
    /// Inertia of the UAV alone about its centre of mass \[kg m2\].
    pub uav_inertia: f64,
    /// First joint in the UAV frame \[m\].
    pub mount: Vec2,
    /// Lengths of the links \[m\].
    pub length: [f64; N],
    /// What balances the arm, if anything.
    pub balancer: Option<Balancer>,
    /// Mass of the payload \[kg\].
    pub payload_mass: f64,
    /// Distance of the held payload from the last joint \[m\].
    pub payload_com: f64,
    /// Largest distance of the held payload from any joint, and from the UAV's centre of mass \[m\].
    pub payload_reach: f64,
    empty: Masses<N>,
    loaded: Masses<N>,
}

impl Balancer {
    fn new(balance: Balance, parameters: &Parameters) -> Option<Self> {
        match balance {
            Balance::None => None,
            Balance::Counterweight => {
                let body = &parameters.counterweight;
                Some(Self::Counterweight(Slider { mass: body.mass, inertia: body.inertia, height: body.height }))
            }
            Balance::Element => {
                let body = &parameters.balance_element;
                Some(Self::Element(Body::new(body.mass, body.com, body.inertia)))
            }
        }
    }

    fn mass(&self) -> f64 {
        match self {
            Self::Counterweight(slider) => slider.mass,
            Self::Element(body) => body.mass,
        }
    }
}

impl<const N: usize> Vehicle<N> {
    /// Takes the mass properties out of `parameters`.
    ///
    /// # Errors
    /// If `structure` does not have `N` coordinates.
    pub fn new(structure: Structure, parameters: &Parameters) -> Result<Self> {
        let links = structure.links;
        if structure.coordinates() != N {
            return Err(Error::Inconsistent {
                name: "structure".to_owned(),
                expected: format!("{N} coordinates"),
                found: structure.to_string(),
            });
        }
        let mount = vec2(parameters.mount.x, parameters.mount.y);
        let payload = &parameters.payload;
        let mut empty = [Body::NOTHING; N];
        let mut length = [0.0; N];
        for (i, link) in parameters.links.iter().enumerate().take(links) {
            empty[i] = Body::new(link.mass, link.com, link.inertia);
            length[i] = link.length;
        }
        let mut loaded = empty;
        loaded[links - 1] = empty[links - 1].with(Body::new(payload.mass, payload.com, 0.0));
        let balancer = Balancer::new(structure.balance, parameters);
        let others = parameters.uav.mass + balancer.map_or(0.0, |balancer| balancer.mass());
        Ok(Self {
            links,
            revolute: std::array::from_fn(|i| if i < links { 1.0 } else { 0.0 }),
            gravity: parameters.gravity,
            uav_mass: parameters.uav.mass,
            uav_inertia: parameters.uav.inertia,
            mount,
            length,
            balancer,
            payload_mass: payload.mass,
            payload_com: payload.com,
            payload_reach: reach(mount, &length) + payload.com.abs(),
            empty: Masses::new(empty, &length, others),
            loaded: Masses::new(loaded, &length, others),
        })
    }

    /// All masses, the payload's with the last link's if it is `held`.
    #[inline]
    #[must_use]
    pub fn masses(&self, held: bool) -> &Masses<N> {
        if held { &self.loaded } else { &self.empty }
    }

    /// Mass of UAV, arm and what balances it, without the payload \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.empty.whole
    }

    /// Mass of the arm and what balances it, without the payload \[kg\].
    #[must_use]
    pub fn carried_mass(&self) -> f64 {
        self.empty.whole - self.uav_mass
    }

    /// Largest distance of a point of the stretched arm from the UAV's centre of mass \[m\].
    #[must_use]
    pub fn reach(&self) -> f64 {
        reach(self.mount, &self.length)
    }
}

// One copy for all numbers of coordinates.
#[inline(never)]
fn reach(mount: Vec2, length: &[f64]) -> f64 {
    mount.norm() + length.iter().sum::<f64>()
}
