"""The pages that Documentation/MakeTables.py writes, from rows that are made up and from the program's own."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT, PROGRAM = sys.argv[1:3]
MACHINE = {"processor": "P", "cores": 2, "caches": "C", "memory_gigabytes": 1.5, "system": "S", "compiler": "G",
           "vtk": "V", "load": 0.25}
HEAD = {"task": "friction", "command": "pointhaptics bench friction", "machine": MACHINE}
ROWS = [{"method": method, "shape": "plane", "speed_metres_per_second": 0.05, "mean_ratio": 0.3,
         "rms_error_percent": error, "max_error_percent": 2 * error, "peak": 0.35}
        for method, error in (("surface-fit", 0.0125), ("gradient-steps, tuned", 53.5))]
PAGE = """# Accuracy

| question | answer | section |
|---|---|---|
| Ratio of friction to normal force | RMS error at most 9 %; the paper's method 99 % | [Friction](#friction) |
| Another question | kept | [Other](#other) |

## Friction

<!-- bench friction ratio: begin -->
old
<!-- bench friction ratio: end -->

Text below.
"""


def output_of(command, text=""):
    return subprocess.run(command, input=text, text=True, capture_output=True, check=True).stdout


def run(rows, *options):
    return output_of([sys.executable, SCRIPT, *options], rows)


class MakeTables(unittest.TestCase):
    lines = "\n".join(json.dumps(line) for line in [HEAD] + [{"study": "ratio", **row} for row in ROWS] +
                      [{"study": "ratio", "remark": "one was left out"}])
    document = json.dumps({**HEAD, "ratio": {"rows": ROWS, "remarks": ["one was left out"]}}, indent=2)

    def test_prints_the_same_table_of_rows_and_of_a_document(self):
        text = run(self.lines)
        self.assertIn("surface-fit            plane          50       0.300       0.0125       0.0250  0.350", text)
        self.assertIn("one was left out", text)
        self.assertEqual(text, run(self.document))

    def test_replaces_table_and_summary_and_keeps_the_rest(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "Accuracy.md"
            file.write_text(PAGE)
            for _ in range(2):
                run(self.lines, "-o", folder)
                page = file.read_text()
                self.assertIn("| RMS error at most 0.0125 %; the paper's method 53.5 % | [Friction](#friction) |", page)
                self.assertIn("| Another question | kept | [Other](#other) |", page)
                self.assertIn("| surface-fit | plane | 50 | 0.300 | 0.0125 | 0.0250 | 0.350 |", page)
                self.assertIn("    pointhaptics bench friction\n", page)
                self.assertNotIn("old", page)
                self.assertEqual(page.count("begin -->"), 1)
                self.assertTrue(page.endswith("Text below.\n"))

    def test_understands_what_the_program_prints(self):
        text = run(output_of([PROGRAM, "bench", "friction", "--quick"]))
        self.assertEqual(text.count("surface-fit"), 2)
        self.assertIn("pointhaptics bench friction --quick\nMeasured on: ", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
