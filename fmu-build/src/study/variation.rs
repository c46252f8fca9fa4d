//! A scenario with some of its numbers changed: what depends on a number that the thesis does not print?

use std::sync::Arc;

use uam::reference::TableError;
use uam::scenarios::{Error, Problem, Scenario};

/// Beside the names of parameters, `duration` and `step`: all times of path and grasp are divided by it.
pub const PACE: &str = "pace";
/// Likewise: all ways of the path are multiplied by it.
pub const SIZE: &str = "size";

/// Names with new values, each as written in a scenario file.
pub type Changes<'a> = &'a [(&'a str, &'a str)];

/// The scenario with these changes, in their order; what is given new values between two factors changes at once, and
/// only has to go together in the end.
///
/// # Errors
/// Names the key or value that is not understood, with what is allowed.
pub fn vary(scenario: &Scenario, changes: Changes<'_>) -> Result<Scenario, Error> {
    let mut varied = scenario.clone();
    let mut values: Vec<(&str, &str)> = Vec::new();
    for &(name, value) in changes {
        let change = match name {
            PACE => at_pace,
            SIZE => of_size,
            _ => {
                values.retain(|(other, _)| *other != name);
                values.push((name, value));
                continue;
            }
        };
        varied = change(varied.with(std::mem::take(&mut values))?, factor(name, value)?)?;
    }
    varied.with(values)
}

fn factor(name: &str, value: &str) -> Result<f64, Error> {
    let number = value.parse().ok().filter(|&factor: &f64| factor > 0.0 && factor.is_finite());
    let refused = || Problem::Value { key: name.into(), expected: "a number above 0".into(), found: value.into() };
    number.ok_or_else(|| Error::Change(refused()))
}

fn at_pace(mut scenario: Scenario, pace: f64) -> Result<Scenario, Error> {
    let parameters = &mut scenario.parameters;
    let legs = parameters.reference.legs.iter_mut();
    let times = legs.flat_map(|leg| [&mut leg.start, &mut leg.duration, &mut leg.ramp]);
    for time in times.chain([&mut parameters.reference.circle.duration, &mut parameters.payload.grasp_time]) {
        *time /= pace;
    }
    scale_table(scenario, PACE, pace, 1.0)
}

fn of_size(mut scenario: Scenario, size: f64) -> Result<Scenario, Error> {
    let reference = &mut scenario.parameters.reference;
    let ways = reference.legs.iter_mut().flat_map(|leg| [&mut leg.dx, &mut leg.dy]);
    ways.chain([&mut reference.circle.diameter]).for_each(|way| *way *= size);
    scale_table(scenario, SIZE, 1.0, size)
}

fn scale_table(mut scenario: Scenario, name: &str, pace: f64, size: f64) -> Result<Scenario, Error> {
    if let Some(table) = &mut scenario.parameters.reference.table {
        let refused =
            |reason: TableError| Error::Change(Problem::Path { key: name.to_owned(), reason: reason.to_string() });
        *table = Arc::new(table.scaled(pace, size).map_err(refused)?);
    }
    Ok(scenario)
}

#[cfg(test)]
mod tests {
    use uam::scenarios::{catalogue, find};
    use uam::{Parameters, Structure};

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
    fn pace_and_size_change_a_table_too() {
        let text = "id = 'a'\nbased_on = '4.3b'\npath = [[0, 0, 0], [1, 0.02, 0.01], [3, 0.01, -0.03]]";
        let known = Scenario::read(text).unwrap();
        let varied = vary(&known, &[(PACE, "2"), (SIZE, "0.5"), ("payload.mass", "0.1")]).unwrap();
        for t in [0.2, 0.5, 1.1, 1.5] {
            let [before, now] = [(&known, 2.0 * t), (&varied, t)].map(|(run, t)| run.parameters.reference.at(t));
            assert!((0.5 * before.displacement - now.displacement).norm() < 1e-16);
            assert!((before.velocity - now.velocity).norm() < 1e-15);
        }
        let refused = vary(&known, &[(SIZE, "1e308"), (SIZE, "1e308")]).unwrap_err().to_string();
        assert!(refused.starts_with("`size`: row 2: x must be a finite number"), "{refused}");
    }

    #[test]
    fn one_change_may_be_for_every_joint() {
        let varied = vary(&find("4.4b").unwrap(), &[("joint[*].acceleration_limit", "6")]).unwrap();
        assert!(varied.parameters.joints[..3].iter().all(|joint| joint.acceleration_limit == 6.0));
    }

    /// Of every family that there is, whatever the numbers of the others.
    #[test]
    fn every_member_of_a_family_is_changed_and_nothing_else() {
        for structure in Structure::all() {
            let id = catalogue().unwrap().into_iter().find(|scenario| scenario.structure == structure);
            let Some(known) = id else { continue };
            for (name, members) in [
                ("link[*].com", structure.links),
                ("joint[*].weight", structure.links),
                ("reference.leg[*].dx", 4),
                ("reference.leg[*].start", 4),
            ] {
                let varied = vary(&known, &[(name, "0.75")]).unwrap();
                let members: Vec<String> = (1..=members).map(|n| name.replace('*', &n.to_string())).collect();
                let (before, now) = (known.parameters.clone(), varied.parameters);
                for variable in Parameters::table(structure).variables() {
                    let Some(value) = variable.real(&now) else { continue };
                    let expected =
                        if members.contains(&variable.name) { 0.75 } else { variable.real(&before).unwrap() };
                    assert_eq!(value, expected, "{structure}: {name}: {}", variable.name);
                }
            }
        }
        let refused = vary(&find("4.3b").unwrap(), &[("link[*].mas", "1")]).unwrap_err().to_string();
        assert!(refused.contains("no parameter `link[*].mas`; did you mean `link[1].mass`"), "{refused}");
    }

    /// The first of two changes alone would be refused; the last one of the same name counts.
    #[test]
    fn changes_only_have_to_go_together_in_the_end() {
        let known = find("4.3b").unwrap();
        let [shorter, steeper] = [("reference.leg[*].duration", "0.4"), ("reference.leg[*].ramp", "0.1")];
        assert!(vary(&known, &[shorter]).is_err());
        assert_eq!(vary(&known, &[shorter, steeper]).unwrap(), vary(&known, &[steeper, shorter]).unwrap());
        let varied = vary(&known, &[("joint[*].weight", "2"), ("joint[2].weight", "3")]).unwrap();
        assert_eq!(varied.parameters.joints[..3].iter().map(|joint| joint.weight).sum::<f64>(), 2.0 + 3.0 + 2.0);
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
