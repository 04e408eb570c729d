# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of users: the one place that reads their text and writes them.

What is written goes into a file beside its place, is flushed to the disk, checked, and
takes its name last: an error leaves what was there, and no half. A file whose place a
user has chosen, or that one may have changed, is never replaced unasked: within
all_or_none() it is refused, and keep() puts it aside as the program does with earlier
results.
"""
import contextlib
import csv
import functools
import io
import json
import os
import re
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, TypeVar, cast

from caisson import terminal


class InputError(Exception):
    """A file or a number that cannot be used; the text is for the user."""


Refusal = type[InputError]
Reader = TypeVar("Reader", bound=Callable[..., Any])
TRACEBACK = "CAISSON_TRACEBACK"  # in the environment: show faults in full
# what reading a file that is not as it should be may end with
DAMAGE = (
    *(ArithmeticError, AttributeError, LookupError, MemoryError),
    *(RecursionError, TypeError, ValueError, csv.Error),
)
MOST = 2**29  # bytes of a text: a device has no end
EARLIER = re.compile(r"earlier_(\d{1,9})")  # as the program names them

read_last: deque[Path] = deque(maxlen=3)  # for what is said of a damaged file
_waiting: dict[Path, bytes] | None = None  # what all_or_none() is going to write


def read_bytes(path: Path, refuse: Refusal = InputError) -> bytes:
    """Return the content of a file. Raises what refuse says: InputError or one of its
    kind."""
    if path not in read_last:
        read_last.append(path)
    try:
        with open(path, "rb") as file:
            data = file.read(MOST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise refuse(f"{path} cannot be read: {reason}") from error
    if len(data) > MOST:
        raise refuse(f"{path} is larger than {MOST // 2**20} MiB")
    return data


def read_text(path: Path, refuse: Refusal = InputError) -> str:
    """Return the text of a file in UTF-8. Raises what refuse says, with the line of the
    first byte that is none."""
    data = read_bytes(path, refuse)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise refuse(
            f"{path}, line {line}: the byte 0x{data[error.start]:02x} is no text in"
            " UTF-8; save the file as UTF-8"
        ) from error


def words_of(error: Exception) -> str:
    """Return the kind and the text of an error in one line."""
    kind = type(error).__name__
    return one_line(f"{kind}: {error}" if str(error) else kind)[:200]


def reads(function: Reader) -> Reader:
    """Decorate what reads the file, or files, of its first argument: damage that it
    does not know becomes an InputError on the first of them."""

    @functools.wraps(function)
    def call(paths: Any, *others: Any, **more: Any) -> Any:
        try:
            return function(paths, *others, **more)
        except DAMAGE as error:
            if TRACEBACK in os.environ:
                raise
            path = paths if isinstance(paths, Path) else paths[0]
            text = f"({words_of(error)}; {TRACEBACK}=1 shows more)"
            raise InputError(f"{path} is damaged or too large {text}") from error

    return cast(Reader, call)


def in_one_line(text: str) -> str:
    """Return a text with a blank for each end of a line or other control character."""
    return "".join(c if c.isprintable() else " " for c in text)


def one_line(text: str) -> str:
    """Return a text of a user as a remark in a file or a line on the terminal needs
    it."""
    return in_one_line(text).strip()


def quoted(text: str) -> str:
    """Return a text as a string of TOML or JSON."""
    return json.dumps(text, ensure_ascii=False)


def remarks(mark: str, lines: Iterable[str]) -> list[str]:
    """Return lines as remarks of a file in which they begin with a mark."""
    return [f"{mark} {one_line(line)}" for line in lines]


def _write_beside(path: Path, data: bytes) -> None:
    """Write a file beside its place, and give it its name when it is whole."""
    if path.exists() and not path.is_file():  # a device or a pipe has no beside
        path.write_bytes(data)
        return
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(0, "it is write-protected")
    new = path.with_name(f".caisson-{os.getpid()}-{threading.get_ident()}.part")
    try:
        with open(new, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if new.stat().st_size != len(data):
            raise OSError(0, "the disk has not kept all of it")
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def write(path: Path, content: str | bytes) -> Path:
    """Write a file whole, or leave what was there; return its path. Raises OSError,
    which names the file."""
    data = content
    if isinstance(data, str):
        data = data.encode("utf-8", errors="backslashreplace")
    if _waiting is not None:
        _waiting[path] = data
        return path
    try:
        _write_beside(path, data)
    except OSError as error:
        kept = "; what was there is kept" if path.exists() else ""
        reason = error.strerror or error
        raise OSError(f"{path} cannot be written: {reason}{kept}") from error
    return path


def save(figure: Any, path: Path, dpi: int = 150) -> Path:
    """Write a figure of matplotlib, in the format that its name ends with; return the
    path."""
    buffer = io.BytesIO()
    terminal.set_literally(figure)
    figure.savefig(buffer, format=path.suffix[1:] or "png", dpi=dpi)
    return write(path, buffer.getvalue())


def save_pages(figures: Iterable[Any], path: Path) -> Path:
    """Write figures of matplotlib as the pages of a .pdf file; return the path."""
    from matplotlib.backends.backend_pdf import PdfPages

    buffer = io.BytesIO()
    with PdfPages(buffer) as pages:
        for figure in figures:
            terminal.set_literally(figure)
            pages.savefig(figure)
    return write(path, buffer.getvalue())


@contextlib.contextmanager
def all_or_none(overwrite: bool) -> Iterator[None]:
    """Let write() wait for the end of the block, and then write all files: none where
    the block fails, or where one of them is there with another content and not to be
    overwritten. Raises InputError."""
    global _waiting
    if _waiting is not None:  # within another one, which decides
        yield
        return
    _waiting = {}
    try:
        yield
        files = _waiting
    finally:
        _waiting = None
    for path, data in files.items():
        if not overwrite and path.is_file() and path.read_bytes() != data:
            raise InputError(
                f"{path} exists, and differs from what would be written; --overwrite"
                " replaces it"
            )
    for path, data in files.items():
        write(path, data)


def keep(path: Path, content: str | bytes) -> Path:
    """Write a file into the directory of a run; another one of this name goes to the
    next earlier_N there. Returns its path."""
    data = content.encode("utf-8") if isinstance(content, str) else content
    if path.is_file() and path.read_bytes() != data:
        found = map(EARLIER.fullmatch, os.listdir(path.parent))
        number = max((int(name[1]) for name in found if name), default=0) + 1
        place = path.parent / f"earlier_{number}"
        place.mkdir()
        path.rename(place / path.name)
    return write(path, data)
