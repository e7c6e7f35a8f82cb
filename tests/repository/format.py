#!/usr/bin/python3
"""Checks that the C++ sources are as clang-format 14 leaves them. format.py [ROOT]; exit status 77: not installed."""
import os
import shutil
import subprocess
import sys

import layers

root = sys.argv[1] if len(sys.argv) > 1 else "."
program = shutil.which("clang-format-14")
if not program:
    print("clang-format-14 is not installed; Debian 12 has it, and versions differ in what they format")
    sys.exit(77)
files = [path for path in layers.sources(root) if path.endswith((".h", ".cpp")) and not path.startswith("shaders/")]
done = subprocess.run([program, "--dry-run", "-Werror", "--ferror-limit=1", *files], cwd=root, capture_output=True, text=True)
unformatted = sorted({line.split(":")[0] for line in done.stderr.splitlines() if "code should be clang-formatted" in line})
if done.returncode != 0:
    print("not formatted: " + " ".join(unformatted) if unformatted else done.stderr)
    print(f"mend them with: {os.path.basename(program)} -i FILE...")
sys.exit(1 if done.returncode else 0)
