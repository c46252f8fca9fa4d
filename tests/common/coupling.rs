//! Controller and plant connected by rates and grasp, as a master would.

use uam::control::{self, Inputs, Planner};
use uam::{Parameters, Structure};

use super::run::Run;

pub struct Coupling {
    pub plant: Run,
    pub commands: control::Outputs,
    pub external: Inputs,
    planner: Box<dyn Planner>,
}

impl Coupling {
    pub fn new(structure: Structure, parameters: &Parameters) -> Self {
        let mut commands = control::Outputs::default();
        let planner = control::new(structure, parameters, &mut commands).unwrap();
        Self { plant: Run::new(structure, parameters.clone()), commands, external: Inputs::default(), planner }
    }

    /// One communication step: the plant under the present commands, then the controller.
    pub fn try_step(&mut self, size: f64) -> uam::Result<()> {
        let t = self.plant.time;
        self.plant.inputs.rate_command = self.commands.rate_command;
        self.plant.inputs.acceleration_command = self.commands.acceleration_command;
        self.plant.inputs.grasp = self.commands.grasp;
        self.plant.try_step(size)?;
        self.planner.tune(&self.plant.model.parameters);
        self.planner.step(&self.external, t, size, &mut self.commands)
    }

    #[track_caller]
    pub fn step(&mut self, size: f64) {
        self.try_step(size).unwrap();
    }

    /// How far the plant's end effector is from where it should be.
    pub fn error(&self) -> f64 {
        (self.plant.outputs.end_effector - self.commands.reference).norm()
    }
}
