#!/usr/bin/python3
"""Checks the words of identifiers, parameters, comments and documentation: one meaning each, the field's own. Names of
shaders say what these do.

words.py [ROOT]: prints "file:line: 'word': say ..."; exit status 1 where there is one. Identifiers are read word by
word: `kMostRays` and `most_rays` hold "most rays".
"""
import os
import re
import sys

import hygiene

ENDINGS = (".h", ".cpp", ".glsl", ".comp", ".vert", ".geom", ".frag", ".rgen", ".rmiss", ".rchit", ".rahit", ".py",
           ".sh", ".cmake", ".txt", ".yaml", ".md", ".html", ".css", ".js")
HERE = "tests/house/words.py"

# (what to find in a line, what to say in its place, uses that stay), as regular expressions.
WORDS = [
    (r"middles?", "center", ()),
    (r"cent(?:re|red|res)", "center", ()),
    (r"former(?:ly)?", "previous", ()),
    (r"renew(?:ed|s|al|ing)?", "updated or rebuilt", ()),
    (r"flux sums?", "accumulator", ()),
    (r"voxel writes?", "accumulator", ()),
    (r"anew", "again or rebuilt", ()),
    (r"beside", "next to or adjacent", ()),
    (r"exposed", "unoccluded or visible", ()),
    (r"turned", "rotated, flipped or permuted", ()),
    (r"judg(?:e[ds]?|ing|ments?)", "reference or compare", ()),
    (r"strictness", "edge-stopping scale", ()),
    (r"(?:an?|the|its|their|each|every|ray's|\w+ed) shares?(?: of)?", "part, fraction or weight", ()),
    (r"shar(?:es?|ed|ing) out", "divide up", ()),
    (r"(?:lobe|cone|hemisphere)s?(?:'s?)? cells?|cells? of (?:a|the) (?:lobe|cone|hemisphere)", "stratum", ()),
    (r"voxel(?:'s)? sides?|sides? of (?:a|the|each) voxels?", "face", ()),
    (r"pieces?", "fragment or part", ("in one piece", "piece of furniture")),
    (r"cover", "coverage or opacity",
     (r"(?:to|they|that|can|will|not|together|n't|surfaces|cells|triangles|voxels) cover", r"^\W*cover")),
    (r"covers (?:add|of|that|a ray collects)|(?:whose|the|of) covers", "coverages", ()),
]

# The same for identifiers alone: in prose the words are English.
IDENTIFIERS = [
    (r"most", "max", ()),
    (r"least", "min", ("at_least",)),
    (r"ahead", "forward", ()),
    (r"cover", "coverage", ()),
    (r"shares?$", "fraction, weight or part", ()),
]

# Words that names of shaders do without.
SHADERS = {
    "aim": "generate_..., and what",
    "spread": "dilate, propagate_..., or scatter_..., and what",
    "keep": "store_... or compact_..., and what",
    "begin": "init_..., and what",
    "place": "what it does",
    "join": "what it joins",
}
SHADER_FOLDERS = ("passes/common/", "passes/view/", "passes/voxels/")  # Whose shaders have their names.

IDENTIFIER = re.compile(r"[A-Za-z_]\w*")


def split(text):
    """Words of identifiers, which begin at capitals and after underscores."""
    text = re.sub(r"\bk([A-Z])", r"\1", text)
    text = re.sub(r"([a-z0-9])([A-Z])", r"\1 \2", text)
    return re.sub(r"([A-Z])([A-Z][a-z])", r"\1 \2", text).replace("_", " ")


def is_compound(name):
    return "_" in name.strip("_") or re.search(r"[a-z0-9][A-Z]", name) is not None


# Nearly all lines hold none of the words: one look tells.
ANY_WORD = re.compile("|".join(pattern for pattern, _, _ in WORDS), re.I)
ANY_IDENTIFIER = re.compile("|".join(pattern.rstrip("$") for pattern, _, _ in IDENTIFIERS), re.I)


def problems_of(line):
    separate = split(line)
    for pattern, instead, stays in WORDS if ANY_WORD.search(separate) else ():
        text = separate
        for kept in stays:
            text = re.sub(kept, "", text, flags=re.I)
        for found in re.findall(rf"\b(?:{pattern})\b", text, re.I):
            yield f"'{found}': say {instead}"
    for name in IDENTIFIER.findall(line) if ANY_IDENTIFIER.search(separate) else ():
        if not is_compound(name) and not name.isupper():
            continue
        for pattern, instead, stays in IDENTIFIERS:
            if re.search(rf"\b(?:{pattern})\b", split(name), re.I) and name not in stays:
                yield f"'{name}': say {instead}"


def problems_of_name(path):
    name, ending = os.path.splitext(os.path.basename(path))
    if path.startswith(SHADER_FOLDERS) and ending in (".glsl", ".comp", ".vert", ".geom", ".frag"):
        for word in name.split("_"):
            if word in SHADERS:
                yield f"'{word}': say {SHADERS[word]}"


def check(root):
    problems = []
    for path in hygiene.tracked(root):
        if not path.endswith(ENDINGS) or path == HERE or path == "tests/house/selftest.py":
            continue
        problems += [f"{path}:1: {text}" for text in problems_of_name(path)]
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                problems += [f"{path}:{number}: {text}" for text in problems_of(line)]
    return problems


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(found) or "words: each has its one meaning")
    sys.exit(1 if found else 0)
