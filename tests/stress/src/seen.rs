//! What both units show at a communication point.

use uam::control::Status;
use uam::variables::options::Choice;

use crate::pair::Pair;

/// Where values stand that are not among the first of the controller.
#[derive(Debug, Clone, Copy)]
pub struct Places {
    status: usize,
    singular_value: usize,
    late_miss: Option<usize>,
}

impl Places {
    /// Those of a pair.
    pub fn of(pair: &Pair<'_>) -> Result<Self, String> {
        let place = |name: &str| pair.controller.place(name);
        let must = |name: &str| place(name).ok_or_else(|| format!("the controller has no output {name}"));
        Ok(Self {
            status: must("ik.status")?,
            singular_value: must("ik.min_singular_value")?,
            late_miss: place("ik.late_miss"),
        })
    }
}

/// All outputs of a communication point.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    n: usize,
    places: Places,
    /// All outputs of the controller.
    pub controller: &'a [f64],
    /// All outputs of the plant.
    pub plant: &'a [f64],
}

impl<'a> Seen<'a> {
    /// What was read last.
    pub fn of(pair: &'a Pair<'_>, places: Places) -> Self {
        Self { n: pair.coordinates, places, controller: &pair.controller.values, plant: &pair.plant.values }
    }

    /// Commanded rates for the coming interval \[rad/s, m/s\].
    pub fn rates(&self) -> &'a [f64] {
        &self.controller[..self.n]
    }

    /// Commanded accelerations \[rad/s2, m/s2\].
    pub fn accelerations(&self) -> &'a [f64] {
        &self.controller[self.n..2 * self.n]
    }

    /// Pose and velocity of the base, positions of the coordinates, place of the end effector, as predicted.
    pub fn predicted(&self) -> &'a [f64] {
        &self.controller[2 * self.n + 1..3 * self.n + 9]
    }

    /// The same of the plant.
    pub fn observed(&self) -> &'a [f64] {
        &self.plant[..self.n + 8]
    }

    /// Positions of the coordinates in the plant \[rad, m\].
    pub fn positions(&self) -> &'a [f64] {
        &self.plant[6..6 + self.n]
    }

    /// Predicted pose of the UAV \[m, m, rad\].
    pub fn pose(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.predicted()[i])
    }

    /// Wanted place of the end effector \[m\].
    pub fn reference(&self) -> [f64; 2] {
        [0, 1].map(|i| self.controller[3 * self.n + 9 + i])
    }

    /// How far the prediction has the end effector from where it is wanted, along each axis \[m\].
    pub fn miss(&self) -> [f64; 2] {
        [0, 1].map(|i| self.predicted()[self.n + 6 + i] - self.reference()[i])
    }

    /// Number of the status, from 0.
    pub fn status_number(&self) -> usize {
        (self.controller[self.places.status] as usize).saturating_sub(1)
    }

    /// Name of the status.
    pub fn status(&self) -> &'static str {
        status_name(self.status_number())
    }

    /// Whether the status says that the path is kept.
    pub fn keeps_path(&self) -> bool {
        self.status() == "ok" || self.status().starts_with("task_")
    }

    /// The smallest singular value of the path's matrix \[m\].
    pub fn singular_value(&self) -> f64 {
        self.controller[self.places.singular_value]
    }

    /// A miss that became known afterwards \[m\], if the controller says so.
    pub fn late_miss(&self) -> Option<f64> {
        self.places.late_miss.map(|place| self.controller[place])
    }
}

/// Name of the status of this number, from 0.
pub fn status_name(number: usize) -> &'static str {
    Status::Ok.items().get(number).map_or("unknown", |item| item.name)
}
