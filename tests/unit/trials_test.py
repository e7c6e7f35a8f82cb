"""The search of `voxray tune` on costs made by hand, its targets and values."""
import itertools
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "framework"))
from orchestration import sweep  # noqa: E402
from orchestration.errors import UsageError, did_you_mean, one_line  # noqa: E402
from orchestration.trials import Target  # noqa: E402
from orchestration.tune import values_of  # noqa: E402
from orchestration.search import Model, Outcome, Search, variants_of  # noqa: E402

COLUMNS = ("flip", "ssim", "psnr_db", "mean_ratio", "indirect_relmse", "indirect_mean_ratio")
RAYS, SIZES, LEVELS = [4, 8, 16, 32, 64, 128, 256], [16, 32, 64, 128], [1, 2, 3, 4]


def space_of(methods, rays=RAYS, sizes=SIZES, levels=LEVELS):
    values = [methods, [str(v) for v in rays], [str(v) for v in sizes], [str(v) for v in levels]]
    return {"axes": ["method", "rays", "size", "levels"], "swaps": [True, False, False, False],
            "variants": [{"name": "_".join(v), "values": list(v)} for v in itertools.product(*values)]}


class Made:
    """Errors that sum up noise and bias, costs of a build and a frame: a small trial has a 16th of the frame's cost, and an
    error that is off by a factor of its own."""

    def __init__(self, target, build=20.0, off=1.3):
        self.target, self.build, self.off, self.trials = target, build, off, []

    def truth(self, name):
        method, rays, size, levels = name.split("_")
        rays, size, levels = int(rays), int(size), int(levels)
        noise = {"plain": 2.0, "smart": 0.7}[method] / rays / levels ** 0.5
        error = noise + 6.0 / size ** 2 + 0.002 * levels
        build, frame = self.build * size / 16, rays * (1 + 0.1 * levels) * {"plain": 1.0, "smart": 1.6}[method]
        return error / self.target, build, frame

    def __call__(self, names, is_small):
        self.trials += [(name, is_small) for name in names]
        found = {}
        for name in names:
            excess, build, frame = self.truth(name)
            found[name] = (Outcome(excess * self.off, (build, frame), build + frame / 16) if is_small
                           else Outcome(excess, (build, frame), build + frame))
        return found

    def best(self, variants):
        met = [sum(self.truth(v.name)[1:]) for v in variants if self.truth(v.name)[0] <= 1]
        return min(met) if met else None


class Searching(unittest.TestCase):
    def search(self, target, methods=("plain", "smart"), **made):
        variants = variants_of(space_of(list(methods)))
        costs = Made(target, **made)
        search = Search(variants, costs, len(variants) / 5)
        search.run()
        return search, costs, variants

    def test_finds_nearly_the_cheapest_for_a_fifth_of_the_sweep(self):
        for target, build, off in itertools.product((0.4, 0.1, 0.05, 0.03, 0.02), (0.0, 1.0, 20.0), (0.7, 1.0, 1.3)):
            with self.subTest(target=target, build=build, off=off):
                search, costs, variants = self.search(target, build=build, off=off)
                best = search.best()
                self.assertLessEqual(search.full[best].excess, 1)
                self.assertLessEqual(search.full[best].cost, 1.15 * costs.best(variants))
                spent = sum(o.spent for rung in (search.small, search.full) for o in rung.values())
                self.assertLessEqual(spent, sum(sum(costs.truth(v.name)[1:]) for v in variants) / 5)

    def test_is_deterministic_and_runs_nothing_twice(self):
        first, again = self.search(0.05)[1].trials, self.search(0.05)[1].trials
        self.assertEqual(first, again)
        self.assertEqual(len(first), len(set(first)))

    def test_what_can_not_be_met_ends_within_the_budget_with_what_comes_close(self):
        search, costs, variants = self.search(1e-3)
        closest = min(costs.truth(v.name)[0] for v in variants)
        best = search.full[search.best()]
        self.assertGreater(best.excess, 1)
        self.assertLess(best.excess, 1.2 * closest)
        self.assertLessEqual(search.used(), len(variants) / 5)

    def test_variants_that_fail_are_passed_over(self):
        variants = variants_of(space_of(["plain", "smart"]))
        costs = Made(0.05)
        search = Search(variants, lambda names, small: {name: None if name.startswith("smart") else outcome
                                                        for name, outcome in costs(names, small).items()}, 40)
        search.run()
        self.assertTrue(search.best().startswith("plain"))
        nothing = Search(variants, lambda names, small: {name: None for name in names}, 40)
        nothing.run()
        self.assertIsNone(nothing.best())

    def test_without_small_trials_it_still_finds_one(self):
        variants = variants_of(space_of(["smart"]))
        costs = Made(0.05)
        search = Search(variants, costs, len(variants) / 5, has_small=False)
        search.run()
        self.assertFalse(any(is_small for _, is_small in costs.trials))
        self.assertLessEqual(search.full[search.best()].cost, 1.15 * costs.best(variants))

    def test_a_single_variant_is_its_own_choice(self):
        variants = variants_of(space_of(["smart"], [16], [64], [2]))
        search = Search(variants, Made(0.5), 1)
        search.run()
        self.assertEqual(search.best(), "smart_16_64_2")


class Places(unittest.TestCase):
    def test_values_stand_in_the_sweeps_order_and_idle_ones_at_the_center(self):
        space = {"axes": ["m", "a.rays"], "swaps": [True, False],
                 "variants": [{"name": "x", "values": ["A", "4"]}, {"name": "y", "values": ["A", "16"]},
                              {"name": "z", "values": ["A", "8"]}, {"name": "w", "values": ["B", "-"]}]}
        self.assertEqual([v.position for v in variants_of(space)], [(0.0,), (0.5,), (1.0,), (0.5,)])
        self.assertEqual([v.group for v in variants_of(space)], [("A",)] * 3 + [("B",)])

    def test_a_power_law_is_learnt_from_its_ends(self):
        model = Model([(0.0,), (0.5,), (1.0,)], [1.0, 8.0, 64.0])
        for at, value in zip((0.0, 0.25, 0.5, 0.75, 1.0), model([(0.0,), (0.25,), (0.5,), (0.75,), (1.0,)])):
            self.assertAlmostEqual(math.log(value), math.log(64) * at, delta=0.2)


class Targets(unittest.TestCase):
    def test_errors_fall_and_similarity_rises(self):
        self.assertAlmostEqual(Target.read("indirect_relmse=0.02", COLUMNS).excess(0.01), 0.5)
        self.assertAlmostEqual(Target.read("ssim=0.98", COLUMNS).excess(0.96), 2)
        self.assertAlmostEqual(Target.read("indirect_mean_ratio=1.01", COLUMNS).excess(0.98), 2)
        self.assertAlmostEqual(Target.read("psnr_db=40", COLUMNS).excess(60), 0.1)
        self.assertEqual(Target.read("flip=0.1", COLUMNS).excess(math.nan), math.inf)

    def test_what_no_image_can_meet_is_refused(self):
        for text in ("flip", "flip=", "flip=x", "flip=0", "ssim=1", "mean_ratio=1", "=3", "flip=nan", "flop=1"):
            with self.assertRaises(UsageError):
                Target.read(text, COLUMNS)

    def test_parameters_take_halves_and_doubles_within_their_range(self):
        count = {"type": "integer", "minimum": 4, "maximum": 64}
        self.assertEqual(values_of(count, 12, "a.n"), ["4", "6", "12", "24", "48", "64"])
        self.assertEqual(values_of({"type": "number"}, 0.1, "a.n"), ["0.0125", "0.025", "0.05", "0.1", "0.2", "0.4", "0.8"])
        self.assertEqual(values_of({"type": "boolean"}, True, "a.n"), ["false", "true"])
        self.assertEqual(values_of({"type": "integer", "enum": [5, 6, 16, 36]}, 16, "a.n"), ["5", "6", "16", "36"])
        many = [f"c{i}" for i in range(20)]
        self.assertEqual(values_of({"enum": many}, "c1", "a.n"), many[:5])
        for schema, own in (({"type": "string"}, "x"), ({"type": "number"}, 0)):
            with self.assertRaises(UsageError):
                values_of(schema, own, "a.n")


class Lock(unittest.TestCase):
    """Of `voxray sweep`."""

    def test_it_goes_on_in_the_program_that_takes_the_process_over(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / ".lock"
            line = ("import os, sys; from pathlib import Path; from orchestration import sweep;"
                    "os.set_inheritable(sweep.lock(Path(sys.argv[1]), Path('out')), True);"
                    "os.execvp('sh', ['sh', '-c', 'echo; exec sleep 60'])")
            with subprocess.Popen([sys.executable, "-c", line, str(path)], stdout=subprocess.PIPE,
                                  env={**os.environ, "PYTHONPATH": sys.path[0]}) as holder:
                self.assertEqual(holder.stdout.read(1), b"\n")
                with self.assertRaisesRegex(UsageError, f"^out: process {holder.pid} is writing results there"):
                    sweep.lock(path, Path("out"))
                holder.kill()
            os.close(sweep.lock(path, Path("out")))


class Words(unittest.TestCase):
    """As the C++ program has them (framework/base)."""

    def test_near_words(self):
        for word, names, said in (("nrms", ["flip", "nrmse"], "; did you mean 'nrmse'?"), ("ab", ["ba", "x"], "; did you mean 'ba'?"),
                                  ("rays", ["block", "rays_per_block"], "; did you mean 'rays_per_block'?"),
                                  ("pos", ["target", "position"], "; did you mean 'position'?"),
                                  ("zzz", ["a", "b"], "; one of: a, b"), ("a", [], "")):
            self.assertEqual(did_you_mean(word, names), said)

    def test_what_is_printed_is_one_line(self):
        self.assertEqual(one_line("a\nb\x1b[2J\udcff\u202e ü\n"), "a b\\x1b[2J\\xff\\xe2\\x80\\xae ü")


if __name__ == "__main__":
    unittest.main()
