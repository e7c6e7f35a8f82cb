#!/usr/bin/python3
"""Checks of the repository find what they are for: each rule against a tree that breaks it, and one that does not."""
import graphlib
import json
import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from datetime import datetime
from pathlib import Path

import commands
import docs
import hygiene
import layers
import paper_tables
import skips


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name

    def write(self, path, text, executable=False):
        whole = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(whole), exist_ok=True)
        with open(whole, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(whole, 0o755 if executable else 0o644)


class Layers(Tree):
    def setUp(self):
        super().setUp()
        for path in ("framework/base/error.h", "framework/vulkan/device.h", "framework/image/image.h",
                     "framework/scene/scene.h", "framework/trace/ray.h", "framework/graph/pass.h",
                     "framework/experiment/runner.h", "framework/app/commands.h", "passes/common/families.h",
                     "framework/config/yaml.h", "passes/surfels/surfels.h", "passes/surfels/surfels.glsl",
                     "passes/view/one/one.h", "passes/view/one/one.comp", "passes/view/two/two.h",
                     "passes/view/two/two.glsl", "passes/view/shared.h", "passes/novel_family/three.h",
                     "passes/common/compute/scan.h", "passes/common/voxels/voxels.h", "passes/common/octree/octree.h",
                     "passes/common/stray.h", "passes/common/novel/novel.h", "shaders/shared/types.h",
                     "shaders/scene/scene.glsl", "shaders/compute/scan.glsl", "shaders/voxels/grid.glsl",
                     "shaders/octree/node.glsl", "tests/unit/helper.h"):
            self.write(path, "#pragma once\n")
        for name in ("one", "two"):
            self.write(f"passes/view/{name}/{name}.cpp", "VOXRAY_REGISTER_PASS(Pass);\n")

    def problems(self, path, include):
        self.write(path, f"// A comment.\n#include {include}\n")
        problems = layers.check(self.root)
        os.remove(os.path.join(self.root, path))
        return problems

    def refused(self, *includes):
        for path, include in includes:
            with self.subTest(path=path, include=include):
                problem, = self.problems(path, include)
                self.assertTrue(problem.startswith(path + ":2: "), problem)

    def allowed(self, *includes):
        for path, include in includes:
            self.assertEqual(self.problems(path, include), [])

    def test_layers(self):
        self.refused(("framework/base/x.cpp", '"vulkan/device.h"'), ("framework/vulkan/x.cpp", '"scene/scene.h"'),
                     ("framework/scene/x.cpp", '"../trace/ray.h"'), ("framework/trace/x.cpp", '"graph/pass.h"'),
                     ("framework/graph/x.cpp", '"experiment/runner.h"'), ("framework/novel/x.cpp", '"base/error.h"'),
                     ("framework/experiment/x.cpp", '"app/commands.h"'))
        self.allowed(("framework/scene/x.cpp", '"image/image.h"'), ("framework/trace/x.cpp", '"shaders/shared/types.h"'),
                     ("framework/app/x.cpp", '"experiment/runner.h"'))

    def test_passes(self):
        self.refused(("framework/experiment/x.cpp", '"passes/common/families.h"'),
                     ("framework/graph/x.cpp", '"passes/common/voxels/voxels.h"'),
                     ("passes/view/one/x.cpp", '"passes/view/two/two.h"'), ("passes/view/one/x.cpp", '"../two/two.h"'),
                     ("passes/view/one/x.comp", '"passes/view/two/two.glsl"'),
                     ("passes/view/one/x.cpp", '"experiment/runner.h"'),
                     ("passes/view/one/x.cpp", '"tests/unit/helper.h"'),
                     ("passes/common/voxels/x.cpp", '"passes/view/shared.h"'),
                     ("shaders/x.glsl", '"passes/view/two/two.glsl"'))
        self.allowed(("passes/view/one/x.cpp", '"passes/common/voxels/voxels.h"'), ("passes/view/one/x.cpp", '"one.h"'),
                     ("passes/common/families.cpp", '"passes/view/shared.h"'),
                     ("framework/app/x.cpp", '"passes/common/families.h"'))

    def test_families(self):
        self.allowed(("passes/view/one/x.cpp", '"passes/view/shared.h"'),
                     ("passes/view/one/x.cpp", '"passes/surfels/surfels.h"'),
                     ("passes/clusters/x.comp", '"passes/surfels/surfels.glsl"'))
        self.refused(("passes/surfels/x.cpp", '"passes/view/shared.h"'),
                     ("passes/view/shared.cpp", '"passes/view/one/one.h"'),
                     ("passes/novel_family/x.cpp", '"passes/common/voxels/voxels.h"'))

    def test_shaders_that_are_compiled(self):
        self.write("passes/view/two/two.comp", "// A comment.\n")
        for path, shader, is_allowed in (("passes/view/one/x.cpp", "passes/view/one/one.comp", True),
                                         ("passes/view/one/x.cpp", "one.comp", True),
                                         ("passes/view/one/x.cpp", "passes/view/two/two.comp", False),
                                         ("passes/view/one/x.cpp", "../two/two.comp", False),
                                         ("passes/view/one/x.cpp", "docs/examples/tint/tint.comp", False)):
            self.write(path, f'    Kernel kernel_{{*this, "{shader}"}};\n')
            self.assertEqual(layers.check(self.root) == [], is_allowed, shader)

    def test_modules(self):
        """Upwards, in circles, what is in no module, and GLSL."""
        self.refused(("passes/common/voxels/x.cpp", '"passes/common/octree/octree.h"'),
                     ("passes/common/x.cpp", '"passes/common/voxels/voxels.h"'),
                     ("passes/view/one/x.cpp", '"passes/common/stray.h"'),
                     ("passes/view/one/x.cpp", '"passes/common/novel/novel.h"'),
                     ("shaders/voxels/x.glsl", '"shaders/octree/node.glsl"'),
                     ("shaders/scene/x.glsl", '"shaders/voxels/grid.glsl"'),
                     ("shaders/novel/x.glsl", '"shaders/voxels/grid.glsl"'),
                     ("shaders/octree/x.glsl", '"passes/common/octree/octree.h"'),
                     ("passes/common/voxels/x.comp", '"shaders/octree/node.glsl"'))
        self.allowed(("passes/common/octree/x.cpp", '"passes/common/voxels/voxels.h"'),
                     ("passes/common/octree/x.cpp", '"octree.h"'), ("passes/common/octree/x.cpp", '"graph/pass.h"'),
                     ("shaders/octree/x.glsl", '"shaders/voxels/grid.glsl"'),
                     ("shaders/voxels/x.glsl", '"shaders/scene/scene.glsl"'),
                     ("passes/view/one/x.comp", '"shaders/octree/node.glsl"'))

    def test_no_circles(self):
        graphlib.TopologicalSorter(layers.LAYERS).prepare()
        graphlib.TopologicalSorter(layers.MODULES).prepare()
        graphlib.TopologicalSorter(layers.FAMILIES).prepare()

    def test_third_party(self):
        self.refused(("framework/experiment/x.cpp", "<tiny_gltf.h>"), ("framework/trace/x.cpp", '"tiny_gltf.h"'),
                     ("tests/bench/x.cpp", "<embree4/rtcore.h>"), ("passes/view/one/x.cpp", "<vulkan/vulkan.h>"),
                     ("framework/image/x.cpp", "<gtest/gtest.h>"), ("framework/app/x.cpp", "<httplib.h>"))
        self.allowed(("framework/scene/x.cpp", "<tiny_gltf.h>"), ("framework/vulkan/x.cpp", "<vulkan/vulkan.h>"),
                     ("framework/trace/embree_api.h", "<embree4/rtcore.h>"))


class Hygiene(Tree):
    def problems(self):
        return hygiene.check(self.root)[0]

    def test_clean_tree(self):
        self.write("framework/base/x.cpp", "int x;\n" * hygiene.WANTED)
        self.write("scripts/x.sh", "#!/usr/bin/env bash\ntrue\n", executable=True)
        self.assertEqual(hygiene.check(self.root), ([], []))

    def test_length(self):
        self.write("framework/base/x.cpp", "int x;\n" * (hygiene.WANTED + 1))
        self.assertEqual(self.problems(), [])
        self.assertEqual(len(hygiene.check(self.root)[1]), 1)
        self.write("framework/base/x.cpp", "int x;\n" * (hygiene.MAX + 1))
        self.assertEqual(len(self.problems()), 1)

    def test_words(self):
        for text in ("// TO" "DO: later", "# FIX" "ME", "see deb.debian" ".org/x", "index: pypi" ".org", "cd /wo" "rk/main"):
            self.write("docs/x.md", "fine\n" + text + "\n")
            problems = self.problems()
            self.assertEqual(len(problems), 1, text)
            self.assertTrue(problems[0].startswith("docs/x.md:2: "), problems)

    def test_scripts(self):
        self.write("run", "#!/usr/bin/env bash\nif true; then\n", executable=True)
        self.assertEqual(len(self.problems()), 1)
        self.write("run", "#!/usr/bin/env bash\ntrue\n", executable=False)
        self.assertEqual(len(self.problems()), 1)


class Docs(Tree):
    def setUp(self):
        super().setUp()
        self.write("scripts/packages.txt", "# when | probe | Debian\nrun | command g++ 11 | g++ [debian 12] | gcc-c++ | gcc\n")
        self.write("docs/dependencies.md", "# Top\n| `g++` | compiles |\n")
        self.write("README.md", "[why](docs/dependencies.md#top) ![x](docs/dependencies.md)\n")

    def test_clean_tree(self):
        self.assertEqual(docs.check(self.root), [])

    def test_dead_link(self):
        self.write("docs/page.md", "See [this](nowhere.md).\n")
        self.assertEqual(len(docs.check(self.root)), 1)

    def test_link_to_a_heading(self):
        self.write("docs/page.md", "# One\n```\n# no heading\n```\n## `run` and [--resume](x), twice\n## One\n")
        for anchor, problems in (("one", 0), ("one-1", 0), ("run-and---resume-twice", 0), ("two", 1), ("no-heading", 1)):
            with self.subTest(anchor):
                self.write("docs/other.md", f"[a](page.md#{anchor})\n")
                self.assertEqual(len([p for p in docs.check(self.root) if p.startswith("docs/other.md")]), problems)
        self.write("docs/other.md", "# Here\n[a](#here) [b](#there)\n")
        self.assertEqual(len([p for p in docs.check(self.root) if "#there" in p]), 1)

    def test_pages_of_folders_are_read(self):
        self.write("docs/papers/page.md", "See [this](nowhere.md).\n")
        self.assertEqual(len(docs.check(self.root)), 1)

    def test_long_lines_of_text(self):
        wide = 121 * "x"
        self.write("docs/page.md", f"| {wide} |\n```\n{wide}\n```\n{wide[1:]}\n")
        self.assertEqual(docs.check(self.root), [])
        self.write("docs/page.md", f"fine\n{wide}\n")
        self.assertEqual(docs.check(self.root), ["docs/page.md:2: a line longer than 120 columns"])

    def test_tables_of_results(self):
        self.write("docs/papers/tables/x.toml", """[run.mirrors]
command = "run x.yaml"
values = {error = "nrmse", ms = "gather.frame.ms_median"}
[table.mirrors]
run = "mirrors"
heading = "mirror"
rows = {vct = "VCT", leaves = "leaves, *p* = 64"}
columns = {nRMSE = "{error:.2f}", "over VCT" = "{ms / of['vct']['ms']:.1f} times", paper = ["1", "-"]}
""")
        self.write("docs/papers/tables/mirrors.csv", "# abc; llvmpipe; run x.yaml\nvariant,error,ms\nleaves,0.125,30\nvct,1,20\n")
        table = ("| mirror | nRMSE | over VCT | paper |\n| --- | --- | --- | --- |\n| VCT | 1.00 | 1.0 times | 1 |\n"
                 "| leaves, *p* = 64 | 0.12 | 1.5 times | - |\n")
        page = "before\n\n<!-- table: mirrors -->\n{}\nafter\n"
        for shown, problem in ((table, None), (table.replace("0.12", "0.11"), "docs/papers/x.md: a table is not what"),
                               ("", "docs/papers/x.md: a table is not what")):
            self.write("docs/papers/x.md", page.format(shown))
            self.assertEqual([p.startswith(problem or "none") for p in docs.check(self.root)], [True] if problem else [])
        done = subprocess.run([sys.executable, paper_tables.__file__, "--root", self.root], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, "docs/papers/x.md\n"), done.stderr)
        self.assertEqual(docs.check(self.root), [])

        # What makes each table, from its definition, its results and the time that was kept
        self.write("docs/papers/x.md", "## A [mirror](y.md)\n" + page.format(table))
        self.write("docs/papers/y.md", "")
        self.write("docs/papers/tables/times.csv", "run,seconds\nmirrors,120\n")
        row = ("| [A mirror](papers/x.md#a-mirror), `mirrors` | `./voxray run x.yaml` | "
               "VCT: nRMSE 1.00, over VCT 1.0 times, paper 1; 1 more row | 2 min |\n")
        for shown, problems in ((row, 0), (row.replace("1.00", "1.01"), 1), (row.replace("2 min", "3 min"), 1)):
            self.write("docs/replicate.md", "<!-- table: replicate_x -->\n| table | command | comes out | time |\n"
                       "| --- | --- | --- | --- |\n" + shown)
            self.assertEqual(len(docs.check(self.root)), problems, docs.check(self.root))
        os.remove(os.path.join(self.root, "docs/replicate.md"))

        self.write("docs/papers/x.md", page.format(table) + "<!-- table: lights -->\n")
        self.assertEqual(docs.check(self.root), ["docs/papers/x.md: no table lights in docs/papers/tables"])
        self.write("docs/papers/x.md", "none\n")
        self.assertEqual(docs.check(self.root), ["tables that no page shows: mirrors"])
        self.write("docs/papers/x.md", page.format(table))
        self.write("docs/papers/tables/mirrors.csv", "#\nvariant,error,ms\nvct,1,20\n")
        self.assertEqual(docs.check(self.root), ["table mirrors: no variant leaves in the results of mirrors"])
        self.write("docs/papers/tables/mirrors.csv", "#\nvariant,error,ms\nleaves,0.125,\nvct,1,20\n")
        self.assertEqual(docs.check(self.root), ["table mirrors, leaves: name 'ms' is not defined"])

    def test_times_of_runs_are_kept(self):
        manifest = {"references": [{"cached": True, "seconds": 7}, {"cached": False, "seconds": 50}]}
        last = {"started": "2026-01-01T00:00:00Z", "variants": []}
        interrupted = {"started": "2025-12-31T23:00:00Z", "variants": ["v", "w"]}
        for number, variant in enumerate(interrupted["variants"]):  # Ready 10 s and 20 s after their session's start
            self.write(f"a/images/{variant}/result.json", "{}")
            ready = datetime.fromisoformat("2025-12-31T23:00:10+00:00").timestamp() + 10 * number
            os.utime(os.path.join(self.root, f"a/images/{variant}/result.json"), (ready, ready))
        finished = "2026-01-01T00:01:40Z"
        for sessions, end, kept in (([last], finished, {"a": 107.0}), ([interrupted, last], finished, {"a": 127.0}), ([last], "", {})):
            self.write("docs/papers/tables/times.csv", "run,seconds\n")
            self.write("a/manifest.json", json.dumps({**manifest, "sessions": sessions, "finished": end}))
            paper_tables.replicate_tables.keep_times(Path(self.root), {"a": Path(self.root) / "a"})
            self.assertEqual(paper_tables.replicate_tables.kept_times(Path(self.root)), kept)

    def test_what_stands_in_place_of_a_time(self):
        for name, device in (("a", "llvmpipe"), ("b", "llvmpipe"), ("gpu", "NVIDIA H200")):
            self.write(f"docs/papers/tables/{name}.csv", f"# 123; {device}; run x.yaml\n")
        time_of = paper_tables.replicate_tables.time_of
        for names, shown in ((["a"], "2 min"), (["a", "a"], "4 min"), (["a", "b"], "> 2 min"), (["a", "gpu"], "> 2 min"), (["b"], "-"),
                             (["gpu"], "GPU"), (["b", "gpu"], "-"), ([], "-")):
            self.assertEqual(time_of(Path(self.root), names, {"a": 120}), shown, names)

    def test_table_of_several_runs(self):
        self.write("docs/papers/tables/x.toml", """[run.mirrors]
command = "run x.yaml"
values = {ms = "gather.frame.ms_median"}
[run.octrees]
command = "bench octrees"
values = {bytes = "bytes"}
[table.verdicts]
columns = ["claim", "here"]
lines = [["faster", "{of['mirrors']['vct']['ms'] / of['mirrors']['leaves']['ms']:.1f} times"], ["smaller", "{of['octrees']['octrees/64']['bytes']:.0f}"]]
[table.times]
run = "mirrors"
heading = "mirror"
rows = {vct = "VCT"}
columns = {over = "{ms / of[variant.replace('vct', 'leaves')]['ms']:.1f}"}
""")
        self.write("docs/papers/tables/mirrors.csv", "#\nvariant,ms\nleaves,10\nvct,25\n")
        self.write("docs/papers/tables/octrees.csv", "#\nvariant,bytes\noctrees/64,7\n")
        times = "\n<!-- table: times -->\n| mirror | over |\n| --- | --- |\n| VCT | 2.5 |\n"
        page = "<!-- table: verdicts -->\n| claim | here |\n| --- | --- |\n| faster | 2.5 times |\n| smaller | 7 |\n" + times
        self.write("docs/papers/x.md", page)
        self.assertEqual(docs.check(self.root), [])
        self.write("docs/papers/tables/octrees.csv", "#\nvariant,bytes\noctrees/64,8\n")
        self.assertEqual(len(docs.check(self.root)), 1)
        self.write("docs/papers/tables/octrees.csv", "#\nvariant,bytes\noctrees/32,8\n")
        self.assertEqual(docs.check(self.root), ["table verdicts, smaller: 'octrees/64'"])

    def test_values_of_a_run(self):
        self.write("results.csv", "variant,status,nrmse,ssim@mirror\na,ok,0.5,\nb,failed,,\n")
        self.write("passes.csv", "variant,pass,phase,ms_median\na,gather,frame,3\na,gather,build,4\nb,gather,frame,5\n")
        self.write("values.csv", "variant,pass,name,frame,value\na,gather,hits,0,1\na,gather,hits,1,2\n")
        self.write("manifest.json", '{"references": [{"flip_noise": 0.25, "hash": "x", "variants": ["a", "b"]}]}')
        values = paper_tables.values_of(self.root)
        self.assertEqual(set(values), {"a"})
        self.assertEqual((values["a"]["flip_noise"], "hash" in values["a"]), ("0.25", False))
        self.assertNotIn("ssim@mirror", values["a"])
        self.assertEqual([values["a"][name] for name in ("nrmse", "gather.frame.ms_median", "gather.build.ms_median", "gather.hits")],
                         ["0.5", "3", "4", "1.5"])

    def measured(self, run):
        """Lines of the CSV of a run, but for the first; git knows no commit of the tree."""
        os.makedirs(os.path.join(self.root, "docs/papers/tables"), exist_ok=True)
        with unittest.mock.patch.object(paper_tables, "commit_of", return_value="abc"):
            paper_tables.measure(Path(self.root), "found", run, os.path.join(self.root, "program"))
        with open(os.path.join(self.root, "docs/papers/tables/found.csv"), encoding="utf-8") as file:
            return file.read().splitlines()[1:]

    def test_values_that_a_script_prints(self):
        self.write("program", "#!/bin/bash\nmkdir -p ${@: -1}; cd ${@: -1}; echo variant,pass,phase > passes.csv; echo '{}' > manifest.json\n"
                   "printf 'variant,status,device,nrmse\\na,ok,cpu,0.5\\nb,ok,cpu,\\n' > results.csv\n", executable=True)
        self.write("scripts/rank.py", "print('| variant | spp | time |\\n| --- | --- | --- |\\n| b | 4 | 2.0 |')\n")
        run = {"command": "run x.yaml", "script": os.path.join(self.root, "scripts/rank.py"), "values": {"error": "nrmse", "time": "rank.time"}}
        self.assertEqual(self.measured(run), ["variant,error,time", "a,0.5,", "b,,2.0"])

    def test_values_of_a_search(self):
        self.write("scripts/search.py", """import os, sys
out = sys.argv[-1]
for p in "84":
    os.makedirs(f"{out}/leaves.p-{p}")
    open(f"{out}/leaves.p-{p}/results.csv", "w").write(f"variant,status,device,nrmse\\nx,ok,cpu,0.{p}\\n")
    open(f"{out}/leaves.p-{p}/passes.csv", "w").write("variant,pass,phase\\n")
    open(f"{out}/leaves.p-{p}/manifest.json", "w").write("{}")
open(f"{out}/trail.csv", "w").write("leaves.p,excess,ms\\n8,0,3\\n4,0,2\\n")
""")
        self.assertEqual(self.measured({"command": "scripts/search.py x.yaml", "values": {"error": "nrmse"}}),
                         ["variant,error", "8,0.8", "4,0.4"])

    def test_values_of_benchmarks(self):
        run = {"command": "bench order/.*", "values": {"speed": "rays_s"}}
        with self.assertRaisesRegex(paper_tables.TableError, "no benchmark"):
            self.measured(run)
        self.write("build/release/bench_x", "#!/bin/bash\n[[ $* == *list_tests* ]] && echo one || echo '{\"context\": {\"num_cpus\": 2}, "
                   "\"benchmarks\": [{\"name\": \"order/1/iterations:1/process_time\", \"rays_s\": 3}]}'\n", executable=True)
        self.assertEqual(self.measured(run), ["variant,speed", "order/1,3"])

    def test_package_without_a_reason(self):
        self.write("docs/dependencies.md", "# Top\n| `gcc` | compiles |\n")
        self.assertEqual(len(docs.check(self.root)), 1)

    def test_quoted_file_that_changed(self):
        self.write("code.cpp", "int a;\n")
        self.write("docs/page.md", "<!-- file: code.cpp -->\n```cpp\nint a;\n```\n")
        self.assertEqual(docs.check(self.root), [])
        self.write("code.cpp", "int b;\n")
        self.assertEqual(len(docs.check(self.root)), 1)


class Commands(Tree):
    def setUp(self):
        super().setUp()
        self.write("configs/one.yaml", "name: one\n")
        self.write("tests/bench/x_bench.cpp", "BENCHMARK(gather)\n    ->Arg(1);\n"
                   "#define RAYS(scene, kind) \\\n    BENCHMARK_CAPTURE(trace, scene##_##kind##_closest, 1)\nRAYS(room, Embree);\n")
        self.write("tests/unit/x_test.cpp", "TEST(Voxels, AreFew) {}\nTEST_F(Rays, Hit) {}\n")
        self.write("scripts/bench_gpu.py", 'parser.add_argument("--device")\n')
        self.write("tests/all.cmake", "voxray_tests(chain SHARDS 2)\nadd_test(NAME repository.docs COMMAND x)\n")
        self.write("program", "#!/usr/bin/env bash\n[[ $1 == run && $2 == --help ]] && echo '  --set PATH=VALUE  --dry-run' && exit\n"
                   "[[ $1 == plan && $* == *good=1* ]] && exit\n[[ $1 == plan ]] && { echo 'bad key' >&2; exit 2; }\n"
                   "[[ $1 == passes && ( $2 == --help || $2 == gather ) ]]\n", executable=True)
        self.program = commands.Program(os.path.join(self.root, "program"))

    def problems(self, text):
        self.write("README.md", text + "\n")
        self.write("docs/page.md", "")
        return commands.check(self.root, self.program)

    def test_what_is_there(self):
        for text in ("run configs/one.yaml", "run CONFIG...", "bench gather", "bench 'gath|none'", "bench room_", "bench [FILTER]",
                     "bench gpu --device NAME",
                     "test Voxels", "test chain", "test 'repository\\.'", "test", "passes gather", "passes NAME", "run --dry-run",
                     "run configs/one.yaml --set good=1"):
            self.assertEqual(self.problems(f"| `./voxray {text}` |"), [], text)
            self.assertEqual(self.problems(f"```\n./voxray {text}  # Why.\n```"), [], text)
        self.assertEqual(self.problems("`configs/one.yaml`, `tests/unit/`, `ninja tests_chain`, `passes/<name>/`"), [])

    def test_what_is_not(self):
        for text in ("run configs/two.yaml", "bench stream", "bench gpu --fast", "test Cones", "passes gatherer", "dance", "run --fast",
                     "run configs/one.yaml --set bad=1"):
            self.assertEqual(len(self.problems(f"Run `./voxray {text}`.")), 1, text)
            self.assertEqual(len(self.problems(f"```\n./voxray {text}\n```")), 1, text)
        for text in ("`configs/two.yaml`", "`ninja tests_cones`", "`tests/unit/y_test.cpp`"):
            self.assertEqual(len(self.problems(text)), 1, text)


class Skips(Tree):
    def setUp(self):
        super().setUp()
        self.write("tests/unit/x_test.cpp", "TEST(Scenes, Large) {}\nTEST(Scenes, Small) {}\n")
        self.write("tests/allowed_skips.txt", "# Comment.\nScenes.Large | not part of the repository\n")

    def test_list(self):
        self.assertEqual(skips.check(self.root), [])
        self.write("tests/allowed_skips.txt", "Scenes.Gone | gone\nScenes.Large |\n")
        self.assertEqual(len(skips.check(self.root)), 2)

    def test_disabled_tests(self):
        self.write("tests/unit/x_test.cpp", "TEST(Scenes, Large) {}\nTEST(Scenes, DISABLED_Small) {}\n")
        self.assertEqual(len(skips.check(self.root)), 1)

    def run_of(self, output, more=""):
        self.write("run.xml", f'<testsuite><testcase name="scene.shard0" status="run">{more}'
                   f"<system-out>{output}</system-out></testcase></testsuite>")
        return skips.check_run(self.root, os.path.join(self.root, "run.xml"))

    def test_runs(self):
        self.assertEqual(self.run_of("all well"), ([], []))
        self.assertEqual(self.run_of("x\n[  SKIPPED ] Scenes.Large: no file\ny"), (["skipped Scenes.Large: no file"], []))
        self.assertEqual(len(self.run_of("[  SKIPPED ] Scenes.Small: no file\n")[1]), 1)
        self.assertEqual(len(self.run_of("test_a (x.Y.test_a) ... skipped 'no reason'")[1]), 1)
        self.assertEqual(len(self.run_of("not installed", '<skipped message="SKIP_RETURN_CODE=77"/>')[1]), 1)


if __name__ == "__main__":
    unittest.main()
