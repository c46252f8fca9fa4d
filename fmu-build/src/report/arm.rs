//! The vehicle drawn at some instants.

use std::fmt::Write;

use maud::{Markup, html};
use uam::mechanics::planar::{Rotation, Vec2, vec2};
use uam::reference::ReferenceKind;

use super::Series;
use super::decimate::envelope;
use super::pose::Pose;
use crate::host::record::NotRecorded;
use crate::host::run::Run;

/// Half the width of the drawn UAV \[m\]; the model knows no size.
const SPAN: f64 = 0.24;
/// Side of the drawn payload \[m\].
const PAYLOAD: f64 = 0.045;
/// Free length of the drawn spring \[m\].
const SPRING: f64 = 0.09;
/// Pixels per metre.
const SCALE: f64 = 330.0;
/// Space above a frame for its title \[px\].
const TITLE: f64 = 24.0;
/// Most instants that fit beside each other.
const MOST: usize = 5;

/// Instants worth drawing: start, end, and where something begins or ends.
#[must_use]
pub fn instants(series: &Series<'_>) -> Vec<f64> {
    let recording = &series.run.recording;
    let (Some(&start), Some(&stop)) = (recording.times().first(), recording.times().last()) else {
        return Vec::new();
    };
    let reference = &series.run.scenario.parameters.reference;
    let legs = reference.legs.iter().filter(|leg| leg.duration > 0.0);
    let mut events: Vec<f64> = match reference.kind {
        ReferenceKind::Circle => [0.3, 0.5, 0.7].map(|share| share * reference.circle.duration).into(),
        ReferenceKind::Table => [0.25, 0.5, 0.75, 1.0].map(|share| share * reference.end()).into(),
        ReferenceKind::Path | ReferenceKind::External => {
            legs.flat_map(|leg| [leg.start, leg.start + leg.duration]).collect()
        }
    };
    events.sort_by(f64::total_cmp);
    let apart = 0.04 * (stop - start);
    let mut chosen = vec![start];
    for event in events.iter().map(|event| start + event) {
        if chosen.len() + 1 < MOST && event - chosen[chosen.len() - 1] > apart && stop - event > apart {
            chosen.push(event);
        }
    }
    chosen.push(stop);
    chosen
}

/// Part of the plane that a drawing shows \[m\].
#[derive(Debug, Clone, Copy)]
struct Window {
    low: Vec2,
    high: Vec2,
}

impl Window {
    fn around(points: impl Iterator<Item = Vec2>) -> Self {
        let start = Self { low: vec2(-SPAN, -SPAN), high: vec2(SPAN, 0.0) };
        let mut window =
            points.fold(start, |window, point| Self { low: window.low.inf(&point), high: window.high.sup(&point) });
        window.low -= vec2(0.03, 0.02);
        window.high += vec2(0.03, 0.08);
        window
    }

    fn size(&self) -> Vec2 {
        SCALE * (self.high - self.low)
    }

    /// From metres to pixels, downwards.
    fn px(&self, point: Vec2) -> Vec2 {
        SCALE * vec2(point.x - self.low.x, self.high.y - point.y)
    }

    fn path(&self, points: impl IntoIterator<Item = Vec2>) -> String {
        points.into_iter().fold(String::new(), |mut text, point| {
            let px = self.px(point);
            // Writing to a string cannot fail.
            let _ = write!(text, "{:.1},{:.1} ", px.x, px.y);
            text
        })
    }
}

/// One strip of frames per series, all in the same window.
///
/// # Errors
/// If the position of a part was not recorded.
pub fn strips(series: &[Series<'_>], instants: &[f64]) -> Result<Markup, NotRecorded> {
    let frames = series.iter().map(|series| poses(series, instants)).collect::<Result<Vec<_>, _>>()?;
    let window = Window::around(frames.iter().flatten().flat_map(|(_, pose)| {
        let sides = [-SPAN, SPAN].map(|x| pose.base + Rotation::by(pose.roll).apply(vec2(x, 0.05)));
        let below = pose.hand - vec2(0.0, SPRING + PAYLOAD);
        pose.joints.iter().copied().chain(sides).chain([below]).collect::<Vec<_>>()
    }));
    Ok(html! {
        @for (series, frames) in series.iter().zip(&frames) {
            div.strip {
                h3 style={ "color:" (series.paint.css()) } { (series.label) }
                (strip(series, frames, window)?)
            }
        }
    })
}

fn poses(series: &Series<'_>, instants: &[f64]) -> Result<Vec<(f64, Pose)>, NotRecorded> {
    let Run { scenario, recording, .. } = series.run;
    let rows = instants.iter().filter_map(|&time| Some((time, recording.row_at(time)?)));
    rows.map(|(time, row)| Ok((time, Pose::at(scenario, recording, row)?))).collect()
}

fn strip(series: &Series<'_>, frames: &[(f64, Pose)], window: Window) -> Result<Markup, NotRecorded> {
    let size = window.size();
    let gap = 10.0;
    let width = (size.x + gap) * f64::from(u32::try_from(frames.len()).unwrap_or(u32::MAX));
    let capture = Pose::capture(&series.run.scenario, &series.run.recording)?;
    Ok(html! {
        svg.arm viewBox={ "-1 0 " (width + 2.0 - gap) " " (size.y + TITLE + 1.0) } role="img"
            aria-label="The vehicle at some instants" {
            @for (i, (time, pose)) in frames.iter().enumerate() {
                @let left = f64::from(u32::try_from(i).unwrap_or(u32::MAX)) * (size.x + gap);
                g transform={ "translate(" (left) " " (TITLE) ")" } {
                    rect x="0" y="0" width=(size.x) height=(size.y) rx="6" fill="#fafbfc" stroke="#e8ecf0" {}
                    text x="4" y="-7" { "t = " ((1e3 * time).round() / 1e3) " s" }
                    (frame(series, pose, capture, window)?)
                }
            }
        }
    })
}

fn frame(series: &Series<'_>, pose: &Pose, capture: Option<Vec2>, window: Window) -> Result<Markup, NotRecorded> {
    let recording = &series.run.recording;
    let colour = series.paint.css();
    let wanted = envelope(recording.column("reference.x")?, recording.column("reference.y")?.iter().copied(), 100);
    let start = window.px(vec2(0.0, 0.0));
    let payload = if pose.attached { Some(pose.hand) } else { capture };
    let support = &series.run.scenario.parameters.support;
    Ok(html! {
        line x1=(start.x) x2=(start.x) y1="0" y2=(window.size().y) stroke="#cfd6dd" stroke-dasharray="3 4" {}
        polyline points=(window.path(wanted.into_iter().map(|(x, y)| vec2(x, y)))) fill="none" stroke="#97a3af"
            stroke-width="1.5" {}
        @if let (Some(capture), true) = (capture, support.stiffness > 0.0) {
            @let load = payload.map_or(support.height, |payload| payload.y.min(support.height));
            polyline points=(window.path(spring(vec2(capture.x, load - 0.5 * PAYLOAD), support.height - SPRING)))
                fill="none" stroke="#7a8694" stroke-width="1.5" stroke-linejoin="round" {}
        }
        (uav(pose, window))
        polyline points=(window.path(pose.joints.iter().copied())) fill="none" stroke=(colour) stroke-width="7"
            stroke-linecap="round" stroke-linejoin="round" {}
        @for joint in pose.joints.iter().map(|joint| window.px(*joint)) {
            circle cx=(joint.x) cy=(joint.y) r="3" fill="#ffffff" {}
        }
        @if let Some(payload) = payload {
            @let corner = window.px(payload + vec2(-0.5 * PAYLOAD, 0.5 * PAYLOAD));
            rect x=(corner.x) y=(corner.y) width=(SCALE * PAYLOAD) height=(SCALE * PAYLOAD) rx="2" fill="#333a45"
                fill-opacity=(if pose.attached { "0.9" } else { "0.35" }) {}
        }
    })
}

/// Frame, hub and rotors of a multicopter, seen from the front.
fn uav(pose: &Pose, window: Window) -> Markup {
    let turn = Rotation::by(pose.roll);
    let at = |x: f64, y: f64| pose.base + turn.apply(vec2(x, y));
    let line = |points: &[(f64, f64)]| window.path(points.iter().map(|&(x, y)| at(x, y)));
    let hub = [(-0.055, -0.018), (0.055, -0.018), (0.045, 0.028), (-0.045, 0.028)];
    html! {
        polyline points=(line(&[(-0.17, 0.012), (0.17, 0.012)])) stroke="#4a5361" stroke-width="4" {}
        @for side in [-0.17, 0.17] {
            polyline points=(line(&[(side, 0.012), (side, 0.04)])) stroke="#4a5361" stroke-width="4" {}
            polyline points=(line(&[(side - 0.07, 0.042), (side + 0.07, 0.042)])) stroke="#9aa5b1" stroke-width="3"
                stroke-linecap="round" {}
        }
        polygon points=(line(&hub)) fill="#4a5361" stroke="#4a5361" stroke-width="3" stroke-linejoin="round" {}
        @if let Some(counterweight) = pose.counterweight {
            @let corner = window.px(counterweight + vec2(-0.03, 0.02));
            rect x=(corner.x) y=(corner.y) width=(SCALE * 0.06) height=(SCALE * 0.04) fill="#c8a000" {}
        }
        @if let Some(element) = pose.balance_element {
            @let end = window.px(element);
            polyline points=(window.path([pose.base, element])) stroke="#c8a000" stroke-width="4" {}
            circle cx=(end.x) cy=(end.y) r="6" fill="#c8a000" {}
        }
    }
}

/// Corner points of a spring below `top` that stands at height `ground`, with its ground.
fn spring(top: Vec2, ground: f64) -> Vec<Vec2> {
    let (plate, coil, coils) = (0.035, 0.018, 6);
    let at = |x: f64, share: f64| vec2(top.x + x, top.y + share * (ground - top.y));
    let mut points = vec![at(-plate, 0.0), at(plate, 0.0), at(0.0, 0.0)];
    for i in 0..coils {
        let side = if i % 2 == 0 { coil } else { -coil };
        points.push(at(side, (f64::from(i) + 0.5) / f64::from(coils)));
    }
    points.extend([at(0.0, 1.0), at(-plate, 1.0), at(plate, 1.0)]);
    points
}
