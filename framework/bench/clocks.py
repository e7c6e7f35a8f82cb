"""The clock of an NVIDIA GPU while it is measured: a time is as good as the clock at which it was taken was steady."""

from __future__ import annotations

import shutil
import statistics
import subprocess
import threading

_PERIOD_MS = 100
_BUSY_PERCENT = 1  # of the time; where the device is less busy, its clock is not counted


class ClockWatch:
    """Reads the clock in the background, from construction to `ended()`; reads nothing where there is no `nvidia-smi`."""

    def __init__(self) -> None:
        self._busy_mhz: list[float] = []
        self._process = None
        if program := shutil.which("nvidia-smi"):
            self._process = subprocess.Popen([program, "--query-gpu=clocks.sm,utilization.gpu", "--format=csv,noheader,nounits",
                                              f"--loop-ms={_PERIOD_MS}"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in self._process.stdout:
            clock, _, busy = line.partition(",")
            try:
                if float(busy) >= _BUSY_PERCENT:
                    self._busy_mhz.append(float(clock))
            except ValueError:
                continue  # A value that the driver does not tell

    def ended(self) -> dict | None:
        """MHz while the device was busy: 5th percentile, median and highest. None where nothing was read."""
        if self._process:
            self._process.terminate()
            self._process.wait()
        read = sorted(self._busy_mhz)
        return {"p05": read[len(read) // 20], "median": statistics.median(read), "highest": read[-1]} if read else None
