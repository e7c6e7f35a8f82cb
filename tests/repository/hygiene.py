#!/usr/bin/python3
"""Checks every tracked file: length, left-over notes, host names of package registries, machine paths, scripts.

hygiene.py [ROOT]: prints "file:line: problem"; exit status 1 where there is one. Files of more than WANTED
lines are only reported.
"""
import os
import re
import subprocess
import sys

WANTED, MAX = 400, 500  # Lines of a source file.
SOURCE_FOLDERS = ("framework/", "passes/", "shaders/")
NOTES = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
REGISTRIES = re.compile(
    r"\b(debian|ubuntu|fedoraproject|archlinux|pypi|pythonhosted|npmjs|crates|conan|golang|rubygems)\.(org|com|io|net)\b",
    re.I)
CONFLICTS = re.compile(r"^(<{7}|={7}|>{7})( |$)")
MACHINE_PATHS = re.compile(r"(?<![\w.])/(work|farm|tmp/brief|home/\w+)/")


def tracked(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return [path for path in listed.stdout.split("\0") if os.path.isfile(os.path.join(root, path))]
    found = []
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in (".git", "build", "results")]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in files]
    return sorted(found)


def check(root):
    """Returns (problems, remarks)."""
    problems, remarks = [], []
    for path in tracked(root):
        whole = os.path.join(root, path)
        with open(whole, "rb") as file:
            content = file.read()
        if b"\0" in content[:8192]:
            continue
        lines = content.decode("utf-8", "replace").splitlines()
        if path.startswith(SOURCE_FOLDERS) and len(lines) > WANTED:
            text = f"{path}: {len(lines)} lines (wanted at most {WANTED}, allowed {MAX})"
            (problems if len(lines) > MAX else remarks).append(text)
        for number, line in enumerate(lines, 1):
            for pattern, what in ((NOTES, "left-over note"), (REGISTRIES, "host name of a package registry"),
                                  (MACHINE_PATHS, "path of one machine"), (CONFLICTS, "conflict marker of a merge")):
                if pattern.search(line):
                    problems.append(f"{path}:{number}: {what}")
        if lines and re.match(r"#!.*\bbash\b", lines[0]):
            parsed = subprocess.run(["bash", "-n", whole], capture_output=True, text=True)
            if parsed.returncode != 0:
                problems.append(f"{path}: not valid bash: {parsed.stderr.strip()}")
            if not os.access(whole, os.X_OK):
                problems.append(f"{path}: a script that is not executable")
    return problems, remarks


if __name__ == "__main__":
    found, noted = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(noted + found) or "hygiene: nothing found")
    sys.exit(1 if found else 0)
