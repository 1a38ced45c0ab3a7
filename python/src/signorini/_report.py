"""The page of a folder of results."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

from . import _core


def report(
    folder: str | os.PathLike[str],
    *,
    over: str | os.PathLike[str] | None = None,
    out: str | os.PathLike[str] | None = None,
) -> Path:
    """Write the report on a folder of results: one HTML file that needs no network.

    It is that of ``signorini report``. Folders of results are written by the tool, and here by
    `Case.run`, `realisations`, `sweep` of a case, `one_at_a_time`, `branches` and `wear`, as their
    argument ``folder``.

    Parameters
    ----------
    folder : path
        The results.
    over : path, optional
        Other results to draw in the same figures: of a run over a run, of a sweep over a sweep.
    out : path, optional
        The file to write; ``report.html`` in the folder if left out.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    OSError
        For a folder without results, with results that are not finished or were changed, or of a
        command that has no page; for a page that cannot be written.

    Warns
    -----
    UserWarning
        Of results of a version that recorded no digests: their tables cannot be verified.

    Examples
    --------
    >>> import signorini as sg
    >>> import tempfile
    >>> case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     table = sg.sweep(case, {"wall.*.restitution": [0.5, 0.8]}, measures=["contacts"], folder=folder)
    ...     sg.report(folder).name
    'report.html'
    """
    path, remark = _core._report(folder, over, out)
    if remark is not None:
        warnings.warn(remark, UserWarning, stacklevel=2)
    return Path(path)
