"""A run's variants apart by what they are compared with: errors and times of two scenes don't compare."""

from __future__ import annotations

import dataclasses

from report.load import Results
from report.setting import scene_of


def comparisons(results: Results) -> list[tuple[str, Results]]:
    """The variants of one scene and one reference at a time, each with a name that no other has, in the order of the
    table. Other tables than `variants` are left whole."""
    keys = [(scene_of(results, row), results.reference_folder(row["variant"]) or "")
            for _, row in results.variants.iterrows()]
    found = []
    for key in dict.fromkeys(keys):
        chosen = [other == key for other in keys]
        scene, folder = key
        is_told_by_scene = len({other for other in keys if other[0] == scene}) == 1
        found.append((scene if is_told_by_scene else f"{scene} ({folder})",
                      dataclasses.replace(results, variants=results.variants[chosen])))
    return found
