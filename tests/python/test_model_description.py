"""Facts of the model descriptions that validators do not look at, for every structure."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest

from conftest import ALL, Pair, build
from unit import Unit

Element = ElementTree.Element
UNITS = [(structure, unit) for structure in ALL for unit in ("controller", "plant")]
EVERY_UNIT = pytest.mark.parametrize(
    "root", UNITS, ids=lambda unit: f"{unit[0]}-{unit[1]}", indirect=True
)


@pytest.fixture
def root(request: pytest.FixtureRequest) -> Element:
    """The model description of a unit."""
    structure, unit = request.param
    with zipfile.ZipFile(getattr(build(structure), unit)) as fmu:
        return ElementTree.fromstring(fmu.read("modelDescription.xml"))


def variables(root: Element) -> Iterator[tuple[Element, Element]]:
    """Every variable with the element of its type."""
    for variable in root.iterfind("ModelVariables/ScalarVariable"):
        yield variable, variable[0]


@EVERY_UNIT
def test_units_are_defined(root: Element) -> None:
    units = {unit.get("name"): unit for unit in root.iterfind("UnitDefinitions/Unit")}
    used = set()
    for variable, kind in variables(root):
        unit = kind.get("unit")
        assert (unit is not None) == (kind.tag == "Real"), variable.get("name")
        if unit:
            used.add(unit)
            displays = {display.get("name") for display in units[unit].iterfind("DisplayUnit")}
            assert kind.get("displayUnit") in displays | {None}
    assert used == set(units), "no unit is there for nothing"
    assert all(unit.find("BaseUnit") is not None for unit in units.values())


@EVERY_UNIT
def test_enumerations(root: Element) -> None:
    """FMI 2.0, 2.2.3: items by number; here from 1, each with a word of explanation."""
    types = {kind.get("name"): kind for kind in root.iterfind("TypeDefinitions/SimpleType")}
    for kind in types.values():
        items = kind.findall("Enumeration/Item")
        assert [int(item.get("value", "")) for item in items] == list(range(1, len(items) + 1))
        assert len({item.get("name") for item in items}) == len(items)
        assert all(item.get("description") for item in items) and kind.get("description")
    for variable, kind in variables(root):
        if kind.tag == "Enumeration":
            items = types[kind.get("declaredType")].findall("Enumeration/Item")
            start = kind.get("start")
            assert start is None or 1 <= int(start) <= len(items)
            assert variable.get("variability") != "continuous"


@EVERY_UNIT
def test_start_values_are_within_bounds(root: Element) -> None:
    bounded = 0
    for variable, kind in variables(root):
        settable = variable.get("causality") in ("parameter", "input")
        assert (kind.get("start") is not None) == settable, variable.get("name")
        if kind.tag == "Real" and settable:
            start = float(kind.get("start", ""))
            assert float(kind.get("min", "-inf")) <= start <= float(kind.get("max", "inf"))
            bounded += "min" in kind.attrib
    assert bounded > 10


@EVERY_UNIT
def test_names_are_structured_and_unambiguous(root: Element) -> None:
    """FMI 2.0, 2.2.9; records and leaves share no name, for some hosts make buses of records."""
    names = [variable.get("name", "") for variable, _ in variables(root)]
    part = r"[a-zA-Z]\w*(\[[1-9]\d*\])?"
    assert all(re.fullmatch(rf"{part}(\.{part})*", name) for name in names)
    records = {name[: dot.start()] for name in names for dot in re.finditer(r"\.", name)}
    assert not records & set(names)
    assert all(variable.get("description") for variable, _ in variables(root))


@EVERY_UNIT
def test_initial_and_variability_go_together(root: Element) -> None:
    """FMI 2.0, 2.2.7, table of allowed combinations."""
    allowed = {
        ("parameter", "fixed", "exact"),
        ("parameter", "tunable", "exact"),
        ("input", "continuous", None),
        ("input", "discrete", None),
        ("output", "continuous", "calculated"),
        ("output", "discrete", "calculated"),
        ("independent", "continuous", None),
    }
    for variable, _ in variables(root):
        attributes = tuple(variable.get(key) for key in ("causality", "variability", "initial"))
        assert attributes in allowed, variable.attrib
    assert [v.get("name") for v, _ in variables(root) if v.get("causality") == "independent"] == [
        "time"
    ]


def unknowns(root: Element, group: str) -> Iterator[tuple[str, list[str]]]:
    """Names of unknowns and of what they depend on; both lists as written are checked."""
    names = [variable.get("name", "") for variable, _ in variables(root)]
    for unknown in root.iterfind(f"ModelStructure/{group}/Unknown"):
        indices = [int(index) for index in unknown.attrib["dependencies"].split()]
        kinds = unknown.attrib["dependenciesKind"].split()
        assert indices == sorted(set(indices)) and len(kinds) == len(indices)
        yield names[int(unknown.attrib["index"]) - 1], [names[index - 1] for index in indices]


@EVERY_UNIT
def test_outputs_depend_on_nothing_at_a_communication_point(root: Element) -> None:
    """An attribute that is left out would mean: on everything."""
    outputs = [v.get("name") for v, _ in variables(root) if v.get("causality") == "output"]
    found = dict(unknowns(root, "Outputs"))
    assert list(found) == outputs
    assert not any(found.values())


@EVERY_UNIT
def test_initial_unknowns_depend_on_parameters_only(root: Element) -> None:
    causality = {v.get("name"): v.get("causality") for v, _ in variables(root)}
    found = dict(unknowns(root, "InitialUnknowns"))
    assert list(found) == [name for name, kind in causality.items() if kind == "output"]
    for name, dependencies in found.items():
        assert all(causality[other] == "parameter" for other in dependencies), name


@EVERY_UNIT
def test_head(root: Element) -> None:
    assert root.get("fmiVersion") == "2.0"
    assert root.get("variableNamingConvention") == "structured"
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", root.get("guid", ""))
    categories = [category.get("name") for category in root.iterfind("LogCategories/Category")]
    assert {"logEvents", "logStatusWarning", "logStatusError"} <= set(categories)
    experiment = root.find("DefaultExperiment")
    assert experiment is not None
    assert {key: float(value) for key, value in experiment.items()} == {
        "startTime": 0.0,
        "stopTime": 30.0,
        "stepSize": 1e-3,
    }


# What a value of a parameter goes together with only.
COMPANY = {
    ("ik.resolution", 5): {"ik.hold": 2},
    ("ik.path_axes", 2): {"ik.resolution": 5, "ik.hold": 2},
}
# A unit without a table inside cannot follow one.
REFUSED = {("reference.kind", 4)}


@pytest.mark.parametrize("unit", ["controller", "plant"])
def test_initial_unknowns_depend_on_what_they_list(pair: Pair, unit: str) -> None:
    """Every parameter is changed in turn: what changes of the initial outputs must list it."""
    with Unit(getattr(pair, unit)) as opened:
        model, instance = opened.description, opened.instantiate()
        listed = {
            unknown.variable.name: {dependency.name for dependency in unknown.dependencies}
            for unknown in model.initialUnknowns
        }
        assert len(opened.variables) > 80 and any(listed.values())
        outputs = opened.names("output")
        # The last leg is not in use: with a duration, its other parameters mean something.
        base = {"reference.leg[4].duration": 1.0, "reference.leg[4].ramp": 0.2}
        base = {name: value for name, value in base.items() if name in opened.variables}

        def initial(changes: dict[str, float]) -> list[float]:
            instance.slave.reset()
            instance.initialize(parameters=base | changes)
            return instance.all(outputs)

        usual = initial({})
        effective = 0
        for name in opened.names("parameter"):
            parameter = opened.variables[name]
            start = float(parameter.start)
            if parameter.type == "Enumeration":
                others = range(1, len(parameter.declaredType.items) + 1)
                values = [float(item) for item in others if item != start]
            else:
                values = [base.get(name, start) * 0.9 + 0.01]
            for value in values:
                if (name, value) in REFUSED:
                    continue
                company = COMPANY.get((name, value), {})
                expected = initial(company) if company else usual
                found = initial(company | {name: value})
                changed = {o for o, old, new in zip(outputs, expected, found) if old != new}
                missing = {output for output in changed if name not in listed[output]}
                assert not missing, f"{name} decides {missing}"
                effective += bool(changed)
        assert effective > 10


@pytest.mark.parametrize("unit", ["controller", "plant"])
def test_contents(pair: Pair, unit: str) -> None:
    fmu: Path = getattr(pair, unit)
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
    assert {"modelDescription.xml", "documentation/index.html", "model.png"} <= set(names)
    assert (
        len([name for name in names if re.fullmatch(rf"binaries/\w+/{fmu.stem}\.\w+", name)]) == 1
    )
