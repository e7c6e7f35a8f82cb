"""A run's variants apart by what they are compared with: errors and times of two scenes don't compare."""

from __future__ import annotations

import dataclasses

from report.results import Results
from report.setting import scenes_of


def comparisons(results: Results) -> list[tuple[str, Results]]:
    """The variants of one scene and one reference at a time, each with a name that no other has, in the order of the
    table. Other tables than `variants` are left whole."""
    keys = [(scene, results.reference_folder(variant) or "")
            for scene, variant in zip(scenes_of(results), results.variants["variant"])]
    found, different = [], list(dict.fromkeys(keys))
    for key in different:
        chosen = [other == key for other in keys]
        scene, folder = key
        is_unique = sum(other[0] == scene for other in different) == 1
        found.append((scene if is_unique else f"{scene} ({folder})",
                      dataclasses.replace(results, variants=results.variants[chosen])))
    return found
