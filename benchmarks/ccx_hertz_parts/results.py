# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the runs say: the table of all, the cheapest within a tolerance, and the picture of error against cost."""
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

JUDGED = ("peak pressure", "contact radius")


def is_within(run, tolerance):
    return all(abs(run.errors[name]) <= tolerance for name in JUDGED)


def group(runs):
    """The runs of each series, by dofs."""
    series = {}
    for run in runs:
        series.setdefault((run.code, run.series), []).append(run)
    return {name: sorted(members, key=lambda run: run.dofs) for name, members in series.items()}


def find_cheapest(series, tolerance):
    """The coarsest run that is within and whose finer ones all are: one within by luck does not count. None: no run."""
    found = None
    for run in reversed(series):
        if not is_within(run, tolerance):
            break
        found = run
    return found


def write_table(path, runs):
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        names = list(runs[0].errors)
        writer.writerow(["code", "series", "run", "dofs [1]", "core-seconds [s]", "memory peak [MB]",
                         *(f"error of {name} [1]" for name in names)])
        for run in runs:
            writer.writerow([run.code, run.series, run.name, run.dofs, f"{run.seconds:.3f}", f"{run.megabytes:.0f}",
                             *(f"{run.errors[name]:.5f}" for name in names)])


def describe(runs):
    """Text: all runs, and for each tolerance the cheapest of each series and the ratio of the best of both codes."""
    lines = [f"{'run':34} {'dofs':>7} {'core-s':>8} {'MB':>5} {'p0':>8} {'a':>8} {'approach':>8}"]
    for run in runs:
        errors = " ".join(f"{100 * error:+7.2f}%" for error in run.errors.values())
        lines.append(f"{run.code + ' ' + run.name:34} {run.dofs:7} {run.seconds:8.2f} {run.megabytes:5.0f} {errors}")
    for tolerance in (0.02, 0.01, 0.005):
        lines += ["", f"Cheapest with p0 and a within {100 * tolerance:g} %, there and on all finer meshes of the series:"]
        lines += describe_cheapest(group(runs), tolerance)
    return "\n".join(lines)


def describe_cheapest(series, tolerance):
    lines, best = [], {}
    for (code, name), members in series.items():
        run = find_cheapest(members, tolerance)
        said = f"{run.seconds:.2f} core-seconds, {run.dofs} dofs" if run else "no run"
        lines.append(f"  {code + ', ' + name:30} {said}")
        if run and (code not in best or run.seconds < best[code].seconds):
            best[code] = run
    if len(best) == 2:
        lines.append(f"  CalculiX needs {best['CalculiX'].seconds / best['Signorini'].seconds:.2g} times the core-seconds "
                     f"of Signorini ({best['CalculiX'].name} against {best['Signorini'].name})")
    else:
        lines.append("  nothing to compare: " + ("; ".join(f"only {code} gets there" for code in best) or "neither does"))
    return lines


def draw(path, runs):
    figure, plots = plt.subplots(1, 2, figsize=(12, 4.4), sharey=True, constrained_layout=True)
    for axes, name in zip(plots, JUDGED):
        for (code, label), members in group(runs).items():
            theirs = code == "CalculiX"
            axes.loglog([run.seconds for run in members], [abs(run.errors[name]) for run in members],
                        "s--" if theirs else "o-", markersize=4.5, linewidth=1.3, label=f"{code}, {label}",
                        markerfacecolor="white" if theirs else None)
        axes.axhline(0.01, color="0.5", linewidth=0.8)
        axes.set(title=name, xlabel="core-seconds of the whole run")
        axes.grid(True, which="major", color="0.9")
    plots[0].set_ylabel("relative error")
    plots[1].legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.savefig(path, dpi=150)
