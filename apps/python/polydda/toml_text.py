"""A scene as a dict, written as TOML."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any


def to_toml(scene: Mapping[str, Any]) -> str:
    """The TOML text of a scene: strings, numbers, booleans, lists, NumPy arrays and dicts of them."""
    lines: list[str] = []
    tables: list[str] = []
    for key, value in scene.items():
        if isinstance(value, Mapping):
            tables += ["", f"[{_key(key)}]", *_rows(value)]
        elif _is_list_of_tables(value):
            for table in value:
                tables += ["", f"[[{_key(key)}]]", *_rows(table)]
        else:
            lines.append(f"{_key(key)} = {_value(value)}")
    return "\n".join(lines + tables) + "\n"


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(v, Mapping) for v in value)


def _rows(table: Mapping[str, Any]) -> list[str]:
    return [f"{_key(key)} = {_value(value)}" for key, value in table.items()]


def _key(key: str) -> str:
    return json.dumps(key, ensure_ascii=False)


def _value(value: Any) -> str:
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_rows(value)) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_value, value)) + "]"
    raise TypeError(f"a scene cannot hold a {type(value).__name__}: write a string, number, boolean, list or dict")
