//! All parameters of vehicle, autopilot, payload, inverse kinematics and reference: the plain data that
//! describe a run, and the tables that name them.

use std::fmt;

use crate::autopilot::Autopilot;
use crate::error::{Error, Result};
use crate::options;
use crate::reference::Reference;
use crate::variables::{Kind, Table};

pub(crate) mod culprit;
pub mod defaults;
mod table;

pub use table::{declare_controller, declare_plant, declare_shared};

/// Largest number of revolute links of an arm.
pub const MAX_LINKS: usize = 6;
/// Largest number of coordinates: the links and what balances the arm.
pub const MAX_COORDINATES: usize = MAX_LINKS + 1;

/// What balances the arm besides the arm itself: one more coordinate, the last one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Balance {
    /// Nothing.
    None,
    /// A counterweight that slides along the UAV's x axis (thesis 3.8).
    Counterweight,
    /// A body that turns about the UAV's centre of mass (thesis 3.4).
    Element,
}

impl Balance {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::None, Self::Counterweight, Self::Element];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Counterweight => "counterweight",
            Self::Element => "balance_element",
        }
    }

    /// First part of the names of its variables, if it has any.
    #[must_use]
    pub fn prefix(self) -> Option<&'static str> {
        (self != Self::None).then(|| self.name())
    }
}

/// What is chosen when a unit is built: it fixes the list of variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Structure {
    /// Number of revolute links, 1 to [`MAX_LINKS`].
    pub links: usize,
    /// What balances the arm.
    pub balance: Balance,
}

impl Structure {
    /// Three links and nothing to balance them: the vehicle of thesis 4.3.
    pub const DEFAULT: Self = Self { links: 3, balance: Balance::None };

    /// Checks the number of links.
    ///
    /// # Errors
    /// If it is not 1 to [`MAX_LINKS`].
    pub fn new(links: usize, balance: Balance) -> Result<Self> {
        if (1..=MAX_LINKS).contains(&links) {
            Ok(Self { links, balance })
        } else {
            Err(Error::Structure { links, largest: MAX_LINKS })
        }
    }

    /// Every structure that can be built, the default first.
    pub fn all() -> impl Iterator<Item = Self> {
        let others = (1..=MAX_LINKS)
            .flat_map(|links| Balance::ALL.map(|balance| Self { links, balance }))
            .filter(|structure| *structure != Self::DEFAULT);
        std::iter::once(Self::DEFAULT).chain(others)
    }

    /// Number of coordinates: one per joint, and one for what balances the arm.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.links + usize::from(self.balance != Balance::None)
    }
}

/// Instantiates an expression for the number of coordinates of a structure: the one place where a number
/// known at run time becomes one known to the compiler.
#[macro_export]
macro_rules! for_coordinates {
    ($structure:expr, $n:ident => $body:expr) => {
        match $structure.coordinates() {
            1 => {
                const $n: usize = 1;
                $body
            }
            2 => {
                const $n: usize = 2;
                $body
            }
            3 => {
                const $n: usize = 3;
                $body
            }
            4 => {
                const $n: usize = 4;
                $body
            }
            5 => {
                const $n: usize = 5;
                $body
            }
            6 => {
                const $n: usize = 6;
                $body
            }
            7 => {
                const $n: usize = 7;
                $body
            }
            _ => Err($crate::Error::Structure { links: $structure.links, largest: $crate::parameters::MAX_LINKS }),
        }
    };
}

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} link{}", self.links, if self.links == 1 { "" } else { "s" })?;
        match self.balance {
            Balance::None => Ok(()),
            Balance::Counterweight => write!(f, " and counterweight"),
            Balance::Element => write!(f, " and balance element"),
        }
    }
}

/// Mass properties of the multicopter alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Uav {
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about the centre of mass \[kg m2\].
    pub inertia: f64,
}

/// Where the first joint sits in the UAV frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Mount {
    /// To the right of the UAV's centre of mass \[m\].
    pub x: f64,
    /// Above the UAV's centre of mass \[m\].
    pub y: f64,
}

/// One link of the arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Mass \[kg\].
    pub mass: f64,
    /// Distance to the next joint or to the end effector \[m\].
    pub length: f64,
    /// Distance of the centre of mass from the link's joint \[m\].
    pub com: f64,
    /// Moment of inertia about the link's centre of mass \[kg m2\].
    pub inertia: f64,
}

options! {
    #[doc = " What the motor of a joint follows."]
    pub enum Actuation {
        #[doc = " The commanded rate, whatever torque that takes."]
        Rate = "rate",
        #[doc = " The commanded torque; none lets the joint turn freely (thesis 3.6)."]
        Torque = "torque",
    }
}

/// One revolute joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Angle at the start \[rad\]; 0 continues the previous link, the first link hangs down.
    pub start: f64,
    /// Largest rate that the controller commands \[rad/s\].
    pub rate_limit: f64,
    /// Weight of the rate in the norm of the rates.
    pub weight: f64,
    /// Largest change of the commanded rate per time \[rad/s2\].
    pub acceleration_limit: f64,
    /// Smallest angle \[rad\].
    pub lower: f64,
    /// Largest angle \[rad\].
    pub upper: f64,
    /// What its motor follows in the plant.
    pub actuation: Actuation,
}

/// The sliding counterweight, for instance the battery (thesis 3.8).
#[derive(Debug, Clone, PartialEq)]
pub struct Counterweight {
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about its centre of mass \[kg m2\].
    pub inertia: f64,
    /// Height of its centre of mass in the UAV frame \[m\].
    pub height: f64,
    /// Position along the UAV's x axis at the start \[m\].
    pub start: f64,
    /// How far it slides to both sides \[m\].
    pub stroke: f64,
    /// Largest rate that the controller commands \[m/s\]; 0: it is locked.
    pub rate_limit: f64,
    /// Largest change of the commanded rate per time \[m/s2\].
    pub acceleration_limit: f64,
    /// How long it takes to balance the arm, as time constant \[s\].
    pub time_constant: f64,
}

/// The balance element: a body that turns about the UAV's centre of mass, for instance a disc, or a mass on
/// an arm (thesis 3.4).
#[derive(Debug, Clone, PartialEq)]
pub struct BalanceElement {
    /// Mass \[kg\].
    pub mass: f64,
    /// Distance of its centre of mass from its axis \[m\].
    pub com: f64,
    /// Moment of inertia about its centre of mass \[kg m2\].
    pub inertia: f64,
    /// Angle at the start \[rad\]; 0: its centre of mass hangs below the axis.
    pub start: f64,
}

/// A point mass that the end effector picks up.
#[derive(Debug, Clone, PartialEq)]
pub struct Payload {
    /// Mass \[kg\].
    pub mass: f64,
    /// Distance from the last joint along the last link \[m\].
    pub com: f64,
    /// When the controller closes the gripper, counted from the start \[s\].
    pub grasp_time: f64,
}

/// The elastic support on which the payload rests (thesis 4.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Stiffness \[N/m\].
    pub stiffness: f64,
    /// Height of the unloaded support \[m\].
    pub height: f64,
}

options! {
    #[doc = " How the base is predicted to move."]
    pub enum BaseModel {
        #[doc = " It slides along x and keeps its momentum: perfect control (thesis 2.1)."]
        Ideal = "ideal",
        #[doc = " It also rolls, which tilts the thrust; it keeps its altitude (thesis 2.2)."]
        HorizontalThrust = "horizontal_thrust",
        #[doc = " Its altitude follows thrust and weight, but not the arm (thesis 2.3)."]
        VerticalThrust = "vertical_thrust",
        #[doc = " The arm moves it in both directions, but does not turn with it (thesis 2.4)."]
        Translating = "translating",
        #[doc = " It moves and turns freely with the arm on it (thesis 2.5)."]
        Full = "full",
    }
}

options! {
    #[doc = " How a redundant arm chooses among the rates that follow the path."]
    pub enum Resolution {
        #[doc = " Smallest joint rates (right pseudo-inverse of the generalized Jacobian)."]
        MinimumNorm = "minimum_norm",
        #[doc = " Towards a small moment of weight (gradient projection, thesis 3.1)."]
        Gradient = "gradient",
        #[doc = " No moment on the UAV by the moment model (extended Jacobian, thesis 3.2, 3.3 and 3.6)."]
        ExtendedJacobian = "extended_jacobian",
        #[doc = " As little moment on the UAV as limits of rate, acceleration and position allow (thesis 3.7, 3.8, 4.4)."]
        LeastSquares = "least_squares",
        #[doc = " No moment on the UAV, by accelerations of arm and balance element; rates do not jump (thesis 3.4)."]
        AccelerationLevel = "acceleration_level",
    }
}

options! {
    #[doc = " Along which axes of the inertial frame the end effector follows the path."]
    pub enum PathAxes {
        #[doc = " Along x and y."]
        Both = "both",
        #[doc = " Along x, wherever that leads along y (thesis 3.4)."]
        Horizontal = "horizontal",
    }
}

impl PathAxes {
    /// How many they are.
    #[must_use]
    pub fn number(self) -> usize {
        match self {
            Self::Both => 2,
            Self::Horizontal => 1,
        }
    }
}

options! {
    #[doc = " How rates move between two plans."]
    pub enum Hold {
        #[doc = " They are constant, and jump."]
        ZeroOrder = "zero_order",
        #[doc = " They change linearly: the end effector ends the interval at the wanted velocity, too."]
        FirstOrder = "first_order",
    }
}

options! {
    #[doc = " What the arm is taken to feel of the base's motion, in the moment that it exerts on the UAV."]
    pub enum MomentModel {
        #[doc = " Nothing (thesis 3.2)."]
        FixedBase = "fixed_base",
        #[doc = " Its horizontal velocity (thesis 3.3)."]
        SlidingBase = "sliding_base",
        #[doc = " All that the base model predicts of it (thesis 3.6)."]
        FreeBase = "free_base",
    }
}

options! {
    #[doc = " How the interval between two plans is predicted."]
    pub enum Discretization {
        #[doc = " Explicit Euler for momentum, Jacobian at the old configuration: the thesis' own step."]
        Euler = "euler",
        #[doc = " The coming interval is integrated, and the rates are such that its end is on the reference."]
        Exact = "exact",
    }
}

/// Settings of the inverse kinematics.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseKinematics {
    /// Interval between two plans \[s\].
    pub sample_time: f64,
    /// Prediction of the base.
    pub base_model: BaseModel,
    /// Use of redundancy.
    pub resolution: Resolution,
    /// What of the path is followed.
    pub path_axes: PathAxes,
    /// Rates per gradient of the squared distance of centres of mass \[rad/(m2 s)\].
    pub gradient_gain: f64,
    /// Prediction of the moment on the UAV.
    pub moment_model: MomentModel,
    /// What a rate of a joint costs beside the squared moment on the UAV \[(N m)2 s/rad\].
    pub rate_penalty: f64,
    /// Moment on the UAV per angular momentum in the rates of the arm \[1/s\]; 0: its free motion is not damped.
    pub moment_damping: f64,
    /// How long a lasting angular momentum is damped, as time constant \[s\].
    pub moment_washout: f64,
    /// Prediction of the coming interval.
    pub discretization: Discretization,
    /// Rates in the coming interval.
    pub hold: Hold,
}

/// Everything that describes a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    /// Acceleration of gravity \[m/s2\].
    pub gravity: f64,
    /// The multicopter.
    pub uav: Uav,
    /// First joint in the UAV frame.
    pub mount: Mount,
    /// Links from the UAV outwards; those beyond the structure are ignored.
    pub links: [Link; MAX_LINKS],
    /// Joints from the UAV outwards.
    pub joints: [Joint; MAX_LINKS],
    /// Counterweight; ignored if the structure has none.
    pub counterweight: Counterweight,
    /// Balance element; ignored if the structure has none.
    pub balance_element: BalanceElement,
    /// Hover control.
    pub autopilot: Autopilot,
    /// Payload.
    pub payload: Payload,
    /// Support of the payload.
    pub support: Support,
    /// Inverse kinematics.
    pub ik: InverseKinematics,
    /// Wanted motion of the end effector.
    pub reference: Reference,
}

impl Parameters {
    /// The parameters of both units, each once.
    #[must_use]
    pub fn table(structure: Structure) -> Table<Self> {
        let mut table = Table::default();
        declare_shared(&mut table, structure);
        declare_controller(&mut table, structure);
        declare_plant(&mut table, structure);
        table
    }

    /// Checks every parameter of both units against its bounds.
    ///
    /// # Errors
    /// Names the first parameter out of its bounds, with what was expected and found.
    pub fn check(&self, structure: Structure) -> Result<()> {
        for variable in Self::table(structure).variables() {
            if let Kind::Real { bounds, at, .. } = variable.kind {
                let found = *at.get(self);
                if !bounds.admit(found) {
                    return Err(Error::OutOfBounds {
                        name: variable.name.clone(),
                        expected: bounds.to_string(),
                        found,
                    });
                }
            }
        }
        self.check_together(structure)
    }

    /// Checks whether parameters that are within their bounds go together.
    ///
    /// # Errors
    /// Names the first parameter that does not suit another one, with what was expected and found.
    pub fn check_together(&self, structure: Structure) -> Result<()> {
        for (i, Joint { lower, upper, .. }) in self.joints.iter().enumerate().take(structure.links) {
            if lower > upper {
                return Err(Error::Inconsistent {
                    name: format!("joint[{}].upper", i + 1),
                    expected: format!("not less than joint[{}].lower = {lower}", i + 1),
                    found: upper.to_string(),
                });
            }
        }
        self.reference.check()
    }
}
