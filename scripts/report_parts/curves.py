# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plots of a report: each function draws one figure, or returns None when its columns are absent."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib import ticker

INK, GRID = "#27323f", "#e3e8ee"
MAX_FORCES = 8  # curves of forces in one plot
COLOURS = ["#2166ac", "#d6604d", "#4d9f6a", "#e6a23c", "#7b5ea7", "#5b6b7b"]
MORE_COLOURS = ["#b2537d", "#2a9d9a"]  # where six do not do
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
    axes.set(title="Contact pressure (per undeformed area)", xlabel=table.label("radius"), ylabel=table.label("pressure"))
    axes.set_xlim(left=min(0.0, *finite(table["radius"])))
    axes.legend()
    return figure


#: what a run has and what it has lost; their sum is what it began with and what was put in since
HELD = ("kinetic energy", "elastic energy", "contact energy", "dissipated since the start",
        "dissipated by viscosity since the start", "rubbed off since the start", "plastic work since the start",
        "energy lost by implicit contact since the start")
PUT_IN = ("work since the start", "work of obstacles since the start", "renewed contact energy since the start",
          "energy of adaptation since the start")


def energy_ledger(run):
    """All energies with their sum, and that beside what was put in where there is a ledger, with its residual."""
    table = run.statistics
    progress = axis_of(table)

    def named(names):
        return [name for name in names if table.has_values(name) and any(finite(table[name]))]

    held, put_in = named(HELD), named(PUT_IN)
    if not held or not progress:
        return None
    residual = table.has_values("ledger residual")
    if residual:
        figure, (axes, below) = plt.subplots(2, 1, sharex=True, height_ratios=[3, 1], figsize=(6.4, 4.8))
    else:
        figure, axes = plt.subplots()
        below = axes
    axes.set_prop_cycle(color=COLOURS + MORE_COLOURS)
    for name in held:
        axes.plot(table[progress], table[name], label=short(name), **dots(table))
    total = sums(table, held)
    if residual:
        for name, style in zip(put_in, (":", "-.", (0, (1, 4)), (0, (6, 2, 1, 2, 1, 2)))):
            axes.plot(table[progress], table[name], color="#9aa7b4", linewidth=1.1, linestyle=style, label=short(name))
        axes.plot(table[progress], [total[0] + value for value in sums(table, put_in)], color="#c9d2db", linewidth=4.5,
                  zorder=1, label="start + put in")
    axes.plot(table[progress], total, color=INK, linewidth=1.1, linestyle=(0, (5, 2)), label="sum")
    axes.set_ylabel(f"energy [{table.units.get(held[0], '')}]")
    axes.legend(ncols=4, fontsize=8, loc="lower right", bbox_to_anchor=(1.0, 0.99), columnspacing=1.0,
                handlelength=1.8)
    figure.suptitle("Energies", x=0.11, horizontalalignment="left", fontsize=11, fontweight="bold")
    if residual:
        below.plot(table[progress], table["ledger residual"], color=COLOURS[4], linewidth=1.2)
        below.axhline(0, color="#9aa7b4", linewidth=0.8)
        below.set_ylabel("residual")
    below.set_xlabel(table.label(progress))
    return figure


def short(name):
    return name.removesuffix(" since the start").removeprefix("energy of ").removeprefix("energy ")


def sums(table, names):
    """The sum of the columns, row by row; zeros where there is none."""
    return [sum(values) for values in zip(*(table[name] for name in names))] or [0.0] * table.n_rows()


def curve(run, name, title, colour):
    """One quantity that is never negative, over time or load."""
    table = run.statistics
    progress = axis_of(table)
    if not (progress and table.has_values(name) and any(finite(table[name]))):
        return None
    figure, axes = plt.subplots()
    axes.plot(table[progress], table[name], color=colour, **dots(table))
    axes.fill_between(table[progress], table[name], color=colour, alpha=0.08)
    axes.set(title=title, xlabel=table.label(progress), ylabel=table.label(name))
    axes.set_ylim(bottom=0)
    return figure


def penetration(run):
    return curve(run, "max penetration over h", "Greatest penetration over mesh width", COLOURS[1])


def largest_pressure(run):
    return curve(run, "max pressure", "Largest contact pressure (per undeformed area)", COLOURS[3])


def contact_area(run):
    return curve(run, "contact area", "Contact area (undeformed)", COLOURS[2])


def forces(run, kind, title):
    """Components of all forces of a kind; those that are round-off beside the greatest only hide the zero line."""
    table = run.statistics
    progress = axis_of(table)
    names = [name for name in table.columns if name.startswith(kind) and table.has_values(name)]
    sizes = {name: max(map(abs, finite(table[name]))) for name in names}
    greatest = max(sizes.values(), default=0.0)
    if not progress or not greatest > 0:
        return None
    shown = [name for name in names if sizes[name] > 1e-6 * greatest]
    largest = sorted(shown, key=sizes.get)[-MAX_FORCES:]
    figure, axes = plt.subplots()
    for name in (name for name in shown if name in largest):
        axes.plot(table[progress], table[name], label=name[len(kind):], **dots(table))
    axes.axhline(0, color="#9aa7b4", linewidth=0.8)
    rest = f", the largest {MAX_FORCES} of {len(shown)}" if len(shown) > MAX_FORCES else ""
    axes.set(title=title + rest, xlabel=table.label(progress), ylabel=f"force [{table.units.get(names[0], '')}]")
    axes.legend(fontsize=8)
    return figure


def contact_force(run):
    return forces(run, "contact force ", "Contact force")


def support_force(run):
    return forces(run, "support force ", "Force of the supports")


def estimated_error(run):
    """Both parts of the estimated error over the load."""
    table = run.statistics
    progress = axis_of(table)
    names = [name for name in ("estimated discretization error", "estimated contact error")
             if table.has_values(name) and any(finite(table[name]))]
    if not progress or not names:
        return None
    figure, axes = plt.subplots()
    for name in names:
        axes.plot(table[progress], table[name], label=name.removeprefix("estimated ").removesuffix(" error"),
                  **dots(table))
    axes.set(title="Estimated error in the energy norm", xlabel=table.label(progress),
             ylabel="over the norm of the solution [1]")
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8)
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


def axis_of(table):
    """The column that curves run over, `time` or `load parameter`; None unless it has more than one value."""
    for name in ("time", "load parameter"):
        if table.has_values(name) and len(set(finite(table[name]))) > 1:
            return name
    return None


def dots(table):
    """Few points are load steps: show them as such."""
    return {"marker": "o", "markersize": 3.5} if table.n_rows() <= 40 else {}


#: file name, drawing function
ALL = [("contact_pressure", contact_pressure), ("contact_force", contact_force), ("largest_pressure", largest_pressure),
       ("penetration", penetration), ("energy", energy_ledger), ("support_force", support_force),
       ("contact_area", contact_area), ("estimated_error", estimated_error), ("run_time", run_time)]
