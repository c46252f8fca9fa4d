//! A plant with its inputs and outputs, stepped by hand.

use nalgebra::{Vector2, Vector3};
use uam::plant::{self, Inputs, Outputs, Simulation};
use uam::{Parameters, Structure};

use super::model::{self, Body, Model};

#[derive(Clone)]
pub struct Run {
    pub model: Model,
    pub inputs: Inputs,
    pub outputs: Outputs,
    pub time: f64,
    simulation: Box<dyn Simulation>,
}

impl Run {
    pub fn new(structure: Structure, parameters: Parameters) -> Self {
        let simulation = plant::new(structure, &parameters).unwrap();
        let mut outputs = Outputs::default();
        simulation.initial_outputs(&mut outputs).unwrap();
        Self { model: Model { structure, parameters }, inputs: Inputs::default(), outputs, time: 0.0, simulation }
    }

    pub fn try_step(&mut self, size: f64) -> uam::Result<()> {
        self.simulation.tune(&self.model.parameters);
        self.simulation.step(&self.inputs, self.time, size, &mut self.outputs)?;
        self.simulation.observe(self.time + size, &mut self.outputs)?;
        self.time += size;
        Ok(())
    }

    #[track_caller]
    pub fn step(&mut self, size: f64) {
        self.try_step(size).unwrap();
    }

    /// The right limit: the present instant under the present inputs, after all jumps.
    pub fn jump(&mut self) {
        self.step(0.0);
    }

    pub fn steps(&mut self, number: usize, size: f64) {
        for _ in 0..number {
            self.step(size);
        }
    }

    /// The outputs now and after each of `number` steps of `size`, under the present inputs.
    pub fn record(&mut self, number: usize, size: f64) -> Vec<Outputs> {
        let mut all = vec![self.outputs.clone()];
        for _ in 0..number {
            self.step(size);
            all.push(self.outputs.clone());
        }
        all
    }

    pub fn rates(&self) -> plant::OutputDerivatives {
        self.simulation.output_derivatives()
    }

    pub fn bodies(&self) -> Vec<Body> {
        self.model.observed(&self.outputs, self.outputs.attached)
    }

    /// What the integrator must get right, in one list.
    pub fn motion(&self) -> Vec<f64> {
        let o = &self.outputs;
        [o.pose.as_slice(), o.velocity.as_slice(), o.momentum.as_slice(), &o.position].concat()
    }

    /// Force on the whole system and its moment about the origin, from the outputs' thrust and torque.
    pub fn load(&self, outputs: &Outputs) -> Vector3<f64> {
        let (model, inputs) = (&self.model, &self.inputs);
        let bodies = model.observed(outputs, outputs.attached);
        let at = model.coordinates(outputs);
        let roll = outputs.pose.z;
        let base_force = inputs.load.base_force + outputs.thrust * Vector2::new(-roll.sin(), roll.cos());
        let push = if outputs.attached { model.parameters.support.stiffness * model.pressed(outputs) } else { 0.0 };
        let support = Vector2::new(0.0, push);
        let weight = Vector2::new(0.0, -model::mass(&bodies) * model.gravity());
        let force = base_force + inputs.load.tip_force + support + weight;
        let moment = outputs.torque
            + inputs.load.base_torque
            + inputs.load.tip_torque
            + model::cross(outputs.pose.xy(), base_force)
            + model::cross(model.end_effector(&at), inputs.load.tip_force)
            + model::cross(model.payload(&at), support)
            + model::weight_moment(&bodies, model.gravity(), Vector2::zeros());
        Vector3::new(force.x, force.y, moment)
    }
}
