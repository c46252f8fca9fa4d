"""The numbers in the documents are those that commands print now.

    source tests/environment.sh && UAM_WRITE=1 "$python" -m pytest tests/python/test_documents.py

writes them anew instead of comparing them. Times are not compared, only the rows that they are in.
"""

from __future__ import annotations

import difflib
import os
import re

import pytest
from fmpy import read_model_description

from conftest import ROOT
from document_parts import PARTS
from documents import Block, MissingError, Part, Quote, Times

# Tables with numbers that no command prints, by their headings.
BY_HAND = {
    "| platform | needs beside Rust | runs on | seen |",
    "| command (after `uam`) | what it does |",
    "| you want | set |",
    "| `ik.resolution` | number | good for | costs | fails |",
    "| | FMI | state / bytes | input / output derivatives | variables' units | source |",
}
DOCUMENTS = ("README.md", *(f"docs/{page.name}" for page in sorted((ROOT / "docs").glob("*.md"))))


@pytest.mark.parametrize("part", PARTS, ids=str)
def test_numbers_are_those_of_today(part: Part) -> None:
    path = ROOT / part.document
    text = path.read_text()
    begin, end = part.span(text)
    there = text[begin:end]
    try:
        now = part.now(there)
    except MissingError as reason:
        print(f"skipped: {part} ({reason})")
        pytest.skip(str(reason))
    if os.environ.get("UAM_WRITE"):
        if part.may_be_written(now):
            # Some commands take minutes, in which somebody may have changed the rest.
            text = path.read_text()
            begin, end = part.span(text)
            path.write_text(text[:begin] + now + text[end:])
        return
    difference = "\n".join(difflib.unified_diff(there.splitlines(), now.splitlines(), lineterm=""))
    assert part.agrees(there, now), f"{part.document} is out of date:\n{difference}"


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_table_of_numbers_has_a_source(document: str) -> None:
    text = (ROOT / document).read_text()
    blocks = [p for p in PARTS if isinstance(p, Block) and p.document == document]
    assert sorted(re.findall("<!-- begin: (.*) -->", text)) == sorted(b.name for b in blocks)
    for begin, end in sorted((b.span(text) for b in blocks), reverse=True):
        text = text[:begin] + text[end:]
    tables = re.findall(r"^(\|.*\|)\n\|[ -|]*\|\n((?:\|.*\n)+)", text, re.MULTILINE)
    assert tables or document != "README.md"
    unknown = {head for head, body in tables if re.search(r"\d", body)} - BY_HAND
    assert not unknown, "between markers, or by hand?"


def test_enumerations_have_their_numbers_in_the_documents() -> None:
    """Many hosts take the numbers only."""
    numbers: dict[str, dict[str, int]] = {}
    for unit in ("uam_controller", "uam_plant"):
        description = read_model_description(str(ROOT / "modelDescription" / f"{unit}.xml"))
        for variable in description.modelVariables:
            if variable.declaredType is not None:
                items = variable.declaredType.items
                numbers[variable.name] = {item.name: int(item.value) for item in items}
    text = "".join((ROOT / document).read_text() for document in DOCUMENTS)
    found = re.findall(r"`([\w.\[\]]+)\s*=\s*(\w+)`(?: \((\d+)\))?", text)
    named = [(name.replace("[i]", "[1]"), item, number) for name, item, number in found]
    named = [(name, item, number) for name, item, number in named if name in numbers]
    assert len(named) >= 9
    for name, item, number in named:
        assert number == str(numbers[name][item]), f"{name} = {item}"


def test_a_quote_is_found_and_written_over_lines() -> None:
    quote = Quote("", "a way of {:.1f} mm, and {:.0f} times that", lambda: [2.06, 31.0])
    text = "It has a way\nof 1.9 mm, and\n  30 times that."
    begin, end = quote.span(text)
    assert quote.now(text[begin:end]) == "a way\nof 2.1 mm, and\n  31 times that"


def test_times_may_differ_and_rows_may_not() -> None:
    page = "A machine\n\n| Plant | time | error |\n|-------|------|-------|\n| FMU | {} | {} |\n"
    block = Times("", "", str)
    there = page.format("226 ns", "4e-12")
    assert block.agrees(there, page.format("1.37 µs", "5e-13").replace("A", "Another"))
    assert not block.agrees(there, there.replace("FMU", "library"))
    assert not block.agrees(there, there + "| another | 1 ns | 2e-3 |\n")
