"""Atomic writing of files.

A file is written beside its place under a temporary name and then renamed, so that neither a full
disk, nor an exception, nor an interrupt leaves half of it behind or destroys the one before.
"""

from __future__ import annotations

import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a path to write to; it takes the place of `path` when the block ends without an error.

    The given path has the suffix of `path`, for writers that choose the format by it. A device or
    pipe (`/dev/stdout`) is not replaced but written to.

    Raises
    ------
    OSError
        with `path` as its `filename`, not the temporary name.
    """
    target = Path(path)
    try:
        if target.is_dir():
            raise IsADirectoryError(21, "is a directory; name a file in it", str(target))
        if target.exists() and not target.is_file():
            with tempfile.TemporaryDirectory() as folder:
                draft = Path(folder, "draft" + target.suffix)
                yield draft
                target.write_bytes(draft.read_bytes())
            return
        target = target.resolve()  # a link stays a link
        draft = target.with_name(f".{secrets.token_hex(8)}{target.suffix}")
        try:
            yield draft
            with draft.open("rb") as handle:
                os.fsync(handle.fileno())
            if target.exists():
                shutil.copymode(target, draft)
            draft.replace(target)
        finally:
            draft.unlink(missing_ok=True)
    except OSError as fault:
        raise _named(fault, Path(path)) from fault


def write_atomically(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write a whole file, text as UTF-8 with the line ends that it has.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_atomically(Path(folder, "wear.csv"), "cycle,u_c_mm\\n")
    ...     [file.name for file in Path(folder).iterdir()]
    ['wear.csv']
    """
    with replacing(path) as draft:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)


def write_all(folder: str | os.PathLike[str], contents: Mapping[str, str | bytes]) -> None:
    """Write files by their names into a folder, which is made if need be.

    Files of the same names are replaced, one by one and after all are written; others stay.
    """
    target = Path(folder)
    try:
        created = not target.exists()
        target.mkdir(parents=True, exist_ok=True)
        try:
            # inside the target, thus on the same file system, where a rename is atomic
            with tempfile.TemporaryDirectory(prefix=".draft-", dir=target) as draft:
                for name, content in contents.items():
                    write_atomically(Path(draft, name), content)
                for name in sorted(contents):
                    Path(draft, name).replace(target / name)
        except BaseException:
            if created:
                shutil.rmtree(target, ignore_errors=True)
            raise
    except OSError as fault:
        raise _named(fault, target) from fault


def obstacle(path: str | os.PathLike[str]) -> str | None:
    """Return why a file cannot be written there, None if no obstacle is known.

    For use before a long computation; the write may still fail and must be handled.

    >>> obstacle("no such folder/wear.csv")
    'no such folder: no such folder; make it first'
    """
    target = Path(path)
    if target.is_dir():
        return f"{target}: is a folder; name a file in it"
    if not target.parent.exists():
        return f"{target.parent}: no such folder; make it first"
    if not target.parent.is_dir():
        return f"{target.parent}: is not a folder"
    if not os.access(target if target.exists() else target.parent, os.W_OK):
        return f"{target}: may not be written"
    return None


def obstacle_to_folder(path: str | os.PathLike[str]) -> str | None:
    """Return why files cannot be written into a folder, which is made if need be; None as above.

    >>> obstacle_to_folder(__file__ + "/report").endswith("files.py: is not a folder")
    True
    """
    target = Path(path)
    nearest = next(place for place in (target, *target.absolute().parents) if place.exists())
    if not nearest.is_dir():
        return f"{nearest}: is not a folder"
    if not os.access(nearest, os.W_OK):
        return f"{nearest}: may not be written"
    return None


def _named(fault: OSError, path: Path) -> OSError:
    """Return the same fault with the path that the user gave."""
    return OSError(fault.errno or 5, fault.strerror or str(fault) or "cannot be written", str(path))
