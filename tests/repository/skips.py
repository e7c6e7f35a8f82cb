#!/usr/bin/python3
"""Counts skipped tests. In continuous integration (CI is set) a skip that tests/allowed_skips.txt does not list fails.

skips.py ROOT: checks the list: each entry names a test that is there and a reason; no test is disabled in its source.
skips.py ROOT JUNIT: lists what a run of ctest skipped, from the file of its --output-junit.
"""
import os
import re
import sys
import xml.etree.ElementTree

import commands

LIST = "tests/allowed_skips.txt"
SKIPPED = re.compile(r"^\[  SKIPPED \] (\w+\.\w+): (.*)$", re.M)
SKIPPED_UNITTEST = re.compile(r"^\w+ \(\w+\.([\w.]+)\).* \.\.\. skipped '(.*)'$", re.M)


def allowed(root):
    """Reasons by test."""
    entries = {}
    with open(os.path.join(root, LIST), encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                name, _, reason = (part.strip() for part in line.partition("|"))
                entries[name] = reason
    return entries


def unittest_names(root):
    """CLASS.METHOD of the tests in Python."""
    names = []
    for text in commands.sources(root, "tests", ".py"):
        for owner, body in re.findall(r"^class (\w+)\(.*?\):\n(.*?)(?=^\S|\Z)", text, re.M | re.S):
            names += [f"{owner}.{method}" for method in re.findall(r"^    def (test_\w+)\(", body, re.M)]
    return names


def check(root):
    known = commands.test_names(root) + unittest_names(root)
    problems = []
    for name, reason in allowed(root).items():
        if name not in known:
            problems.append(f"{LIST}: there is no test {name}")
        if not reason:
            problems.append(f"{LIST}: {name} has no reason")
    return problems + [f"{name} is disabled: mend it or take it out" for name in known if "DISABLED_" in name]


def skipped(junit):
    """Reasons by test, of a run."""
    found = {}
    for case in xml.etree.ElementTree.parse(junit).iter("testcase"):
        output = case.findtext("system-out") or ""
        inside = {name: reason for name, reason in SKIPPED.findall(output)}
        inside |= {name: reason for name, reason in SKIPPED_UNITTEST.findall(output)}
        if not inside and (case.find("skipped") is not None or case.get("status") == "notrun"):
            lines = output.strip().splitlines()
            inside = {case.get("name"): lines[-1] if lines else "did not run"}
        found |= inside
    return found


def check_run(root, junit):
    """Returns (what was skipped, as lines; those that are not allowed)."""
    entries, lines, refused = allowed(root), [], []
    for name, reason in sorted(skipped(junit).items()):
        lines.append(f"skipped {name}: {reason}")
        if name not in entries:
            refused.append(f"{name} was skipped and is not in {LIST}")
    return lines, refused


if __name__ == "__main__":
    tree = sys.argv[1] if len(sys.argv) > 1 else "."
    if len(sys.argv) > 2:
        noted, found = check_run(tree, sys.argv[2])
        print("\n".join(noted + [f"{len(noted)} tests skipped"]))
        if not os.environ.get("CI"):
            found = []
    else:
        found = check(tree)
    print("\n".join(found) or "skips: nothing found")
    sys.exit(1 if found else 0)
