# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plots of a study: each function draws one figure, or returns None when there is nothing to draw."""
import math

from .curves import COLOURS, INK, is_number, plt

MESHES = ("uniform", "adaptive")
ALONG = (*MESHES, "step", "alpha", "degree", "solver", "copies", "potential", "contact")  # a line joins runs that differ in the first of these they have
LABELS = {"alpha": "\u03b1", "solver": "", "step": "step factor"}
MARKERS = "osD^vPX*"


def error_over_time(run):
    """Error against run time: a panel for the largest of all errors, and one a quantity."""
    return panels(run, "run_time", "run time without output [s]", "Error against run time")


def error_over_dofs(run):
    return panels(run, "n_dofs", "degrees of freedom", "Error against degrees of freedom")


def panels(run, key, label, title):
    study = run.summary["study"]
    quantities = study["quantities"]
    all_series = series_of(study)
    shown = (["largest of all"] if len(quantities) > 1 else []) + quantities
    if not any(points(rows, key, quantity) for _, rows in all_series for quantity in shown):
        return None
    n_columns = min(2, len(shown))
    n_rows = -(-len(shown) // n_columns)
    figure, all_axes = plt.subplots(n_rows, n_columns, figsize=(5.2 * n_columns + 0.6, 3.6 * n_rows + 0.4), squeeze=False)
    panel_list = [axes for row in all_axes for axes in row]
    for axes, quantity in zip(panel_list, shown):
        draw_panel(axes, all_series, key, quantity)
        if quantity == shown[0]:
            if key == "run_time":
                draw_front(axes, study)
            axes.set_title(f"Largest error of {len(quantities)} quantities" if len(shown) > 1 else quantity)
        else:
            axes.set_title(quantity)
        axes.axhline(study["tolerance"], color="#9aa7b4", linestyle=(0, (2, 2)), linewidth=1.1,
                     label=f"tolerance {study['tolerance']:g}")
        axes.set(xlabel=label, ylabel="relative error")
    for axes in panel_list[len(shown):]:
        axes.set_visible(False)
    handles, names = panel_list[0].get_legend_handles_labels()
    legend_below(figure, handles, names)
    figure.suptitle(title, x=0.01, horizontalalignment="left", fontsize=11, fontweight="bold")
    return figure


def draw_panel(axes, all_series, key, quantity):
    axes.set(xscale="log", yscale="log")
    for (label, rows), look in zip(all_series, looks(all_series)):
        found = points(rows, key, quantity)
        if found:
            axes.plot(*zip(*found), label=label, **look)


def draw_front(axes, study):
    by_name = {row["run"]: row for row in study["rows"]}
    front = [(row["run_time"], row["largest_error"]) for row in map(by_name.get, study["pareto_front"])
             if row["largest_error"] > 0]
    if front:
        axes.plot(*zip(*front), color=INK, linewidth=0.9, marker="o", markersize=9, markerfacecolor="none",
                  drawstyle="steps-post", label="Pareto front", zorder=1)


def memory(run):
    """Memory of the runs against their size."""
    all_series = series_of(run.summary["study"])
    figure, axes = plt.subplots()
    axes.set(xscale="log", title="Memory", xlabel="degrees of freedom", ylabel="peak of memory, all ranks [MB]")
    for (label, rows), look in zip(all_series, looks(all_series)):
        found = [(row["n_dofs"], row["memory_peak_mb"]) for row in rows if is_number(row["memory_peak_mb"])]
        if found:
            axes.plot(*zip(*sorted(found)), label=label, **look)
    if not axes.lines:
        plt.close(figure)
        return None
    axes.set_ylim(bottom=0)
    legend_below(figure, *axes.get_legend_handles_labels())
    return figure


def growth(run):
    """What a cell costs over how many there are, of studies that vary the number of bodies: level where all is linear."""
    rows = [row for row in run.summary["study"]["rows"] if "copies" in row["settings"] and row["status"] == "ok"]
    shown = [("run time of a cell and step, \u00b5s", lambda row: row["time_of_cell_step"]),
             ("set-up time of a cell, \u00b5s", lambda row: row["set_up_time"] / row["n_cells"])]
    if not rows or not all(is_number(row["set_up_time"]) for row in rows):
        return None
    figure, all_axes = plt.subplots(1, 2, figsize=(11, 4))
    for axes, (label, value) in zip(all_axes, shown):
        found = sorted((row["n_cells"], 1e6 * value(row)) for row in rows)
        first = found[0][1]
        axes.axhspan(0.75 * first, 1.25 * first, color="#dfe6ec", label="within 25 % of the smallest run")
        axes.plot(*zip(*found), color=COLOURS[0], marker="o", markersize=4.5, linewidth=1.4, label="measured")
        axes.set(xscale="log", xlabel="cells", ylabel=label)
        axes.set_ylim(bottom=0)
    legend_below(figure, *all_axes[0].get_legend_handles_labels())
    figure.suptitle("Growth with the number of bodies", x=0.01, horizontalalignment="left", fontsize=11, fontweight="bold")
    return figure


def legend_below(figure, handles, names):
    """Below all panels, which make room for it."""
    width, height = figure.get_size_inches()
    n_columns = max(1, min(len(names), int(width / (0.5 + 0.075 * max(map(len, names))))))
    room = (0.22 * -(-len(names) // n_columns) + 0.1) / height
    figure.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    figure.legend(handles, names, loc="lower center", ncols=n_columns, fontsize=8)


def points(rows, key, quantity):
    """Pairs (x, error) in the order of the list; what a logarithm cannot show is left out."""
    pairs = [(row[key], error_of(row, quantity)) for row in rows]
    return [(x, error) for x, error in pairs if x and error and math.isfinite(x) and math.isfinite(error)]


def error_of(row, quantity):
    if quantity == "largest of all":
        return row["largest_error"] if is_number(row["largest_error"]) else None
    for error in row["errors"]:
        if error["quantity"] == quantity:
            return abs(error["relative_error"]) if is_number(error["relative_error"]) else None
    return None


def series_of(study):
    """Pairs (label, rows): runs that differ in one list only, in the order of its values."""
    found = {}
    for row in study["rows"]:
        if row["status"] != "ok":
            continue
        settings = dict(row["settings"])
        along = next(name for name in ALONG if name in settings)
        value = settings.pop(along)
        number = float(value) if along not in ("solver",) and is_numeral(value) else math.inf
        found.setdefault((along if along in MESHES else "", tuple(settings.items())), []).append((number, row))
    return [(label_of(*key), [row for _, row in sorted(rows, key=lambda pair: pair[0])]) for key, rows in found.items()]


def label_of(mesh, settings):
    parts = [mesh] if mesh else []
    parts += [f"{LABELS.get(name, name)} {value}".strip() for name, value in settings]
    return ", ".join(parts) or "runs"


def looks(all_series):
    """Colour by the settings, broken lines for uniform meshes, markers by the settings where colours repeat."""
    names = []
    for label, _ in all_series:
        rest = label.split(", ", 1)[-1] if label.split(", ")[0] in MESHES else label
        names.append(rest if rest not in MESHES else "")
    order = list(dict.fromkeys(names))
    result = []
    for (label, _), name in zip(all_series, names):
        index = order.index(name)
        is_uniform = label.startswith("uniform")
        result.append({"color": COLOURS[index % len(COLOURS)], "marker": MARKERS[index // len(COLOURS) % len(MARKERS)],
                       "markersize": 4.5, "linestyle": (0, (4, 2)) if is_uniform else "-", "linewidth": 1.4,
                       "markerfacecolor": "white" if is_uniform else None, "zorder": 2})
    return result


def is_numeral(value):
    try:
        float(value)
    except ValueError:
        return False
    return True


#: file name, drawing function
ALL = [("error_time", error_over_time), ("error_dofs", error_over_dofs), ("growth", growth),
       ("memory", memory)]
