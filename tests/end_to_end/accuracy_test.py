# A small sweep of the Cornell box with the real client and server: interrupted, resumed, and its
# figures checked. FARLIGHT names the client; FARLIGHT_REPORT the folder, which tests of the page use.
import csv
import json
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLIENT = os.environ["FARLIGHT"]
OUT = pathlib.Path(os.environ["FARLIGHT_REPORT"])
COMMAND = [CLIENT, "accuracy", "--device", "software", "--scene", ROOT / "scenes/cornell_box.json", "--grid", "tiny",
           "--size", "128x72", "--seeds", "10", "--reference-samples", "1024", "--out", OUT]
PATIENCE = 600  # seconds; a slow machine is no failure


def measurements():
    journal = OUT / "measured.jsonl"
    return journal.read_text().count("\n") - 1 if journal.exists() else 0


class Accuracy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUT, ignore_errors=True)
        cls.interrupted = cls.run_until(3)
        cls.kept = measurements()
        cls.resumed = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE, check=False)
        if cls.resumed.returncode not in (0, 1):
            raise AssertionError(cls.resumed.stderr)
        cls.report = json.loads((OUT / "accuracy.json").read_text())

    @staticmethod
    def run_until(count):
        """Starts a sweep and interrupts it after `count` measurements; its exit status and what it said."""
        with subprocess.Popen(COMMAND, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as sweep:
            until = time.monotonic() + PATIENCE
            while measurements() < count and sweep.poll() is None and time.monotonic() < until:
                time.sleep(0.02)
            sweep.send_signal(signal.SIGINT)
            said = sweep.communicate(timeout=PATIENCE)[1]
            return sweep.returncode, said

    def test_interrupting_keeps_what_is_done(self):
        status, said = self.interrupted
        self.assertEqual(status, 1, said)
        self.assertIn("goes on from here", said)
        self.assertGreaterEqual(self.kept, 3)
        self.assertIn(f"going on: {self.kept} measurements are done", self.resumed.stderr)

    def test_no_picture_of_averaged_frames_is_left(self):
        self.assertEqual(len(self.report["averaging"]["points"]), 3)
        self.assertFalse((OUT / "averaged").exists())

    def test_plain_path_tracing_has_slope_minus_one(self):
        # The mean over seeds is known to about 2.3 %, the slope over 1 to 16 samples then to 0.012:
        # another driver's numbers fail this by chance in less than one of 10,000 cases.
        self.assertAlmostEqual(self.report["slope"]["mse"], -1, delta=0.05)
        self.assertAlmostEqual(self.report["slope"]["relmse"], -1, delta=0.05)

    def test_raw_samples_have_no_bias_and_a_filter_has(self):
        points = {point["label"]: point for point in self.report["points"]}
        raw, filtered = points["none, 1 sample"], points["svgf, 1 sample"]
        self.assertLess(abs(raw["bias"]), 0.05 * raw["relmse"])  # noise of 45 pairs of seeds: about 1 %
        self.assertGreater(filtered["bias_lower"], 0)
        self.assertLess(filtered["relmse"], 0.5 * raw["relmse"])
        for point in points.values():
            self.assertAlmostEqual(point["bias"] + point["variance"], point["relmse"], delta=1e-9 + 1e-6 * point["relmse"])

    def test_the_frontier_holds_no_dominated_point(self):
        points = self.report["frontier"]["points"]
        self.assertGreaterEqual(len(points), 2)
        for cheaper, dearer in zip(points, points[1:]):
            self.assertLess(cheaper["ms"], dearer["ms"])
            self.assertGreater(cheaper["relmse"], dearer["relmse"])

    def test_pass_times_add_up_to_the_whole_frame(self):
        # Both clocks run in the same frames, so the machine's load is in both; half of the points may be off.
        check = self.report["timing_check"]
        self.assertEqual(check["points"], len(self.report["points"]))
        off = [abs(point["ms"] / point["whole_ms"] - 1) for point in self.report["points"]]
        self.assertLessEqual(statistics.median(off), check["tolerance"], off)
        self.assertAlmostEqual(max(off), check["worst"], places=9)
        self.assertEqual(self.resumed.returncode, 1 if check["failed"] else 0, self.resumed.stderr)

    def test_the_step_response_falls(self):
        response = {row["label"]: row["errors"] for row in self.report["response"]["points"]}
        self.assertLess(response["svgf, 1 sample"][-1], 0.5 * response["svgf, 1 sample"][0])

    def test_a_picture_that_remembers_is_behind_lamps_that_move(self):
        motion = self.report["motion"]
        moving = motion["frames"]
        errors = {row["label"]: row["errors"] for row in motion["points"]}["svgf, 1 sample"]
        self.assertGreater(errors[moving - 1], 1.5 * errors[0])  # measured 3 times; behind by more with each frame
        self.assertLess(errors[-1], errors[moving - 1])
        raw = {row["label"]: row for row in motion["points"]}["none, 1 sample"]
        self.assertEqual(raw["lag"], 0)

    def test_a_line_of_the_table_for_each_point(self):
        with open(OUT / "accuracy.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["label"] for row in rows], [point["label"] for point in self.report["points"]])
        self.assertAlmostEqual(float(rows[0]["relmse"]), self.report["points"][0]["relmse"], places=12)

    def test_the_price_list_is_printed(self):
        self.assertIn("| to halve the error |", self.resumed.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
