"""libcosim again: units and connections are taken from the SSP."""

from libcosimpy.CosimExecution import CosimExecution

from coupling import Coupling, Rows, serve
from with_libcosim import nanoseconds, run


def couple(coupling: Coupling) -> Rows:
    execution = CosimExecution.from_ssp_file(str(coupling.ssp), step_size=nanoseconds(coupling))
    yield from run(coupling, execution, execution.slave_index_from_instance_name("plant"))


if __name__ == "__main__":
    serve(couple)
