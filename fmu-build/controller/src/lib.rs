//! The controller as a shared library with the FMI 2.0 co-simulation interface.

uam::export_fmi2!(uam::units::controller::ControllerUnit);
