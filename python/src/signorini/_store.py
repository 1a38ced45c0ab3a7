"""Finished rows of a sweep in a folder, from which an interrupted sweep continues."""

from __future__ import annotations

import hashlib
import os
import pickle
import uuid
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._core import Scene

_DIGEST = 16


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
        # Threads change no number.
        how = repr(options[:4]).encode()
        self.digests = [_digest(make, point, how) for point in points]

    def missing(self, values: npt.NDArray[np.float64], errors: list[str | None]) -> list[int]:
        """Fills in the rows that the folder has, and returns the indices of the others."""
        if self.folder is None:
            return list(range(self.count))
        found: dict[bytes, tuple[npt.NDArray[np.float64], str]] = {}
        for path in sorted(self.folder.glob("*.npz")):
            with np.load(path) as rows:
                if rows["values"].shape[1:] == (self.width,):
                    keys = [key.tobytes() for key in rows["digests"]]
                    found.update(zip(keys, zip(rows["values"], rows["errors"].tolist(), strict=True), strict=True))
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


def _digest(make: Callable[..., Scene], point: Mapping[str, Any], how: bytes) -> bytes:
    try:
        what = pickle.dumps(make(**point))
    except ValueError as error:
        what = str(error).encode()
    return hashlib.blake2b(what + how, digest_size=_DIGEST).digest()
