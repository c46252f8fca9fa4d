//! The numbers behind the verdict, in sentences.

use crate::study::check::hover::Mode;
use crate::study::check::{Demand, Drift, Imbalance, Report};
use crate::study::own_vehicle::three_digits;
use uam::autopilot::AutopilotMode;
use uam::parameters::Resolution;
use uam::scenarios::Scenario;
use uam::variables::options::Choice;

/// Drifts \[m/s, m/s2\] and moments \[N m\] below this are rounding.
const NOTHING: f64 = 1e-6;
/// Stops farther away than this are none \[rad\].
const FAR: f64 = std::f64::consts::TAU;

/// One paragraph a subject.
pub fn sentences(scenario: &Scenario, report: &Report) -> Vec<String> {
    vec![balance(scenario, report), arm(report), hover(scenario, report), path(scenario, report)]
}

/// Where an imbalance leads in the end.
pub fn drift(imbalance: &Imbalance, resolution: Resolution) -> String {
    let side = |value: f64| if value < 0.0 { "to the left" } else { "to the right" };
    let how = match imbalance.drift {
        Drift::Held => return "The ideal autopilot holds the roll against it.".to_owned(),
        Drift::Unknown => return "What follows is up to the external autopilot.".to_owned(),
        Drift::Tumbles if imbalance.moment.abs() < NOTHING => return "Nothing brings a roll back.".to_owned(),
        Drift::Tumbles => return "Nothing brings the roll back: the UAV tumbles.".to_owned(),
        Drift::Speed(rate) | Drift::Acceleration(rate) if rate.abs() < NOTHING => {
            return "Nobody holds the horizontal position, but nothing drives the UAV away from the start either."
                .to_owned();
        }
        Drift::Speed(v) => format!(
            "would go on drifting {} at {:?} m/s, {:.3} m in ten seconds",
            side(v),
            three_digits(v.abs()),
            10.0 * v.abs()
        ),
        Drift::Acceleration(a) => format!(
            "would go {} with {:?} m/s2, {:.3} m in ten seconds, for without autopilot.roll.ki the roll stays",
            side(a),
            three_digits(a.abs()),
            50.0 * a.abs()
        ),
    };
    // What simulations show; see the tests of the command line.
    let instead = match resolution {
        Resolution::MinimumNorm | Resolution::Gradient => {
            "keeps the hand in place and so leans the arm while the UAV drifts"
        }
        _ => "swings what it can into balance",
    };
    format!(
        "Nobody holds the horizontal position: with resting joints the UAV {how}; the resolution {} {instead}, which usually \
         brings it to rest somewhere else.",
        resolution.name()
    )
}

fn balance(scenario: &Scenario, report: &Report) -> String {
    let imbalance = &report.imbalance;
    let moment = if imbalance.moment.abs() < NOTHING { 0.0 } else { three_digits(imbalance.moment) };
    let roll = imbalance
        .roll
        .map_or_else(String::new, |roll| format!(", which rolls the UAV by {:.3} degrees at most", roll.to_degrees()));
    let mut text = format!(
        "Balance: what the UAV carries gives a moment of {moment:?} N m about the UAV's centre of mass{roll}. {}",
        drift(imbalance, scenario.parameters.ik.resolution)
    );
    if moment == 0.0 {
        return text;
    }
    let mut starts: Vec<String> = Vec::new();
    starts.extend(imbalance.joints.first().map(|(n, angle)| format!("\"joint[{n}].start\" = {angle:.6} (rad)")));
    starts.extend(imbalance.counterweight.map(|(place, within)| {
        let remark = if within { "" } else { ", beyond its stroke" };
        format!("counterweight.start = {place:.6} (m{remark})")
    }));
    if !starts.is_empty() {
        text += &format!(" Alone would balance it: {}.", starts.join(", or "));
    }
    text
}

fn arm(report: &Report) -> String {
    let mut text = format!(
        "Arm: {:.3} m long. The smallest singular value of the end effector's Jacobian is {:.4} m at the start",
        report.reach, report.smallest_singular_value
    );
    if let Some(both) = report.with_moment {
        text += &format!(", {both:.4} m with the moment on the UAV as a third task");
    }
    text += ".";
    let nearest = report.to_stops.iter().copied().enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b));
    if let Some((i, distance)) = nearest.filter(|(_, distance)| *distance < FAR) {
        text += &format!(" Nearest to a stop is joint {}, {distance:.2} rad away.", i + 1);
    }
    text
}

fn hover(scenario: &Scenario, report: &Report) -> String {
    let Some(hover) = &report.hover else {
        return match scenario.parameters.autopilot.mode {
            AutopilotMode::Ideal => "Hover: ideal, altitude and roll are held whatever comes.",
            _ => "Hover: up to an external autopilot.",
        }
        .to_owned();
    };
    let sampled = match scenario.parameters.autopilot.sample_time {
        0.0 => "continuous".to_owned(),
        time => format!("sampled every {time} s"),
    };
    format!(
        "Hover ({sampled}; eigenvalues in 1/s, linearized): altitude {}; roll {}. Nobody holds the horizontal position.",
        modes(&hover.altitude),
        modes(&hover.roll)
    )
}

fn modes(modes: &[Mode]) -> String {
    let mode = |Mode { decay, frequency }: &Mode| {
        // Pairs are conjugate.
        let swing = if *frequency > 1e-9 { format!(" ± {frequency:.2}i") } else { String::new() };
        format!("{:.2}{swing}", -decay)
    };
    let mut texts: Vec<String> = modes.iter().map(mode).collect();
    texts.dedup();
    let least =
        modes.iter().map(|Mode { decay, frequency }| decay / decay.hypot(*frequency)).fold(f64::INFINITY, f64::min);
    format!("{} (least damping ratio {least:.2})", texts.join(", "))
}

fn path(scenario: &Scenario, report: &Report) -> String {
    let Some(Demand { farthest, nearest, speed, acceleration, .. }) = &report.demand else {
        return "Path: none, the hand is to rest or follows inputs.".to_owned();
    };
    let rates = if report.smallest_singular_value > 1e-6 * report.reach {
        format!("takes up to {:.2} rad/s at the start", speed / report.smallest_singular_value)
    } else {
        "no joint rates give at the start in every direction".to_owned()
    };
    let limits = scenario.parameters.joints[..scenario.structure.links].iter().map(|joint| joint.rate_limit);
    let lowest = limits.fold(f64::INFINITY, f64::min);
    format!(
        "Path: {:.3} m to {:.3} m from the first joint, farthest at {:.2} s, of {:.3} m that the arm is long, with the UAV \
         where it starts. Largest speed {speed:.3} m/s, which {rates} (lowest limit \
         {lowest:.2} rad/s); largest acceleration {acceleration:.3} m/s2.",
        nearest.distance, farthest.distance, farthest.time, report.reach
    )
}
