"""Finished rows of a sweep in a folder, from which an interrupted sweep continues."""

from __future__ import annotations

import hashlib
import os
import pickle
import time
import uuid
import zipfile
import zlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._core import Scene

_DIGEST = 16

#: A file under its temporary name is written in far less than this, s; an older one is what a killed
#: process left.
_ABANDONED = 3600.0


class Store:
    """Rows by a digest of their scene and of how it is run: whatever makes an equal scene finds them."""

    def __init__(
        self,
        folder: str | os.PathLike[str] | None,
        make: Callable[..., Scene],
        points: Sequence[Mapping[str, Any]],
        options: tuple[Any, ...],
        width: int,
    ) -> None:
        self.folder = None if folder is None else Path(folder)
        self.width = width
        self.digests: list[bytes] = []
        if self.folder is None:
            self.count = len(points)
            return
        self.count = len(points)
        self.folder.mkdir(parents=True, exist_ok=True)
        self._remove_abandoned()
        # Threads change no number.
        how = repr(options[:4]).encode()
        self.digests = [_digest(make, point, how) for point in points]

    def missing(self, values: npt.NDArray[np.float64], errors: list[str | None]) -> list[int]:
        """Fills in the rows that the folder has, and returns the indices of the others."""
        if self.folder is None:
            return list(range(self.count))
        found: dict[bytes, tuple[npt.NDArray[np.float64], str]] = {}
        for path in sorted(self.folder.glob("*.npz")):
            digests, stored, texts = _read(path)
            if stored.shape[1:] == (self.width,):
                keys = [key.tobytes() for key in digests]
                found.update(zip(keys, zip(stored, texts, strict=True), strict=True))
        missing = []
        for index, digest in enumerate(self.digests):
            if digest in found:
                values[index], text = found[digest]
                errors[index] = text or None
            else:
                missing.append(index)
        return missing

    def add(self, indices: Sequence[int], rows: tuple[npt.NDArray[np.float64], list[str | None]]) -> None:
        """Writes rows to a file of their own, whole or not at all."""
        if self.folder is None:
            return
        digests = np.frombuffer(b"".join(self.digests[i] for i in indices), np.uint8).reshape(-1, _DIGEST)
        path = self.folder / f"{uuid.uuid4().hex}.npz"
        part = path.with_suffix(".part")
        with part.open("wb") as file:
            np.savez(file, digests=digests, values=rows[0], errors=np.array([text or "" for text in rows[1]], "U"))
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
        _sync_folder(self.folder)

    def _remove_abandoned(self) -> None:
        """Removes what processes that were killed left under temporary names."""
        if self.folder is None:
            return
        for part in self.folder.glob("*.part"):
            try:
                if time.time() - part.stat().st_mtime > _ABANDONED:
                    part.unlink()
            except OSError:
                # Another process removed it first.
                continue


def _read(path: Path) -> tuple[npt.NDArray[np.uint8], npt.NDArray[np.float64], list[str]]:
    """Digests, values and errors of the rows in a file; zip's checksums tell whether it is as written."""
    try:
        if not path.is_file():
            raise ValueError("not a regular file")
        # Opened here, since NumPy leaves open what it cannot read.
        with path.open("rb") as file, zipfile.ZipFile(file):
            file.seek(0)
            with np.load(file) as rows:
                digests, values, texts = rows["digests"], rows["values"], rows["errors"].tolist()
        if not len(digests) == len(values) == len(texts):
            raise ValueError("its arrays differ in length")
    except (OSError, EOFError, KeyError, ValueError, zipfile.BadZipFile, zlib.error) as error:
        text = f"{path}: not the rows that a sweep wrote there ({error}); without the file they are computed again"
        raise OSError(text) from error
    return digests, values, texts


def _sync_folder(folder: Path) -> None:
    """Writes the names in a folder onto the disk, where the system can."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _digest(make: Callable[..., Scene], point: Mapping[str, Any], how: bytes) -> bytes:
    try:
        what = pickle.dumps(make(**point))
    except ValueError as error:
        what = str(error).encode()
    return hashlib.blake2b(what + how, digest_size=_DIGEST).digest()
