"""What the tests of the report share: results that are made up, the program, a parsed page."""

from __future__ import annotations

import contextlib
import io
import json
import re
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "framework"), str(ROOT / "tests" / "unit")]

import report_results as made_up  # noqa: E402
from report import make_report  # noqa: E402
from report.results import Metric  # noqa: E402

NRMSE = Metric("nrmse", "nRMSE", "", "low", "", True)
FLIP = Metric("flip", "HDR-FLIP", "", "low", "")
_VOID = {"meta", "img", "input", "br", "wbr", "path", "rect", "use", "hr", "link"}


def numbers_of(source: str) -> dict:
    """What a page's script shows."""
    return json.loads(re.search('<script type="application/json" id="data">(.*)</script>', source)[1])


class Page(HTMLParser):
    """A parsed page; fails on a tag that is not closed and on an id that stands twice."""

    def __init__(self, source: str):
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict]] = []
        self.text = ""
        self.feed(source)
        self.close()
        assert not self.open, f"not closed: {self.open}"
        ids = self.attributes("id")
        assert len(ids) == len(set(ids)), "an id stands twice"

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if tag not in _VOID:
            assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
            self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.text += data

    def attributes(self, name: str) -> list[str]:
        return [attrs[name] for _, attrs in self.tags if name in attrs]

    def count(self, tag: str, css_class: str) -> int:
        return sum(t == tag and css_class in (a.get("class") or "").split() for t, a in self.tags)


class ReportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "run"

    def run_program(self) -> tuple[int, str]:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            status = make_report.main([str(self.directory)])
        return status, errors.getvalue()

    def make(self, rows, run, **options) -> Page:
        made_up.write_results(self.directory, rows, run, **options)
        status, errors = self.run_program()
        self.assertEqual((status, errors), (0, ""))
        return Page((self.directory / "report.html").read_text(encoding="utf-8"))
