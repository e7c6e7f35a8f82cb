"""scripts/run_notebooks.py: the repository's notebooks, and ones that are wrong."""
import os
import subprocess
import sys
from pathlib import Path

import nbformat
from support import SOURCE, CommandTest

sys.path.append(os.path.join(SOURCE, "tests", "unit"))
import pareto_results  # noqa: E402

SCRIPT = os.path.join(SOURCE, "scripts", "run_notebooks.py")


class Notebooks(CommandTest):
    def run_notebooks(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *arguments], cwd=self.folder, env=self.environment, capture_output=True, text=True)

    def notebook(self, source, text):
        cell = nbformat.v4.new_code_cell(source, outputs=[nbformat.v4.new_output("stream", name="stdout", text=text)])
        nbformat.write(nbformat.v4.new_notebook(cells=[cell]), self.path("one.ipynb"))
        return self.run_notebooks("one.ipynb")

    def test_those_of_the_repository_show_what_they_store(self):
        done = self.run_notebooks()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_stale_outputs_and_cells_that_fail(self):
        for source, text, status in (("print('nRMSE', 0.100)", "nRMSE 0.104\n", 0), ("print('nRMSE', 0.100)", "nRMSE 0.110\n", 1),
                                     ("print('nRMSE', 0.100)", "relMSE 0.100\n", 1), ("print('nRMSE', 0.100)", "", 1), ("1 / 0", "", 1)):
            self.assertEqual(self.notebook(source, text).returncode, status, (source, text))
        self.assertIn("ZeroDivisionError", self.notebook("1 / 0", "").stdout)

    def test_charts_are_shown_after_one_another(self):
        pareto_results.write(Path(self.path("results")), ("cornell",), images=False)
        sources = (f"import sys\nsys.path.append({os.path.join(SOURCE, 'framework', 'python')!r})\nimport voxray\nresults = voxray.load('results')",
                   "results.pareto()", "results.variants.plot.scatter('frame_ms_median', 'nrmse')")
        nbformat.write(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources]), self.path("one.ipynb"))
        self.run_notebooks("one.ipynb", "--write")
        cells = nbformat.read(self.path("one.ipynb"), as_version=4).cells
        shown = [sum("image/png" in output.get("data", {}) for output in cell.outputs) for cell in cells]
        self.assertEqual(shown, [0, 1, 1], cells)

    def test_outputs_are_written(self):
        self.notebook("print(2)", "3\n")
        self.assertEqual(self.run_notebooks("one.ipynb", "--write").returncode, 0)
        self.assertEqual(self.run_notebooks("one.ipynb").returncode, 0)
