# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of users: the one place that reads their text and writes them.

What is written goes into a file beside its place, is flushed to the disk, checked, and
takes its name last: an error leaves what was there, and no half.

What this package has not written, or what was changed since, is never replaced. The
file RECORD of a directory has size and checksum of what was written there. Any other
file goes to the next earlier_N, as the program does with earlier results, and a line
says so. Where the user chooses the place, within all_or_none(), it is refused, unless
--overwrite is given. A file that is named on the command line and read is an input, and
is never an output.
"""
import contextlib
import csv
import fcntl
import functools
import io
import json
import os
import re
import sys
import threading
import zlib
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
DPI = 150  # of pictures
MOST = 2**29  # bytes of a file
EARLIER = re.compile(r"earlier_(\d{1,6})")  # as the program names them
RECORD = ".caisson"  # lines of a checksum, a size and a name; and of an owner
OWNER = "of "  # begins the line that names the file whose results are there

read_last: deque[Path] = deque(maxlen=3)  # for what is said of a damaged file
named: set[Path] = set()  # on the command line
_read: set[Path] = set()
_places: dict[Path, Path] = {}  # the earlier_N of this command, by directory
_waiting: dict[Path, bytes] | None = None  # what all_or_none() is going to write


def note_reading(path: Path) -> None:
    """Remember that a file is read, by this process or by the program."""
    if named:
        _read.add(path.resolve())


def read_bytes(path: Path, refuse: Refusal = InputError) -> bytes:
    """Return the content of a file. Raises what refuse says: InputError or one of its
    kind."""
    if path not in read_last:
        read_last.append(path)
    note_reading(path)
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise refuse(
            f"{path} is a device or a pipe: write what it gives into a file, and name"
            " that"
        )
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


def _stamp(data: bytes) -> str:
    """Return checksum and size of a content, as RECORD has them."""
    return f"{zlib.crc32(data):08x} {len(data)}"


def _recorded(directory: Path, change: dict[str, str] | None = None) -> dict[str, str]:
    """Return what RECORD of a directory says, {name: stamp} and {OWNER: path}, after
    a change of it."""
    known = dict[str, str]()
    with contextlib.suppress(OSError):
        how = "a+" if change else "r"
        with (directory / RECORD).open(how, -1, "utf-8", "replace") as file:
            with contextlib.suppress(OSError):  # of file systems without locks
                fcntl.flock(file, fcntl.LOCK_EX if change else fcntl.LOCK_SH)
            file.seek(0)
            for line in file.read().splitlines():
                if line.startswith(OWNER):
                    known[OWNER] = line.removeprefix(OWNER)
                elif len(words := line.split(" ", 2)) == 3:
                    known[words[2]] = " ".join(words[:2])
            if change and not change.items() <= known.items():
                known |= change
                file.truncate(0)
                file.writelines(f"{v} {k}\n" for k, v in known.items() if k != OWNER)
                file.writelines(f"{OWNER}{v}\n" for k, v in known.items() if k == OWNER)
    return known


def make_directory(path: Path, refuse: Refusal = InputError) -> None:
    """Make a directory for results unless it is there. Raises what refuse says:
    InputError or one of its kind, with the part of the path that is in the way."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        parts = (part for part in (path, *path.parents) if os.path.lexists(part))
        found = next(parts, path)
        why = error.strerror if found.is_dir() else f"{found} is no directory"
        raise refuse(
            f"{path} cannot be made: {why}; name another directory, or move what is"
            " there"
        ) from error


def claim(directory: Path, source: Path, how: str) -> None:
    """Take a directory for the results of a file. Raises InputError where it has those
    of another one. how: to choose another directory."""
    own = os.path.relpath(source.resolve(), directory.resolve())
    found = _recorded(directory).get(OWNER, own)
    if found != own:
        other = os.path.normpath(directory / found)
        raise InputError(
            f"{directory} has the results of {other}, and not of {source}: {how}. If it"
            f" is the same file at another place, delete its line in"
            f" {directory / RECORD}"
        )
    make_directory(directory)
    _recorded(directory, {OWNER: own})


def begin(paths: Iterable[Path]) -> None:
    """Begin a command that names these paths."""
    _read.clear()
    _places.clear()
    named.clear()
    named.update(path.resolve() for path in paths if path.is_file())


def refuse_input(path: Path) -> None:
    """Raise InputError where a file is named on the command line, and was read."""
    if path.is_file() and path.resolve() in named & _read:
        raise InputError(
            f"{path} is an input of this command, which would replace it: copy it to"
            " another place, and name that"
        )


def is_locked(directory: Path) -> bool:
    """Return whether a run computes in the directory; no, where the file system has no
    locks."""
    try:
        with (directory / ".lock").open(encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:  # no such file, or no locks
        return False
    return False


def _put_aside(path: Path) -> Path:
    """Move a file to the next earlier_N of its directory, that of this command where
    there is one; return its new path."""
    place = _places.get(path.parent)
    if place is None or not place.is_dir() or (place / path.name).exists():
        found = map(EARLIER.fullmatch, os.listdir(path.parent))
        number = max((int(name[1]) for name in found if name), default=0) + 1
        place = _places[path.parent] = path.parent / f"earlier_{number}"
        place.mkdir()
    return path.rename(place / path.name)


def _say_kept(path: Path, new: Path) -> None:
    """Say on the terminal where a file is now."""
    print(f"kept: {path} is now {new}", file=sys.stderr)


def _content(path: Path) -> bytes | None:
    """Return the content of a file, None where there is none."""
    return path.read_bytes() if path.is_file() else None


def _is_kept(path: Path, data: bytes | None) -> bool:
    """Return whether a file is to be put aside before it gets this content: unless it
    has it already, or is as this package has written it. Raises InputError where it is
    an input."""
    old = _content(path)
    if old is None or old == data:
        return False
    refuse_input(path)
    return _recorded(path.parent).get(path.name) != _stamp(old)


def remove(path: Path) -> None:
    """Remove a file that this package has written, if it is there; one that was changed
    since is put aside. Raises InputError where it is an input."""
    if _is_kept(path, None):
        _say_kept(path, _put_aside(path))
    path.unlink(missing_ok=True)


def _write_beside(path: Path, data: bytes, is_kept: bool) -> None:
    """Write a file beside its place, and give it its name when it is whole. is_kept:
    put aside what has this name."""
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
        aside = _put_aside(path) if is_kept else None
        try:
            new.replace(path)
        except OSError:
            if aside:
                aside.rename(path)
                with contextlib.suppress(OSError):  # it has other files
                    aside.parent.rmdir()
            raise
        if aside:
            _say_kept(path, aside)
    finally:
        new.unlink(missing_ok=True)


def _write_whole(path: Path, data: bytes, is_kept: bool = False) -> Path:
    """Write a file whole, or leave what was there; return its path. Raises OSError,
    which names the file."""
    try:
        _write_beside(path, data, is_kept)
    except OSError as error:
        kept = "; what was there is kept" if path.exists() else ""
        reason = error.strerror or error
        raise OSError(f"{path} cannot be written: {reason}{kept}") from error
    return path


def _write_own(path: Path, data: bytes, is_kept: bool) -> Path:
    """Write a file whole and record it; return its path. Raises OSError."""
    _write_whole(path, data, is_kept)
    if path.is_file() and path.name.isprintable():
        _recorded(path.parent, {path.name: _stamp(data)})
    return path


def _bytes_of(content: str | bytes) -> bytes:
    """Return a content in UTF-8."""
    if isinstance(content, str):
        return content.encode("utf-8", errors="backslashreplace")
    return content


def write(path: Path, content: str | bytes) -> Path:
    """Write a file whole, or leave what was there; return its path. A file that this
    package has not written, or that was changed since, is put aside. Raises OSError,
    which names the file, or InputError where it is an input."""
    data = _bytes_of(content)
    if _waiting is not None:
        _waiting[path] = data
        return path
    return _write_own(path, data, _is_kept(path, data))


def save(figure: Any, path: Path, dpi: int | None = None) -> Path:
    """Write a figure of matplotlib, in the format that its name ends with, and with
    dots per inch (DPI if None); return the path."""
    buffer = io.BytesIO()
    terminal.set_literally(figure)
    figure.savefig(buffer, format=path.suffix[1:] or "png", dpi=dpi or DPI)
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
def all_or_none(overwrite: bool | None = None) -> Iterator[None]:
    """Let write() wait for the end of the block, and then write all files: none where
    the block fails, or where one of them is there with another content and not to be
    overwritten. None stands for the rule of write(). Raises InputError."""
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
        if _content(path) in (None, data):
            continue
        refuse_input(path)
        if overwrite is False:
            raise InputError(
                f"{path} exists, and differs from what would be written; --overwrite"
                " replaces it"
            )
    for path, data in files.items():
        if overwrite is None:
            write(path, data)
        else:
            _write_whole(path, data)


def keep(path: Path, content: str | bytes) -> Path:
    """Write a file as write() does, but put another one aside whoever has written it.
    Returns its path."""
    data = _bytes_of(content)
    return _write_own(path, data, _content(path) not in (None, data))
