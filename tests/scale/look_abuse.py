#!/usr/bin/python3
"""Sends malformed requests to `voxray look`: mutations of right ones, in their JSON and in their HTTP.

look_abuse.py PROGRAM [REQUESTS] [SEED]: each has to be answered, a refusal with a word, unless it breaks off or is no HTTP of the
page, which may end the connection. Right requests stand between them. At the end the first variant has to look as it did at first, to the bit. Prints
how many requests had which answer, and the memory and open files of the program; exit status 1 where something is wrong.
"""
import http.client
import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

CONFIG = {"name": "abuse", "scene": {"builtin": "cornell"}, "image": {"width": 32, "height": 24}, "seed": 7,
          "graph": [{"pass": "gbuffer"}, {"pass": "voxelize", "resolution": 12},
                    {"pass": "inject_light_rays", "id": "inject", "rays_per_light": 1024}, {"pass": "direct_shadow_rays"},
                    {"pass": "gather_irradiance"}, {"pass": "composite"}],
          "sweep": {"voxelize.resolution": [12, 8]}}
BODIES = ({"shrink": 4}, {"shrink": 4, "changes": [{"path": "scene.camera", "value": {"position": [0, 1, 2], "target": [0, 1, 0], "fov_deg": 60}}]},
          {"page": "a", "shrink": 2, "changes": [{"path": "seed", "value": 8}, {"path": "image.exposure_stops", "value": 1}]},
          {"shrink": 4, "variant": "resolution-8"}, {"shrink": 3, "changes": [{"path": "voxelize.resolution", "value": 9}]})
ODD_VALUES = (None, True, -1, 0, 65, 1e308, -2**63, 2**64, "", "x", "\0", "../..", [], {}, [[[]]], {"a": {"b": 1}}, "\ud83d\ude00", [1] * 1000)
METHODS = ("GET", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD", "TRACE", "CONNECT", "get", "P\0ST", "", "X" * 500)
SECONDS = 20  # until an answer is missed
# What right requests leave behind: caches that fill once, and the allocator's free lists
GREW = 1.05


class Look:
    """A program that serves a page."""

    def __init__(self, program, folder, scene="", options=(), cwd=None):
        """@param scene a file in the folder, in place of CONFIG @param cwd where the program is started"""
        file = Path(folder) / (scene or "abuse.json")
        if not scene:
            file.write_text(json.dumps(CONFIG), encoding="utf-8")
        self.process = subprocess.Popen([program, "look", str(file), "--validate", *options], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/(\w+)/", self.address).groups()
        self.port = int(port)

    def image(self, **request):
        """Status, and the answer's map and PNG, or its text."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10 * SECONDS)
        connection.request("POST", f"/{self.token}/image", json.dumps(request))
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        if answer.status != 200:
            return answer.status, body.decode(), b""
        line, _, png = body.partition(b"\n")
        return 200, json.loads(line), png

    def send(self, data, breaks_off):
        """Status and body, or None where the connection ends. @param breaks_off whether data lacks its end"""
        with socket.create_connection(("127.0.0.1", self.port), SECONDS) as raw:
            try:
                raw.sendall(data)
                if breaks_off:
                    raw.shutdown(socket.SHUT_WR)
                return self._answer(raw)
            except (ConnectionResetError, BrokenPipeError):
                return None

    @staticmethod
    def _answer(raw):
        answer = http.client.HTTPResponse(raw)
        try:
            answer.begin()
            return answer.status, answer.read()
        except (http.client.HTTPException, ValueError):
            return None

    def resident(self):
        with open(f"/proc/{self.process.pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def open_files(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def end(self):
        """@return exit status, and what was said"""
        self.process.send_signal(signal.SIGINT)
        said = self.process.communicate(timeout=60)[1]
        return self.process.returncode, said


def odd_json(chance):
    """The body of a right request, with one thing wrong."""
    request = json.loads(json.dumps(chance.choice(BODIES)))
    kind = chance.randrange(6)
    if kind == 0:
        request[chance.choice([*request, "what", ""])] = chance.choice(ODD_VALUES)
    elif kind == 1:
        request["changes"] = [chance.choice([{"path": chance.choice(ODD_VALUES), "value": 1}, {"path": "seed"}, {"value": 1}, 1, None,
                                             {"path": "seed", "value": chance.choice(ODD_VALUES)}, {"path": "graph", "value": chance.choice(ODD_VALUES)}])]
    elif kind == 2:
        return b"[" * chance.randrange(1, 3000)
    text = bytearray(json.dumps(request).encode())
    for _ in range(chance.randrange(4) if kind > 2 else 0):
        at = chance.randrange(len(text))
        if chance.random() < 0.3:
            del text[at:at + chance.randrange(1, 9)]
        elif chance.random() < 0.5:
            text[at:at] = chance.choice([b"{", b"}", b"\"", b"\xff", b"\0", b": ", b"&a", b"*a", b"<<: ", b"- "])
        else:
            text[at] = chance.randrange(256)
        text = text or bytearray(b"x")
    return bytes(text)


def odd_request(chance, look):
    """Bytes of a request with something wrong, whether it breaks off before its end, and whether it is HTTP of the page."""
    kind, body = chance.randrange(10), odd_json(chance)
    method, path, version = "POST", f"/{look.token}/image", "HTTP/1.1"
    headers = {"Host": f"127.0.0.1:{look.port}", "Content-Length": str(len(body)), "Connection": "close"}
    breaks_off, is_known = False, kind not in (3, 6, 7, 8, 9)
    if kind == 3:
        headers["Content-Length"] = chance.choice(["", "-1", "x", str(len(body) + chance.randrange(1, 100)), str(2**64), "1e3", str(1 << 40)])
        breaks_off = True
    elif kind == 4:
        headers[chance.choice(["Host", "Origin"])] = chance.choice(["evil.example", "", "null", f"localhost:{look.port}.evil", "127.0.0.1", "\x01"])
    elif kind == 5:
        path = chance.choice(["/image", "/" + look.token, f"/{look.token[:-1]}0/image", f"/{look.token}/../image", f"/{look.token}/%2e%2e/image", "",
                              f"/{look.token}/" + "x" * chance.choice([10, 9000, 70000]), f"/{look.token}/image?{'a=b&' * 3000}", "*", "http://x/"])
    elif kind == 6:
        method = chance.choice(METHODS)
    elif kind == 7:
        headers |= {f"X-{i}": "y" * chance.choice([1, 9000]) for i in range(chance.choice([1, 90, 300]))}
    elif kind == 8:
        version = chance.choice(["HTTP/0.9", "HTTP/9", "", "HTTP/1.1 x"])
    start = f"{method} {path} {version}\r\n" + "".join(f"{name}: {value}\r\n" for name, value in headers.items())
    data = start.encode() + b"\r\n" + body
    if kind == 9:
        breaks_off = True
        data = data[:chance.randrange(len(data))] if chance.random() < 0.5 else chance.randbytes(chance.randrange(1, 400)) + b"\r\n\r\n"
    return data, breaks_off, is_known


def run(program, count, seed, folder):
    """@return what is wrong, a line each; how many requests had which status; memory and files after a tenth and at the end"""
    chance, wrong, answers, use = random.Random(seed), [], Counter(), []
    look = Look(program, folder)
    try:
        _, first, picture = look.image(variant="resolution-12")
        for number in range(1, count + 1):
            data, breaks_off, is_known = odd_request(chance, look)
            answer = look.send(data, breaks_off)
            answers[answer[0] if answer else None] += 1
            if answer is None and is_known:
                wrong.append(f"no answer to {data[:300]!r}")
            elif answer and (answer[0] >= 500 or (answer[0] >= 300 and not answer[1].strip() and not data.startswith(b"HEAD"))):
                wrong.append(f"{answer[0]} {answer[1][:100]!r} to {data[:300]!r}")
            if number % 50 == 0:
                status, said, _ = look.image(shrink=4)
                if status != 200 or "error" in said:
                    wrong.append(f"after {number} requests a right one is answered by {status} {said}")
                    break
            if number in (max(1, count // 10), count):
                use.append((look.resident(), look.open_files()))
        _, last, same = look.image(variant="resolution-12")
        if last["config"] != first["config"] or same != picture:
            wrong.append("the first variant has changed")
        status, said = look.end()
        if status != 0 or not re.fullmatch(r"voxray: stopping;.*", said.strip()):
            wrong.append(f"it ends with status {status}: {said}")
    finally:
        look.process.kill()
        look.process.wait()
    return wrong, answers, use


def main():
    program, count, seed = sys.argv[1], *(int(word) for word in (*sys.argv[2:], *("10000", "1")[len(sys.argv) - 2:]))
    with tempfile.TemporaryDirectory() as folder:
        wrong, answers, use = run(program, count, seed, folder)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    said = ", ".join(f"{number} with {status or 'none'}" for status, number in sorted(answers.items(), key=str))
    (before, files), (after, now) = use[0], use[-1]
    print(f"{count} requests, answers: {said}; resident memory {before / 2**20:.1f} MiB after a tenth, {after / 2**20:.1f} at the end; "
          f"{files} and {now} open files")
    return 1 if wrong or after > GREW * before or now > files + 2 else 0


if __name__ == "__main__":
    sys.exit(main())
