"""Terminals and icons: the file of FMI 3.0 in units of FMI 2.0, where it is asked for."""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy import read_model_description
from lxml import etree

from conftest import SOME, Structure, build

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"


def members(fmu: Path) -> dict[str, str]:
    """The variables of the only terminal, by member; checked against the schema of the standard."""
    with zipfile.ZipFile(fmu) as archive:
        root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        icon = archive.read("terminalsAndIcons/icon.png")
    etree.XMLSchema(file=str(SCHEMA)).assertValid(root)
    assert icon.startswith(b"\x89PNG")
    (terminal,) = root.iter("Terminal")
    assert (terminal.get("name"), terminal.get("matchingRule")) == ("commands", "plug")
    return {m.get("memberName"): m.get("variableName") for m in terminal}


def fmi_library_complains(fmu: Path) -> bool:
    """The rule of FMI Library 3.0.4: the file, if any, has the model description's version."""
    with zipfile.ZipFile(fmu) as archive:
        if "terminalsAndIcons/terminalsAndIcons.xml" not in archive.namelist():
            return False
        names = ("terminalsAndIcons/terminalsAndIcons.xml", "modelDescription.xml")
        here, there = (etree.fromstring(archive.read(name)).get("fmiVersion") for name in names)
    return here != there


@pytest.mark.parametrize("structure", SOME, ids=str)
def test_no_importer_complains_unless_the_file_is_asked_for(structure: Structure) -> None:
    """What the schema wants and what FMI Library wants exclude each other."""
    pair = build(structure)
    assert not fmi_library_complains(pair.controller) and not fmi_library_complains(pair.plant)
    asked = build(structure, "--terminals")
    assert fmi_library_complains(asked.plant) and members(asked.plant)


@pytest.mark.parametrize("structure", SOME, ids=str)
def test_both_units_have_matching_plugs(structure: Structure) -> None:
    pair = build(structure, "--terminals")
    controller, plant = members(pair.controller), members(pair.plant)
    assert controller.keys() == plant.keys()
    coordinates = structure.links + (structure.balance != "none")
    assert len(plant) == 2 * coordinates + 1
    for fmu, causality, plug in (
        (pair.controller, "output", controller),
        (pair.plant, "input", plant),
    ):
        known = {v.name: v.causality for v in read_model_description(fmu).modelVariables}
        assert {known[name] for name in plug.values()} == {causality}
