"""Does a command that the C++ program hands over: orchestration COMMAND PROGRAM OPTIONS.

OPTIONS is JSON: what was written for each option of the command (framework/app/orchestration.cpp lists them, and checks
what was written), a text, a list of texts or a boolean; null where there is nothing.
Exit status: that of the command; 1 something failed, 2 a mistake, 130 interrupted."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from types import SimpleNamespace

sys.path[0] = str(Path(__file__).resolve().parents[1])

from orchestration.errors import Failed, ProgramEnded, UsageError, one_line  # noqa: E402
from orchestration.program import INTERRUPTED, Program  # noqa: E402


def complain(message: object, status: int) -> int:
    print(f"voxray: error: {one_line(str(message))}", file=sys.stderr)
    return status


def main(command: str, program: str, given: str) -> int:
    options = SimpleNamespace(**{name.replace("-", "_").lower(): value for name, value in json.loads(given).items()})
    try:
        status = importlib.import_module(f"orchestration.{command}").main(Program(program, options), options)
        sys.stdout.flush()
        return status
    except ProgramEnded as ended:
        return ended.status
    except UsageError as error:
        return complain(error, 2)
    except Failed as failed:
        return complain(failed, 1)
    except OSError as error:
        return complain(f"{error.filename}: {error.strerror}" if error.filename else error, 1)
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
