//! The tables that name the parameters: units, bounds and descriptions.

use super::{Balance, Parameters, Structure};
use crate::reference::LEGS;
use crate::variables::unit;
use crate::variables::{Bounds, Table};

/// Declares the parameters that both units have.
pub fn declare_shared<D: AsMut<Parameters>>(table: &mut Table<D>, structure: Structure) {
    table
        .fixed()
        .real(
            "gravity",
            &unit::METRE_PER_SECOND2,
            Bounds::NON_NEGATIVE,
            "Acceleration of gravity, downwards",
            |d, _| &mut d.as_mut().gravity,
        )
        .real("uav.mass", &unit::KILOGRAM, Bounds::POSITIVE, "Mass of the UAV alone", |d, _| &mut d.as_mut().uav.mass)
        .real(
            "uav.inertia",
            &unit::KILOGRAM_METRE2,
            Bounds::POSITIVE,
            "Roll inertia of the UAV about its centre of mass",
            |d, _| &mut d.as_mut().uav.inertia,
        )
        .real(
            "mount.x",
            &unit::METRE,
            Bounds::ANY,
            "First joint in the UAV frame, to the right of the UAV's centre of mass",
            |d, _| &mut d.as_mut().mount.x,
        )
        .real(
            "mount.y",
            &unit::METRE,
            Bounds::ANY,
            "First joint in the UAV frame, above the UAV's centre of mass",
            |d, _| &mut d.as_mut().mount.y,
        );
    for i in 0..structure.links {
        let n = i + 1;
        table
            .fixed()
            .at(i)
            .real(
                format!("link[{n}].mass"),
                &unit::KILOGRAM,
                Bounds::NON_NEGATIVE,
                format!("Mass of link {n}"),
                |d, i| &mut d.as_mut().links[i].mass,
            )
            .real(
                format!("link[{n}].length"),
                &unit::METRE,
                Bounds::POSITIVE,
                format!("Length of link {n}, from its joint to the next joint or the end effector"),
                |d, i| &mut d.as_mut().links[i].length,
            )
            .real(
                format!("link[{n}].com"),
                &unit::METRE,
                Bounds::ANY,
                format!("Distance of the centre of mass of link {n} from its joint, along the link"),
                |d, i| &mut d.as_mut().links[i].com,
            )
            .real(
                format!("link[{n}].inertia"),
                &unit::KILOGRAM_METRE2,
                Bounds::NON_NEGATIVE,
                format!("Moment of inertia of link {n} about its centre of mass"),
                |d, i| &mut d.as_mut().links[i].inertia,
            )
            .real(
                format!("joint[{n}].start"),
                &unit::RADIAN,
                Bounds::ANY,
                format!(
                    "Angle of joint {n} at the start; at 0 the link continues the previous one (joint 1: hangs down)"
                ),
                |d, i| &mut d.as_mut().joints[i].start,
            );
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare_counterweight(table),
        Balance::Element => declare_balance_element(table),
    }
    declare_autopilot(table);
    table
        .fixed()
        .real("payload.mass", &unit::KILOGRAM, Bounds::NON_NEGATIVE, "Mass of the payload, a point", |d, _| {
            &mut d.as_mut().payload.mass
        })
        .real(
            "payload.com",
            &unit::METRE,
            Bounds::ANY,
            "Distance of the held payload from the last joint, along the last link",
            |d, _| &mut d.as_mut().payload.com,
        )
        .real(
            "support.stiffness",
            &unit::NEWTON_PER_METRE,
            Bounds::NON_NEGATIVE,
            "Stiffness of the elastic support of the payload",
            |d, _| &mut d.as_mut().support.stiffness,
        )
        .real(
            "support.height",
            &unit::METRE,
            Bounds::ANY,
            "Height of the unloaded support in the inertial frame",
            |d, _| &mut d.as_mut().support.height,
        );
}

fn declare_counterweight<D: AsMut<Parameters>>(table: &mut Table<D>) {
    table
        .fixed()
        .real("counterweight.mass", &unit::KILOGRAM, Bounds::NON_NEGATIVE, "Mass of the counterweight", |d, _| {
            &mut d.as_mut().counterweight.mass
        })
        .real(
            "counterweight.inertia",
            &unit::KILOGRAM_METRE2,
            Bounds::NON_NEGATIVE,
            "Moment of inertia of the counterweight about its centre of mass",
            |d, _| &mut d.as_mut().counterweight.inertia,
        )
        .real(
            "counterweight.height",
            &unit::METRE,
            Bounds::ANY,
            "Height of the counterweight in the UAV frame",
            |d, _| &mut d.as_mut().counterweight.height,
        )
        .real(
            "counterweight.start",
            &unit::METRE,
            Bounds::ANY,
            "Position of the counterweight along the UAV's x axis at the start",
            |d, _| &mut d.as_mut().counterweight.start,
        );
}

fn declare_balance_element<D: AsMut<Parameters>>(table: &mut Table<D>) {
    table
        .fixed()
        .real(
            "balance_element.mass",
            &unit::KILOGRAM,
            Bounds::NON_NEGATIVE,
            "Mass of the balance element, which turns about the UAV's centre of mass",
            |d, _| &mut d.as_mut().balance_element.mass,
        )
        .real(
            "balance_element.com",
            &unit::METRE,
            Bounds::ANY,
            "Distance of the balance element's centre of mass from its axis",
            |d, _| &mut d.as_mut().balance_element.com,
        )
        .real(
            "balance_element.inertia",
            &unit::KILOGRAM_METRE2,
            Bounds::NON_NEGATIVE,
            "Moment of inertia of the balance element about its centre of mass",
            |d, _| &mut d.as_mut().balance_element.inertia,
        )
        .real(
            "balance_element.start",
            &unit::RADIAN,
            Bounds::ANY,
            "Angle of the balance element at the start; at 0 its centre of mass hangs below the axis",
            |d, _| &mut d.as_mut().balance_element.start,
        );
}

fn declare_autopilot<D: AsMut<Parameters>>(table: &mut Table<D>) {
    table.fixed().choice("autopilot.mode", "How the hover is controlled", |d, _| &mut d.as_mut().autopilot.mode).real(
        "autopilot.sample_time",
        &unit::SECOND,
        Bounds::NON_NEGATIVE,
        "Sample time of the autopilot; 0: evaluated continuously",
        |d, _| &mut d.as_mut().autopilot.sample_time,
    );
    table
        .tunable()
        .real(
            "autopilot.altitude.kp",
            &unit::NEWTON_PER_METRE,
            Bounds::NON_NEGATIVE,
            "Proportional gain of the altitude control",
            |d, _| &mut d.as_mut().autopilot.altitude.kp,
        )
        .real(
            "autopilot.altitude.ki",
            &unit::NEWTON_PER_METRE_SECOND,
            Bounds::NON_NEGATIVE,
            "Integral gain of the altitude control",
            |d, _| &mut d.as_mut().autopilot.altitude.ki,
        )
        .real(
            "autopilot.altitude.kd",
            &unit::NEWTON_SECOND_PER_METRE,
            Bounds::NON_NEGATIVE,
            "Derivative gain of the altitude control",
            |d, _| &mut d.as_mut().autopilot.altitude.kd,
        )
        .real(
            "autopilot.roll.kp",
            &unit::NEWTON_METRE_PER_RADIAN,
            Bounds::NON_NEGATIVE,
            "Proportional gain of the roll control",
            |d, _| &mut d.as_mut().autopilot.roll.kp,
        )
        .real(
            "autopilot.roll.ki",
            &unit::NEWTON_METRE_PER_RADIAN_SECOND,
            Bounds::NON_NEGATIVE,
            "Integral gain of the roll control",
            |d, _| &mut d.as_mut().autopilot.roll.ki,
        )
        .real(
            "autopilot.roll.kd",
            &unit::NEWTON_METRE_SECOND_PER_RADIAN,
            Bounds::NON_NEGATIVE,
            "Derivative gain of the roll control",
            |d, _| &mut d.as_mut().autopilot.roll.kd,
        );
}

/// Declares the parameters that only the plant has.
pub fn declare_plant<D: AsMut<Parameters>>(table: &mut Table<D>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        table.fixed().at(i).choice(
            format!("joint[{n}].actuation"),
            format!("What the motor of joint {n} follows"),
            |d, i| &mut d.as_mut().joints[i].actuation,
        );
    }
}

/// Declares the parameters that only the controller has.
pub fn declare_controller<D: AsMut<Parameters>>(table: &mut Table<D>, structure: Structure) {
    table
        .fixed()
        .real(
            "sample_time",
            &unit::SECOND,
            Bounds::POSITIVE,
            "Interval between two plans, in whole communication steps: rounded down, but one step at least",
            |d, _| &mut d.as_mut().ik.sample_time,
        )
        .choice(
            "ik.base_model",
            "How the base is predicted to move; whatever is chosen, it is ideal under an ideal autopilot",
            |d, _| &mut d.as_mut().ik.base_model,
        )
        .choice("ik.resolution", "How a redundant arm chooses among the rates that follow the path", |d, _| {
            &mut d.as_mut().ik.resolution
        })
        .choice(
            "ik.path_axes",
            "Along which axes the end effector follows the path; horizontal: for acceleration_level",
            |d, _| &mut d.as_mut().ik.path_axes,
        )
        .choice(
            "ik.moment_model",
            "What the arm is taken to feel of the base's motion, in the moment that it exerts on the UAV",
            |d, _| &mut d.as_mut().ik.moment_model,
        )
        .choice("ik.discretization", "How the interval between two plans is predicted", |d, _| {
            &mut d.as_mut().ik.discretization
        })
        .choice("ik.hold", "How rates move between two plans; first_order for acceleration_level", |d, _| {
            &mut d.as_mut().ik.hold
        })
        .real(
            "payload.grasp_time",
            &unit::SECOND,
            Bounds::ANY,
            "When the payload is grasped, counted from the start; negative: held from the start",
            |d, _| &mut d.as_mut().payload.grasp_time,
        );
    table.tunable().real(
        "ik.gradient_gain",
        &unit::RADIAN_PER_METRE2_SECOND,
        Bounds::ANY,
        "With the resolution gradient: joint rates per gradient of the squared horizontal distance between the centres \
         of mass of the UAV and of what it carries; negative: towards a small distance",
        |d, _| &mut d.as_mut().ik.gradient_gain,
    )
    .real(
        "ik.rate_penalty",
        &unit::NEWTON2_METRE2_SECOND_PER_RADIAN,
        Bounds::NON_NEGATIVE,
        "What each absolute joint rate costs beside the squared mean moment on the UAV; for least_squares",
        |d, _| &mut d.as_mut().ik.rate_penalty,
    )
    .real(
        "ik.moment_damping",
        &unit::PER_SECOND,
        Bounds::NON_NEGATIVE,
        "Moment on the UAV per angular momentum that the rates give to what it carries: damps the free motion of the arm; 0: \
         none, as in the thesis; for extended_jacobian, least_squares and acceleration_level",
        |d, _| &mut d.as_mut().ik.moment_damping,
    )
    .real(
        "ik.moment_washout",
        &unit::SECOND,
        Bounds::POSITIVE,
        "Time constant after which a lasting motion of the arm is damped no more: else it would push the UAV away",
        |d, _| &mut d.as_mut().ik.moment_washout,
    );
    for i in 0..structure.links {
        let n = i + 1;
        table.tunable().at(i).real(
            format!("joint[{n}].rate_limit"),
            &unit::RADIAN_PER_SECOND,
            Bounds::POSITIVE,
            format!(
                "Largest rate commanded to joint {n}; where it binds, the second task of the resolution gives way first, \
                 then the path"
            ),
            |d, i| &mut d.as_mut().joints[i].rate_limit,
        )
            .real(
                format!("joint[{n}].weight"),
                &unit::ONE,
                Bounds::POSITIVE,
                format!(
                    "Weight of joint {n} in the norm of the rates that is kept small; only ratios of weights count"
                ),
                |d, i| &mut d.as_mut().joints[i].weight,
            )
        .real(
            format!("joint[{n}].acceleration_limit"),
            &unit::RADIAN_PER_SECOND2,
            Bounds::POSITIVE,
            format!("Largest change of the rate commanded to joint {n} per time; for least_squares"),
            |d, i| &mut d.as_mut().joints[i].acceleration_limit,
        );
        table
            .fixed()
            .at(i)
            .real(
                format!("joint[{n}].lower"),
                &unit::RADIAN,
                Bounds::ANY,
                format!(
                    "Smallest angle of joint {n}, before which it brakes in time, and to which it comes back from beyond; \
                     for least_squares, the other resolutions know no stops"
                ),
                |d, i| &mut d.as_mut().joints[i].lower,
            )
            .real(
                format!("joint[{n}].upper"),
                &unit::RADIAN,
                Bounds::ANY,
                format!(
                    "Largest angle of joint {n}, before which it brakes in time, and to which it comes back from beyond; \
                     for least_squares, the other resolutions know no stops"
                ),
                |d, i| &mut d.as_mut().joints[i].upper,
            );
    }
    if structure.balance == Balance::Counterweight {
        table
            .tunable()
            .real(
                "counterweight.rate_limit",
                &unit::METRE_PER_SECOND,
                Bounds::NON_NEGATIVE,
                "Largest rate commanded to the counterweight, 0: it is locked; for least_squares, otherwise it is locked",
                |d, _| &mut d.as_mut().counterweight.rate_limit,
            )
            .real(
                "counterweight.acceleration_limit",
                &unit::METRE_PER_SECOND2,
                Bounds::POSITIVE,
                "Largest change of the rate commanded to the counterweight per time",
                |d, _| &mut d.as_mut().counterweight.acceleration_limit,
            )
            .real(
                "counterweight.time_constant",
                &unit::SECOND,
                Bounds::NON_NEGATIVE,
                "How fast the counterweight goes where it balances arm and payload, unless limits make it slower; short \
                 ones make it chatter, since the arm answers to its motion",
                |d, _| &mut d.as_mut().counterweight.time_constant,
            );
        table.fixed().real(
            "counterweight.stroke",
            &unit::METRE,
            Bounds::NON_NEGATIVE,
            "How far the counterweight slides to both sides of the UAV's centre of mass",
            |d, _| &mut d.as_mut().counterweight.stroke,
        );
    }
    table
        .fixed()
        .choice("reference.kind", "What the end effector follows", |d, _| &mut d.as_mut().reference.kind)
        .choice(
            "external_reference.instant",
            "Which instant of a communication step the values of external_reference belong to",
            |d, _| &mut d.as_mut().reference.instant,
        );
    for j in 0..LEGS {
        let n = j + 1;
        table
            .fixed()
            .at(j)
            .real(
                format!("reference.leg[{n}].start"),
                &unit::SECOND,
                Bounds::NON_NEGATIVE,
                format!("When leg {n} begins, counted from the start"),
                |d, j| &mut d.as_mut().reference.legs[j].start,
            )
            .real(
                format!("reference.leg[{n}].duration"),
                &unit::SECOND,
                Bounds::NON_NEGATIVE,
                format!("How long leg {n} takes; 0: no such leg"),
                |d, j| &mut d.as_mut().reference.legs[j].duration,
            )
            .real(
                format!("reference.leg[{n}].ramp"),
                &unit::SECOND,
                Bounds::NON_NEGATIVE,
                format!("How long leg {n} accelerates, and brakes"),
                |d, j| &mut d.as_mut().reference.legs[j].ramp,
            )
            .real(
                format!("reference.leg[{n}].dx"),
                &unit::METRE,
                Bounds::ANY,
                format!("Way of leg {n} to the right"),
                |d, j| &mut d.as_mut().reference.legs[j].dx,
            )
            .real(
                format!("reference.leg[{n}].dy"),
                &unit::METRE,
                Bounds::ANY,
                format!("Way of leg {n} upwards"),
                |d, j| &mut d.as_mut().reference.legs[j].dy,
            )
            .choice(format!("reference.leg[{n}].profile"), format!("Velocity in the ramps of leg {n}"), |d, j| {
                &mut d.as_mut().reference.legs[j].profile
            });
    }
    table
        .fixed()
        .real("reference.circle.diameter", &unit::METRE, Bounds::NON_NEGATIVE, "Diameter of the circle", |d, _| {
            &mut d.as_mut().reference.circle.diameter
        })
        .real(
            "reference.circle.duration",
            &unit::SECOND,
            Bounds::POSITIVE,
            "How long one turn takes, at rest before and after",
            |d, _| &mut d.as_mut().reference.circle.duration,
        )
        .real(
            "reference.circle.start_angle",
            &unit::RADIAN,
            Bounds::ANY,
            "Where on the circle the end effector starts; 0: rightmost",
            |d, _| &mut d.as_mut().reference.circle.start_angle,
        );
}
