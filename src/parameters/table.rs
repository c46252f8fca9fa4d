//! The tables that name the parameters: units, bounds and descriptions.

use super::{Balance, Parameters, Structure};
use crate::reference::LEGS;
use crate::variables::Table;
use crate::variables::declare::{Part, declare};

/// Declares the parameters that both units have.
pub fn declare_shared<D: Part<Parameters>>(table: &mut Table<D>, structure: Structure) {
    declare! { table.fixed(), Parameters;
        "gravity" [METRE_PER_SECOND2 >= 0] "Acceleration of gravity, downwards"
            |p, _| p.gravity;
        "uav.mass" [KILOGRAM > 0] "Mass of the UAV alone"
            |p, _| p.uav.mass;
        "uav.inertia" [KILOGRAM_METRE2 > 0] "Roll inertia of the UAV about its centre of mass"
            |p, _| p.uav.inertia;
        "mount.x" [METRE] "First joint in the UAV frame, to the right of the UAV's centre of mass"
            |p, _| p.mount.x;
        "mount.y" [METRE] "First joint in the UAV frame, above the UAV's centre of mass"
            |p, _| p.mount.y;
    }
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.fixed().at(i), Parameters;
            "link[{n}].mass" [KILOGRAM >= 0] "Mass of link {n}"
                |p, i| p.links[i].mass;
            "link[{n}].length" [METRE > 0] "Length of link {n}, from its joint to the next joint or the end effector"
                |p, i| p.links[i].length;
            "link[{n}].com" [METRE] "Distance of the centre of mass of link {n} from its joint, along the link"
                |p, i| p.links[i].com;
            "link[{n}].inertia" [KILOGRAM_METRE2 >= 0] "Moment of inertia of link {n} about its centre of mass"
                |p, i| p.links[i].inertia;
            "joint[{n}].start" [RADIAN]
                "Angle of joint {n} at the start; at 0 the link continues the previous one (joint 1: hangs down)"
                |p, i| p.joints[i].start;
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare_counterweight(table),
        Balance::Element => declare_balance_element(table),
    }
    declare_autopilot(table);
    declare! { table.fixed(), Parameters;
        "payload.mass" [KILOGRAM >= 0] "Mass of the payload, a point"
            |p, _| p.payload.mass;
        "payload.com" [METRE] "Distance of the held payload from the last joint, along the last link"
            |p, _| p.payload.com;
        "support.stiffness" [NEWTON_PER_METRE >= 0] "Stiffness of the elastic support of the payload"
            |p, _| p.support.stiffness;
        "support.height" [METRE] "Height of the unloaded support in the inertial frame"
            |p, _| p.support.height;
    }
}

fn declare_counterweight<D: Part<Parameters>>(table: &mut Table<D>) {
    declare! { table.fixed(), Parameters;
        "counterweight.mass" [KILOGRAM >= 0] "Mass of the counterweight"
            |p, _| p.counterweight.mass;
        "counterweight.inertia" [KILOGRAM_METRE2 >= 0] "Moment of inertia of the counterweight about its centre of mass"
            |p, _| p.counterweight.inertia;
        "counterweight.height" [METRE] "Height of the counterweight in the UAV frame"
            |p, _| p.counterweight.height;
        "counterweight.start" [METRE] "Position of the counterweight along the UAV's x axis at the start"
            |p, _| p.counterweight.start;
    }
}

fn declare_balance_element<D: Part<Parameters>>(table: &mut Table<D>) {
    declare! { table.fixed(), Parameters;
        "balance_element.mass" [KILOGRAM >= 0] "Mass of the balance element, which turns about the UAV's centre of mass"
            |p, _| p.balance_element.mass;
        "balance_element.com" [METRE] "Distance of the balance element's centre of mass from its axis"
            |p, _| p.balance_element.com;
        "balance_element.inertia" [KILOGRAM_METRE2 >= 0]
            "Moment of inertia of the balance element about its centre of mass"
            |p, _| p.balance_element.inertia;
        "balance_element.start" [RADIAN]
            "Angle of the balance element at the start; at 0 its centre of mass hangs below the axis"
            |p, _| p.balance_element.start;
    }
}

fn declare_autopilot<D: Part<Parameters>>(table: &mut Table<D>) {
    declare! { table.fixed(), Parameters;
        "autopilot.mode" [choice] "How the hover is controlled"
            |p, _| p.autopilot.mode;
        "autopilot.sample_time" [SECOND >= 0] "Sample time of the autopilot; 0: evaluated continuously"
            |p, _| p.autopilot.sample_time;
    }
    declare! { table.tunable(), Parameters;
        "autopilot.altitude.kp" [NEWTON_PER_METRE >= 0] "Proportional gain of the altitude control"
            |p, _| p.autopilot.altitude.kp;
        "autopilot.altitude.ki" [NEWTON_PER_METRE_SECOND >= 0] "Integral gain of the altitude control"
            |p, _| p.autopilot.altitude.ki;
        "autopilot.altitude.kd" [NEWTON_SECOND_PER_METRE >= 0] "Derivative gain of the altitude control"
            |p, _| p.autopilot.altitude.kd;
        "autopilot.roll.kp" [NEWTON_METRE_PER_RADIAN >= 0] "Proportional gain of the roll control"
            |p, _| p.autopilot.roll.kp;
        "autopilot.roll.ki" [NEWTON_METRE_PER_RADIAN_SECOND >= 0] "Integral gain of the roll control"
            |p, _| p.autopilot.roll.ki;
        "autopilot.roll.kd" [NEWTON_METRE_SECOND_PER_RADIAN >= 0] "Derivative gain of the roll control"
            |p, _| p.autopilot.roll.kd;
    }
}

/// Declares the parameters that only the plant has.
pub fn declare_plant<D: Part<Parameters>>(table: &mut Table<D>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.fixed().at(i), Parameters;
            "joint[{n}].actuation" [choice] "What the motor of joint {n} follows"
                |p, i| p.joints[i].actuation;
        }
    }
}

/// Declares the parameters that only the controller has.
pub fn declare_controller<D: Part<Parameters>>(table: &mut Table<D>, structure: Structure) {
    declare! { table.fixed(), Parameters;
        "sample_time" [SECOND > 0]
            "Interval between two plans, in whole communication steps: rounded down, but one step at least"
            |p, _| p.ik.sample_time;
        "ik.base_model" [choice]
            "How the base is predicted to move; whatever is chosen, it is ideal under an ideal autopilot"
            |p, _| p.ik.base_model;
        "ik.resolution" [choice] "How a redundant arm chooses among the rates that follow the path"
            |p, _| p.ik.resolution;
        "ik.path_axes" [choice] "Along which axes the end effector follows the path; horizontal: for acceleration_level"
            |p, _| p.ik.path_axes;
        "ik.moment_model" [choice]
            "What the arm is taken to feel of the base's motion, in the moment that it exerts on the UAV"
            |p, _| p.ik.moment_model;
        "ik.discretization" [choice] "How the interval between two plans is predicted"
            |p, _| p.ik.discretization;
        "ik.hold" [choice] "How rates move between two plans; first_order for acceleration_level"
            |p, _| p.ik.hold;
        "payload.grasp_time" [SECOND]
            "When the payload is grasped, counted from the start; negative: held from the start"
            |p, _| p.payload.grasp_time;
    }
    declare! { table.tunable(), Parameters;
        "ik.gradient_gain" [RADIAN_PER_METRE2_SECOND]
            "With the resolution gradient: joint rates per gradient of the squared horizontal distance between the \
             centres of mass of the UAV and of what it carries; negative: towards a small distance"
            |p, _| p.ik.gradient_gain;
        "ik.rate_penalty" [NEWTON2_METRE2_SECOND_PER_RADIAN >= 0]
            "What each absolute joint rate costs beside the squared mean moment on the UAV; for least_squares"
            |p, _| p.ik.rate_penalty;
        "ik.moment_damping" [PER_SECOND >= 0]
            "Moment on the UAV per angular momentum that the rates give to what it carries: damps the free motion of \
             the arm; 0: none, as in the thesis; for extended_jacobian, least_squares and acceleration_level"
            |p, _| p.ik.moment_damping;
        "ik.moment_washout" [SECOND > 0]
            "Time constant after which a lasting motion of the arm is damped no more: else it would push the UAV \
             away"
            |p, _| p.ik.moment_washout;
    }
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.tunable().at(i), Parameters;
            "joint[{n}].rate_limit" [RADIAN_PER_SECOND > 0]
                "Largest rate commanded to joint {n}; where it binds, the second task of the resolution gives way \
                 first, then the path"
                |p, i| p.joints[i].rate_limit;
            "joint[{n}].weight" [ONE > 0]
                "Weight of joint {n} in the norm of the rates that is kept small; only ratios of weights count"
                |p, i| p.joints[i].weight;
            "joint[{n}].acceleration_limit" [RADIAN_PER_SECOND2 > 0]
                "Largest change of the rate commanded to joint {n} per time; for least_squares"
                |p, i| p.joints[i].acceleration_limit;
        }
        declare! { table.fixed().at(i), Parameters;
            "joint[{n}].lower" [RADIAN]
                "Smallest angle of joint {n}, before which it brakes in time, and to which it comes back from beyond; \
                 for least_squares, the other resolutions know no stops"
                |p, i| p.joints[i].lower;
            "joint[{n}].upper" [RADIAN]
                "Largest angle of joint {n}, before which it brakes in time, and to which it comes back from beyond; \
                 for least_squares, the other resolutions know no stops"
                |p, i| p.joints[i].upper;
        }
    }
    if structure.balance == Balance::Counterweight {
        declare! { table.tunable(), Parameters;
            "counterweight.rate_limit" [METRE_PER_SECOND >= 0]
                "Largest rate commanded to the counterweight, 0: it is locked; for least_squares, otherwise it is \
                 locked"
                |p, _| p.counterweight.rate_limit;
            "counterweight.acceleration_limit" [METRE_PER_SECOND2 > 0]
                "Largest change of the rate commanded to the counterweight per time"
                |p, _| p.counterweight.acceleration_limit;
            "counterweight.time_constant" [SECOND >= 0]
                "How fast the counterweight goes where it balances arm and payload, unless limits make it slower; \
                 short ones make it chatter, since the arm answers to its motion"
                |p, _| p.counterweight.time_constant;
        }
        declare! { table.fixed(), Parameters;
            "counterweight.stroke" [METRE >= 0]
                "How far the counterweight slides to both sides of the UAV's centre of mass"
                |p, _| p.counterweight.stroke;
        }
    }
    declare! { table.fixed(), Parameters;
        "reference.kind" [choice] "What the end effector follows"
            |p, _| p.reference.kind;
        "external_reference.instant" [choice]
            "Which instant of a communication step the values of external_reference belong to"
            |p, _| p.reference.instant;
    }
    for j in 0..LEGS {
        let n = j + 1;
        declare! { table.fixed().at(j), Parameters;
            "reference.leg[{n}].start" [SECOND >= 0] "When leg {n} begins, counted from the start"
                |p, j| p.reference.legs[j].start;
            "reference.leg[{n}].duration" [SECOND >= 0] "How long leg {n} takes; 0: no such leg"
                |p, j| p.reference.legs[j].duration;
            "reference.leg[{n}].ramp" [SECOND >= 0] "How long leg {n} accelerates, and brakes"
                |p, j| p.reference.legs[j].ramp;
            "reference.leg[{n}].dx" [METRE] "Way of leg {n} to the right"
                |p, j| p.reference.legs[j].dx;
            "reference.leg[{n}].dy" [METRE] "Way of leg {n} upwards"
                |p, j| p.reference.legs[j].dy;
            "reference.leg[{n}].profile" [choice] "Velocity in the ramps of leg {n}"
                |p, j| p.reference.legs[j].profile;
        }
    }
    declare! { table.fixed(), Parameters;
        "reference.circle.diameter" [METRE >= 0] "Diameter of the circle"
            |p, _| p.reference.circle.diameter;
        "reference.circle.duration" [SECOND > 0] "How long one turn takes, at rest before and after"
            |p, _| p.reference.circle.duration;
        "reference.circle.start_angle" [RADIAN] "Where on the circle the end effector starts; 0: rightmost"
            |p, _| p.reference.circle.start_angle;
    }
}
