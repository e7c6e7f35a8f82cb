"""`voxray pareto`: charts the methods of many runs, speed against accuracy."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

from orchestration.errors import UsageError
from orchestration.program import Program
from report import pareto_page
from report.results import ReportError


def main(_: Program, options: SimpleNamespace) -> int:
    page = Path(options.out)
    try:
        table = pareto_page.write(page, [Path(folder) for folder in options.results], options.error, options.light,
                                  with_images=not options.no_images, figures_to=Path(options.figures) if options.figures else None)
    except ReportError as error:
        raise UsageError(f"pareto: {error}") from error
    print(page, table, *([options.figures] if options.figures else []), sep="\n")
    return 0
