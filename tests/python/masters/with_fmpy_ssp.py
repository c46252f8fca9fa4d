"""FMPy's own master for SSP. It drives the first step with zeros at all connected inputs."""

from fmpy.ssp.simulation import simulate_ssp

from coupling import RECORDED, Coupling, Rows, serve


def couple(coupling: Coupling) -> Rows:
    # It steps while time < stop, with a running sum; its rows carry the beginning of the step.
    stop = coupling.stop - coupling.step / 2
    table = simulate_ssp(str(coupling.ssp), stop_time=stop, step_size=coupling.step)
    columns = [table[f"plant.{name}"] for name in RECORDED]
    return zip(table["time"] + coupling.step, *columns)


if __name__ == "__main__":
    serve(couple)
