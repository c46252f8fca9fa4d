"""CoFMUpy: its default master. It drives the first step with zeros at all connected inputs."""

from cofmupy import Coordinator

from coupling import GRASP, RATES, RECORDED, Coupling, Rows, serve


def couple(coupling: Coupling) -> Rows:
    units = {"controller": coupling.controller, "plant": coupling.plant}
    coordinator = Coordinator()
    coordinator.start(
        {
            "fmus": [{"id": name, "path": str(path)} for name, path in units.items()],
            "connections": [
                {
                    "source": {"type": "fmu", "id": "controller", "variable": name},
                    "target": {"type": "fmu", "id": "plant", "variable": name},
                }
                for name in (*RATES, GRASP)
            ]
            + [
                # The controller ignores this input as long as it follows its own path, but a wire
                # back makes CoFMUpy step both in parallel; without, the controller steps first.
                {
                    "source": {"type": "fmu", "id": "plant", "variable": "end_effector.x"},
                    "target": {
                        "type": "fmu",
                        "id": "controller",
                        "variable": "external_reference.x",
                    },
                }
            ],
            "cosim_method": "jacobi",
        }
    )
    coordinator.run_simulation(coupling.step, coupling.stop)
    results = coordinator.get_results()
    # Its rows carry the beginning of a step and the values at its end.
    ends = [time + coupling.step for time in results["time"]]
    return zip(ends, *(results["plant", name] for name in RECORDED))


if __name__ == "__main__":
    serve(couple)
