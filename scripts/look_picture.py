#!/usr/bin/python3
"""Takes the picture of the page of `voxray look` that docs/look.md shows, in headless Chromium.

look_picture.py [--program PROGRAM] [--out FILE.png] [--samples N]: two variants of Sponza over one another, when the reference
has N samples a pixel. Cards of passes are closed but those of OPEN, so that "Scene and reference" is in the picture. It shows
times: let nothing else run meanwhile.
"""
import argparse
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[1]
sys.path += [str(ROOT / "tests" / "unit"), str(ROOT / "tests" / "scale")]
import browser  # noqa: E402
from look_latency import settle  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

CONFIG, COMPARED = ROOT / "configs" / "sponza.yaml", "filtered rays: 4 a pixel"
WORDS = ["--set", "image.width=640", "--set", "image.height=360", "--set", "image.exposure_stops=1.5"]
WIDTH = 1400
OPEN = ("voxelize", "indirect")
CLOSE = """for (const details of document.querySelectorAll("#passes details")) details.open = arguments[0].includes(details.dataset.id);
    return document.documentElement.scrollHeight"""
SAMPLES = "return Number(document.getElementById('reference').textContent.match(/(\\d+) of/)?.[1] ?? 0)"


def take(address, samples, file):
    shown = browser.Browser(WIDTH, 900)
    try:
        shown.driver.get(address)
        settle(shown)
        Select(shown.driver.find_element("name", "compare")).select_by_visible_text(COMPARED)
        settle(shown)
        while shown.run(SAMPLES) < samples or shown.run("return document.querySelectorAll('#reference tbody tr').length") < 4:
            time.sleep(0.2)
        shown.resize(WIDTH, shown.run(CLOSE, OPEN))
        shown.run("document.activeElement.blur()")
        shown.settle()
        shown.driver.save_screenshot(str(file))
    finally:
        shown.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "voxray"))
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "look.png")
    parser.add_argument("--samples", type=int, default=16)
    options = parser.parse_args()
    with subprocess.Popen([options.program, "look", CONFIG, *WORDS], stdout=subprocess.PIPE, text=True) as program:
        try:
            take(program.stdout.readline().strip(), options.samples, options.out)
        finally:
            program.terminate()
    return 0


if __name__ == "__main__":
    sys.exit(main())
