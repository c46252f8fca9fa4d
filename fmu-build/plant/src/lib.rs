//! The plant as a shared library with the FMI 2.0 co-simulation interface.

uam::export_fmi2!(uam::units::plant::PlantUnit);
