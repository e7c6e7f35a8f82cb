"""What a command's errors are, and how words that a user wrote are told in them."""

from __future__ import annotations

from collections.abc import Iterable


class Failed(Exception):
    """Something could not be done: exit status 1."""


class UsageError(Exception):
    """A mistake of the user: exit status 2."""


class ProgramEnded(Exception):
    """The program ended a command's work and said why: its exit status is the command's."""

    def __init__(self, status: int) -> None:
        super().__init__(f"the program ended with status {status}")
        self.status = status


def one_line(text: str) -> str:
    """As framework/base/one_line.h has it: control characters, and bytes that are no UTF-8, as escapes."""
    plain = text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
    return "".join(c if c.isprintable() or c == " " else " " if c in "\n\r\t" else
                   "".join(f"\\x{byte:02x}" for byte in c.encode("utf-8")) for c in plain).rstrip()


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """As framework/base/suggest.h has it: a near candidate, else all of them."""
    candidates = list(candidates)
    near = _nearest(word, candidates)
    if near:
        return f"; did you mean '{near}'?"
    return f"; one of: {', '.join(candidates)}" if candidates else ""


def _nearest(word: str, candidates: list[str]) -> str:
    others = [candidate for candidate in candidates if candidate != word]
    best = min(others, key=lambda candidate: _distance(word.lower(), candidate.lower()), default="")
    if best and _distance(word.lower(), best.lower()) <= max(1, len(word) // 3):
        return best
    if not word:
        return ""
    return next((candidate for candidate in candidates if f"_{word}_" in f"_{candidate}_"
                 or (len(word) >= 3 and candidate.startswith(word))), "")


def _distance(a: str, b: str) -> int:
    """Insertions, deletions, substitutions, swaps of neighbors."""
    rows = [list(range(len(b) + 1))]
    for i, x in enumerate(a, 1):
        row = [i]
        for j, y in enumerate(b, 1):
            row.append(min(rows[i - 1][j] + 1, row[j - 1] + 1, rows[i - 1][j - 1] + (x != y)))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                row[j] = min(row[j], rows[i - 2][j - 2] + 1)
        rows.append(row)
    return rows[-1][-1]
