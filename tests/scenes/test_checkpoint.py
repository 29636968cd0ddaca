#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of runs that are stopped and go on from their checkpoint: test_checkpoint.py PROGRAM."""
import csv
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from program import ROOT, ProgramTest

SCENES = ROOT / "tests/scenes"
VALIDATION = ROOT / "parameter_files/validation"
SAVED = ["--set", "Checkpoint/Interval=1000"]
SAVED_EACH_STEP = ["--set", "Checkpoint/Interval=0"]
BAR = SCENES / "pulled_bar.prm"
STEPS = ["--set", "Quasi-static/Load steps=60", "--set", "Output/Number of fields=0"]
TOLERANCE = 1e-10
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class StoppedRunTest(ProgramTest):
    def on_ranks(self, n_ranks, file, *options):
        start = ["mpirun", "-np", str(n_ranks), "--oversubscribe", "--bind-to", "none"] if n_ranks > 1 else []
        return [*start, *self.command(file, *options)]

    def run_on(self, n_ranks, file, *options):
        return subprocess.run(self.on_ranks(n_ranks, file, *options), capture_output=True, text=True, check=False,
                              env=ENVIRONMENT)

    def n_rows(self):
        statistics = self.path / "statistics.csv"
        return statistics.read_text().count("\n") - 1 if statistics.is_file() else 0

    def stop(self, stop, after_rows, n_ranks, file, *options):
        """Starts a run and sends it a signal as soon as it has so many rows; returns the process at its end."""
        process = subprocess.Popen(self.on_ranks(n_ranks, file, *options), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        while self.n_rows() < after_rows:
            self.assertIsNone(process.poll(), "the run has ended too early")
            time.sleep(0.002)
        ranks = [process.pid]
        if n_ranks > 1:
            children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text()
            ranks = [int(child) for child in children.split()]
        os.kill(ranks[0], stop)
        message = process.communicate(timeout=120)[1]
        self.assertNotEqual(process.returncode, 0)
        return message

    def statistics(self):
        with open(self.path / "statistics.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        return rows[0], [[float(value) for value in row] for row in rows[1:]]

    def fields(self):
        text = (self.path / "solution.pvd").read_text(encoding="utf-8")
        return [line for line in text.splitlines() if "DataSet" in line]

    def check_same(self, one, other, name):
        (heads, rows), (other_heads, other_rows) = one, other
        self.assertEqual(heads, other_heads, name)
        self.assertEqual(len(rows), len(other_rows), name)
        for column, head in enumerate(heads):
            scale = max(abs(row[column]) for row in rows)
            scale = max(scale, 1.) if head.endswith("[1]") else scale
            for row, other_row in zip(rows, other_rows):
                self.assertLessEqual(abs(row[column] - other_row[column]), TOLERANCE * scale,
                                     f"{name}: {head} at {row[0]}")

    def check_resumed(self, file, *options, n_ranks=1):
        """A run, and the same one stopped by a signal and resumed, must end alike."""
        whole = self.run_on(n_ranks, file, *options)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        statistics, summary = self.statistics(), self.summary()
        fields = self.fields()
        shutil.rmtree(self.path)
        message = self.stop(signal.SIGTERM, 2 * len(statistics[1]) // 3, n_ranks, file, *options, *SAVED)
        self.assertIn("--resume", message)
        self.assertEqual(self.summary()["status"], "interrupted")
        resumed = self.run_on(n_ranks, file, *options, *SAVED, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertIn("Resumed from", resumed.stdout)
        self.check_same(statistics, self.statistics(), file)
        self.assertEqual(self.fields(), fields)
        end = self.summary()
        self.assertEqual(end["status"], "ok")
        for section in ("energy", "momentum", "contact"):
            for key, value in summary.get(section, {}).items():
                if isinstance(value, float):
                    scale = max(abs(value), summary[section].get("largest", 0.), 1e-6)
                    self.assertLessEqual(abs(end[section][key] - value), TOLERANCE * scale, f"{section}/{key}")
        self.assertEqual(end["n_steps"], summary["n_steps"])
        self.assertGreater(end["run_time"]["total"], 0.)
        return summary


class ResumeTest(StoppedRunTest):
    def test_explicit_friction(self):
        self.check_resumed(VALIDATION / "incline.prm")

    def test_explicit_friction_with_implicit_contact(self):
        self.check_resumed(VALIDATION / "incline.prm", "--set", "Explicit/Contact stepping=implicit")

    def test_implicit_friction(self):
        self.check_resumed(SCENES / "implicit_slide.prm", "--set", "Implicit/Time step=0.001")

    def test_quasi_static_friction(self):
        self.check_resumed(VALIDATION / "friction_loop.prm", "--set", "Body bar/Mesh/Cells=50, 1")

    def test_plasticity(self):
        self.check_resumed(BAR, *STEPS)

    def test_explicit_plasticity(self):
        self.check_resumed(SCENES / "taylor_bar.prm")

    def test_adaptive_friction(self):
        self.check_resumed(SCENES / "adaptive_friction.prm", "--set", "Explicit/End time=0.1")

    def test_adaptive_equilibria(self):
        self.check_resumed(SCENES / "adaptive_ball.prm", "--set", "Quasi-static/Load steps=2",
                           "--set", "Adaptivity/Maximum cycles=2")

    def test_adaptive_plasticity(self):
        self.check_resumed(SCENES / "bent_beam.prm", "--set", "Quasi-static/Load steps=16")

    def test_adaptive_plasticity_in_motion(self):
        self.check_resumed(SCENES / "adaptive_taylor.prm", "--set", "Explicit/End time=1e-5", n_ranks=2)

    def test_two_ranks(self):
        self.check_resumed(VALIDATION / "incline.prm", "--set", "Explicit/End time=0.3", n_ranks=2)

    def test_adaptive_friction_on_two_ranks(self):
        self.check_resumed(SCENES / "adaptive_friction.prm", "--set", "Explicit/End time=0.04", n_ranks=2)

    def test_moving_obstacle(self):
        self.check_resumed(SCENES / "conveyor.prm")


class DamageTest(StoppedRunTest):
    """What is wrong with a checkpoint is said, and the one before is used."""

    def setUp(self):
        super().setUp()
        # Not killed, which may leave one of the two half written.
        self.stop(signal.SIGINT, 20, 1, BAR, *STEPS, *SAVED_EACH_STEP)
        newest = (self.path / "checkpoint/last").read_text()
        self.files = [self.path / "checkpoint" / slot / "rank_0" for slot in (newest, str(1 - int(newest)))]

    def resume(self, *options):
        return self.run_program(BAR, *STEPS, "--resume", *options)

    def damage(self, file):
        content = bytearray(file.read_bytes())
        content[len(content) // 2] ^= 1
        file.write_bytes(content)

    def check_end(self):
        _, rows = self.statistics()
        times = [row[0] for row in rows]
        self.assertEqual(len(times), 61)
        self.assertEqual(times, sorted(set(times)))

    def test_a_killed_run_goes_on(self):
        shutil.rmtree(self.path)
        self.stop(signal.SIGKILL, 20, 1, BAR, *STEPS, *SAVED_EACH_STEP)
        done = self.resume()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_end()
        self.assertEqual(self.summary()["warnings"], [])

    def test_a_flipped_bit_leads_to_the_one_before(self):
        self.damage(self.files[0])
        done = self.resume()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{self.files[0]} is damaged", done.stdout)
        self.assertIn(f"Resumed from {self.files[1].parent}", done.stdout)
        self.check_end()
        self.assertEqual(len(self.summary()["warnings"]), 1)

    def test_a_file_cut_in_half_leads_to_the_one_before(self):
        content = self.files[0].read_bytes()
        self.files[0].write_bytes(content[:len(content) // 2])
        done = self.resume()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{self.files[0]} has ", done.stdout)
        self.check_end()

    def test_two_damaged_ones_are_refused(self):
        for file in self.files:
            self.damage(file)
        rows = self.n_rows()
        done = self.resume()
        self.assertEqual(done.returncode, 3)
        self.assertIn("there is no good checkpoint", done.stderr)
        for file in self.files:
            self.assertIn(str(file), done.stderr)
        self.assertEqual(self.n_rows(), rows)

    def test_another_scene_is_refused(self):
        rows = self.n_rows()
        done = self.resume("--set", "Body bar/Material/Yield stress=2e4")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'Body bar/Material/Yield stress' is not what the run began with", done.stderr)
        self.assertIn("'2e4'", done.stderr)
        self.assertEqual(self.n_rows(), rows)

    def test_the_end_may_be_another(self):
        done = self.resume("--set", "Quasi-static/End time=2.5", "--set", "Output/Number of fields=1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.statistics()[1][-1][0], 2.5)
        self.assertIn("set End time", (self.path / "parameters.prm").read_text())

    def test_an_end_before_the_checkpoint_is_refused(self):
        rows = self.n_rows()
        done = self.resume("--set", "Quasi-static/End time=0.1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the end time lies before the checkpoint", done.stderr)
        self.assertEqual(self.n_rows(), rows)

    def test_another_number_of_ranks_is_refused(self):
        done = self.run_on(2, BAR, *STEPS, "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertIn("mpirun -np 1", done.stderr)

    def test_a_full_disk_loses_nothing(self):
        last = (self.path / "checkpoint/last").read_bytes()
        self.files[1].unlink()
        self.files[1].symlink_to("/dev/full")
        full = self.resume(*SAVED_EACH_STEP)
        self.assertEqual(full.returncode, 3, full.stderr)
        self.assertIn("cannot write the checkpoint: No space left on device", full.stderr)
        self.assertEqual((self.path / "checkpoint/last").read_bytes(), last)
        done = self.resume()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.summary()["warnings"], [])
        self.check_end()

    def test_a_new_run_forgets_the_old_one(self):
        self.assertEqual(self.run_program(BAR, *STEPS).returncode, 0)
        done = self.resume()
        self.assertEqual(done.returncode, 3)
        self.assertIn("there is no checkpoint to resume from", done.stderr)


class OtherMeshTest(StoppedRunTest):
    """A mesh file that has been changed meanwhile is not gone on with."""

    STRESS = ROOT / "parameter_files/stress"

    def setUp(self):
        super().setUp()
        self.mesh = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "wedge.msh"
        shutil.copy(self.STRESS / "meshes/wedge.msh", self.mesh)
        self.run_command = [self.STRESS / "points.prm", "--set", "Explicit/End time=0.2",
                            "--set", "Contact/Allow initial overlap=true", "--set", f"Body upper/Mesh/File={self.mesh}"]
        self.stop(signal.SIGINT, 20, 1, *self.run_command, *SAVED)

    def check_refused(self, found):
        rows = self.n_rows()
        done = self.run_program(*self.run_command, "--resume")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("the mesh is not that of the checkpoint", done.stderr)
        self.assertIn(found, done.stderr)
        self.assertEqual(self.n_rows(), rows)

    def test_the_same_goes_on(self):
        done = self.run_program(*self.run_command, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_node_moved(self):
        lines = self.mesh.read_text().splitlines()
        node = lines.index("$Nodes") + 5
        number, x, y, z = lines[node].split()
        lines[node] = f"{number} {float(x) + 1e-6!r} {y} {z}"
        self.mesh.write_text("\n".join(lines) + "\n")
        self.check_refused("1e-06 m")

    def test_another_mesh(self):
        shutil.copy(self.STRESS / "meshes/cracked.msh", self.mesh)
        self.check_refused("degrees of freedom")


if __name__ == "__main__":
    unittest.main()
