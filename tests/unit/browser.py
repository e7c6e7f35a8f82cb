"""A page in headless Chromium, through its WebDriver, without a network."""

from __future__ import annotations

import io
import json
import os
import shutil
import time
from pathlib import Path

import numpy as np
from PIL import Image

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

DRIVER = shutil.which("chromedriver")
WITHOUT_LIMIT = 1e6  # seconds
MISSING = "" if webdriver and DRIVER else "needs chromedriver and Python's selenium"


class Browser:
    """One window; close() ends it."""

    def __init__(self, width: int = 1400, height: int = 900):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium") or ""
        flags = ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-dev-shm-usage",
                 "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1", f"--window-size={width},{height}"]
        # Root, as in a container, has no sandbox
        for flag in flags + ["--no-sandbox"] * (os.geteuid() == 0):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        # On a busy machine anything may take long; ctest stops what hangs
        self.driver.set_script_timeout(WITHOUT_LIMIT)
        self.driver.set_page_load_timeout(WITHOUT_LIMIT)
        self.resize(width, height)

    def close(self) -> None:
        self.driver.quit()

    def resize(self, width: int, height: int) -> None:
        """What the page has of the screen, CSS pixels."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def media(self, medium: str = "", scheme: str = "light") -> None:
        """Shows the page on "screen" ("") or as it is printed ("print"), in a "light" or "dark" scheme."""
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"media": medium, "features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, path: Path, address: str = "") -> float:
        """Loads a page from scratch. @return seconds until its first frame after loading was drawn."""
        self.driver.get("about:blank")
        start = time.monotonic()
        self.driver.get(path.resolve().as_uri() + (f"#{address}" if address else ""))
        self.settle()
        return time.monotonic() - start

    def settle(self) -> None:
        """Waits until two frames were drawn, and images that are in the making."""
        self.driver.execute_async_script("""
            const done = arguments[0];
            const wait = () => (document.querySelector('[aria-busy="true"]') ? requestAnimationFrame(wait) : done());
            requestAnimationFrame(() => requestAnimationFrame(wait));""")

    def run(self, script: str, *arguments):
        """What a script of the page returns."""
        return self.driver.execute_script(script, *arguments)

    def picture(self, selector: str) -> np.ndarray:
        """The pixels of the first element in sight, 0 to 1; shape (height, width, 3)."""
        element = self.run("return [...document.querySelectorAll(arguments[0])].find((e) => e.offsetParent)", selector)
        self.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", element)
        self.settle()
        with Image.open(io.BytesIO(element.screenshot_as_png)) as image:
            return np.asarray(image.convert("RGB"), dtype=float) / 255

    def console(self) -> list[str]:
        """What the page and the browser said since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self) -> list[str]:
        """Addresses that were asked for since the last call, but for data in the page itself."""
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        addresses = [message["params"]["request"]["url"] for message in messages if message["method"] == "Network.requestWillBeSent"]
        return [address for address in addresses if not address.startswith("data:")]
