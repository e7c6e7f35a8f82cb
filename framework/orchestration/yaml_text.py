"""Configs as YAML, of plain dicts and lists."""

from __future__ import annotations

import json
from collections.abc import Iterator


def scalar(value) -> str:
    return json.dumps(value, ensure_ascii=False)


def yaml_lines(value: dict, indent: int = 0) -> Iterator[str]:
    """Maps in blocks, lists of maps an entry a line."""
    for key, item in value.items():
        name = key if key.replace("_", "a").isalnum() else scalar(key)
        if isinstance(item, dict) and item:
            yield f"{' ' * indent}{name}:"
            yield from yaml_lines(item, indent + 2)
        elif isinstance(item, list) and item and all(isinstance(entry, dict) for entry in item):
            yield f"{' ' * indent}{name}:"
            yield from (f"{' ' * (indent + 2)}- {scalar(entry)}" for entry in item)
        else:
            yield f"{' ' * indent}{name}: {scalar(item)}"
