# SPDX-License-Identifier: GPL-2.0-or-later
"""A dictionary as the text of a scene: what TOML needs, in the order given."""

import json
import re

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def _key(name):
    if not isinstance(name, str):
        raise TypeError(f"a key of a scene is a text, not {name!r}")
    return name if _BARE.match(name) else json.dumps(name, ensure_ascii=False)


def _value(value, where):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v, f'{where}.{k}')}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and getattr(value, "ndim", 0) > 0:
        return "[" + ", ".join(_value(v, where) for v in value) + "]"
    try:
        return repr(float(value))
    except (TypeError, ValueError):
        return json.dumps(_text(value), ensure_ascii=False)


def _text(value):
    """A SymPy expression in the scene's language."""
    if hasattr(value, "free_symbols"):
        from .expressions import from_sympy

        return from_sympy(value)
    raise TypeError(f"{value!r} is no value of a scene; numbers, texts, lists, dictionaries and SymPy's are")


def _is_table_list(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, dict) for one in value)


def to_toml(scene):
    """The scene's text. Dictionaries become tables, lists of dictionaries arrays of tables."""
    lines = []
    for name, value in scene.items():
        if not isinstance(value, dict) and not _is_table_list(value):
            lines.append(f"{_key(name)} = {_value(value, name)}")
    for name, value in scene.items():
        tables = [value] if isinstance(value, dict) else list(value) if _is_table_list(value) else []
        for table in tables:
            lines.append(f"[{_key(name)}]" if isinstance(value, dict) else f"[[{_key(name)}]]")
            lines += [f"{_key(key)} = {_value(one, f'{name}.{key}')}" for key, one in table.items()]
    return "\n".join(lines) + "\n"
