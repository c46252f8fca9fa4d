//! What users should know of the units beside their variables.

use maud::{Markup, html};

/// What both units have in common.
pub fn conventions() -> Markup {
    html! {
        h2 { "Conventions" }
        ul {
            li { "SI units; " i { "x" } " points to the right, " i { "y" } " upwards, angles count counter-clockwise." }
            li {
                "The joint angles add up: link " i { "i" } " has the angle roll + " i { "q" } sub { "1" } " + … + "
                i { "q" } sub { i { "i" } } " and hangs straight down where that is 0."
            }
            li {
                "The UAV's frame has its origin in the UAV's centre of mass; the UAV starts in the origin of the "
                "inertial frame, at rest. A counterweight slides along the UAV's " i { "x" } " axis; a balance element "
                "turns about the UAV's centre of mass and hangs below it where its angle is 0."
            }
            li { "Times in parameters count from the start of the simulation." }
            li {
                "Any communication step is accepted. No output depends on an input at the same communication point, "
                "so connections in both directions make no algebraic loop."
            }
            li {
                "All continuous outputs have a first derivative for hosts that extrapolate: the left limit, or 0 for "
                "what is a mean over a step or held for one."
            }
            li {
                "The state can be got, set and serialized at any time. It can be set into another instance of the same "
                "structure as long as the instance that gave it lives; as bytes, it outlives the process. Bytes of "
                "another version of the unit are refused."
            }
        }
    }
}

/// The controller.
pub fn controller() -> Markup {
    html! {
        h2 { "What it does" }
        p {
            "The multicopter hovers and gives way when the arm moves. The controller predicts momentum and motion of "
            "the whole system under the autopilot's forces and chooses joint rates that bring the end effector, not "
            "just the arm, where the path wants it (generalized Jacobian with external momentum). Joints beyond the "
            "two that the path needs keep the moment on the UAV at zero, or the rates small; the parameter "
            code { "ik.resolution" } " decides."
        }
        h2 { "How to connect it" }
        p {
            "It plans: the outputs at a communication point are the rates for the coming interval, from the end of "
            "initialization on. Connect " code { "joint[i].rate_command" } ", " code { "counterweight.rate_command" }
            " and " code { "grasp" } " to whatever moves the arm: the inputs of the same names of "
            code { "uam_plant" } ", a model of another tool, or a robot. Hold the rates until the next communication "
            "point, or with " code { "ik.hold" } " = " code { "first_order" } " let them change by "
            code { "joint[i].acceleration_command" } ". Run both units in parallel, or the plant first."
        }
        p {
            "The start values are a complete payload pick-up of 30 s. For your own vehicle set the parameters of both "
            "units to the same values; for your own path set " code { "reference.kind" } " to " code { "external" }
            " and feed " code { "external_reference" } "."
        }
    }
}

/// The plant.
pub fn plant() -> Markup {
    html! {
        h2 { "What it does" }
        p {
            "A multicopter in a vertical plane carries an arm. Each joint follows a rate, or a torque if "
            code { "joint[i].actuation" } " says so: without torque it turns freely. The states are the pose of "
            "the UAV and the momentum of the whole system: rates may jump from one step to the next, the UAV's "
            "velocity then jumps with them, and momentum is conserved. The autopilot that keeps the hover is "
            "included. At the rising edge of " code { "grasp" } " the arm takes over the payload, at rest, from an "
            "elastic support, which lets go of it once it is lifted."
        }
        h2 { "How to connect it" }
        p {
            "Connect " code { "joint[i].rate_command" } ", " code { "counterweight.rate_command" } " and "
            code { "grasp" } " to a controller: the outputs of the same names of " code { "uam_controller" }
            ", or your own. A rate is held over the communication step; " code { "joint[i].acceleration_command" }
            " gives it a slope. All other inputs may stay unconnected."
        }
        p {
            "Hosts that interpolate may give first derivatives of all continuous inputs for the coming step: inputs "
            "then change linearly within it. Given for a rate, a derivative replaces the acceleration command in "
            "that step; derivatives of acceleration commands have no effect."
        }
        p {
            "Outputs are left limits: what is true at the end of the finished step, under the rates held in it. "
            "Forces, moments and torques are means over that step, so that jumps of the rates count."
        }
    }
}
