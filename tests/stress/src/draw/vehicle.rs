//! Vehicles: some as in the thesis, most with nothing symmetric about them, all with an autopilot that keeps them up.

use uam::autopilot::{AutopilotMode, Gains};
use uam::parameters::{BalanceElement, Counterweight, Link, Uav};
use uam::scenarios::default_parameters;
use uam::{Parameters, Structure};

use super::Draw;

/// Mass \[kg\] and moment of inertia with a folded arm \[kg m2\] of the thesis' vehicle, for which its gains are.
const THESIS: (f64, f64) = (7.2, 0.45);

/// A vehicle; its arm hangs at the angles of the start values.
pub fn draw(draw: &mut Draw, structure: Structure) -> Parameters {
    let mut p = default_parameters(structure);
    if draw.percent(85) {
        masses(draw, structure, &mut p);
    }
    p.gravity = draw.weighed(&[(16, 9.81), (1, 3.7), (2, 1.62), (1, 0.2)]);
    autopilot(draw, structure, &mut p);
    p
}

fn masses(draw: &mut Draw, structure: Structure, p: &mut Parameters) {
    let mass = draw.scale(0.8, 8.0);
    let radius = draw.between(0.12, 0.4);
    p.uav = Uav { mass, inertia: mass * radius * radius };
    (p.mount.x, p.mount.y) = match draw.below(4) {
        0 | 1 => (0.0, 0.0),
        2 => (0.0, draw.about_zero(0.1)),
        _ => (draw.about_zero(0.08), draw.about_zero(0.1)),
    };
    let share = draw.scale(0.05, 1.0) / structure.links as f64;
    let shifted = draw.percent(30);
    for link in &mut p.links {
        let length = draw.scale(0.05, 0.35);
        let mass = share * mass * draw.between(0.4, 1.6);
        let com = length * if shifted { draw.between(-0.1, 1.1) } else { draw.between(0.3, 0.7) };
        *link = Link { mass, length, com, inertia: mass * length * length / 12.0 * draw.between(0.5, 2.0) };
    }
    let body = share * mass * draw.between(0.3, 2.0);
    p.counterweight = Counterweight {
        mass: body,
        inertia: body * 1e-3,
        height: draw.about_zero(0.08),
        start: if draw.percent(50) { 0.0 } else { draw.about_zero(0.05) },
        ..p.counterweight
    };
    p.balance_element = BalanceElement {
        mass: body,
        com: if draw.percent(50) { 0.0 } else { draw.about_zero(0.1) },
        inertia: body * draw.scale(1e-3, 1e-2),
        start: draw.about_zero(3.0),
    };
    p.payload.mass = p.uav.mass * draw.scale(0.01, 0.25);
}

/// Gains of the thesis, for this mass and this moment of inertia, at up to twice its pace and with no less damping.
fn autopilot(draw: &mut Draw, structure: Structure, p: &mut Parameters) {
    let links = &p.links[..structure.links];
    let arm: f64 = links.iter().map(|link| link.mass).sum();
    let reach: f64 = links.iter().map(|link| link.length).sum();
    let (mass, inertia) = (p.uav.mass + arm, p.uav.inertia + 0.1 * arm * reach * reach);
    let mut paced = |gains: Gains, size: f64| {
        let pace = draw.between(0.7, 2.0);
        Gains {
            kp: gains.kp * size * pace * pace,
            ki: gains.ki * size * pace * pace * draw.between(0.0, 1.0),
            kd: gains.kd * size * pace * draw.between(1.0, 3.0),
        }
    };
    p.autopilot.altitude = paced(p.autopilot.altitude, mass / THESIS.0);
    p.autopilot.roll = paced(p.autopilot.roll, inertia / THESIS.1);
    p.autopilot.sample_time = draw.weighed(&[(15, 0.0), (1, 1e-3), (1, 2e-3), (1, 5e-3), (1, 1e-2)]);
    p.autopilot.mode = draw.weighed(&[(15, AutopilotMode::Pid), (1, AutopilotMode::Ideal)]);
}
