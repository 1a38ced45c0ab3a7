"""Cases from nested mappings: the text of a case file, read as one."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Mapping
from typing import Any

from . import _core
from ._core import Case


def case(tables: Mapping[str, Any], *, name: str = "case") -> Case:
    """A case from the tables and keys of the case format, as nested mappings.

    Parameters
    ----------
    tables : mapping of str to value
        What a case file has: ``{"system": {"oscillator": {"mass": 1.0, ..}}, "wall": [{..}], ..}``.
        Values are numbers, texts, True, False, sequences, mappings, and the objects that `hole`,
        `flats`, `slider`, `Archard` and the methods of `Load` make; None leaves a key out. Files that it names
        are looked for in the working folder.
    name : str
        Of the case, in results and messages.

    Returns
    -------
    Case

    Raises
    ------
    ValueError
        For a case that makes no sense: line and key of `Case.text`, and what would be accepted.
    TypeError
        For tables that are no mapping, such as the name of a case, which `load` takes; for a value
        that a case file cannot hold.

    Examples
    --------
    >>> import signorini as sg
    >>> ball = sg.case({
    ...     "system": {"oscillator": {"mass": 1.0, "damping": 0.0, "stiffness": 0.0}},
    ...     "wall": [{"name": "floor", "side": "lower", "position": 0.0, "restitution": 0.5}],
    ...     "initial": {"displacement": 1.0},
    ...     "load": [sg.Load.constant(-9.81)],
    ...     "time": {"end": 1.0, "step": 1e-3},
    ... })
    >>> ball.run()
    <Run: located, 1001 rows to 1.0 s, 2 contacts>
    """
    if not isinstance(tables, Mapping):
        raise TypeError(f"tables is {tables!r}; expected a mapping of the tables of a case; load reads a case by name")
    return _core._case(text(tables), name)


def text(tables: Mapping[str, Any]) -> str:
    """The text of a case file: a line for each value, so that messages point at it."""
    return "\n".join(_lines((), tables)).lstrip() + "\n"


def _lines(path: tuple[str, ...], table: Mapping[str, Any]) -> Iterable[str]:
    """The values of a table, then the tables within it under their heads, down to `system.beam`."""
    within: dict[str, Any] = {}
    for key, value in _given(table):
        if (len(path) < 2 and isinstance(value, Mapping)) or (not path and _is_list_of_tables(value)):
            within[key] = value
        else:
            yield f"{_key(key)} = {_value(key, value)}"
    for key, value in within.items():
        if isinstance(value, Mapping):
            yield f"\n[{'.'.join([*path, _key(key)])}]"
            yield from _lines((*path, _key(key)), value)
            continue
        for entry in value:
            yield f"\n[[{_key(key)}]]"
            yield from (f"{_key(k)} = {_value(k, v)}" for k, v in _given(_table_of(entry)))


def _given(table: Mapping[str, Any]) -> Iterable[tuple[str, Any]]:
    return ((key, _table_of(value)) for key, value in table.items() if value is not None)


def _table_of(value: Any) -> Any:
    """An object of this package as the table of a case file that it stands for; others as they are."""
    return value._table() if hasattr(value, "_table") else value


def _is_list_of_tables(value: Any) -> bool:
    entries = [_table_of(entry) for entry in value] if isinstance(value, (list, tuple)) else []
    return bool(entries) and all(isinstance(entry, Mapping) for entry in entries)


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _quoted(key)


def _quoted(text: str) -> str:
    """A text as TOML, which has no surrogates."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(key: str, value: Any) -> str:
    """A value as TOML."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return _quoted(value)
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers.
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(k)} = {_value(k, v)}' for k, v in _given(value))} }}"
    if isinstance(value, Iterable):
        return f"[{', '.join(_value(key, entry) for entry in value)}]"
    raise TypeError(f"{key} is {value!r}; expected a number, a text, True or False, a sequence or a mapping of these")
