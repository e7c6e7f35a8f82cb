"""scripts/image_sheet.py on a run made up of images of one colour each: which stands where, and under which name."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

from PIL import Image
from report_support import ROOT, made_up

sys.path.insert(0, str(ROOT / "scripts"))
import image_sheet  # noqa: E402

SIZE = (80, 50)
COLORS = {"reference": (200, 0, 0), "a": (0, 200, 0), "b": (0, 0, 200)}


class Sheet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder, self.picture = Path(folder.name) / "run", Path(folder.name) / "sheet.png"
        rows = [made_up.variant("b", 10, 0.3, name="lookup"), made_up.failed("c", "no", name="rays"),
                made_up.variant("a", 10, 0.2, name="a name too long for one line below its image")]
        made_up.write_results(self.run_folder, rows, made_up.manifest([]), images=False)
        for folder, color in COLORS.items():
            path = self.run_folder / "images" / folder / "indirect.png"
            path.parent.mkdir(parents=True, exist_ok=True)
            Image.new("RGB", SIZE, color).save(path)

    def program(self, *arguments):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            return image_sheet.main([str(self.run_folder), str(self.picture), *arguments]), errors.getvalue()

    def test_the_reference_first_then_variants_in_the_order_of_the_table(self):
        self.assertEqual(self.program("--columns", "2"), (0, ""))
        with Image.open(self.picture) as picture:
            whole = picture.convert("RGB")
        self.assertEqual(whole.width, 2 * SIZE[0] + image_sheet.GAP)
        step = whole.height // 2
        self.assertGreater(step, SIZE[1] + 2 * image_sheet.LINE)  # The long name takes several lines
        places = {"reference": (0, 0), "b": (SIZE[0] + image_sheet.GAP, 0), "a": (0, step)}
        for name, (x, y) in places.items():
            for corner in ((x, y), (x + SIZE[0] - 1, y + SIZE[1] - 1)):
                self.assertEqual(whole.getpixel(corner), COLORS[name], name)
            below = whole.crop((x, y + SIZE[1], x + SIZE[0], y + step)).convert("L")
            self.assertLess(below.getextrema()[0], 100, f"{name} has no name below it")
        self.assertEqual(whole.crop((SIZE[0] + image_sheet.GAP, step, whole.width, whole.height)).getcolors(), [
            ((SIZE[0]) * (whole.height - step), (255, 255, 255))])

    def test_a_run_without_a_reference(self):
        made_up.write_results(self.run_folder, [made_up.variant("a", 10, 0.2)], {**made_up.manifest([]), "reference": None}, images=False)
        self.assertEqual(self.program(), (0, ""))
        with Image.open(self.picture) as picture:
            self.assertEqual(picture.width, SIZE[0])
            self.assertEqual(picture.convert("RGB").getpixel((0, 0)), COLORS["a"])

    def test_a_jpeg(self):
        self.picture = self.picture.with_suffix(".jpg")
        self.assertEqual(self.program(), (0, ""))
        with Image.open(self.picture) as picture:
            self.assertEqual((picture.format, picture.mode), ("JPEG", "RGB"))

    def test_a_missing_image_is_named(self):
        (self.run_folder / "images/a/indirect.png").unlink()
        status, error = self.program()
        self.assertEqual(status, 1)
        self.assertIn("no images/a/indirect.png", error)
        self.assertFalse(self.picture.exists())


if __name__ == "__main__":
    unittest.main()
