"""Pieces of documents with numbers that a command prints: where they stand, and what they must be.

`document_parts.py` lists them all; `test_documents.py` compares them, and writes them anew if
UAM_WRITE is set.
"""

from __future__ import annotations

import re
import string
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


class MissingError(Exception):
    """What this machine, or a short run of the tests, has not got to print a part."""


class Part(ABC):
    """A piece of a document."""

    document: str

    @abstractmethod
    def span(self, text: str) -> tuple[int, int]:
        """Where it begins and ends."""

    @abstractmethod
    def now(self, there: str) -> str:
        """The same piece with the numbers of today.

        Raises MissingError where they cannot be had.
        """

    def agrees(self, there: str, now: str) -> bool:
        """Whether what stands there is as good as what comes out now."""
        return there == now

    def may_be_written(self, _: str) -> bool:
        """Whether numbers of this kind may go into a document."""
        return True


@dataclass(frozen=True)
class Block(Part):
    """What stands between `<!-- begin: NAME -->` and `<!-- end -->`, or a whole document."""

    document: str
    name: str
    printed: Callable[[], str]
    whole: bool = False

    def __str__(self) -> str:
        return f"{self.document}: {self.name}"

    def span(self, text: str) -> tuple[int, int]:
        if self.whole:
            return 0, len(text)
        opening = f"<!-- begin: {self.name} -->\n"
        assert text.count(opening) == 1, f"{self.document} has not one `{opening.strip()}`"
        begin = text.index(opening) + len(opening)
        return begin, text.index("<!-- end -->", begin)

    def now(self, there: str) -> str:
        return self.printed() if self.whole else f"\n{self.printed().strip(chr(10))}\n\n"


class Sizes(Block):
    """Sizes of libraries, which change a little with compilers; some platforms may be missing."""

    TOLERANCE = 0.05

    def now(self, there: str) -> str:
        return keep_missing(there, super().now(there))

    def agrees(self, there: str, now: str) -> bool:
        pairs = zip(re.findall(r"\b\d{3,4}\b", there), re.findall(r"\b\d{3,4}\b", now))
        near = all(abs(float(a) / float(b) - 1) <= self.TOLERANCE for a, b in pairs)
        return near and shape(there) == shape(now)


class Hosts(Block):
    """Hosts, of which some may be missing here; differences are those of rounding."""

    FACTOR = 2.0

    def now(self, there: str) -> str:
        return keep_missing(there, super().now(there))

    def agrees(self, there: str, now: str) -> bool:
        difference = re.compile(r"\d\.\de-\d+")
        pairs = zip(difference.findall(there), difference.findall(now))
        near = all(1 / self.FACTOR <= float(a) / float(b) <= self.FACTOR for a, b in pairs)
        return near and difference.sub("", there) == difference.sub("", now)


class Times(Block):
    """Times, which no test compares: titles and rows have to be the same."""

    ROUNDS = 5

    def agrees(self, there: str, now: str) -> bool:
        return times_shape(there) == times_shape(now)

    def may_be_written(self, now: str) -> bool:
        return int(re.search(r"medians of (\d+) rounds", now)[1]) >= self.ROUNDS


MISSING = "(missing)"


def keep_missing(there: str, now: str) -> str:
    """What is missing now stays as it stands there; rows are found by their first cell."""
    first = {line.split("|")[1].strip(): line for line in there.splitlines() if line[:1] == "|"}
    lines = []
    for line in now.splitlines():
        name = line.split("|")[1].strip() if line[:1] == "|" else ""
        lines += [line] if MISSING not in line else [first[name]] if name in first else []
    return "\n".join([*lines, ""])


def shape(text: str) -> str:
    """A table without its numbers."""
    return re.sub(NUMBER, "#", text)


def times_shape(text: str) -> list[str]:
    """The rows of tables of times without numbers, units and padding.

    The first line is the machine.
    """
    plain = re.sub(r" (ns|µs)\b", "", "\n".join(text.strip().splitlines()[1:]))
    return [re.sub(r"[\s-]+", " ", shape(line)).strip() for line in plain.splitlines() if line]


@dataclass(frozen=True)
class Quote(Part):
    """Words with numbers between them, such as `{:.1f}`; they may go over several lines."""

    document: str
    words: str
    numbers: Callable[[], list[float]]

    def __str__(self) -> str:
        return f"{self.document}: {self.words[:40]}"

    def pattern(self) -> re.Pattern[str]:
        pieces = []
        for words, name, _, _ in string.Formatter().parse(self.words):
            pieces.append(r"\s+".join(re.escape(word) for word in re.split(r"\s+", words)))
            if name is not None:
                pieces.append(f"({NUMBER})")
        return re.compile("".join(pieces))

    def span(self, text: str) -> tuple[int, int]:
        found = list(self.pattern().finditer(text))
        assert len(found) == 1, f"{self.document} has {len(found)} times: {self.words}"
        return found[0].span()

    def now(self, there: str) -> str:
        formats = [f for _, name, f, _ in string.Formatter().parse(self.words) if name is not None]
        values = [format(value, f) for value, f in zip(self.numbers(), formats, strict=True)]
        match = self.pattern().fullmatch(there)
        for n in range(len(values), 0, -1):
            there = there[: match.start(n)] + values[n - 1] + there[match.end(n) :]
        return there
