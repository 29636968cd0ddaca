# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a study: plots, all runs, observed orders."""
from . import page
from .page import count, duration, is_number, percent, significant, text

CLEAR = 0.9  # fits with a smaller R² are shown in grey


def compose(run, figures, omissions):
    summary = run.summary
    study = summary["study"]
    images = dict(figures)
    wide = "".join(f'<div class="card">{page.image(name, images[name])}</div>' for name in ("growth", "error_time", "error_dofs")
                   if name in images)
    memory = f'<div class="card">{page.image("memory", images["memory"])}</div>' if "memory" in images else ""
    body = [page.header(summary, page.scene_name(summary)), key_figures(study), wide, orders_tables(study),
            runs_table(study), memory, page.omissions_card(omissions), page.parameters_card(run.parameters),
            '<footer>Run times are without the writing of output, the smallest of the repeats. Every run has its own '
            "folder below runs/; the table for scripts is study.csv.</footer>"]
    return page.document(page.scene_name(summary), body)


def key_figures(study):
    by_name = {row["run"]: row for row in study["rows"]}
    cheapest = by_name.get(study["cheapest"])
    named = (f'{cheapest["run"]}: {duration(cheapest["run_time"])}' if cheapest else "none of these runs")
    ended = sum(row["status"] == "ok" for row in study["rows"])
    best = min((row["largest_error"] for row in study["rows"] if is_number(row["largest_error"])), default=None)
    entries = [(f"cheapest with no error above {percent(study['tolerance']).lstrip('+')}", named),
               ("combinations that ended well", f"{ended} of {len(study['rows'])}"),
               ("repeats of each", str(study["n_repeats"])),
               ("smallest of the largest errors", percent(best).lstrip("+"))]
    entries += [(f"model error of {name}, taken off", percent(value)) for name, value in study["model_errors"].items()]
    cells = "".join(f'<div class="figure"><b>{text(value)}</b><span>{text(name)}</span></div>' for name, value in entries
                    if value)
    return f'<div class="figures">{cells}</div>'


def orders_tables(study):
    """Those of the quantities that count and of the estimates are open, all others folded away."""
    if not study["orders"]:
        return ('<div class="card note"><h2>Observed orders</h2>None: an order needs three runs or more with an error '
                "above zero that differ in one list only.</div>")
    shown = [*study["quantities"], "estimated discretization", "estimated contact"]
    first = sorted((order for order in study["orders"] if order["quantity"] in shown),
                   key=lambda order: shown.index(order["quantity"]))
    rest = [order for order in study["orders"] if order["quantity"] not in shown]
    return orders_table("Observed orders (error ∝ variable^order; least squares in log–log)", first, "open") + \
        orders_table("Orders of the other quantities (of an error that is mere round-off they mean nothing)", rest, "")


def orders_table(title, orders, state):
    if not orders:
        return ""
    rows = "".join(order_row(order) for order in orders)
    return (f'<details class="card" {state}><summary>{text(title)}</summary>'
            "<table><tr><th>error of</th><th>in</th><th>at</th>"
            '<th class="number">order</th><th class="number">± standard error</th><th class="number">R²</th>'
            f'<th class="number">points</th></tr>{rows}</table></details>')


def order_row(order):
    look = "" if order["r_squared"] > CLEAR else ' class="note"'
    return (f'<tr{look}><td>{text(order["quantity"])}</td><td>{text(order["in"].replace("alpha", "α"))}</td>'
            f'<td>{text(settings_text(order["settings"]))}</td><td class="number">{order["order"]:.3f}</td>'
            f'<td class="number">{order["standard_error"]:.3f}</td><td class="number">{order["r_squared"]:.4f}</td>'
            f'<td class="number">{order["n_points"]}</td></tr>')


def runs_table(study):
    quantities = [error["quantity"] for error in next((row["errors"] for row in study["rows"] if row["errors"]), [])]
    heads = "".join(f'<th class="number">{text(name)}</th>'
                    for name in ("cells", "dofs", "steps", "iterations", "α", "k_A [Pa/m]", "run time", "core-seconds",
                                 "memory [MB]", "largest error", *quantities))
    rows = "".join(run_row(row, study, quantities) for row in study["rows"])
    return (f'<div class="card"><h2>All runs</h2><table><tr><th>run</th><th></th>{heads}</tr>{rows}</table>'
            '<p class="note">● on the Pareto front: no other run beats it in run time and largest error both. '
            f'Largest error of: {text(", ".join(study["quantities"]))}.</p></div>')


def run_row(row, study, quantities):
    if row["status"] != "ok":
        why = f'{row["status"]}: {row["reason"]}'.partition("\n")[0]
        return (f'<tr><td class="name">{text(row["run"])}</td><td></td>'
                f'<td colspan="{10 + len(quantities)}" class="note">{text(why)}</td></tr>')
    errors = {error["quantity"]: error["relative_error"] for error in row["errors"]}
    values = [count(row["n_cells"]), count(row["n_dofs"]), count(row["n_steps"]), count(row["n_iterations"]),
              significant(row["alpha"], 4), significant(row["effective_stiffness"], 4), duration(row["run_time"]),
              significant(row["core_seconds"], 3), significant(row["memory_peak_mb"], 3),
              percent(row["largest_error"]).lstrip("+")]
    values += [percent(errors.get(name)) for name in quantities]
    mark = "●" if row["run"] in study["pareto_front"] else ""
    name = f'<b>{text(row["run"])}</b>' if row["run"] == study["cheapest"] else text(row["run"])
    cells = "".join(f'<td class="number">{text(value)}</td>' for value in values)
    return f'<tr><td class="name">{name}</td><td>{mark}</td>{cells}</tr>'


def settings_text(settings):
    return ", ".join(f'{name.replace("alpha", "α")} {value}' for name, value in settings.items())
