"""The packs of docs/packs: each is confirmed by this build, small, and listed with what made it."""
import os
import tomllib
import unittest

from support import SOURCE, CommandTest

PACKS = os.path.join(SOURCE, "docs", "packs")
MOST_BYTES = 200_000

with open(os.path.join(PACKS, "packs.toml"), "rb") as listed:
    NAMES = list(tomllib.load(listed))


class Packs(CommandTest):
    def test_each_is_small_and_listed(self):
        there = sorted(name for name in os.listdir(PACKS) if name.endswith(".zip"))
        self.assertEqual(there, sorted(f"{name}.zip" for name in NAMES))
        for name in there:
            self.assertLess(os.path.getsize(os.path.join(PACKS, name)), MOST_BYTES, name)

    def check(self, name):
        print(self.expect(0, "verify", os.path.join(PACKS, f"{name}.zip"), "--quiet").stdout)


for pack in NAMES:
    setattr(Packs, f"test_{pack}", lambda self, name=pack: self.check(name))

if __name__ == "__main__":
    unittest.main()
