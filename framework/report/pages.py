"""How every page is made: from a template, with nothing outside it that it refers to, into a file that appears whole."""

from __future__ import annotations

import base64
import csv
import io
import json
import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import jinja2

from report.results import ReportError

_HERE = Path(__file__).resolve().parent
# Where d3 lies: Debian's node-d3, and npm's global packages elsewhere
_D3 = [Path(folder) / "d3/dist/d3.min.js" for folder in ("/usr/share/nodejs", "/usr/lib/node_modules", "/usr/local/lib/node_modules")]


def render(template: str, *, scripts: Sequence[str] = (), data=None, folder: Path = _HERE, **values) -> str:
    """The whole page. Templates extend page.html.j2, which has what all pages have.

    @param scripts files of this folder, in the order in which they run; "d3" is that library. @param data what they show
    @param folder of the template"""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader([folder, _HERE]), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    return environment.get_template(template).render(
        style_css=_own("style.css"), scripts="\n".join(map(_own, scripts)), data=json_text(data), **values)


def _own(name: str) -> str:
    path = _HERE / name
    if name == "d3":
        path = next((path for path in _D3 if path.is_file()), None)
        if path is None:
            raise ReportError(f"d3, which draws charts, is not there (Debian's node-d3): no {' or '.join(map(str, _D3))}")
    return path.read_text(encoding="utf-8")


def json_text(value) -> str:
    """Compact JSON to stand in a page, numbers with 4 significant digits, NaN and infinity as null."""
    return json.dumps(_rounded(value), separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")


def _rounded(value):
    if isinstance(value, dict):
        return {str(key): _rounded(item) for key, item in value.items()}
    if hasattr(value, "tolist"):  # of numpy or pandas
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_rounded(item) for item in value]
    if isinstance(value, float):
        rounded = float(f"{value:.4g}") if math.isfinite(value) else None
        return int(rounded) if rounded is not None and rounded.is_integer() else rounded
    return value


def data_uri(data: bytes, kind: str = "image/png") -> str:
    """An image file to embed."""
    return f"data:{kind};base64," + base64.b64encode(data).decode("ascii")


def csv_text(rows: Iterable[Iterable]) -> str:
    lines = io.StringIO()
    csv.writer(lines, lineterminator="\n").writerows(rows)
    return lines.getvalue()


def write_whole(path: Path, content: str) -> None:
    """Writes a file that is either the old one or wholly the new one, whatever interrupts the writing.

    @throws OSError that names it"""
    name = path.with_name(f".{path.stem}.{os.getpid()}.tmp{path.suffix}")
    try:
        with open(name, "w", encoding="utf-8", errors="backslashreplace") as out:
            out.write(content)
            out.flush()
            os.fsync(out.fileno())
        os.replace(name, path)
    except BaseException as error:
        name.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OSError(error.errno, f"cannot write: {error.strerror or error}", str(path)) from error
        raise
