//! Wanted motions.

use uam::mechanics::planar::{Rotation, Vec2};
use uam::parameters::PathAxes;
use uam::reference::{Circle, Leg, Profile, Reference, ReferenceKind, Target};
use uam::{Parameters, Structure};

use super::Draw;

/// Up to three jumps of this size are made good before a rest has ended \[m\]: what is left over is at 0.2 m/s.
const SHORT: f64 = 0.1;

/// A wanted motion that comes from outside.
#[derive(Debug, Clone)]
pub struct External {
    /// A path from the starting point.
    path: Reference,
    /// When it jumps, and by how much, to the right and upwards \[s, m\].
    jumps: Vec<(f64, [f64; 2])>,
}

impl External {
    /// The wanted motion at time `t` \[s\] from the start, for an end effector that starts at `origin` \[m\].
    pub fn at(&self, origin: Vec2, t: f64) -> Target {
        let mut target = self.path.at(t);
        target.displacement += origin;
        for (_, [dx, dy]) in self.jumps.iter().filter(|(time, _)| t >= *time) {
            target.displacement += Vec2::new(*dx, *dy);
        }
        target
    }

    /// Whether it jumps anywhere.
    pub fn jumps(&self) -> bool {
        !self.jumps.is_empty()
    }
}

/// What is followed.
pub struct Path {
    /// Where it comes from outside: what.
    pub external: Option<External>,
    /// From when on it is at rest \[s\]; infinite: it may move to the end.
    pub at_rest: f64,
}

/// A path for the vehicle of `p` in a run of `duration` \[s\], of which it rests the last `rest` \[s\].
pub fn draw(draw: &mut Draw, structure: Structure, p: &mut Parameters, duration: f64, rest: f64) -> Path {
    let moving = duration - rest;
    let reach: f64 = p.links[..structure.links].iter().map(|link| link.length).sum();
    let external = draw.percent(25);
    let reference = &mut p.reference;
    reference.legs = [Leg::NONE; _];
    if !external && draw.percent(12) {
        reference.kind = ReferenceKind::Circle;
        reference.circle = Circle {
            diameter: reach * draw.scale(0.02, 0.5),
            duration: if rest > 0.0 { moving } else { draw.between(0.6, 1.5) * moving.min(3.0) },
            start_angle: draw.about_zero(3.0),
        };
    } else {
        legs(draw, reference, reach, moving);
    }
    if p.ik.path_axes == PathAxes::Horizontal {
        reference.legs.iter_mut().for_each(|leg| leg.dy = 0.0);
    }
    let external =
        external.then(|| External { path: reference.clone(), jumps: jumps(draw, reach, moving, rest > 0.0) });
    if external.is_some() {
        reference.kind = ReferenceKind::External;
    } else if reference.kind != ReferenceKind::Circle {
        reference.kind = ReferenceKind::Path;
    }
    Path { external, at_rest: if rest > 0.0 { moving } else { f64::INFINITY } }
}

/// There, and mostly somewhere else, or back.
fn legs(draw: &mut Draw, reference: &mut Reference, reach: f64, moving: f64) {
    reference.kind = ReferenceKind::Path;
    let far = draw.percent(15);
    let count = 1 + draw.below(3);
    let share = moving.min(6.0) / count as f64;
    let mut before = Vec2::zeros();
    for (i, leg) in reference.legs.iter_mut().enumerate().take(count) {
        let size = reach * if far { draw.between(0.5, 1.5) } else { draw.scale(0.01, 0.5) };
        let way = if i > 0 && draw.percent(50) {
            -before
        } else {
            Rotation::by(draw.about_zero(std::f64::consts::PI)).down() * size
        };
        let duration = share * draw.between(0.3, 0.99);
        let profile = draw.weighed(&[(3, Profile::Smooth), (1, Profile::Trapezoidal)]);
        let ramp = duration * draw.between(0.15, 0.5);
        *leg = Leg { start: share * i as f64, duration, ramp, dx: way.x, dy: way.y, profile };
        before = way;
    }
}

/// Mostly none; before a rest so short that they are made good in it.
fn jumps(draw: &mut Draw, reach: f64, moving: f64, rests: bool) -> Vec<(f64, [f64; 2])> {
    let count = draw.weighed(&[(5, 0), (2, 1), (1, 3)]);
    (0..count)
        .map(|_| {
            let size = reach * draw.scale(0.01, 0.4);
            let size = if rests { size.min(SHORT) } else { size };
            let way = Rotation::by(draw.about_zero(std::f64::consts::PI)).down() * size;
            (draw.between(0.1, 0.99) * moving, [way.x, way.y])
        })
        .collect()
}
