"""`voxray look`: what its server answers and refuses, and what tests of its page share."""
import http.client
import io
import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np
from PIL import Image
from support import PROGRAM, SOURCE, TINY, CommandTest

sys.path[:0] = [os.path.join(SOURCE, "tests", "unit"), os.path.join(SOURCE, "tests", "scale")]
sys.path.append(os.path.join(SOURCE, "framework"))
import browser  # noqa: E402
import look_abuse  # noqa: E402
from report import exr_pixels  # noqa: E402

if not browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select

CONFIG = TINY.replace("width: 32, height: 24", "width: 64, height: 48")


class Look(CommandTest):
    yaml = CONFIG

    def setUp(self):
        super().setUp()
        self.use_own_references("cache")
        self.write("look.yaml", self.yaml)
        self.process = subprocess.Popen([PROGRAM, "look", "look.yaml", "--validate"], cwd=self.folder, env=self.environment, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.process.stderr.close)
        self.addCleanup(self.process.stdout.close)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        self.address = self.process.stdout.readline().strip()
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/(\w{32})/", self.address).groups()
        self.process.stdout.readline()

    def ask(self, method="GET", name="", body=None, headers=None, path=None):
        """@return status, body"""
        connection = http.client.HTTPConnection("127.0.0.1", int(self.port))
        self.addCleanup(connection.close)
        connection.request(method, path or f"/{self.token}/{name}", body, headers or {})
        answer = connection.getresponse()
        return answer.status, answer.read()

    def image(self, **request):
        status, body = self.ask("POST", "image", json.dumps(request))
        self.assertEqual(status, 200, body)
        line, _, png = body.partition(b"\n")
        return json.loads(line), png


def settle(page):
    """Waits for the whole image of the newest state."""
    page.driver.execute_async_script("""
        const done = arguments[0];
        const wait = () => (window.look?.settled && !document.querySelector('[aria-busy]') ? done() : setTimeout(wait, 20));
        wait();""")


def descendants(process):
    """Ids of the processes that a process has started, and that they have."""
    stats = [stat.read_text().rpartition(")") for stat in Path("/proc").glob("[0-9]*/stat")]
    children = [int(name.split()[0]) for name, _, rest in stats if int(rest.split()[1]) == process]
    return [one for child in children for one in (child, *descendants(child))]


def pixels(png):
    with Image.open(io.BytesIO(png)) as image:
        return np.asarray(image.convert("RGB"))


class Server(Look):
    def test_serves_its_own_page_alone(self):
        for name in ("", "look.js", "camera.js", "keys.js", "passes.js", "path.js", "reference.js", "side.js", "split.js", "times.js", "views.js", "look.css", "style.css", "start.json"):
            self.assertEqual(self.ask(name=name)[0], 200, name)
        self.assertEqual(self.ask(headers={"Host": f"localhost:{self.port}"})[0], 200)
        own = f"http://127.0.0.1:{self.port}"
        self.assertEqual(self.ask("POST", "image", "{}", {"Origin": own})[0], 200)
        for headers, why in (({"Host": "evil.example"}, b"foreign Host"), ({"Host": f"evil.example:{self.port}"}, b"foreign Host"),
                             ({"Origin": "http://evil.example"}, b"foreign Origin"), ({"Origin": "null"}, b"foreign Origin"),
                             ({"Origin": f"http://localhost:{self.port}"}, b"foreign Origin")):
            for method, name in (("GET", ""), ("GET", "start.json"), ("POST", "image")):
                status, body = self.ask(method, name, "{}", headers)
                self.assertEqual(status, 403)
                self.assertIn(why, body)
        for path in ("/", "/look.js", "/image", f"/{self.token}", f"/{self.token[:-1]}x/", f"/{self.token.upper()}x/", "/../" + self.token + "/"):
            for method in ("GET", "POST"):
                status, body = self.ask(method, path=path)
                self.assertEqual(status, 403, path)
                self.assertIn(b"no token", body)
        for name in ("../look/look.js", "look.html", "%2e%2e/look.js", "image"):
            self.assertEqual(self.ask(name=name)[0], 404, name)
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertGreaterEqual(self.ask(method, "image", "{}")[0], 400, method)

    def test_is_reached_from_this_machine_alone(self):
        with socket.socket() as other:
            other.settimeout(2)
            with self.assertRaises(OSError):
                other.connect((socket.gethostbyname(socket.gethostname()).replace("127.0.0.1", "127.0.0.2"), int(self.port)))
        done = self.expect(1, "look", "look.yaml", "--port", self.port)
        self.assertIn("not free", done.stderr)

    def test_malformed_requests_are_refused_with_a_word(self):
        for body in ("", "{", "[1]", "1", '{"shrink": 0}', '{"shrink": 65}', '{"shrink": "x"}', '{"what": 1}', '{"changes": {}}', '{"changes": [1]}',
                     '{"changes": [{"path": "seed"}]}', '{"changes": [{"path": [1], "value": 1}]}', '{"variant": [1]}', '{"side": 2}', '{"side": -1}', '{"side": 0.5}', '{"config": 1}', '{"close": 1}', '{"close": true}',
                     '{"show": [1]}', '{"show": "gbuffer.N", "parameters": {"show": "albedo"}}', '{"show": "show_voxels", "parameters": 1}',
                      "\x01", "{" * 200):
            status, answer = self.ask("POST", "image", body.encode())
            self.assertEqual(status, 400, body)
            self.assertIn(b"request", answer, body)
        self.assertEqual(self.ask("POST", "image", b" " * (1 << 21))[0], 413)
        chance = random.Random(5)
        for _ in range(200):
            with socket.create_connection(("127.0.0.1", int(self.port))) as raw:
                raw.sendall(chance.randbytes(chance.randrange(1, 400)) + b"\r\n\r\n")
        self.assertIn("config", self.image()[0])

    def test_mutations_of_right_requests_are_refused_with_a_word(self):
        wrong, answers, _ = look_abuse.run(PROGRAM, 300, 2, self.folder)
        self.assertEqual(wrong, [])
        self.assertGreater(min(answers[status] for status in (200, 400, 403, 404)), 3)

    def test_two_programs_show_one_config(self):
        first, png = self.image()
        other = look_abuse.Look(PROGRAM, self.folder)
        self.addCleanup(other.process.stderr.close)
        self.addCleanup(other.process.stdout.close)
        self.addCleanup(other.process.wait)
        self.addCleanup(other.process.kill)
        self.assertNotEqual(other.address, self.address)
        self.assertEqual(self.ask(path=f"/{other.token}/")[0], 403)
        self.assertEqual(other.image(changes=[{"path": "seed", "value": 8}])[1]["config"]["seed"], 8)
        answer, same = self.image()
        self.assertEqual(answer["config"], first["config"])
        self.assertEqual(same, png)

    def test_an_asker_that_goes_away_takes_nothing_with_it(self):
        first, png = self.image()
        for body in ('{"changes": [{"path": "inject.rays_per_light", "value": 4194304}]}', "{}", '{"shrink": 4}'):
            connection = http.client.HTTPConnection("127.0.0.1", int(self.port))
            connection.request("POST", f"/{self.token}/image", body)
            connection.sock.close()
        answer, same = self.image(page="another", changes=[{"path": "inject.rays_per_light", "value": 4096}])
        self.assertEqual(answer["config"], first["config"])
        self.assertEqual(pixels(same).tolist(), pixels(png).tolist())

    def test_changes_are_kept_by_whole_images_alone(self):
        first, png = self.image()
        self.assertEqual(pixels(png).shape, (48, 64, 3))
        draft, small = self.image(shrink=4, changes=[{"path": "voxelize.resolution", "value": 9}])
        self.assertEqual(pixels(small).shape, (12, 16, 3))
        self.assertEqual(draft["config"], first["config"])
        answer, same = self.image(changes=[{"path": "voxelize.resolution", "value": "many"}, {"path": "seed", "value": 8}])
        self.assertEqual([one["path"] for one in answer["refused"]], ["voxelize.resolution"])
        self.assertIn("voxelize.resolution", answer["refused"][0]["error"])
        self.assertEqual(answer["config"], {**first["config"], "seed": 8})
        answer, same = self.image(changes=[{"path": "seed", "value": 7}])
        self.assertEqual(answer["config"], first["config"])
        np.testing.assert_array_equal(pixels(same), pixels(png))
        self.assertIn("no variant", self.image(variant="nothing")[0]["error"])
        self.assertIn("'nowhere'", self.image(changes=[{"path": "scene", "value": {"builtin": "nowhere"}}])[0]["refused"][0]["error"])
        self.assertNotEqual(self.image(variant="resolution-16")[0]["config"], first["config"])

    def test_a_draft_costs_no_build(self):
        self.image()
        camera = {"path": "scene.camera", "value": {"position": [0, 1, 2], "target": [0, 1, 0], "fov_deg": 60}}
        for request in ({"shrink": 4}, {}, {"shrink": 4, "changes": [camera]}, {"changes": [camera]}):
            answer, _ = self.image(**request)
            self.assertEqual({one["id"] for one in answer["passes"] if one["reused"]}, {"voxelize", "inject"}, request)

    def test_a_view_takes_the_place_of_the_image(self):
        first, png = self.image()
        names = {one["name"] for one in first["views"]}
        self.assertIn("show_voxels", names)
        self.expect(0, "run", "look.yaml", "--only", "voxelize.resolution=8", "--out", "run", "--no-report", "--aovs")
        aovs = exr_pixels.read(self.path("run", "images", "resolution-8", "aovs.gbuffer.exr"))
        for request in ({}, {"shrink": 4}):
            answer, shown = self.image(show="gbuffer.N", **request)
            # What it does not need did not run
            self.assertEqual([one["id"] for one in answer["passes"]], ["gbuffer", "voxelize", "inject"])
            self.assertEqual({one["id"] for one in answer["passes"] if one["reused"]}, {"voxelize", "inject"})
            self.assertIn("direction", answer["legend"])
            if not request:
                normal = np.stack([aovs["N." + axis] for axis in "XYZ"], axis=-1)
                expected = np.where((normal == 0).all(-1, keepdims=True), 0, 0.5 * normal + 0.5)
                np.testing.assert_allclose(pixels(shown), 255 * expected, atol=0.51)
                self.assertEqual({one["name"] for one in answer["views"]}, names)
        answer, shown = self.image(show="gbuffer.Z")
        depth = aovs["Z"]
        np.testing.assert_allclose(answer["range"], np.percentile(depth[np.isfinite(depth)], [1, 99]), rtol=0.01)
        ids = pixels(self.image(show="gbuffer.id")[1])
        self.assertEqual(len(np.unique(ids.reshape(-1, 3), axis=0)), len(np.unique(aovs["id"])))
        answer, voxels = self.image(show="show_voxels", parameters={"show": "normal"})
        self.assertEqual([one["id"] for one in answer["passes"]], ["voxelize", "inject", "show_voxels"])
        self.assertGreater(pixels(voxels).mean(), 10)
        self.assertIn("no view 'nothing.x'", self.image(show="nothing.x")[0]["error"])
        self.assertIn("did you mean 'gbuffer.N", self.image(show="gbuffer.Ns")[0]["error"])
        self.assertIn("missing port 'radiance'", self.image(show="show_voxels", parameters={"show": "radiance"})[0]["error"])
        # The image is what it was, and nothing was built again
        answer, same = self.image()
        self.assertEqual({one["id"] for one in answer["passes"] if one["reused"]}, {"voxelize", "inject"})
        np.testing.assert_array_equal(pixels(same), pixels(png))

    def test_a_newer_request_takes_the_place_of_an_older_one(self):
        self.image()
        connections = []
        for request in ({"changes": [{"path": "inject.rays_per_light", "value": 1 << 22}]}, {}, {}):
            connections.append(self.begin(request))
            time.sleep(0.3)
        last, first = connections[2], connections[0]
        self.assertEqual(first.getresponse().status, 204)
        self.assertEqual(connections[1].getresponse().status, 204)
        # What it wanted is kept; whoever asks for another value has its image
        answer, _ = self.image(changes=[{"path": "inject.rays_per_light", "value": 4096}])
        self.assertNotIn("error", answer)
        self.assertIn(last.getresponse().status, (200, 204))

    def test_two_sides_keep_what_each_has_built(self):
        first, png = self.image()
        second, other = self.image(side=1, variant="resolution-16")
        self.assertEqual(second["config"], self.image(variant="resolution-16")[0]["config"])
        np.testing.assert_array_equal(pixels(self.image()[1]), pixels(other))
        self.image(variant="resolution-8")
        for request in ({"side": 1}, {}, {"side": 1, "shrink": 4}, {"shrink": 4}, {"side": 1}, {}):
            answer, shown = self.image(**request)
            self.assertEqual({one["id"] for one in answer["passes"] if one["reused"]}, {"voxelize", "inject"}, request)
            if "shrink" not in request:
                np.testing.assert_array_equal(pixels(shown), pixels(other if request else png))
        # One of another scene
        changes = [{"path": "scene", "value": {"builtin": "still_life"}}, {"path": "seed", "value": 9}]
        other = self.image(side=1, changes=changes)[1]
        for request in ({}, {"side": 1}, {}, {"side": 1}):
            answer, shown = self.image(**request)
            self.assertEqual({one["id"] for one in answer["passes"] if one["reused"]}, {"voxelize", "inject"}, request)
            np.testing.assert_array_equal(pixels(shown), pixels(other if request else png))
        self.assertEqual(self.image()[0]["config"], first["config"])
        self.assertEqual(self.image(side=1, config=first["config"])[0]["config"], first["config"])
        np.testing.assert_array_equal(pixels(self.image(side=1)[1]), pixels(png))
        self.assertEqual(self.image(side=1, close=True)[0], {})
        status, body = self.ask("POST", "image", '{"side": 1}')
        self.assertEqual(status, 400)
        self.assertIn(b"side 1 was closed", body)
        answer, shown = self.image(side=1, config=first["config"])
        self.assertEqual(answer["config"], first["config"])
        self.assertEqual([one["id"] for one in answer["passes"] if one["reused"]], [])
        self.assertIn("one variant", self.image(side=1, config={**first["config"], "sweep": {"seed": [1, 2]}})[0]["error"])

    def begin(self, request):
        """Asks for an image, and does not wait for it."""
        connection = http.client.HTTPConnection("127.0.0.1", int(self.port))
        self.addCleanup(connection.close)
        connection.request("POST", f"/{self.token}/image", json.dumps(request))
        return connection

    def end(self, connection):
        response = connection.getresponse()
        self.assertEqual(response.status, 200)
        return json.loads(response.read().partition(b"\n")[0])

    def test_sides_do_not_drop_one_another(self):
        for side in (0, 1):
            self.image(side=side, variant="resolution-8")
        slow = self.begin({"page": "a", "side": 1, "changes": [{"path": "inject.rays_per_light", "value": 1 << 20}]})
        time.sleep(0.3)
        # One after the other: the second would take the place of the first
        answers = [self.end(self.begin(request)) for request in ({"page": "a", "shrink": 4}, {"page": "a"})]
        answers.append(self.end(slow))
        self.assertEqual([answer["width"] for answer in answers], [16, 64, 64])

    def test_ends_with_an_interrupt(self):
        self.image()
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(20), 0)


class SceneFile(CommandTest):
    def test_a_scene_file_is_shown_with_a_camera_and_light_of_its_own(self):
        self.write("tiny.yaml", TINY)
        self.expect(0, "export-scene", "tiny.yaml", "room.glb")
        look = look_abuse.Look(PROGRAM, self.folder, scene="room.glb", options=["--set", "image.width=64", "--set", "image.height=36"])
        self.addCleanup(look.process.stderr.close)
        self.addCleanup(look.process.stdout.close)
        self.addCleanup(look.process.wait)
        self.addCleanup(look.process.kill)
        status, answer, png = look.image()
        self.assertEqual((status, answer.get("error")), (200, None))
        self.assertEqual(answer["config"]["name"], "room")
        self.assertGreater(pixels(png).mean(), 20)
        # What the page would download is a config for run
        self.write("room.yaml", json.dumps(answer["config"]))
        self.expect(0, "run", "room.yaml", "--out", "run", "--no-report", "--set", "reference=null", "--set", "measure.second_seed=false")
        [variant] = os.listdir(self.path("run", "images"))
        with Image.open(self.path("run", "images", variant, "final.png")) as image:
            np.testing.assert_array_equal(pixels(png), np.asarray(image.convert("RGB")))
        for name in ("room2.glb", "notes.txt"):
            self.assertIn(f"no file '{name}'", self.expect(2, "look", name).stderr)
        # Errors name the file that was opened, no line of a config that is in no file
        self.assertRegex(self.expect(2, "look", "room.glb", "--set", "graph=null").stderr, "^voxray: error: room.glb: 'graph' is missing")


@unittest.skipIf(browser.MISSING, browser.MISSING)
class Browsed(Look):
    """The page in a browser."""

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.browser.resize(1400, 900)
        self.browser.console()
        self.browser.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": self.folder})
        self.browser.driver.get(self.address)
        self.settle()

    def settle(self):
        settle(self.browser)

    def config(self):
        return self.browser.run("return window.look.config")

    def shown(self, canvas="image"):
        """Pixels of a canvas."""
        data = self.browser.run("""const canvas = document.getElementById(arguments[0]), copy = new OffscreenCanvas(canvas.width, canvas.height);
            const context = copy.getContext("2d", {willReadFrequently: true});
            context.drawImage(canvas, 0, 0);
            return [canvas.height, canvas.width, [...context.getImageData(0, 0, canvas.width, canvas.height).data]]""", canvas)
        return np.array(data[2], np.uint8).reshape(data[0], data[1], 4)[..., :3]

    def entry(self, name):
        return next(one for one in self.config()["graph"] if one.get("id", one["pass"]) == name)

    def error(self):
        return self.browser.run("const p = document.getElementById('error'); return p.hidden ? '' : p.textContent")

    def find(self, selector):
        return self.browser.driver.find_element(By.CSS_SELECTOR, selector)

    def press(self, *keys):
        ActionChains(self.browser.driver).send_keys(*keys).perform()

    def hold(self, key, seconds):
        ActionChains(self.browser.driver).key_down(key).pause(seconds).key_up(key).perform()

    def choose(self, name, text):
        Select(self.find(f"select[name={name}]")).select_by_visible_text(text)
        self.settle()

    def type(self, name, text):
        box = self.find(f"input[type=number][name='{name}']")
        box.send_keys(Keys.CONTROL + "a")
        box.send_keys(text + Keys.ENTER)
        self.settle()

    def swap_of(self, name):
        return Select(self.find(f"[data-id={name}] select"))

    def variant(self):
        return self.browser.run("return document.querySelector('select[name=variant]').selectedOptions[0].textContent")

    def download(self):
        """@return the name of the config that is downloaded"""
        before = os.listdir(self.folder)
        self.find("#download").click()
        while not (new := [name for name in os.listdir(self.folder) if name.endswith(".yaml") and name not in before]):
            time.sleep(0.05)
        return Path(new[0]).stem

    def downloaded_runs(self):
        """Downloads the config, runs it, and returns the image of the run's only variant."""
        name = self.download()
        self.assertNotIn("never run", self.expect(0, "validate", f"{name}.yaml").stderr)
        self.expect(0, "run", f"{name}.yaml", "--out", "run", "--no-report", "--set", "reference=null")
        [variant] = [name for name in os.listdir(self.path("run", "images")) if name != "reference"]
        with Image.open(self.path("run", "images", variant, "final.png")) as image:
            return np.asarray(image.convert("RGB"))


if __name__ == "__main__":
    unittest.main()
