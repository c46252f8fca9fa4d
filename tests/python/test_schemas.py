"""Every XML file that is written follows the schema of its standard; FMPy carries the schemas."""

from __future__ import annotations

import io
import zipfile
from functools import cache
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from conftest import FULL, SOME, Structure, build, program

FOLDER = Path(fmpy.__file__).parent
SCHEMAS = {
    "modelDescription.xml": "schema/fmi2/fmi2ModelDescription.xsd",
    "terminalsAndIcons.xml": "schema/fmi3/fmi3TerminalsAndIcons.xsd",
    "SystemStructure.ssd": "ssp/schema/SystemStructureDescription.xsd",
    ".ssv": "ssp/schema/SystemStructureParameterValues.xsd",
}
# Vehicles with start values, names and methods of their own.
OWN = [("4.4b",), ("3.4-1", "--flat"), ("2.5b",)]
# What differs from the start values of the units may be nothing, have no unit, or be all there is.
MINE = {
    "nothing": "",
    "choices": 'parameters.autopilot.mode = "ideal"\nparameters.ik.base_model = "ideal"\n',
    "numbers": 'parameters."link[1].mass" = 0.3\nparameters.gravity = 1.62\n',
    "letters": 'title = "Zwölf <kg> & \\"mehr\\" – 12 µm 🚁"\n',
}


@cache
def schema(path: str) -> etree.XMLSchema:
    """A schema of FMPy."""
    return etree.XMLSchema(file=str(FOLDER / path))


def check(name: str, content: bytes) -> int:
    """Check a file, and all files in it if it is an archive; how many documents there were."""
    if name.endswith((".fmu", ".ssp")):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return sum(check(member, archive.read(member)) for member in archive.namelist())
    if not name.endswith((".xml", ".ssd", ".ssv")):
        return 0
    (path,) = (path for ending, path in SCHEMAS.items() if name.endswith(ending))
    schema(path).assertValid(etree.fromstring(content))
    return 1


def check_folder(folder: Path) -> int:
    """Check every file in a folder."""
    return sum(check(path.name, path.read_bytes()) for path in folder.iterdir() if path.is_file())


@pytest.mark.parametrize("structure", SOME, ids=str)
def test_units_and_system_of_a_structure(structure: Structure) -> None:
    """Two in each FMU, which stands in the SSP, too, beside its own two documents."""
    assert check_folder(build(structure, "--terminals").plant.parent) == 2 * 4 + 2


@pytest.mark.parametrize("arguments", OWN, ids=" ".join)
def test_units_and_system_of_an_own_vehicle(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    program("build", "--terminals", "--scenario", *arguments, "--out", str(tmp_path))
    assert check_folder(tmp_path) == 2 * 4 + 2


def test_every_exported_scenario(tmp_path: Path) -> None:
    scenarios = [line.split()[0] for line in program("list").splitlines()]
    assert len(scenarios) > 40
    for scenario in scenarios:
        program("export", scenario, "--out", str(tmp_path))
    assert check_folder(tmp_path) == 2 * len(scenarios)


@pytest.mark.parametrize("mine", MINE)
def test_scenarios_of_ones_own(tmp_path: Path, mine: str) -> None:
    file = tmp_path / "mine.toml"
    base = "" if mine == "letters" else 'title = "Mine"\n'
    head = f'id = "{mine}"\nduration = 1.0\nstructure.links = 3\n{base}'
    file.write_text(head + MINE[mine])
    program("export", str(file), "--out", str(tmp_path))
    assert check_folder(tmp_path) == 2
    if FULL:
        program("build", "--terminals", "--scenario", str(file), "--out", str(tmp_path))
        assert check_folder(tmp_path) == 2 + 2 * 4 + 2
