//! What can be said of a simulation before it runs, and what in it looks like a mistake.
//!
//! Only the vehicle at its start, its gains and the wanted path are looked at; nothing is integrated. The numbers are in
//! [`Report`], what looks wrong is in its list of [`Finding`]s, each with a value to set instead. [`mistakes`] and [`facts`] say
//! both in sentences.

pub mod arm;
pub mod balance;
pub mod facts;
pub mod hover;
pub mod inputs;
pub mod mistakes;
pub mod path;
pub mod payload;
pub mod statics;

use uam::parameters::{Parameters, Resolution};
use uam::reference::ReferenceKind;
use uam::scenarios::Scenario;

pub use arm::Bend;
pub use balance::{Drift, Imbalance};
pub use hover::{Hover, Instability};
pub use inputs::{Degrees, Inherited, Source};
pub use path::{Demand, Obstacle};
pub use payload::Trap;
use statics::Statics;

/// Something that looks like a mistake, with what to set instead.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// What the UAV carries tilts it from the start on.
    Unbalanced,
    /// The arm starts at, or near, a configuration in which it cannot move its end in every direction.
    Singular(Bend),
    /// An angle that was given in degrees, by its size.
    Degrees(Degrees),
    /// Stops of these joints, from 1, which the resolution does not know.
    StopsIgnored(Vec<usize>),
    /// A coordinate that starts beyond one of its stops \[rad, m\].
    BeyondStop {
        /// Name of the parameter of the start.
        name: String,
        /// Its value.
        found: f64,
        /// The nearest value within the stops.
        nearest: f64,
    },
    /// A table of the path that nobody follows, since `reference.kind` names something else.
    TableIgnored(ReferenceKind),
    /// Values that have to come from outside, while nobody gives any.
    NeedsInput(Source),
    /// Numbers of the thesis' pick-up in a vehicle that is not the thesis'.
    Inherited(Inherited),
    /// The payload, or its support, does not go together with the arm.
    Payload(Trap),
    /// The path does not go together with the arm.
    Path(Obstacle),
    /// The hover does not come to rest with these gains.
    Unstable(Instability),
}

/// What can be said of a scenario before it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// What the UAV carries, and what it does to the UAV.
    pub imbalance: Imbalance,
    /// Smallest singular value of the end effector's Jacobian at the start \[m\].
    pub smallest_singular_value: f64,
    /// The same with the moment on the UAV as a third task, for resolutions that keep it away \[m\].
    pub with_moment: Option<f64>,
    /// Length of the stretched arm \[m\].
    pub reach: f64,
    /// Distance of each joint's start from the nearer of its stops \[rad\]; none where the resolution knows no stops.
    pub to_stops: Vec<f64>,
    /// The hover control; none for an autopilot without gains.
    pub hover: Option<Hover>,
    /// What the path asks for; none if nothing is wanted, or what is wanted comes from outside.
    pub demand: Option<Demand>,
    /// What looks wrong.
    pub findings: Vec<Finding>,
}

/// Looks at a scenario.
///
/// # Errors
/// If its parameters are out of their bounds, or do not go together.
pub fn check(scenario: &Scenario) -> uam::Result<Report> {
    let Scenario { structure, parameters: given, duration, .. } = scenario;
    let structure = *structure;
    given.check(structure)?;
    // What looks like degrees is a finding of its own; all others are about what was meant.
    let parameters = &inputs::in_radians(structure, given);
    let held_from_the_start = parameters.payload.grasp_time <= 0.0;
    let start = Statics::at_start(structure, parameters, held_from_the_start)?;
    let imbalance = Imbalance::of(structure, parameters, &start);
    let reach: f64 = parameters.links[..structure.links].iter().map(|link| link.length).sum();
    let demand = Demand::of(structure, parameters, &start, *duration);
    let hover = Hover::of(structure, parameters, *duration)?;

    let mut findings = inputs::findings(structure, given);
    findings.extend(arm::findings(structure, parameters, &start));
    findings.extend(imbalance.matters().then_some(Finding::Unbalanced));
    findings.extend(hover.iter().flat_map(|hover| &hover.instabilities).cloned().map(Finding::Unstable));
    findings.extend(payload::traps(structure, parameters, &start, *duration).into_iter().map(Finding::Payload));
    findings.extend(demand.iter().flat_map(|demand| &demand.obstacles).cloned().map(Finding::Path));
    Ok(Report {
        imbalance,
        smallest_singular_value: arm::smallest_singular_value(&start.jacobian),
        with_moment: (parameters.ik.resolution == Resolution::ExtendedJacobian)
            .then(|| arm::smallest_singular_value_with_moment(&start))
            .flatten(),
        reach,
        to_stops: arm::to_stops(structure, parameters),
        hover,
        demand,
        findings,
    })
}

/// Whether a payload is picked up, or a support pushes, within a run of this `duration` \[s\].
fn grasps(parameters: &Parameters, duration: f64) -> bool {
    parameters.payload.grasp_time < duration && (parameters.payload.mass > 0.0 || parameters.support.stiffness > 0.0)
}
