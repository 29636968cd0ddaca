# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plots of a report: each function draws one figure, or returns None when its columns are absent."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib import ticker

INK, GRID = "#27323f", "#e3e8ee"
COLOURS = ["#2166ac", "#d6604d", "#4d9f6a", "#e6a23c", "#7b5ea7", "#5b6b7b"]
STYLE = {
    "figure.figsize": (6.4, 3.7), "figure.dpi": 150, "figure.constrained_layout.use": True,
    "font.size": 9.5, "axes.titlesize": 11, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": "#9aa7b4", "xtick.color": "#5b6b7b",
    "ytick.color": "#5b6b7b", "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": GRID, "axes.axisbelow": True, "lines.linewidth": 1.7, "legend.frameon": False,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS), "axes.formatter.use_mathtext": True,
    "axes.formatter.limits": (-3, 4),
}


def use_style():
    plt.rcParams.update(STYLE)


def contact_pressure(run):
    """The computed contact pressure over the radius, on top of the exact one."""
    table = run.profile
    if not (table.has_values("radius") and table.has_values("pressure")):
        return None
    figure, axes = plt.subplots()
    if table.has_values("exact pressure"):
        radius, exact = zip(*sorted(zip(table["radius"], table["exact pressure"])))
        axes.plot(radius, exact, color=INK, linewidth=1.4, label="exact", zorder=3)
        axes.fill_between(radius, exact, color=INK, alpha=0.05)
    axes.plot(table["radius"], table["pressure"], "o", color=COLOURS[1], markersize=3.6, markeredgewidth=0,
              alpha=0.8, label="computed")
    axes.set(title="Contact pressure", xlabel=table.label("radius"), ylabel=table.label("pressure"))
    axes.set_xlim(left=min(0.0, *finite(table["radius"])))
    axes.legend()
    return figure


def energy_ledger(run):
    """All energies with their sum, and below it the residual of the ledger."""
    table = run.statistics
    parts = [name for name in ("kinetic energy", "elastic energy", "contact energy", "dissipated")
             if table.has_values(name) and any(finite(table[name]))]
    if not parts or not moves(table):
        return None
    residual = table.has_values("ledger residual")
    if residual:
        figure, (axes, below) = plt.subplots(2, 1, sharex=True, height_ratios=[3, 1], figsize=(6.4, 4.6))
    else:
        figure, axes = plt.subplots()
        below = axes
    for name in parts:
        axes.plot(table["time"], table[name], label=name)
    axes.plot(table["time"], [sum(values) for values in zip(*(table[name] for name in parts))], color=INK,
              linewidth=1.1, linestyle=(0, (5, 2)), label="sum")
    if table.has_values("work") and any(finite(table["work"])):
        axes.plot(table["time"], table["work"], color="#9aa7b4", linewidth=1.1, linestyle=":",
                  label="work of the loads")
    unit = table.units.get("kinetic energy") or table.units.get(parts[0], "")
    axes.set_ylabel(f"energy [{unit}]" if unit else "energy")
    axes.legend(ncols=5, fontsize=8, loc="lower right", bbox_to_anchor=(1.0, 0.99), columnspacing=1.1, handlelength=1.5)
    figure.suptitle("Energy ledger", x=0.11, horizontalalignment="left", fontsize=11, fontweight="bold")
    if residual:
        below.plot(table["time"], table["ledger residual"], color=COLOURS[4], linewidth=1.2)
        below.axhline(0, color="#9aa7b4", linewidth=0.8)
        below.set_ylabel("residual")
    below.set_xlabel(table.label("time"))
    return figure


def penetration(run):
    """The greatest penetration, relative to the mesh width where that is known."""
    table = run.statistics
    name = "max penetration over h" if table.has_values("max penetration over h") else "max penetration"
    if not (table.has_values(name) and any(finite(table[name])) and moves(table)):
        return None
    figure, axes = plt.subplots()
    axes.plot(table["time"], table[name], color=COLOURS[1], **dots(table))
    axes.fill_between(table["time"], table[name], color=COLOURS[1], alpha=0.08)
    axes.set(title="Greatest penetration", xlabel=table.label("time"), ylabel=table.label(name))
    axes.set_ylim(bottom=0)
    return figure


def contact_force(run):
    table = run.statistics
    names = [f"contact force {axis}" for axis in "xyz"]
    names = [name for name in names if table.has_values(name)]
    if not any(any(finite(table[name])) for name in names) or not moves(table):
        return None
    greatest = max(abs(value) for name in names for value in finite(table[name]))
    figure, axes = plt.subplots()
    for name, colour in zip(names, (COLOURS[1], COLOURS[2], COLOURS[0])):
        # A component that is round-off beside the others only hides the zero line.
        if max(map(abs, finite(table[name]))) > 1e-6 * greatest:
            axes.plot(table["time"], table[name], color=colour, label=name[-1], **dots(table))
    axes.axhline(0, color="#9aa7b4", linewidth=0.8)
    unit = table.units.get(names[0], "")
    axes.set(title="Contact force", xlabel=table.label("time"), ylabel=f"force [{unit}]" if unit else "force")
    axes.legend(ncols=3)
    return figure


def contact_area(run):
    table = run.statistics
    if not (table.has_values("contact area") and any(finite(table["contact area"])) and moves(table)):
        return None
    figure, axes = plt.subplots()
    axes.plot(table["time"], table["contact area"], color=COLOURS[2], **dots(table))
    axes.set(title="Contact area", xlabel=table.label("time"), ylabel=table.label("contact area"))
    axes.set_ylim(bottom=0)
    return figure


def run_time(run):
    """Seconds of every section of the program, the longest first; the rest of the total as a bar of its own."""
    times = run.summary.get("run_time", {})
    sections = {name: value for name, value in times.get("sections", {}).items() if is_number(value)}
    if not sections:
        return None
    rest = times.get("total", 0) - sum(sections.values())
    if rest > 0.01 * times.get("total", 0):
        sections["everything else"] = rest
    names = sorted(sections, key=sections.get)[-12:]
    seconds = [sections[name] for name in names]
    figure, axes = plt.subplots(figsize=(6.4, 1.2 + 0.27 * len(names)))
    bars = axes.barh(names, seconds, color=COLOURS[0], height=0.66)
    axes.bar_label(bars, [f"{value:.3g} s" for value in seconds], padding=4, fontsize=8.5, color="#5b6b7b")
    axes.set(title="Time by section", xlabel="seconds")
    axes.grid(axis="y", visible=False)
    axes.set_xlim(right=1.12 * max(seconds))
    axes.xaxis.set_major_locator(ticker.MaxNLocator(6))
    return figure


def finite(values):
    return [value for value in values if math.isfinite(value)]


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def moves(table):
    """Curves over time need a time that has more than one value."""
    return table.has_values("time") and len(set(finite(table["time"]))) > 1


def dots(table):
    """Few points are load steps: show them as such."""
    return {"marker": "o", "markersize": 3.5} if len(table["time"]) <= 40 else {}


#: file name, drawing function
ALL = [("contact_pressure", contact_pressure), ("energy", energy_ledger), ("penetration", penetration),
       ("contact_force", contact_force), ("contact_area", contact_area), ("run_time", run_time)]
