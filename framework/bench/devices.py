"""What `voxray devices` tells, as data."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

_HEADING = re.compile(r"^(\S.*) \((CPU|GPU)\)$")
_FACT = re.compile(r"^  (\S.*?)\s{2,}(.*)$")


@dataclass
class Device:
    name: str
    is_cpu: bool
    facts: dict[str, str] = field(default_factory=dict)

    @property
    def qualifies(self) -> bool:
        return "does not qualify" not in self.facts

    @property
    def own_tracers(self) -> list[str]:
        """The tracers that run on the device: all but Embree."""
        return [name for name in self.facts.get("ray tracers", "").split(", ") if name and name != "embree"]


def parse(text: str) -> list[Device]:
    """The devices that a listing names, best first."""
    devices: list[Device] = []
    for line in text.splitlines():
        if heading := _HEADING.match(line):
            devices.append(Device(heading[1], heading[2] == "CPU"))
        elif devices and (fact := _FACT.match(line)):
            devices[-1].facts[fact[1]] = fact[2]
    return devices


def chosen(devices: list[Device], wanted: str) -> Device | None:
    """The first that qualifies and has `wanted` in its name, as the program chooses it."""
    return next((d for d in devices if d.qualifies and wanted.lower() in d.name.lower()), None)


def software(devices: list[Device], other: Device) -> Device | None:
    """A device that runs on the processor, unless that is the other one."""
    return next((d for d in devices if d.qualifies and d.is_cpu and d.name != other.name), None)
