# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes that somebody has spoilt: by a slip of the finger, a wrong unit, a line in
the wrong place, or a file that a mail has garbled.

All that is random comes from the generator that is passed, so that a scene can be
made again from its seed. Bytes are mutated, not characters: a file is not always
text.
"""
import random
import re
from collections.abc import Callable, Mapping, Sequence

WORD = re.compile(rb"[^\s=,;:()]+")
NUMBER = re.compile(rb"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
ASSIGNMENT = re.compile(rb"^([ \t]*set[ \t]+([^=\n]+?)[ \t]*=[ \t]*)(.*)$", re.M)
EXTREMES = """0 -0 -1 1 2 1e-300 1e-12 1e-9 1e-6 1e6 1e9 1e12 1e30 1e300 1e308 1e999
    -1e9 nan inf -inf 0x10 1,5 1.5.2 5D6 4294967295 4294967296 2147483648 -2147483649
    18446744073709551616 0/0 1/0 z r t""".split()
ODD_BYTES = [
    b"\0",
    b"\r",
    b"\r\n",
    b"\t",
    b"\xa0",
    b"\xc2\xa0",
    b"\xe2\x88\x92",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"\\\n",
    b"#",
    b"=",
    b"%s%n",
    b"(" * 300,
    b"-" * 3000,
    b"9" * 400,
    b"\n" * 50,
    b"subsection Soil\n" * 30,
]
Random = random.Random
Mutation = Callable[[bytes, Random, "Material"], bytes]


class Material:
    """What mutations take their pieces from: all scenes, and all entries."""

    def __init__(self, scenes: Mapping[str, bytes], entries: Mapping[str, str]) -> None:
        """scenes: {name: text}; entries: {"Section/Entry": default}."""
        self.texts = list(scenes.values())
        everything = b"\n".join(self.texts)
        # in an order that does not change from run to run
        self.words = sorted(set(WORD.findall(everything)))
        self.lines = sorted(set(everything.splitlines()))
        self.entries = sorted(entries.items())
        found = [match.group(3).strip() for match in ASSIGNMENT.finditer(everything)]
        self.values = sorted({*found, *(value.encode() for _, value in self.entries)})


def put(text: bytes, begin: int, end: int, piece: bytes) -> bytes:
    """Return the text with this part replaced."""
    return text[:begin] + piece + text[end:]


def any_match(
    pattern: re.Pattern[bytes], text: bytes, random: Random
) -> re.Match[bytes] | None:
    """Return one of the places that fit, None where there are none."""
    found = list(pattern.finditer(text))
    return random.choice(found) if found else None


def change_bytes(text: bytes, random: Random, _: Material) -> bytes:
    """Flip, insert, delete or replace one or a few bytes."""
    for _i in range(random.choice((1, 1, 1, 2, 8))):
        place = random.randrange(len(text) + 1)
        kind = random.randrange(5)
        if kind == 0 and place < len(text):
            flipped = text[place] ^ 1 << random.randrange(8)
            text = put(text, place, place + 1, bytes([flipped]))
        elif kind == 1:
            text = put(text, place, place, random.choice(ODD_BYTES))
        elif kind == 2:
            text = put(text, place, place + random.choice((1, 2, 30)), b"")
        else:
            text = put(text, place, place + kind - 3, bytes([random.randrange(256)]))
    return text


def change_word(text: bytes, random: Random, material: Material) -> bytes:
    """Replace, double, or drop a word."""
    match = any_match(WORD, text, random)
    if match is None:
        return text
    pieces = (random.choice(material.words), match.group() + b" " + match.group(), b"")
    return put(text, *match.span(), random.choices(pieces, (3, 1, 1))[0])


def change_number(text: bytes, random: Random, _: Material) -> bytes:
    """Replace a number by one that is far out, or of another unit."""
    match = any_match(NUMBER, text, random)
    if match is None:
        return text
    if random.random() < 0.5:
        return put(text, *match.span(), random.choice(EXTREMES).encode())
    scaled = float(match.group()) * random.choice((-1, 1)) * 10 ** random.uniform(-4, 4)
    return put(text, *match.span(), f"{scaled:.6g}".encode())


def nudge_number(text: bytes, random: Random, _: Material) -> bytes:
    """Multiply a number by 0.1 to 10."""
    found = [a for a in ASSIGNMENT.finditer(text) if NUMBER.search(a.group(3))]
    if not found:
        return text
    assignment = random.choice(found)
    match = random.choice(list(NUMBER.finditer(assignment.group(3))))
    scaled = float(match.group()) * 10 ** random.uniform(-1, 1)
    whole = b"." not in match.group() and abs(scaled) >= 1
    piece = f"{scaled:.0f}" if whole else f"{scaled:.5g}"
    begin, end = (assignment.start(3) + place for place in match.span())
    return put(text, begin, end, piece.encode())


def change_lines(text: bytes, random: Random, material: Material) -> bytes:
    """Delete, double, exchange or bring in lines, or cut the text off."""
    lines = text.splitlines(keepends=True)
    if not lines:
        return random.choice(material.lines)
    i, j = random.randrange(len(lines)), random.randrange(len(lines))
    kind = random.randrange(6)
    if kind == 0:
        del lines[i]
    elif kind == 1:
        lines.insert(j, lines[i])
    elif kind == 2:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 3:
        lines.insert(i, random.choice(material.lines) + b"\n")
    elif kind == 4:
        other = random.choice(material.texts).splitlines(keepends=True)
        begin = random.randrange(len(other))
        lines[i:i] = other[begin : begin + random.randrange(1, 12)]
    else:
        return text[: random.randrange(len(text))]
    return b"".join(lines)


def change_value(text: bytes, random: Random, material: Material) -> bytes:
    """Give an entry of the text the value of another one."""
    match = any_match(ASSIGNMENT, text, random)
    if match is None:
        return text
    return put(text, *match.span(3), random.choice(material.values))


def add_entry(text: bytes, random: Random, material: Material) -> bytes:
    """Set any entry, wherever it is declared, to its default, to the value of another
    one, or to a number that is far out."""
    name, default = random.choice(material.entries)
    *sections, entry = name.split("/")
    value = random.choice(
        (default.encode(), random.choice(material.values), b"extreme", b"extreme")
    )
    if value == b"extreme":
        value = random.choice(EXTREMES).encode()
    lines = [f"subsection {section}\n".encode() for section in sections]
    lines += [b"set " + entry.encode() + b" = " + value + b"\n"]
    return text.rstrip(b"\n") + b"\n" + b"".join(lines) + b"end\n" * len(sections)


ROUGH: Sequence[Mutation] = (
    change_bytes,
    change_word,
    change_number,
    change_lines,
    change_value,
    add_entry,
)
GENTLE: Sequence[Mutation] = (nudge_number, nudge_number, change_value, add_entry)


def mutate(
    text: bytes, random: Random, material: Material, mutations: Sequence[Mutation]
) -> bytes:
    """Return the text with one to three mutations."""
    for _ in range(random.randint(1, 3)):
        text = random.choice(mutations)(text, random, material)
    return text
