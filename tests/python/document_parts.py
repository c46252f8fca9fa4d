"""Every table and list of numbers in the documents that comes from a command, with that command."""

from __future__ import annotations

import re
import struct
import zipfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import hosts
from conftest import FULL, TARGET, program
from documents import MISSING, NUMBER, Block, Hosts, MissingError, Part, Quote, Sizes, Times

README, THESIS, DAMPING = "README.md", "docs/thesis.md", "docs/damping.md"
STEPS_PAGE, SPEED = "docs/co-simulation.md", "docs/performance.md"
COMPATIBILITY = "docs/compatibility.md"
CLAIMS, WHICH_STEP = (
    "fmu-build/src/study/claims/thesis.rs",
    "fmu-build/src/package/text/which_step.md",
)
OUT = TARGET / "documents"

Numbers = Callable[[], list[float]]


@cache
def printed(*arguments: str) -> str:
    """What the project's program prints; the files that it writes besides go where nobody looks."""
    prints_only = arguments[:1] in (("thesis",), ("vary",))
    return program(*arguments, *(() if prints_only else ("--out", str(OUT))))


def command(*arguments: str) -> Callable[[], str]:
    return lambda: printed(*arguments)


def main_command() -> str:
    """The table of the main command, set in as a block of code."""
    lines = [line for line in printed().splitlines() if line[:1] in set("┌│╞└")]
    return "\n".join(f"    {line}" for line in lines)


def table_of_hosts() -> str:
    lines = [hosts.HEAD]
    for host in hosts.HOSTS:
        try:
            lines.append(hosts.row(host))
        except hosts.MissingError:
            lines.append(f"| {hosts.title(host)} | {MISSING} |")
    return "\n".join(lines)


def peers() -> str:
    """What the comparison with other programs has written last."""
    page = TARGET / "peers" / "peers.md"
    if not page.exists():
        raise MissingError("bash fmu-build/benches/peers/run has not been run")
    return page.read_text()


PLATFORMS = {
    "linux64": ["linux64"],
    "win64": ["win64"],
    "darwin64": ["darwin64, x86-64", "darwin64, ARM"],
    "aarch64-linux": ["aarch64-linux"],
}


def processors(library: bytes) -> Iterator[int]:
    """The size of a library for each processor that it is for [B]; one of macOS holds several."""
    magic, count = struct.unpack_from(">II", library)
    if magic != 0xCAFEBABE:
        yield len(library)
        return
    for n in range(count):
        yield struct.unpack_from(">IIIII", library, 8 + 20 * n)[3]


def sizes() -> str:
    if not FULL:
        raise MissingError("binaries for other machines are built in the large set only")
    folder = OUT / "platforms"
    program("build", "--all-platforms", "--out", str(folder))
    lines = ["| binaries | controller | plant |", "|---|---|---|"]
    for platform, names in PLATFORMS.items():
        place = folder / platform if platform == "aarch64-linux" else folder
        columns = [
            list(processors(library)) if (library := binary(place, unit, platform)) else []
            for unit in ("uam_controller", "uam_plant")
        ]
        for n, name in enumerate(names):
            cells = [f"{column[n] / 1000:.0f} kB" if column else MISSING for column in columns]
            lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def binary(folder: Path, unit: str, platform: str) -> bytes | None:
    if not (folder / f"{unit}.fmu").exists():
        return None
    with zipfile.ZipFile(folder / f"{unit}.fmu") as fmu:
        found = [name for name in fmu.namelist() if name.startswith(f"binaries/{platform}/")]
        return fmu.read(found[0]) if found else None


def rows(table: str) -> list[list[str]]:
    """The cells of a table in Markdown, below its heading."""
    lines = [line for line in table.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def numbers_in(cells: list[str]) -> list[float]:
    """Numbers with a unit, and perhaps a mark; lengths in mm."""
    found = [re.fullmatch(f"({NUMBER}) (.*?)( [✓✗])?", cell) for cell in cells]
    return [float(match[1]) * (1e3 if match[2] == "m" else 1.0) for match in found]


EULER, EXACT = 0, 1


def varied(scenario: str, quantity: str, *changes: str, by: int = EULER) -> Numbers:
    """A quantity of a simulation as it is, and with each of the changes; lengths in mm."""

    def numbers() -> list[float]:
        table = rows(printed("vary", scenario, *changes, "--all", "--markdown"))
        half = len(table) // 2
        halves = table[:half], table[half:]
        (cells,) = (row[3:] for row in halves[by] if row[1] == quantity)
        return numbers_in(cells)

    return numbers


def some(*parts: tuple[Numbers, slice]) -> Numbers:
    """Some of the numbers of each."""
    return lambda: [number for numbers, wanted in parts for number in numbers()[wanted]]


def reached(acceleration: str, by: int) -> Numbers:
    """How far the arm reaches in the four motions, by the joints' limit of acceleration [mm]."""
    change = f"joint[*].acceleration_limit={acceleration}"
    return lambda: numbers_in([row[2 + by] for row in rows(printed("reach", change, "--markdown"))])


ALL, FIRST, CHANGED = slice(None), slice(1), slice(1, None)
WAY_X, WAY_Y = "UAV moves along x by", "UAV moves along y by"
ERROR, ERROR_Y = "largest end-effector error", "largest end-effector error in y"
END_X = "end-effector error in x at the end"

PACES_2_3A = varied("2.3a", END_X, "pace=2,3.33,5")
PACES_3_2B = varied("3.2b", WAY_X, "pace=0.8,0.9,1,1.1")
PACES_3_5A = varied("3.5a", ERROR_Y, "pace=1,2,3,4")
RAMPS = (f"reference.leg[{n}].profile=trapezoidal" for n in (1, 2))
RAMPS_3_8A = varied("3.8a", WAY_X, *RAMPS)
PACES_3_8A = varied("3.8a", WAY_X, "pace=0.90909,0.5", "duration=6,10")
STEPS = "step=0.002,0.0005,0.00025", "sample_time=0.002,0.0005,0.00025"
STEPS_4_3B = varied("4.3b", ERROR, *STEPS)
PACE_3_7 = varied("3.7", ERROR, "pace=1")
SIDES_3_2C = varied("3.2c", WAY_Y, "pace=2")
LAWS_4_4B = "joint[*].acceleration_limit=60,20,20", "counterweight.time_constant=0.02,0.15,0.21"

SLOW_LAW = "counterweight.time_constant=0.4"

PARTS: list[Part] = [
    # The program prints these words into the table of the thesis: they go first.
    Quote(
        CLAIMS,
        "but to {:.2f} mm, and to {:.1f} mm if the path takes 3 s",
        some((PACES_2_3A, FIRST), (PACES_2_3A, slice(2, 3))),
    ),
    Quote(CLAIMS, "{:.3f} mm with either discretization", some((PACES_3_2B, FIRST))),
    Quote(CLAIMS, "{:.0f} mm at three times its pace", some((PACES_3_5A, slice(3, 4)))),
    Quote(CLAIMS, "{:.2f} mm, as with the extended Jacobian", some((PACE_3_7, FIRST))),
    Quote(
        CLAIMS,
        "{:.1f} to {:.1f} mm if the motion takes 4 s as the text says, {:.1f} mm if it takes 4 s",
        some(
            (varied("3.8a", WAY_X, "pace=0.90909,0.5", "duration=6,10", by=EXACT), FIRST),
            (PACES_3_8A, FIRST),
            (PACES_3_8A, slice(2, 3)),
        ),
    ),
    Block(README, "cargo run --release", main_command),
    Block(THESIS, "thesis --markdown", command("thesis", "--markdown")),
    Block(STEPS_PAGE, "budget --markdown", command("budget", "--markdown")),
    Block(WHICH_STEP, "budget --markdown", command("budget", "--markdown"), whole=True),
    Sizes(COMPATIBILITY, "build --all-platforms", sizes),
    Hosts(COMPATIBILITY, "tests/python/hosts.py", table_of_hosts),
    Times(SPEED, "fmu-build/benches/peers/run --rounds 5", peers),
    *(
        Block(
            DAMPING,
            f"vary pick-up {change} --markdown",
            command("vary", "pick-up", change, "--markdown"),
        )
        for change in ("ik.moment_damping=0,1,2,3,5,8", "ik.moment_washout=0.1,0.2,0.4,1,4")
    ),
    Block(THESIS, "reach --markdown", command("reach", "--markdown")),
    Block(
        THESIS,
        'reach "joint[*].acceleration_limit=20" counterweight.time_constant=0.4 --markdown',
        command("reach", "joint[*].acceleration_limit=20", SLOW_LAW, "--markdown"),
    ),
    Quote(
        THESIS,
        '`"joint[*].acceleration_limit=6"` the four are {:.0f}, {:.0f}, {:.0f} and {:.0f} mm;',
        reached("6", EULER),
    ),
    Quote(
        THESIS,
        "({:.0f}, {:.0f}, {:.0f} and {:.0f} mm with `euler`)",
        reached("1000", EULER),
    ),
    Quote(
        THESIS,
        "below the UAV up to {:.0f} mm, and",
        lambda: numbers_in([rows(printed("reach", "--markdown"))[0][-1]]),
    ),
    Quote(
        THESIS,
        "the error along x at 15 s is {:.2f} mm, {:.2f} mm at twice the pace, {:.1f} mm at 3.33 "
        "times (a path of 3 s) and {:.1f} mm at five times",
        PACES_2_3A,
    ),
    Quote(
        THESIS,
        "the UAV moves along x by {:.3f}, {:.3f}, {:.3f} and {:.3f} mm at 0.8, 0.9, 1 and 1.1",
        some((PACES_3_2B, CHANGED)),
    ),
    Quote(
        THESIS,
        "the error in y is {:.1f}, {:.1f}, {:.1f} and {:.1f} mm at 1, 2, 3 and 4 times the pace",
        some((PACES_3_5A, CHANGED)),
    ),
    Quote(
        THESIS,
        "3.8a: {:.2f} mm in 4 s, {:.2f} mm with trapezoidal ramps, {:.2f} mm in 4.4 s, "
        "{:.2f} mm in 8 s",
        some((RAMPS_3_8A, ALL), (PACES_3_8A, CHANGED)),
    ),
    Quote(
        THESIS,
        "4.3b ends {:.2f} mm off its path with `euler`",
        some((STEPS_4_3B, FIRST)),
    ),
    Quote(
        THESIS,
        "at 2, 1, 0.5 and 0.25 ms it is {:.2f}, {:.2f}, {:.2f} and {:.2f} mm",
        some((STEPS_4_3B, slice(1, 2)), (STEPS_4_3B, FIRST), (STEPS_4_3B, slice(2, None))),
    ),
    Quote(
        THESIS,
        "the way along y of 3.2c ({:.2f} mm, {:.1f} times that of 3.2b, and {:.2f} mm at twice",
        some(
            (SIDES_3_2C, FIRST),
            (varied("3.2c", f"{WAY_Y}, against 3.2b", "pace=2"), FIRST),
            (SIDES_3_2C, CHANGED),
        ),
    ),
    Quote(
        THESIS,
        "the moment has a peak of {:.1f} N m and the roll is {:.1f} degrees with `euler`, "
        "{:.1f} N m and {:.1f} degrees with `exact`",
        some(
            *(
                (varied("4.4b", quantity, *LAWS_4_4B, by=by), slice(1, 2))
                for by in (EULER, EXACT)
                for quantity in ("largest moment of the arm on the UAV", "largest roll")
            )
        ),
    ),
]
