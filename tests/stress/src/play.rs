//! Runs couplings and looks at them.

use std::collections::BTreeMap;

use misuse::digest::Digest;
use misuse::unit::Unit;
use uam::mechanics::planar::Vec2;
use uam::parameters::{Hold, PathAxes, Resolution};
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;

use crate::case::{Back, Case};
use crate::checks::{self, Check, Now};
use crate::course::Course;
use crate::environment::Environment;
use crate::pair::Pair;
use crate::report::Report;
use crate::seen::{Places, Seen};

/// A promise that was broken.
#[derive(Debug, Clone)]
pub struct Broken {
    /// Which.
    pub check: &'static str,
    /// When for the first time, from the start \[s\].
    pub time: f64,
    /// What was found.
    pub found: String,
}

/// What a run came to.
#[derive(Default)]
pub struct Track {
    /// Of all outputs at all points.
    pub digest: u64,
    /// How many steps were made.
    pub steps: u64,
    /// Whether the UAV turned over, which ended the run.
    pub tumbled: bool,
    /// At how many points each status was seen.
    pub statuses: [u64; 16],
    /// What did not hold.
    pub broken: Vec<Broken>,
    /// What was looked at.
    pub looked: Vec<&'static str>,
    course: Course,
}

/// One thread's instances, one pair for each structure, which are made as new for each run.
pub struct Player<'a> {
    units: &'a [Unit; 2],
    environment: Environment,
    /// Whether each communication point is printed.
    traces: bool,
    pairs: BTreeMap<String, Pair<'a>>,
}

impl<'a> Player<'a> {
    /// Without instances so far.
    pub fn new(units: &'a [Unit; 2], environment: Environment, traces: bool) -> Self {
        Self { units, environment, traces, pairs: BTreeMap::new() }
    }

    /// Plays one case.
    ///
    /// # Errors
    /// If the units cannot be used at all.
    pub fn play(&mut self, case: &Case) -> Result<Report, String> {
        let mut track = self.run(case, checks::all(case))?;
        if checks::promises_rest(case) && (track.complete(case) || track.tumbled) {
            track.looked.push("rest");
            let found = checks::rest(&track.course, || Ok(self.run(&minimum_norm(case), Vec::new())?.course));
            track.note("rest", track.time(case), found);
        }
        if case.compared && checks::comparable(case) {
            track.looked.push("clock");
            let even = self.run(&on_even_clock(case), Vec::new())?.course;
            let found = checks::clock(case, &track.course, &even);
            track.note("clock", track.time(case), found);
        }
        if case.again {
            track.looked.push("same again");
            let again = self.run(case, Vec::new())?.digest;
            let found = if again == track.digest { Ok(()) } else { Err("another run has other bits".to_owned()) };
            track.note("same again", track.time(case), found);
        }
        Ok(Report::of(case, track))
    }

    /// A digest of all that both units show in a run, up to where it ends.
    ///
    /// # Errors
    /// If the units cannot be used at all.
    pub fn digest(&mut self, case: &Case) -> Result<String, String> {
        Ok(format!("{:016x}", self.run(case, Vec::new())?.digest))
    }

    /// Runs a case once.
    fn run(&mut self, case: &Case, mut checks: Vec<Box<dyn Check + '_>>) -> Result<Track, String> {
        let key = case.structure.to_string();
        if !self.pairs.contains_key(&key) {
            let pair = Pair::new::<ControllerUnit, PlantUnit>(self.units, case.structure, self.environment)?;
            self.pairs.insert(key.clone(), pair);
        }
        let pair = self.pairs.get_mut(&key).ok_or("no pair")?;
        pair.controller.reset()?;
        pair.plant.reset()?;
        let mut run = Run::of(case, pair)?;
        // Runs that nobody looks at are those that others are compared with.
        run.traces = self.traces && !checks.is_empty();
        if let Err(found) = run.play_through(&mut checks) {
            run.track.note(checks::FINITE, run.time, Err(found));
        } else {
            for check in &mut checks {
                let found = check.end();
                run.track.note(check.name(), run.time, found);
            }
        }
        let mut track = run.track;
        track.digest = run.digest.value();
        track.looked = checks.iter().filter(|check| check.looked()).map(|check| check.name()).collect();
        track.looked.extend(case.back.map(|_| BACK));
        Ok(track)
    }
}

/// From here on a UAV falls and spins faster and faster: nothing is promised then, and the units need ever shorter steps
/// inside of ours \[rad\].
const UPSIDE_DOWN: f64 = std::f64::consts::PI;

/// Name of the check that a state leads to where it was saved.
const BACK: &str = "same after roll-back";

impl Track {
    fn complete(&self, case: &Case) -> bool {
        self.steps == case.steps.steps.len() as u64
    }

    fn time(&self, case: &Case) -> f64 {
        case.steps.steps.iter().take(self.steps as usize).map(|(_, size)| size).sum()
    }

    /// Notes what a check found, if it is the first of that check.
    fn note(&mut self, check: &'static str, time: f64, found: Result<(), String>) {
        if let Err(found) = found
            && self.broken.iter().all(|broken| broken.check != check)
        {
            self.broken.push(Broken { check, time, found });
        }
    }
}

/// The same case on an even clock, with a plan for each step.
fn on_even_clock(case: &Case) -> Case {
    let mut other = case.again();
    (other.steps, other.back) = (case.steps.even(), None);
    other.parameters.ik.sample_time = other.steps.sample_time;
    other
}

/// The same case with the smallest rates.
fn minimum_norm(case: &Case) -> Case {
    let mut other = case.again();
    let ik = &mut other.parameters.ik;
    (ik.resolution, ik.hold, ik.path_axes) = (Resolution::MinimumNorm, Hold::ZeroOrder, PathAxes::Both);
    other
}

/// A run under way.
struct Run<'r, 'a> {
    case: &'r Case,
    pair: &'r mut Pair<'a>,
    places: Places,
    origin: Vec2,
    duration: f64,
    time: f64,
    /// What of the reference was not to be foreseen in the last steps \[m\].
    unforeseen: [f64; 3],
    traces: bool,
    digest: Digest,
    track: Track,
}

impl<'r, 'a> Run<'r, 'a> {
    fn of(case: &'r Case, pair: &'r mut Pair<'a>) -> Result<Self, String> {
        Ok(Self {
            case,
            places: Places::of(pair)?,
            pair,
            origin: case.origin(),
            duration: case.steps.steps.iter().map(|(_, size)| size).sum(),
            time: 0.0,
            unforeseen: [0.0; 3],
            traces: false,
            digest: Digest::EMPTY,
            track: Track::default(),
        })
    }

    fn play_through(&mut self, checks: &mut [Box<dyn Check + '_>]) -> Result<(), String> {
        let values = self.case.values();
        let named = || values.iter().map(|(name, value)| (name.as_str(), *value));
        self.pair.controller.set_all(named())?;
        self.pair.plant.set_all(named())?;
        let start = self.case.steps.start();
        self.pair.controller.begin(start)?;
        self.pair.plant.begin(start)?;
        self.look(checks, 0, 0.0, 0.0);
        let mut expected = None;
        for k in 0..self.case.steps.steps.len() {
            if let Some(back) = self.case.back {
                if k == back.step {
                    expected = Some(self.there_and_back(back)?);
                }
                if k == back.step + back.count && expected.is_some_and(|digest| digest != self.shown()) {
                    let found = format!("other bits {} steps after the return", back.count);
                    self.track.note(BACK, self.time, Err(found));
                }
            }
            let (size, unforeseen) = self.step(k)?;
            self.time += size;
            self.track.steps += 1;
            self.look(checks, k + 1, size, unforeseen);
            if self.track.course.roll > UPSIDE_DOWN {
                self.track.tumbled = true;
                self.track.course.last_rate = f64::INFINITY;
                break;
            }
        }
        Ok(())
    }

    /// Makes step `k`; its length \[s\], and how far the reference moves beyond what can be foreseen \[m\].
    fn step(&mut self, k: usize) -> Result<(f64, f64), String> {
        let (from, size) = self.case.steps.steps[k];
        if let Some(change) = self.case.change.as_ref().filter(|change| change.step == k) {
            let named = || change.values.iter().map(|(name, value)| (name.as_str(), *value));
            self.pair.controller.set_all(named())?;
            self.pair.plant.set_all(named())?;
        }
        let Some(external) = &self.case.path.external else {
            self.pair.step(from, size, None)?;
            return Ok((size, 0.0));
        };
        let now = external.at(self.origin, self.time);
        let (v, a) = (now.velocity, now.acceleration);
        let wanted = [now.displacement.x, now.displacement.y, v.x, v.y, a.x, a.y];
        self.pair.step(from, size, Some(wanted))?;
        // Values belong to the beginning of this step; a plan that is made at its end looks one plan ahead from there.
        let unforeseen = |ahead: f64| {
            let foreseen = now.displacement + v * ahead + a * (0.5 * ahead * ahead);
            (external.at(self.origin, self.time + ahead).displacement - foreseen).norm()
        };
        let steps = self.case.steps.per_plan.unwrap_or(1);
        self.unforeseen.rotate_right(1);
        self.unforeseen[0] = unforeseen(size) + unforeseen(size * (steps + 1) as f64);
        Ok((size, self.unforeseen.iter().sum()))
    }

    /// Goes on by some steps, and back; what it showed there.
    fn there_and_back(&mut self, Back { step, count, through_bytes }: Back) -> Result<u64, String> {
        let mut states = [self.pair.controller.save()?, self.pair.plant.save()?];
        let (time, unforeseen) = (self.time, self.unforeseen);
        let went = (step..step + count).try_for_each(|k| {
            let (size, _) = self.step(k)?;
            self.time += size;
            Ok::<_, String>(())
        });
        let shown = self.shown();
        if through_bytes {
            states = [self.pair.controller.through_bytes(states[0])?, self.pair.plant.through_bytes(states[1])?];
        }
        self.pair.controller.restore(states[0])?;
        self.pair.plant.restore(states[1])?;
        (self.time, self.unforeseen) = (time, unforeseen);
        self.pair.read()?;
        // Where these steps cannot be made they are refused again.
        Ok(if went.is_ok() { shown } else { 0 })
    }

    /// All that both show now.
    fn shown(&self) -> u64 {
        let mut digest = Digest::EMPTY;
        self.pair.controller.values.iter().chain(&self.pair.plant.values).for_each(|value| digest.take_number(*value));
        digest.value()
    }

    fn look(&mut self, checks: &mut [Box<dyn Check + '_>], count: usize, size: f64, unforeseen: f64) {
        let seen = Seen::of(self.pair, self.places);
        seen.controller.iter().chain(seen.plant).for_each(|value| self.digest.take_number(*value));
        let now = Now { count, time: self.time, size, unforeseen, seen };
        if self.traces {
            println!("{now}");
        }
        self.track.course.see(self.case, self.duration, &now);
        self.track.statuses[seen.status_number().min(15)] += 1;
        for check in checks {
            let found = check.see(&now);
            self.track.note(check.name(), self.time, found);
        }
    }
}
