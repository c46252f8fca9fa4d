//! What the benchmarks go through: the reaching motion of the payload pick-up, a millisecond at a time.

#![allow(dead_code, reason = "every benchmark takes what it needs")]
#![allow(clippy::unwrap_used, reason = "helpers of benchmarks may fail like tests")]

use uam::control::{self, Planner};
use uam::parameters::MAX_COORDINATES;
use uam::plant::{self, Simulation};
use uam::{Parameters, Structure};

/// Length of a step \[s\].
pub const STEP: f64 = 1e-3;

/// The reaching motion, after which everything begins again. Each sample of a benchmark is all of it, for the
/// cost of a step changes on the way.
pub const STEPS: u32 = 1500;

/// A vehicle with this number of links.
pub fn links(links: usize) -> Structure {
    Structure { links, ..Structure::DEFAULT }
}

/// A controller on its way through the motion.
pub struct ControllerRun {
    start: Box<dyn Planner>,
    planner: Box<dyn Planner>,
    inputs: control::Inputs,
    steps: u32,
    pub outputs: control::Outputs,
}

impl ControllerRun {
    pub fn new(structure: Structure, parameters: Parameters) -> Self {
        let mut outputs = control::Outputs::default();
        let start = control::new(structure, &parameters, &mut outputs).unwrap();
        let planner = start.clone();
        Self { start, planner, inputs: control::Inputs::default(), steps: 0, outputs }
    }

    pub fn step(&mut self) {
        if self.steps == STEPS {
            (self.planner, self.steps) = (self.start.clone(), 0);
        }
        let t = f64::from(self.steps) * STEP;
        self.planner.step(&self.inputs, t, STEP, &mut self.outputs).unwrap();
        self.steps += 1;
    }
}

/// A plant on its way through the motion, under rates that were planned before.
pub struct PlantRun {
    start: Box<dyn Simulation>,
    simulation: Box<dyn Simulation>,
    inputs: plant::Inputs,
    rates: Vec<[f64; MAX_COORDINATES]>,
    steps: u32,
    pub outputs: plant::Outputs,
}

impl PlantRun {
    pub fn new(structure: Structure, parameters: Parameters) -> Self {
        let mut planned = ControllerRun::new(structure, parameters.clone());
        let rates = (0..STEPS)
            .map(|_| {
                let rate = planned.outputs.rate_command;
                planned.step();
                rate
            })
            .collect();
        let start = plant::new(structure, &parameters).unwrap();
        let simulation = start.clone();
        let (inputs, outputs) = (plant::Inputs::default(), plant::Outputs::default());
        Self { start, simulation, inputs, rates, steps: 0, outputs }
    }

    pub fn step(&mut self) {
        if self.steps == STEPS {
            (self.simulation, self.steps) = (self.start.clone(), 0);
        }
        self.inputs.rate_command = self.rates[self.steps as usize];
        let t = f64::from(self.steps) * STEP;
        self.simulation.step(&self.inputs, t, STEP, &mut self.outputs).unwrap();
        self.steps += 1;
    }

    /// To the middle of the motion.
    pub fn halfway(mut self) -> Self {
        (0..STEPS / 2).for_each(|_| self.step());
        self
    }

    /// A step, and all outputs after it.
    pub fn observed_step(&mut self) {
        self.step();
        self.simulation.observe(f64::from(self.steps) * STEP, &mut self.outputs).unwrap();
    }

    pub fn simulation(&self) -> &dyn Simulation {
        self.simulation.as_ref()
    }
}
