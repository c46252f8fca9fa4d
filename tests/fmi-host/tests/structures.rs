//! Every structure that can be built: its FMUs are loaded and coupled on the pick-up of their start values.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::collections::HashSet;

use fmi::traits::FmiImport;
use fmi_host::{Coupling, Unit, steps};
use uam::Structure;

/// One link cannot follow a path in the plane, only come near: it swings by 2 cm, on an arc \[m\].
const ARC: f64 = 2e-3;

/// Of the start values \[N, N/m\].
const PAYLOAD_WEIGHT: f64 = 0.5 * 9.81;
const SUPPORT_STIFFNESS: f64 = 1000.0;

#[test]
fn every_structure_does_its_pick_up() {
    for structure in Structure::all() {
        let coupling = Coupling::open(structure);
        let track = coupling.run(&[], steps(0.0, 1e-2, 3000)).unwrap();
        let bar = if structure.links == 1 { ARC } else { 5e-7 };
        assert!(track.largest_error() <= bar, "{structure}: {} m", track.largest_error());
        assert!(track.pose.iter().flatten().all(|value| value.is_finite()), "{structure}");
        let sinking = track.farthest(1, -1.0);
        let held: Vec<f64> = track.payload.iter().filter(|(held, _)| *held).map(|(_, support)| *support).collect();
        if structure.links == 1 {
            // The path is horizontal: the payload never leaves its support, which gives way by millimetres.
            assert!(held.iter().all(|&support| support > 0.0), "{structure}: the payload leaves its support");
            let pressed = PAYLOAD_WEIGHT / SUPPORT_STIFFNESS;
            assert!(sinking <= pressed, "{structure}: the UAV sinks by {sinking} m");
        } else {
            assert_eq!(held.last(), Some(&0.0), "{structure}: the payload is lifted");
            assert!((0.05..0.15).contains(&sinking), "{structure}: the payload pulls the UAV down by {sinking} m");
        }
    }
}

/// Library and description of different structures do not go together.
#[test]
fn structures_have_identities_of_their_own() {
    let guids: HashSet<String> = Structure::all()
        .flat_map(|structure| [Unit::controller(structure), Unit::plant(structure)])
        .map(|unit| unit.import().model_description().guid.clone())
        .collect();
    assert_eq!(guids.len(), 2 * Structure::all().count());
}
