"""A container of both FMUs by the FMU Manipulation Toolbox, run by FMPy: one FMU that is a master.

python with_container.py ... [--sequential]    lets the plant step first, the controller after it
"""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from fmpy import simulate_fmu

from coupling import RECORDED, Coupling, Rows, serve

SEQUENTIAL = "--sequential" in sys.argv
if SEQUENTIAL:
    sys.argv.remove("--sequential")


def couple(coupling: Coupling) -> Rows:
    with TemporaryDirectory() as folder:
        for fmu in (coupling.plant, coupling.controller):
            Path(folder, fmu.name).symlink_to(fmu)
        lines = ["rule;from_fmu;from_port;to_fmu;to_port"]
        # Units step in the order in which they are named; equal names are linked.
        lines += [f"FMU;{fmu.name};;;" for fmu in (coupling.plant, coupling.controller)]
        Path(folder, "uam.csv").write_text("\n".join(lines) + "\n")
        command = [Path(sys.executable).with_name("fmucontainer"), "-fmu-directory", folder]
        command += ["-container", f"uam.csv:{coupling.step}"]
        subprocess.run([*command, *["-sequential"] * SEQUENTIAL], check=True, capture_output=True)
        result = simulate_fmu(
            str(Path(folder, "uam.fmu")),
            stop_time=coupling.stop,
            output_interval=coupling.step,
            output=RECORDED,
        )
    return zip(*(result[name] for name in ["time", *RECORDED]))


if __name__ == "__main__":
    serve(couple)
