//! How far the arm reaches, on the coupled FMUs.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::study::claims::DISCRETIZATIONS;
use fmu_build::study::reach::{AGREEMENT, MOTIONS, Reach, STRIDE, Trial, comes_to_its_end, reach};
use fmu_build::study::variation::vary;
use fmu_build::study::{on_all_cores, with_each};
use uam::scenarios::find;

/// What was not seen to its end was not followed, however short the way.
#[test]
fn a_motion_that_does_not_come_to_its_end_is_not_followed() {
    let exact = DISCRETIZATIONS[1];
    for motion in MOTIONS {
        let whole = find(motion.scenario).unwrap();
        let pair = common::pair_of(whole.structure);
        let end = whole.parameters.reference.end();
        assert!(end > 1.0 && end <= whole.duration && comes_to_its_end(&whole), "{}", motion.scenario);
        assert!(Trial::run(pair, &whole, exact, STRIDE).unwrap().followed, "{}", motion.scenario);
        for (name, value, reaches_its_end) in [
            ("duration", "0.5".to_owned(), false),
            ("duration", (end - 1e-3).to_string(), false),
            ("duration", end.to_string(), true),
            ("reference.leg[1].start", (whole.duration - 1e-3).to_string(), false),
            ("pace", "1e-3".to_owned(), false),
        ] {
            let varied = vary(&whole, &[(name, value.as_str())]).unwrap();
            let trial = Trial::run(pair, &varied, exact, STRIDE).unwrap();
            assert_eq!(trial.followed, reaches_its_end, "{}, {name} = {value}", motion.scenario);
        }
    }
}

/// With an acceleration limit and a speed of the counterweight's law, neither of which the thesis prints, all four
/// reaches are those of the thesis, whichever the discretization: the counterweight nearly doubles the reach, and
/// gains little where a payload is lifted.
#[test]
fn the_arm_reaches_as_far_as_in_the_thesis() {
    let jobs = with_each(&MOTIONS);
    let reaches: Vec<Reach> = on_all_cores(&jobs, |&(motion, discretization)| {
        let changes = [("joint[*].acceleration_limit", "20"), ("counterweight.time_constant", "0.4")];
        let scenario = vary(&find(motion.scenario).unwrap(), &changes).unwrap();
        let pair = common::pair_of(scenario.structure);
        reach(|way| Trial::run(pair, &scenario, discretization, way)).unwrap()
    });
    for ((motion, discretization), reach) in jobs.iter().zip(&reaches) {
        let case = format!("{}, {discretization:?}: {} m", motion.scenario, reach.followed);
        assert!((reach.followed / motion.thesis - 1.0).abs() <= AGREEMENT, "{case}");
        assert!(reach.balanced <= reach.followed, "{case}");
    }
    for i in 0..DISCRETIZATIONS.len() {
        let [locked, moving, locked_with_payload, moving_with_payload] =
            [0, 2, 4, 6].map(|motion| reaches[motion + i].followed);
        assert!((1.5..2.0).contains(&(moving / locked)), "{moving} m against {locked} m");
        let ratio = moving_with_payload / locked_with_payload;
        assert!((1.05..1.3).contains(&ratio), "{moving_with_payload} m against {locked_with_payload} m");
        // Locked, the moment is what ends first: the arm alone cannot bring its weight below the UAV any farther.
        assert!((0.13..0.14).contains(&reaches[i].balanced), "{} m", reaches[i].balanced);
    }
}
