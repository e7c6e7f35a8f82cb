#!/usr/bin/python3
"""Checks the documentation against the tree.

Links lead to files and headings that are there; every package has its reason in docs/dependencies.md; a block of code under
"<!-- file: PATH -->" is that file, word for word; a table under "<!-- table: NAME -->" is what its results say
(scripts/paper_tables.py); text ends at column 120 (tables and code may be wider). docs.py [ROOT]; exit status 1 where one is not so.
"""
import os
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts"))
import paper_tables  # noqa: E402

LINK = re.compile(r"\]\(([^)\s]+)\)")
COLUMNS = 120
QUOTED = re.compile(r"<!-- file: (\S+) -->\n```\w*\n(.*?)```\n", re.S)


def pages(root):
    yield from (name for name in sorted(os.listdir(root)) if name.endswith(".md"))
    for folder, folders, files in os.walk(os.path.join(root, "docs")):
        folders.sort()
        yield from (os.path.relpath(os.path.join(folder, name), root) for name in sorted(files) if name.endswith(".md"))


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def long_lines(text):
    """Numbers of the lines of text, not of tables and code, that are too long."""
    is_code = False
    for number, line in enumerate(text.splitlines(), 1):
        is_code ^= line.lstrip().startswith("```")
        if len(line) > COLUMNS and not is_code and not line.lstrip().startswith("|"):
            yield number


def anchors(text):
    """What a link may name after its '#': the headings as GitHub spells them, the second of a name with '-1'."""
    prose = re.sub(r"^\s*```.*?^\s*```", "", text, flags=re.S | re.M)
    names = []
    for heading in re.findall(r"^#+ (.*)$", prose, re.M):
        shown = re.sub(r"\]\([^)]*\)", "", heading).strip().lower()
        name = re.sub(r"[^\w\- ]", "", shown).replace(" ", "-")
        names.append(f"{name}-{names.count(name)}" if name in names else name)
    return names


def check(root):
    problems = []
    for page in pages(root):
        text = read(root, page)
        problems += [f"{page}:{number}: a line longer than {COLUMNS} columns" for number in long_lines(text)]
        for target in LINK.findall(text):
            if re.match(r"\w+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(os.path.join(root, file)):
                problems.append(f"{page}: link to {target}, which is not there")
            elif anchor and file.endswith(".md") and anchor not in anchors(read(root, file)):
                problems.append(f"{page}: link to {target}, but {file} has no such heading")
        for path, quoted in QUOTED.findall(text):
            if not os.path.isfile(os.path.join(root, path)) or read(root, path) != quoted:
                problems.append(f"{page}: the block of {path} is not what the file says")
    reasons = read(root, "docs/dependencies.md")
    for line in read(root, "scripts/packages.txt").splitlines():
        if line.startswith("#") or not line.strip():
            continue
        package = line.split("|")[2].partition("[")[0].strip()
        if f"`{package}`" not in reasons:
            problems.append(f"docs/dependencies.md: no reason for the package {package}")
    return problems + paper_tables.check(Path(root))


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(found) or "docs: links, packages, quoted files and tables are as they say")
    sys.exit(1 if found else 0)
