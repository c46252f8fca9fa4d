//! The two units of a structure, coupled in parallel: equal names are connected.

use std::ffi::c_int;
use std::ptr;

use misuse::functions::{Component, Functions, OK, State};
use misuse::host;
use misuse::unit::{Unit, Variable};
use uam::Structure;
use uam::fmi::{Identity, Model};
use uam::parameters::Balance;

use crate::environment::Environment;

/// An instance of one unit, with what is exchanged with it in each step.
pub struct Instance<'a> {
    functions: &'a Functions,
    component: Component,
    variables: Vec<Variable>,
    environment: Environment,
    /// What is written before each step.
    inputs: Vec<u32>,
    /// What is read after each step.
    outputs: Vec<u32>,
    /// What was read last.
    pub values: Vec<f64>,
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: not used again.
        unsafe { self.functions.free_instance(self.component) }
    }
}

// SAFETY, for all calls: the instance is alive, lists have the length that goes with them.
impl<'a> Instance<'a> {
    /// One of this structure: the library tells by the GUID which one is meant.
    fn new<M: Model<Structure = Structure>>(
        unit: &'a Unit,
        structure: Structure,
        environment: Environment,
    ) -> Result<Self, String> {
        let guid =
            std::ffi::CString::new(Identity::<M>::of(structure).guid().to_string()).map_err(|e| e.to_string())?;
        let (functions, callbacks) = (&unit.functions, host::callbacks());
        let (name, resources) = (c"stress".as_ptr(), c"file:///nowhere".as_ptr());
        let component = environment
            .of(|| unsafe { functions.instantiate(name, 1, guid.as_ptr(), resources, &raw const callbacks, 0, 0) });
        if component.is_null() {
            return Err(format!("{}, {structure}: no instance: {}", unit.name, host::said()));
        }
        let variables = Variable::of(&unit.name, structure);
        Ok(Self { functions, component, variables, environment, inputs: vec![], outputs: vec![], values: vec![] })
    }

    fn must(&self, name: &str, status: c_int) -> Result<(), String> {
        if status == OK { Ok(()) } else { Err(format!("{name}: status {status}, {}", host::said())) }
    }

    fn reference(&self, name: &str) -> Option<u32> {
        self.variables.iter().find(|variable| variable.name == name).map(|variable| variable.reference)
    }

    /// Begins to read all outputs, these ones first.
    fn read_first(&mut self, names: &[String]) {
        let first = names.iter().filter_map(|name| self.reference(name));
        let mut outputs: Vec<u32> = first.collect();
        let others = self.variables.iter().filter(|variable| variable.output).map(|variable| variable.reference);
        outputs.extend(others.filter(|reference| !outputs.contains(reference)).collect::<Vec<_>>());
        self.values = vec![0.0; outputs.len()];
        self.outputs = outputs;
    }

    /// The place of an output among the values.
    pub fn place(&self, name: &str) -> Option<usize> {
        let reference = self.reference(name)?;
        self.outputs.iter().position(|output| *output == reference)
    }

    /// Sets those of the variables that there are, of any type.
    pub fn set_all<'n>(&self, values: impl Iterator<Item = (&'n str, f64)>) -> Result<(), String> {
        let (references, values): (Vec<_>, Vec<_>) =
            values.filter_map(|(name, value)| Some((self.reference(name)?, value))).unzip();
        self.set(&references, &values)
    }

    fn set(&self, references: &[u32], values: &[f64]) -> Result<(), String> {
        let status = self.environment.of(|| unsafe {
            self.functions.set_real(self.component, references.as_ptr(), references.len(), values.as_ptr())
        });
        self.must("fmi2SetReal", status)
    }

    /// Sets the inputs.
    pub fn give(&self, values: &[f64]) -> Result<(), String> {
        self.set(&self.inputs, values)
    }

    /// Reads the outputs.
    pub fn read(&mut self) -> Result<(), String> {
        let Self { functions, component, outputs, values, .. } = self;
        let status = self
            .environment
            .of(|| unsafe { functions.get_real(*component, outputs.as_ptr(), outputs.len(), values.as_mut_ptr()) });
        self.must("fmi2GetReal", status)
    }

    /// Makes it as new.
    pub fn reset(&self) -> Result<(), String> {
        self.must("fmi2Reset", unsafe { self.functions.reset(self.component) })
    }

    /// From parameters to the first communication point.
    pub fn begin(&mut self, start: f64) -> Result<(), String> {
        let (functions, component) = (self.functions, self.component);
        let [set_up, entered, left] = self.environment.of(|| unsafe {
            [
                functions.setup_experiment(component, 0, 0.0, start, 0, 0.0),
                functions.enter_initialization(component),
                functions.exit_initialization(component),
            ]
        });
        self.must("fmi2SetupExperiment", set_up)?;
        self.must("fmi2EnterInitializationMode", entered)?;
        self.must("fmi2ExitInitializationMode", left)?;
        self.read()
    }

    /// One communication step.
    pub fn step(&mut self, from: f64, size: f64) -> Result<(), String> {
        let status = self.environment.of(|| unsafe { self.functions.do_step(self.component, from, size, 1) });
        self.must("fmi2DoStep", status)
    }

    /// Its state.
    pub fn save(&self) -> Result<State, String> {
        let mut state = ptr::null_mut();
        let status = self.environment.of(|| unsafe { self.functions.get_state(self.component, &raw mut state) });
        self.must("fmi2GetFMUstate", status)?;
        Ok(state)
    }

    /// The same state, which was bytes in between.
    pub fn through_bytes(&self, mut state: State) -> Result<State, String> {
        let (functions, component) = (self.functions, self.component);
        let mut size = 0;
        let status = self.environment.of(|| unsafe { functions.state_size(component, state, &raw mut size) });
        self.must("fmi2SerializedFMUstateSize", status)?;
        let mut bytes = vec![0; size];
        let mut copy = ptr::null_mut();
        let [written, freed, read] = self.environment.of(|| unsafe {
            [
                functions.serialize_state(component, state, bytes.as_mut_ptr(), size),
                functions.free_state(component, &raw mut state),
                functions.deserialize_state(component, bytes.as_ptr(), size, &raw mut copy),
            ]
        });
        self.must("fmi2SerializeFMUstate", written)?;
        self.must("fmi2FreeFMUstate", freed)?;
        self.must("fmi2DeSerializeFMUstate", read)?;
        Ok(copy)
    }

    /// Goes back to a state, and gives that up.
    pub fn restore(&self, mut state: State) -> Result<(), String> {
        let [set, freed] = self.environment.of(|| unsafe {
            [self.functions.set_state(self.component, state), self.functions.free_state(self.component, &raw mut state)]
        });
        self.must("fmi2SetFMUstate", set)?;
        self.must("fmi2FreeFMUstate", freed)
    }
}

/// Controller and plant.
pub struct Pair<'a> {
    /// How many coordinates there are.
    pub coordinates: usize,
    /// Its values: rate and acceleration of each coordinate, grasp, and so on as in [`Pair::new`].
    pub controller: Instance<'a>,
    /// Its values begin with pose and velocity of the base, position of each coordinate and end effector.
    pub plant: Instance<'a>,
    /// How many of the controller's first outputs are inputs of the plant.
    connected: usize,
}

impl<'a> Pair<'a> {
    /// New instances.
    pub fn new<C, P>(units: &'a [Unit; 2], structure: Structure, environment: Environment) -> Result<Self, String>
    where
        C: Model<Structure = Structure>,
        P: Model<Structure = Structure>,
    {
        let mut controller = Instance::new::<C>(&units[0], structure, environment)?;
        let mut plant = Instance::new::<P>(&units[1], structure, environment)?;
        let joints = (1..=structure.links).map(|n| format!("joint[{n}]"));
        let parts: Vec<_> = joints.chain(structure.balance.prefix().map(str::to_owned)).collect();
        debug_assert_eq!(parts.len(), structure.coordinates(), "{}", Balance::ALL.len());
        let of_all = |what: &str| parts.iter().map(|part| format!("{part}.{what}")).collect::<Vec<_>>();
        let base = ["x", "y", "roll", "vx", "vy", "roll_rate"].map(|name| format!("base.{name}"));
        let tip = ["x", "y"].map(|axis| format!("end_effector.{axis}"));
        let observed = [base.to_vec(), of_all("position"), tip.to_vec()].concat();
        let predicted: Vec<_> = observed.iter().map(|name| format!("predicted.{name}")).collect();
        let commands = [of_all("rate_command"), of_all("acceleration_command"), vec!["grasp".to_owned()]].concat();
        let wanted = ["x", "y"].map(|axis| format!("reference.{axis}"));
        controller.read_first(&[commands.clone(), predicted, wanted.to_vec()].concat());
        plant.read_first(&observed);
        plant.inputs = commands.iter().filter_map(|name| plant.reference(name)).collect();
        let outside = ["x", "y", "vx", "vy", "ax", "ay"].map(|name| format!("external_reference.{name}"));
        controller.inputs = outside.iter().filter_map(|name| controller.reference(name)).collect();
        // Whatever else has the same name would be connected, too.
        let equal = controller.variables.iter().filter(|variable| variable.output);
        let equal =
            equal.filter(|variable| plant.variables.iter().any(|input| !input.output && input.name == variable.name));
        if equal.count() != commands.len() || plant.inputs.len() != commands.len() {
            return Err(format!("{structure}: the names that the units have in common are not {commands:?}"));
        }
        Ok(Self { coordinates: structure.coordinates(), controller, plant, connected: commands.len() })
    }

    /// One communication step of both: first all values are exchanged, then both go on.
    pub fn step(&mut self, from: f64, size: f64, wanted: Option<[f64; 6]>) -> Result<(), String> {
        self.plant.give(&self.controller.values[..self.connected])?;
        if let Some(wanted) = wanted {
            self.controller.give(&wanted)?;
        }
        self.plant.step(from, size).map_err(|message| format!("plant: {message}"))?;
        self.controller.step(from, size).map_err(|message| format!("controller: {message}"))?;
        self.read()
    }

    /// Reads the outputs of both.
    pub fn read(&mut self) -> Result<(), String> {
        self.controller.read().map_err(|message| format!("controller: {message}"))?;
        self.plant.read().map_err(|message| format!("plant: {message}"))
    }
}
