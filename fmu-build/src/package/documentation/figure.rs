//! The vehicle with its frames and symbols, as a drawing in the page.

use std::f64::consts::{FRAC_PI_2, PI};

use maud::{Markup, html};
use uam::Structure;
use uam::parameters::{Balance, MAX_LINKS};

/// A place, x to the right and y upwards \[px\]; the origin is the UAV's centre of mass.
type Place = [f64; 2];

/// Roll of the UAV in the drawing \[rad\].
const ROLL: f64 = 0.2;
/// Joint angles of the drawn arm \[rad\].
const ANGLES: [f64; MAX_LINKS] = [0.55, -1.1, 0.95, -0.9, 0.85, -0.8];
/// Half the width of the UAV.
const HALF_WIDTH: f64 = 120.0;
/// Length of the whole arm.
const REACH: f64 = 250.0;
/// The first joint in the UAV's frame.
const MOUNT: Place = [0.0, -34.0];

/// Shows where the symbols of the text are.
pub fn vehicle(structure: Structure) -> Markup {
    let mut joint = turned(MOUNT);
    let mut angle = ROLL;
    #[allow(clippy::cast_precision_loss)] // a few links
    let length = REACH / structure.links as f64;
    let mut arm = Vec::new();
    for (number, turn) in (1..=structure.links).zip(ANGLES) {
        let end = ahead(joint, angle + turn, length);
        arm.push(html! {
            (line("dashed", joint, ahead(joint, angle, 46.0)))
            (arc(joint, 36.0, [angle - FRAC_PI_2, angle + turn - FRAC_PI_2]))
            (label(ahead(joint, angle + 0.5 * turn, 52.0), "q", &number.to_string()))
            (line("link", joint, end))
        });
        arm.push(html! { (dot("joint", joint, 7.0)) });
        (joint, angle) = (end, angle + turn);
    }
    html! {
        figure {
            svg viewBox="-330 -135 660 470" role="img" aria-label="Multicopter with arm: frames and symbols" {
                defs {
                    marker id="tip" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="7" markerHeight="7"
                        orient="auto-start-reverse" {
                        path d="M0 0L10 5L0 10z" fill="context-stroke" {}
                    }
                }
                (inertial_frame())
                (uav())
                (balance(structure.balance))
                (payload(joint))
                // What belongs to a joint lies above the links.
                @for part in &arm { (part) }
                (dot("solid", joint, 5.0))
                (label([joint[0] + 20.0, joint[1] + 12.0], "r", "ee"))
            }
            figcaption {
                "Frames and symbols. Arrows along lengths and forces point in the positive direction; an angle is "
                "positive if its arrow turns counter-clockwise."
            }
        }
    }
}

fn inertial_frame() -> Markup {
    let origin = [-290.0, -290.0];
    html! {
        (arrow("thin", origin, [-225.0, -290.0])) (label([-214.0, -290.0], "x", ""))
        (arrow("thin", origin, [-290.0, -225.0])) (label([-290.0, -212.0], "y", ""))
    }
}

fn uav() -> Markup {
    let rotor = |x: f64| {
        html! {
            (line("body", turned([x, 0.0]), turned([x, 16.0])))
            (line("body", turned([x - 38.0, 16.0]), turned([x + 38.0, 16.0])))
        }
    };
    html! {
        (line("dashed", [0.0, 0.0], [215.0, 0.0]))
        (line("dashed", [0.0, 0.0], turned([215.0, 0.0])))
        (arc([0.0, 0.0], 195.0, [0.0, ROLL]))
        (label([208.0, 21.0], "φ", ""))
        (line("body", turned([-HALF_WIDTH, 0.0]), turned([HALF_WIDTH, 0.0])))
        (line("body", [0.0, 0.0], turned(MOUNT)))
        (rotor(-HALF_WIDTH))
        (rotor(HALF_WIDTH))
        (arrow("force", turned([0.0, 14.0]), turned([0.0, 104.0])))
        (label(turned([20.0, 100.0]), "U", "1"))
        (arc_of("force", [0.0, 0.0], 36.0, [ROLL + 0.6 * PI, ROLL + 0.95 * PI]))
        (label(turned([-50.0, 34.0]), "U", "2"))
        (dot("solid", [0.0, 0.0], 6.0))
        (label([24.0, -20.0], "r", "0"))
    }
}

/// What balances the arm.
fn balance(kind: Balance) -> Markup {
    match kind {
        Balance::None => html! {},
        Balance::Counterweight => {
            let corners = [[58.0, 4.0], [98.0, 4.0], [98.0, 24.0], [58.0, 24.0]].map(turned);
            html! {
                polygon class="mass" points=(corners.map(point).join(" ")) {}
                (arrow("thin", turned([0.0, 40.0]), turned([78.0, 40.0])))
                (label(turned([56.0, 54.0]), "s", ""))
                (label(turned([112.0, 36.0]), "m", "w"))
            }
        }
        Balance::Element => {
            let end = ahead([0.0, 0.0], ROLL - 0.9, 78.0);
            html! { (line("body", [0.0, 0.0], end)) (dot("mass", end, 12.0)) }
        }
    }
}

/// The payload at the `end` of the arm, on its support.
fn payload(end: Place) -> Markup {
    let [x, y] = end;
    let zigzag = (0..=8).map(|n| {
        let side = if n == 0 || n == 8 { 0.0 } else { f64::from(n % 2) * 16.0 - 8.0 };
        [x + side, y - 12.0 - 5.0 * f64::from(n)]
    });
    let spring: Vec<_> = zigzag.map(point).collect();
    html! {
        polyline class="thin" points=(spring.join(" ")) {}
        (line("thin", [x - 34.0, y - 52.0], [x + 34.0, y - 52.0]))
        (label([x + 20.0, y - 34.0], "k", ""))
        (dot("mass", end, 12.0))
        (label([x - 34.0, y - 4.0], "m", "P"))
    }
}

/// From the UAV's frame.
fn turned([x, y]: Place) -> Place {
    let (sin, cos) = ROLL.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// The place at a distance in the direction of a link with this absolute angle.
fn ahead([x, y]: Place, angle: f64, distance: f64) -> Place {
    [x + distance * angle.sin(), y - distance * angle.cos()]
}

/// In the drawing y points downwards.
fn point([x, y]: Place) -> String {
    format!("{x:.1},{:.1}", -y)
}

fn line(class: &str, from: Place, to: Place) -> Markup {
    html! { polyline class=(class) points={ (point(from)) " " (point(to)) } {} }
}

fn arrow(class: &str, from: Place, to: Place) -> Markup {
    html! { polyline class=(class) points={ (point(from)) " " (point(to)) } marker-end="url(#tip)" {} }
}

fn arc(center: Place, radius: f64, angles: [f64; 2]) -> Markup {
    arc_of("thin", center, radius, angles)
}

/// An arc about `center` between two angles, counted from the x axis, with an arrow at its end.
fn arc_of(class: &str, [x, y]: Place, radius: f64, angles: [f64; 2]) -> Markup {
    let [from, to] = angles.map(|angle| point([x + radius * angle.cos(), y + radius * angle.sin()]));
    let clockwise = u8::from(angles[1] < angles[0]);
    let arc = format!("M{from} A{radius},{radius} 0 0 {clockwise} {to}");
    html! { path class=(class) d=(arc) marker-end="url(#tip)" {} }
}

fn dot(class: &str, [x, y]: Place, radius: f64) -> Markup {
    html! { circle class=(class) cx=(format!("{x:.1}")) cy=(format!("{:.1}", -y)) r=(radius) {} }
}

/// A symbol with its index.
fn label([x, y]: Place, symbol: &str, index: &str) -> Markup {
    html! {
        text x=(format!("{x:.1}")) y=(format!("{:.1}", -y)) text-anchor="middle" dominant-baseline="middle" {
            (symbol)
            @if !index.is_empty() { tspan dy="5" font-size="12" { (index) } }
        }
    }
}
