"""scripts/setup-debian.sh and doctor.sh on systems of all kinds: their /etc, /usr/include, apt-get and dpkg-query are
made by hand."""
import os
import re
import subprocess
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
SYSTEMS = {
    "debian 12": 'ID=debian\nVERSION_ID="12"\nPRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\n',
    "debian 13": 'ID=debian\nVERSION_ID="13"\nPRETTY_NAME="Debian GNU/Linux 13 (trixie)"\n',
    "debian 14": 'ID=debian\nVERSION_ID="14"\nPRETTY_NAME="Debian GNU/Linux 14 (forky)"\n',
    "made from debian": 'ID=linuxmint\nID_LIKE=debian\nVERSION_ID="6"\nPRETTY_NAME="LMDE 6 (faye)"\n',
    "ubuntu 24.04": 'ID=ubuntu\nID_LIKE=debian\nVERSION_ID="24.04"\nPRETTY_NAME="Ubuntu 24.04.3 LTS"\n',
    "made from ubuntu": 'ID=linuxmint\nID_LIKE="ubuntu debian"\nVERSION_ID="12"\nPRETTY_NAME="Linux Mint 22"\n',
    "fedora": 'ID=fedora\nVERSION_ID=42\nPRETTY_NAME="Fedora Linux 42"\n',
}
# `installed` has a line "NAME VERSION" for each package, the last one counts. What apt-get installs comes in the version
# of Mesa that the system or its backports have.
DPKG_QUERY = """\
declare -A versions
while read -r name version; do versions[$name]=$version; done < "$root/installed"
for name in "${@:4}"; do
  [ -n "${versions[$name]:-}" ] || continue
  case $3 in *Package*) echo "$name installed" ;; *) printf 'installed %s' "${versions[$name]}" ;; esac
done
"""
APT_GET = """\
if [ "$1" = indextargets ]; then
  case "$*" in *Backports*) ;; *) echo "bookworm mirror:/debian" ;; esac
  exit
fi
while [[ $1 = -* ]]; do case $1 in -o) shift 2 ;; *) shift ;; esac; done
echo "$*" >> "$root/asked"
version=$(cat "$root/mesa")
for word in "$@"; do
  case $word in
    bookworm-backports) version=25.0.4 ;;
    install|update|-*) ;;
    *) echo "$word $version" >> "$root/installed" ;;
  esac
done
"""


class System(unittest.TestCase):
    """A copy of scripts/ that takes a folder's etc and include for the machine's."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        for name in ("packages.txt", "setup-debian.sh", "doctor.sh"):
            with open(os.path.join(SCRIPTS, name), encoding="utf-8") as file:
                text = file.read()
            for place in ("/etc/", "/usr/include", "/usr/local/"):
                text = text.replace(place, self.root + place)
            self.write(f"scripts/{name}", text)

    def write(self, name, text):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


class Doctor(System):
    def test_either_embree_will_do(self):
        self.write("etc/os-release", SYSTEMS["fedora"])
        for version, found in (("", False), ("3", True), ("4", True)):
            with self.subTest(version):
                header = os.path.join(self.root, "usr", "include", f"embree{version}", "rtcore.h")
                if version:
                    self.write(f"usr/include/embree{version}/rtcore.h", "")
                done = subprocess.run(["bash", os.path.join(self.root, "scripts", "doctor.sh")], text=True, capture_output=True)
                self.assertEqual(done.returncode, 1, done.stderr)  # Other headers are missing in any case.
                self.assertIn("System: Fedora Linux 42", done.stdout)
                self.assertEqual(header in done.stdout, found, done.stdout)
                self.assertEqual(bool(re.search(r"^  libembree-dev +\| embree-devel +\| embree$", done.stdout, re.M)), not found)
                if version:
                    os.remove(header)


class SetUp(System):
    def setUp(self):
        super().setUp()
        os.makedirs(os.path.join(self.root, "etc/apt/sources.list.d"))
        self.write("installed", "")
        for name, script in (("dpkg-query", DPKG_QUERY), ("apt-get", APT_GET), ("id", "echo 0\n")):
            self.write(f"bin/{name}", f"#!/usr/bin/env bash\nroot={self.root}\n{script}")
            os.chmod(os.path.join(self.root, "bin", name), 0o755)

    def read(self, name):
        path = os.path.join(self.root, name)
        if not os.path.exists(path):
            return ""
        with open(path, encoding="utf-8") as file:
            return file.read()

    def run_on(self, system, purpose="test"):
        """Runs the script. @return its exit status, what it says, and apt-get's commands, in their order."""
        self.write("asked", "")
        self.write("etc/os-release", SYSTEMS[system])
        self.write("mesa", "25.0.7" if system == "debian 13" else "22.3.6")
        done = subprocess.run(["bash", os.path.join(self.root, "scripts", "setup-debian.sh"), purpose], text=True,
                              capture_output=True, env={"PATH": f"{self.root}/bin:/usr/bin:/bin"})
        return done.returncode, done.stderr, self.read("asked").splitlines()

    def names(self):
        return {line.split()[0] for line in self.read("installed").splitlines()}

    def check_nothing_is_left(self, system):
        self.assertEqual(self.run_on(system), (0, "", []))

    def test_debian_12_has_mesa_from_backports(self):
        status, said, asked = self.run_on("debian 12")
        self.assertEqual(status, 0, said)
        self.assertNotIn("not tried", said)
        self.assertEqual(self.read("etc/apt/sources.list.d/voxray-backports.sources").splitlines()[1:3],
                         ["URIs: mirror:/debian", "Suites: bookworm-backports"])
        self.assertEqual([line.split()[0] for line in asked], ["update", "update", "install", "install"])
        self.assertNotIn("mesa-vulkan-drivers", asked[2])
        self.assertEqual(asked[3], "install -y --no-install-recommends -t bookworm-backports mesa-vulkan-drivers")
        self.assertLessEqual({"g++", "clang-format-14", "clang-tidy-14", "chromium-driver", "python3-selenium"}, self.names())
        self.check_nothing_is_left("debian 12")

        # Debian 12's own Mesa is not enough
        self.write("installed", self.read("installed").replace("25.0.4", "22.3.6"))
        self.assertEqual(self.run_on("debian 12")[2][-1], asked[3])

    def test_debian_13_has_all_of_its_own(self):
        status, said, asked = self.run_on("debian 13")
        self.assertEqual(status, 0, said)
        self.assertNotIn("not tried", said)
        self.assertEqual([line.split()[0] for line in asked], ["update", "install"])
        self.assertEqual(self.read("etc/apt/sources.list.d/voxray-backports.sources"), "")
        self.assertLessEqual({"g++", "mesa-vulkan-drivers", "chromium-driver"}, self.names())
        self.assertEqual([name for name in self.names() if name.endswith("-14") or "[" in name], [])
        self.assertNotIn("Mesa", said)
        self.check_nothing_is_left("debian 13")

    def test_systems_made_from_these_are_tried(self):
        for system, has_chromium in (("debian 14", True), ("made from debian", True), ("ubuntu 24.04", False),
                                     ("made from ubuntu", False)):
            with self.subTest(system):
                self.write("installed", "")
                status, said, asked = self.run_on(system)
                self.assertEqual(status, 0, said)
                self.assertRegex(said, r"not tried on (Debian GNU/Linux 14|LMDE 6|Ubuntu 24\.04\.3|Linux Mint 22)")
                self.assertEqual([line.split()[0] for line in asked], ["update", "install"])
                self.assertLessEqual({"g++", "libembree-dev", "mesa-vulkan-drivers"}, self.names())
                self.assertEqual("chromium-driver" in self.names(), has_chromium)
                self.assertNotIn("clang-format-14", self.names())
                self.assertIn("Mesa is older than 25 here, so its lavapipe traces no rays: Embree does", said)
                self.check_nothing_is_left(system)

    def test_other_systems_are_told_the_way_out(self):
        status, said, asked = self.run_on("fedora")
        self.assertEqual((status, asked), (1, []))
        for words in ("Fedora Linux 42", "'./voxray doctor' lists", "VOXRAY_SKIP_SETUP=1"):
            self.assertIn(words, said)

    def test_each_purpose_has_its_packages(self):
        for purpose, has, lacks in (("build", "g++", "python3-numpy"), ("run", "python3-numpy", "snakemake"), ("sweep", "snakemake", "git"),
                                    ("test", "git", "slurmd"), ("slurm", "slurmd", "git")):
            with self.subTest(purpose):
                self.write("installed", "")
                self.assertEqual(self.run_on("debian 13", purpose)[0], 0)
                self.assertIn(has, self.names())
                self.assertNotIn(lacks, self.names())


if __name__ == "__main__":
    unittest.main()
