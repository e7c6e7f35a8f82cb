#!/usr/bin/python3
"""Times how fast the page of `voxray look` follows the mouse, in headless Chromium.

look_latency.py PROGRAM CONFIG [--set PATH=VALUE...] [--compare VARIANT] [--events N]: drags over the image and prints the median
and the 95th percentile of the time from a pointer's event to the frame after the image is drawn, and what the program took of
it, ms. With --compare the image is split, and each side has its line; VARIANT is as in the page's list "compare with".
"""
import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1] / "unit"))
import browser  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

SETTLED = "return Boolean(window.look?.settled && !document.querySelector('[aria-busy]'))"
COUNT = "return window.look.latencies.filter((one) => one.side === arguments[0]).length"


def settle(shown):
    while not shown.run(SETTLED):
        time.sleep(0.05)


def measure(address, events, compare):
    """@return latencies, a map of ms each, and `side`"""
    shown = browser.Browser()
    try:
        shown.driver.get(address)
        settle(shown)
        if compare:
            Select(shown.driver.find_element("name", "compare")).select_by_visible_text(compare)
            settle(shown)
        image = shown.driver.find_element("id", "image")
        ActionChains(shown.driver).move_to_element_with_offset(image, -100, 0).click_and_hold().perform()
        number = 0
        sides = range(2 if compare else 1)
        while min(shown.run(COUNT, side) for side in sides) < events:
            number += 1
            ActionChains(shown.driver, duration=0).move_by_offset(3 if number % 40 < 20 else -3, 0).pause(0.02).perform()
        ActionChains(shown.driver).release().perform()
        return shown.run("return window.look.latencies")
    finally:
        shown.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program")
    parser.add_argument("config")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--compare", default="", metavar="VARIANT")
    parser.add_argument("--events", type=int, default=100)
    options = parser.parse_args()
    words = [word for one in options.set for word in ("--set", one)]
    with subprocess.Popen([options.program, "look", options.config, *words], stdout=subprocess.PIPE, text=True) as program:
        try:
            latencies = measure(program.stdout.readline().strip(), options.events, options.compare)
        finally:
            program.terminate()
    for side in sorted({one["side"] for one in latencies}):
        report(f"side {side}: " if options.compare else "", [one for one in latencies if one["side"] == side])


def report(title, latencies):
    columns = {name: [one[name] for one in latencies] for name in latencies[0]}
    print(f"{title}{len(latencies)} drafts; to the screen: median {statistics.median(columns['ms']):.1f} ms, 95th percentile "
          f"{sorted(columns['ms'])[int(0.95 * len(latencies))]:.1f} ms; medians of the program: "
          + ", ".join(f"{name} {statistics.median(columns[name]):.1f} ms" for name in ("set", "render", "png")) + ", of render the passes of the frame "
          f"{statistics.median(columns['frame']):.1f} ms")


if __name__ == "__main__":
    main()
