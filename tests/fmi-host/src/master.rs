//! A plain parallel master: values are exchanged at t0 + n h, then both units step.

use fmi::fmi2::Fmi2Error;
use fmi::fmi2::schema::Causality;
use uam::Structure;

use crate::{Slave, Unit};

/// Beginning and length of communication steps of equal length: t = t0 + n h, never a running sum.
pub fn steps(start: f64, size: f64, count: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |n| (start + f64::from(n) * size, size))
}

/// The two FMUs of a structure, and the names that are the output of one and the input of the other.
#[derive(Debug)]
pub struct Coupling {
    /// The controller.
    pub controller: Unit,
    /// The plant.
    pub plant: Unit,
    commands: Vec<String>,
}

/// What was observed at every communication point.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Track {
    /// Communication points \[s\].
    pub time: Vec<f64>,
    /// Pose of the UAV: x \[m\], y \[m\], roll \[rad\].
    pub pose: Vec<[f64; 3]>,
    /// Distance of the end effector from the reference \[m\].
    pub error: Vec<f64>,
    /// Mean moment of the arm on the UAV \[N m\].
    pub moment: Vec<f64>,
    /// Whether the payload is held, and the force of the support on it \[N\].
    pub payload: Vec<(bool, f64)>,
}

impl Track {
    /// Largest of one entry of the pose, with a sign: -1 asks for the smallest.
    #[must_use]
    pub fn farthest(&self, entry: usize, sign: f64) -> f64 {
        self.pose.iter().map(|pose| sign * pose[entry]).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Largest tracking error; not a number if one of them is not.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.error.iter().fold(0.0, |largest: f64, &error| if error.is_nan() { error } else { largest.max(error) })
    }

    /// The pose at the end.
    #[must_use]
    pub fn end(&self) -> [f64; 3] {
        self.pose.last().copied().unwrap_or([f64::NAN; 3])
    }

    /// When the end effector is more than `distance` off for the first time.
    #[must_use]
    pub fn lost_at(&self, distance: f64) -> Option<f64> {
        self.error.iter().position(|&error| error > distance || error.is_nan()).map(|row| self.time[row])
    }
}

impl Coupling {
    /// Opens both FMUs.
    #[must_use]
    pub fn open(structure: Structure) -> Self {
        Self::between(Unit::controller(structure), Unit::plant(structure))
    }

    /// Connects equal names.
    #[must_use]
    pub fn between(controller: Unit, plant: Unit) -> Self {
        let inputs = plant.names(&Causality::Input);
        let mut commands = controller.outputs();
        commands.retain(|name| inputs.contains(name));
        Self { controller, plant, commands }
    }

    /// Runs a new instance of each unit. Parameters are set in every unit that has them.
    ///
    /// # Errors
    /// If a unit does not do a step.
    pub fn run(
        &self,
        parameters: &[(&str, f64)],
        steps: impl IntoIterator<Item = (f64, f64)>,
    ) -> Result<Track, Fmi2Error> {
        let mut track = Track::default();
        self.observe(parameters, steps, |time, controller, plant| record(&mut track, time, controller, plant))?;
        Ok(track)
    }

    /// Like [`Coupling::run`]; `look` is called at every communication point with the time and both units.
    ///
    /// # Errors
    /// If a unit does not do a step.
    pub fn observe(
        &self,
        parameters: &[(&str, f64)],
        steps: impl IntoIterator<Item = (f64, f64)>,
        mut look: impl FnMut(f64, &mut Slave<'_>, &mut Slave<'_>),
    ) -> Result<(), Fmi2Error> {
        let (mut controller, mut plant) = (self.controller.instantiate("controller"), self.plant.instantiate("plant"));
        for &(name, value) in parameters {
            for slave in [&mut controller, &mut plant] {
                if slave.unit.variables.contains_key(name) {
                    slave.set(name, value);
                }
            }
        }
        let mut steps = steps.into_iter().peekable();
        let start = steps.peek().map_or(0.0, |&(from, _)| from);
        controller.initialize(start, None);
        plant.initialize(start, None);

        look(start, &mut controller, &mut plant);
        for (from, size) in steps {
            for name in &self.commands {
                let value = controller.get(name);
                plant.set(name, value);
            }
            plant.step(from, size)?;
            controller.step(from, size)?;
            look(from + size, &mut controller, &mut plant);
        }
        Ok(())
    }
}

fn record(track: &mut Track, time: f64, controller: &mut Slave<'_>, plant: &mut Slave<'_>) {
    let mut off =
        |axis: &str| plant.get(&format!("end_effector.{axis}")) - controller.get(&format!("reference.{axis}"));
    track.error.push(off("x").hypot(off("y")));
    track.time.push(time);
    track.pose.push(["base.x", "base.y", "base.roll"].map(|name| plant.get(name)));
    track.moment.push(plant.get("transmitted.moment"));
    track.payload.push((plant.get("payload.attached") != 0.0, plant.get("support.force")));
}
