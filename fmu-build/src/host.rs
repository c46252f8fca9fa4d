//! FMUs in the hands of a host: [`fmu`] loads them as any master would, [`coupling`] connects a pair, [`run`] puts a scenario
//! through it, and [`record`] keeps what came out.

pub mod coupling;
pub mod fmu;
pub mod record;
pub mod run;
pub mod settings;
