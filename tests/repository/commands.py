#!/usr/bin/python3
"""Checks every command that README.md and docs/ name, and every path in them.

commands.py [ROOT]: files and folders in `code` exist, configs of `./voxray run` are there, filters of `./voxray bench`
match a benchmark and those of `./voxray test` a test, sub-commands and programs of tests exist. With the built program
in VOXRAY_PROGRAM also their options, the passes, and `--set` of shipped configs. Exit status 1 where one is not so.
"""
import functools
import os
import re
import shlex
import subprocess
import sys

import docs

CODE = re.compile(r"`([^`\n]+)`")
BLOCK = re.compile(r"```\w*\n(.*?)```", re.S)
TOP = r"(?:configs|docs|framework|notebooks|passes|scripts|shaders|tests)/"
PATH = re.compile(rf"{TOP}[\w./-]+")
SCRIPT_BENCHES = {"gpu": "scripts/bench_gpu.py", "growth": "scripts/growth.py"}  # `./voxray bench NAME` runs the script.
LAUNCHER = {"test", "bench"}  # Commands of the launcher; all others go to the program.


def commands(text):
    """Command lines of a page, as lists of words: `./voxray ...` in a line or at the start of one in a block."""
    lines = [code for code in CODE.findall(BLOCK.sub("", text))]
    lines += [line for block in BLOCK.findall(text) for line in block.splitlines()]
    for line in lines:
        if line.startswith("./voxray "):
            yield shlex.split(line.replace(r"\|", "|"), comments=True)[1:]


def is_placeholder(word):
    return re.search(r"[A-Z]{2}|[<\[]|\.\.\.", word) is not None


def sources(root, folder, endings):
    for at, folders, files in os.walk(os.path.join(root, folder)):
        folders.sort()
        for name in sorted(files):
            if name.endswith(endings):
                with open(os.path.join(at, name), encoding="utf-8") as file:
                    yield file.read()


def benchmarks(root):
    """Names of benchmarks: of BENCHMARK, BENCHMARK_CAPTURE, and macros that make them from a scene's name."""
    names = []
    for text in sources(root, "tests", ".cpp"):
        names += re.findall(r"^BENCHMARK\((\w+)\)", text, re.M)
        names += ["/".join(name) for name in re.findall(r"^BENCHMARK_CAPTURE\((\w+), (\w+),", text, re.M)]
        for macro, parameters, body in re.findall(r"^#define (\w+)\(([^)]*)\)((?:.*\\\n)*.*)", text, re.M):
            for function, case in re.findall(r"BENCHMARK_CAPTURE\((\w+), ([\w#]+)", body):
                for values in re.findall(rf"^{macro}\(([^)]*)\)", text, re.M):
                    given = dict(zip(parameters.split(", "), values.split(", ")))
                    names.append(f"{function}/" + "".join(given.get(part, part) for part in case.split("##")))
    return names


def test_names(root):
    names = []
    for text in sources(root, "tests", ".cpp"):
        names += [f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", text, re.M)]
    programs = []
    for text in sources(root, "tests", (".cmake", "CMakeLists.txt")):
        programs += re.findall(r"^voxray_tests\((\w+)", text, re.M)
        names += re.findall(r"add_test\(NAME ([\w.]+)", text)
    # Which program holds a test is the build's affair: a filter may name either.
    return names + [program + "." for program in programs]


def targets(root):
    text = "".join(sources(root, "tests", (".cmake", "CMakeLists.txt")))
    found = {"tests_" + name for name in re.findall(r"^voxray_tests\((\w+)", text, re.M)}
    for variable, values in re.findall(r"foreach\((\w+) ([^)]*)\)", text):
        for name in re.findall(rf"add_executable\(([\w]*)\${{{variable}}}", text):
            found |= {name + value for value in values.split()}
    return found | set(re.findall(r"add_executable\((bench_\w+)", text))


class Program:
    """The built program, asked each thing once."""

    def __init__(self, path):
        self.path = path

    @functools.cache
    def run(self, *arguments):
        return subprocess.run([self.path, *arguments], capture_output=True, text=True)

    def help(self, command):
        done = self.run(command, "--help")
        return done.stdout if done.returncode == 0 else None


def problem_of(root, words, program):
    """What is wrong with one command line, None where nothing is."""
    command, arguments = words[0], words[1:]
    if is_placeholder(command):
        return None
    if command == "bench" and arguments and arguments[0] in SCRIPT_BENCHES:
        known = re.findall(r"--[\w-]+", docs.read(root, SCRIPT_BENCHES[arguments[0]]))
        return next((f"bench {arguments[0]} has no option {word}" for word in arguments
                     if word.startswith("--") and word.split("=")[0] not in known), None)
    if command in LAUNCHER:
        known = benchmarks(root) if command == "bench" else test_names(root)
        for pattern in arguments:
            if not is_placeholder(pattern) and not any(re.search(pattern, name) for name in known):
                return f"no {'benchmark' if command == 'bench' else 'test'} matches '{pattern}'"
        return None
    values = {i + 1 for i, word in enumerate(arguments) if word == "--set" or word == "--profile"}
    configs = [word for i, word in enumerate(arguments) if word.endswith(".yaml") and i not in values]
    for config in configs:
        if not is_placeholder(config) and not os.path.isfile(os.path.join(root, config)):
            return f"no config {config}"
    if not program:
        return None
    if program.help(command) is None:
        return f"no command {command}"
    for word in arguments:
        if word.startswith("--") and word.split("=")[0] not in re.findall(r"--[\w-]+", program.help(command)):
            return f"{command} has no option {word}"
    if command == "passes" and arguments and not is_placeholder(arguments[0]):
        if program.run("passes", arguments[0]).returncode != 0:
            return f"no pass {arguments[0]}"
    if command == "run" and configs and not is_placeholder(configs[0]) and "--set" in arguments:
        taken = [word for i, option in enumerate(arguments) if option in ("--set", "--profile", "--only")
                 for word in arguments[i:i + 2]]
        done = program.run("plan", os.path.join(root, configs[0]), *taken)
        if done.returncode == 2 and "no file" not in done.stderr:
            return done.stderr.strip()
    return None


def check(root, program=None):
    problems = []
    known_targets = targets(root)
    for page in docs.pages(root):
        text = docs.read(root, page)
        for words in commands(text):
            problem = problem_of(root, words, program)
            if problem:
                problems.append(f"{page}: ./voxray {shlex.join(words)}: {problem}")
        for code in CODE.findall(BLOCK.sub("", text)):
            for path in PATH.findall(code) if re.match(TOP, code) and not is_placeholder(code) else []:
                if "*" not in code and not os.path.exists(os.path.join(root, path.rstrip("."))):
                    problems.append(f"{page}: {path} is not there")
            for target in re.findall(r"\b(?:tests|bench)_\w+", code) if code.startswith("ninja ") else []:
                if target not in known_targets:
                    problems.append(f"{page}: no program {target}")
    return problems


if __name__ == "__main__":
    built = os.environ.get("VOXRAY_PROGRAM")
    found = check(sys.argv[1] if len(sys.argv) > 1 else ".", Program(built) if built else None)
    print("\n".join(found) or "commands: all that the documentation names are there")
    sys.exit(1 if found else 0)
