//! A scenario with some of its numbers changed: what depends on a number that the thesis does not print?

use uam::scenarios::{Error, Problem, Scenario};

/// Beside the names of parameters, `duration` and `step`: all times of path and grasp are divided by it.
pub const PACE: &str = "pace";
/// Likewise: all ways of the path are multiplied by it.
pub const SIZE: &str = "size";

/// In the name of a parameter: that of every link and joint.
pub const EVERY: &str = "[*]";

/// Names with new values, each as written in a scenario file.
pub type Changes<'a> = &'a [(&'a str, &'a str)];

/// The scenario with these changes, in their order.
///
/// # Errors
/// Names the key or value that is not understood, with what is allowed.
pub fn vary(scenario: &Scenario, changes: Changes<'_>) -> Result<Scenario, Error> {
    changes.iter().try_fold(scenario.clone(), |scenario, &(name, value)| match name {
        PACE => Ok(at_pace(scenario, factor(name, value)?)),
        SIZE => Ok(of_size(scenario, factor(name, value)?)),
        _ if name.contains(EVERY) => {
            let names = (1..=scenario.structure.links).map(|n| name.replace(EVERY, &format!("[{n}]")));
            names.into_iter().try_fold(scenario, |scenario, name| scenario.with([(name.as_str(), value)]))
        }
        _ => scenario.with([(name, value)]),
    })
}

fn factor(name: &str, value: &str) -> Result<f64, Error> {
    let number = value.parse().ok().filter(|&factor: &f64| factor > 0.0 && factor.is_finite());
    let refused = || Problem::Value { key: name.into(), expected: "a number above 0".into(), found: value.into() };
    number.ok_or_else(|| Error::Change(refused()))
}

fn at_pace(mut scenario: Scenario, pace: f64) -> Scenario {
    let parameters = &mut scenario.parameters;
    let legs = parameters.reference.legs.iter_mut();
    let times = legs.flat_map(|leg| [&mut leg.start, &mut leg.duration, &mut leg.ramp]);
    for time in times.chain([&mut parameters.reference.circle.duration, &mut parameters.payload.grasp_time]) {
        *time /= pace;
    }
    scenario
}

fn of_size(mut scenario: Scenario, size: f64) -> Scenario {
    let reference = &mut scenario.parameters.reference;
    let ways = reference.legs.iter_mut().flat_map(|leg| [&mut leg.dx, &mut leg.dy]);
    ways.chain([&mut reference.circle.diameter]).for_each(|way| *way *= size);
    scenario
}

#[cfg(test)]
mod tests {
    use uam::scenarios::find;

    use super::*;

    #[test]
    fn pace_and_size_change_the_path_alone() {
        let known = find("4.3b").unwrap();
        let varied = vary(&known, &[(PACE, "2"), (SIZE, "0.5"), ("step", "1e-4")]).unwrap();
        assert_eq!((varied.step, varied.duration), (1e-4, known.duration));
        let at = |scenario: &Scenario, t: f64| scenario.parameters.reference.at(t);
        for t in [0.4, 0.75, 5.1] {
            let (before, now) = (at(&known, 2.0 * t), at(&varied, t));
            assert!((0.5 * before.displacement - now.displacement).norm() < 1e-15);
            assert!((before.velocity - now.velocity).norm() < 1e-14);
        }
        assert_eq!(varied.parameters.payload.grasp_time, 0.8);
        assert_eq!(varied.parameters.support, known.parameters.support);
    }

    #[test]
    fn one_change_may_be_for_every_joint() {
        let varied = vary(&find("4.4b").unwrap(), &[("joint[*].acceleration_limit", "6")]).unwrap();
        assert!(varied.parameters.joints[..3].iter().all(|joint| joint.acceleration_limit == 6.0));
    }

    #[test]
    fn what_is_no_factor_is_refused() {
        let known = find("4.3b").unwrap();
        for (name, value) in [(PACE, "0"), (SIZE, "-1"), (PACE, "inf"), (SIZE, "wide")] {
            let said = vary(&known, &[(name, value)]).unwrap_err().to_string();
            assert_eq!(said, format!("`{name}` must be a number above 0, but is {value}"));
        }
        assert!(vary(&known, &[("paces", "2")]).is_err());
    }
}
