# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes every picture of a report as PNG in the output directory; what cannot be made is named with its reason."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy

TIME_LIMIT = 180  # seconds for the 3-D picture


def make_all(run):
    """Pairs (name, file) of the pictures made, and sentences on those left out."""
    figures, omissions = [], []
    try:
        from . import curves, study_curves
    except ImportError as error:
        return figures, [f"all plots and the picture of the scene: {error} (package python3-matplotlib)."]
    curves.use_style()
    if not run.is_study:
        scene, reason = make_scene(run, curves.plt)
        if scene:
            figures.append(("scene", scene))
        else:
            omissions.append(f"picture of the scene: {reason}")
    for name, draw in study_curves.ALL if run.is_study else curves.ALL:
        path = run.directory / f"report_{name}.png"
        path.unlink(missing_ok=True)
        try:
            figure = draw(run)
        except (ValueError, TypeError, AttributeError) as error:
            omissions.append(f"plot {name}: {error}")
            continue
        if figure is not None:
            figure.savefig(path)
            curves.plt.close(figure)
            figures.append((name, path))
    return figures, omissions


def make_scene(run, plt):
    """The file of the picture, or None and why there is none."""
    target = run.directory / "report_scene.png"
    target.unlink(missing_ok=True)
    if not (run.directory / "solution.pvd").is_file():
        return None, "the run wrote no solution.pvd."
    if not shutil.which("xvfb-run"):
        return None, "no xvfb-run to render off screen (packages xvfb, xauth, libgl1-mesa-dri)."
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        program = pathlib.Path(__file__).with_name("scene.py")
        command = ["xvfb-run", "-a", "-s", "-screen 0 1600x1200x24", "/usr/bin/python3", "-B", str(program),
                   str(run.directory), str(work)]
        environment = dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1")
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=TIME_LIMIT,
                                  env=environment, check=False)
        except subprocess.TimeoutExpired:
            return None, f"rendering took more than {TIME_LIMIT} s."
        if done.returncode != 0 or not (work / "picture.json").is_file():
            lines = (done.stderr or done.stdout).strip().splitlines()
            hint = " (package python3-vtk9)" if "No module named 'vtk" in done.stderr else ""
            return None, f"{lines[-1] if lines else 'VTK stopped without a message'}{hint}."
        compose(work, target, plt)
    return target, ""


def compose(work, target, plt):
    """Views side by side, cut to what they show, with one colour bar."""
    picture = json.loads((work / "picture.json").read_text())
    views = [(widen(crop(plt.imread(work / "whole.png"))), f"Deformed scene at t = {picture['time']:.6g}")]
    if picture["close"]:
        views.append((plt.imread(work / "close.png"), "Cut through the highest contact pressure"))
    widths = [image.shape[1] / image.shape[0] for image, _ in views]
    height = min(5.2, 11.5 / sum(widths))
    figure, all_axes = plt.subplots(1, len(views), figsize=(height * sum(widths) + 1.0, height + 0.4),
                                    width_ratios=widths, squeeze=False)
    for axes, (image, title) in zip(all_axes[0], views):
        axes.imshow(image, interpolation="antialiased")
        axes.set_title(title)
        axes.axis("off")
    if picture["field"]:
        scale = plt.cm.ScalarMappable(plt.Normalize(0, picture["upper"]), picture["colour_map"])
        bar = figure.colorbar(scale, ax=all_axes[0].tolist(), shrink=0.8, aspect=28, pad=0.02,
                              extend="max" if picture["exceeded"] else "neither")
        bar.set_label(picture["field"])
        bar.outline.set_visible(False)
    figure.savefig(target, dpi=150)
    plt.close(figure)


def widen(image):
    """A tall thin image with white on both sides, so that the title above it has room."""
    missing = max(int(0.8 * image.shape[0]) - image.shape[1], 0)
    return numpy.pad(image, ((0, 0), (missing // 2, missing - missing // 2), (0, 0)), constant_values=1.0)


def crop(image):
    """Without the white around the bodies."""
    rows = (image[..., :3] < 0.995).any(axis=(1, 2)).nonzero()[0]
    columns = (image[..., :3] < 0.995).any(axis=(0, 2)).nonzero()[0]
    if not len(rows) or not len(columns):
        return image
    margin = 12
    return image[max(rows[0] - margin, 0):rows[-1] + margin, max(columns[0] - margin, 0):columns[-1] + margin]
