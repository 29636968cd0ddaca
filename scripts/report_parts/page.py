# SPDX-License-Identifier: LGPL-2.1-or-later
"""Composes the page: one HTML file that needs no other."""
import base64
import html
import math

STYLE = """
:root { --ink: #27323f; --soft: #5b6b7b; --line: #e3e8ee; --paper: #ffffff; --ground: #f5f7f9; --accent: #2166ac; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", Roboto,
       "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 2.2rem 1.4rem 3rem; }
header h1 { margin: 0 0 .2rem; font-size: 1.7rem; letter-spacing: -.01em; }
header p { margin: 0; color: var(--soft); }
.badge { display: inline-block; padding: .1rem .65rem; border-radius: 1rem; font-size: .8rem; font-weight: 600;
         vertical-align: .3rem; margin-left: .7rem; background: #e4f2e8; color: #24693c; }
.badge.bad { background: #fbe6e2; color: #a3301c; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(230px, 1fr)); gap: .8rem; margin: 1.5rem 0; }
.figure { background: var(--paper); border: 1px solid var(--line); border-radius: .6rem; padding: .7rem .9rem; }
.figure b { display: block; font-size: 1.2rem; font-variant-numeric: tabular-nums; }
.figure span { color: var(--soft); font-size: .83rem; }
.card { background: var(--paper); border: 1px solid var(--line); border-radius: .6rem; padding: 1rem 1.1rem;
        margin: 0 0 1rem; overflow-x: auto; }
.card h2 { margin: 0 0 .6rem; font-size: 1.02rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(430px, 1fr)); gap: 1rem; margin-bottom: 1rem; }
.plots .card { margin: 0; display: flex; align-items: center; }
img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .35rem .8rem .35rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { color: var(--soft); font-weight: 600; font-size: .85rem; }
td.number, th.number { text-align: right; }
td.bad { color: #a3301c; font-weight: 600; }
td.number, td.name { white-space: nowrap; }
tr:last-child td { border-bottom: 0; }
pre { margin: .6rem 0 0; font: 13px/1.45 ui-monospace, "DejaVu Sans Mono", monospace; overflow-x: auto; }
summary { cursor: pointer; font-weight: 600; }
header pre { white-space: pre-wrap; }
.note { color: var(--soft); }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(430px, 1fr)); gap: 1rem; }
footer { color: var(--soft); font-size: .85rem; margin-top: 1.5rem; }
@media print { body { background: #fff; } .card, .figure { break-inside: avoid; } }
@media (max-width: 520px) { .plots, .columns { grid-template-columns: 1fr; } }
"""

ALTERNATIVES = {
    "scene": "The deformed scene", "contact_pressure": "Contact pressure against the radius",
    "energy": "Energies over time or load", "penetration": "Greatest penetration over time or load",
    "contact_force": "Contact forces over time or load", "contact_area": "Contact area over time or load",
    "support_force": "Forces of the supports over the load",
    "estimated_error": "Both parts of the estimated error over the load",
    "largest_pressure": "Largest contact pressure over time or load",
    "run_time": "Seconds by section of the program",
    "error_time": "Error against run time", "error_dofs": "Error against degrees of freedom",
    "memory": "Memory against degrees of freedom",
}

MOST_COLLISIONS = 20
BAD = ' class="bad"'

UNITS = {"effective_stiffness": " [Pa/m]", "max_penetration": " [m]", "max_pressure": " [Pa, per undeformed area]",
         "area": " [m\u00b2; m in 2-D, undeformed]", "n_pairs_max": " (points near a target, whole run\u2019s most)"}


def compose(run, figures, omissions):
    summary = run.summary
    title = scene_name(summary)
    images = dict(figures)
    plots = "".join(f'<div class="card">{image(name, path)}</div>' for name, path in figures if name != "scene")
    scene = f'<div class="card">{image("scene", images["scene"])}</div>' if "scene" in images else ""
    body = [header(summary, title), key_figures(summary), scene, f'<div class="plots">{plots}</div>' if plots else "",
            errors_table(summary), collisions_table(summary), '<div class="columns">', quantities_table(summary),
            f"<div>{forces_table(summary)}{parts_table(summary)}</div>", "</div>",
            omissions_card(omissions), parameters_card(run.parameters), footer(summary)]
    return document(title, body)


def document(title, body):
    """The page around its parts; empty ones are left out."""
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{text(title)}</title>\n<style>{STYLE}</style></head>\n<body><main>\n"
            + "\n".join(part for part in body if part) + "\n</main></body></html>\n")


def scene_name(summary):
    stem = str(summary.get("input", "")).replace("\\", "/").rsplit("/", 1)[-1]
    stem = stem[:-4] if stem.endswith(".prm") else stem
    return stem.replace("_", " ") or "Run"


def header(summary, title):
    status = str(summary.get("status", "unknown"))
    good = status.lower() in ("ok", "success", "finished", "converged", "completed")
    ranks = summary.get("n_ranks")
    pieces = [f'{summary.get("program", "Signorini")} {summary.get("version", "")}'.strip(),
              str(summary.get("input", "")), plural(ranks, "rank") if ranks else ""]
    return (f'<header><h1>{text(title)}<span class="badge{"" if good else " bad"}">{text(status)}</span></h1>'
            f'<p>{text(" · ".join(piece for piece in pieces if piece))}</p>{failure(summary)}{warnings(summary)}</header>')


def failure(summary):
    reason = summary.get("reason", "")
    return f'<pre class="card">{text(reason)}</pre>' if reason else ""


def warnings(summary):
    return "".join(f'<pre class="card">Warning: {text(warning)}</pre>' for warning in summary.get("warnings") or [])


def key_figures(summary):
    peak = mapping(mapping(summary, "contact"), "peak")
    energy = mapping(summary, "energy")
    entries = [
        ("unknowns", count(summary.get("n_dofs"))),
        ("cells", count(summary.get("n_cells"))),
        ("steps", count(summary.get("n_steps"))),
        ("run time", duration(mapping(summary, "run_time").get("total"))),
        ("memory", f'{significant(summary["memory_peak_mb"], 3)} MB' if "memory_peak_mb" in summary else ""),
        ("largest contact pressure of the run [Pa, per undeformed area]", significant(peak.get("max_pressure"))),
        ("greatest penetration / h of the run", significant(peak.get("max_penetration_over_h"), 3)),
        ("greatest residual of the energy ledger", significant(energy.get("max_ledger_residual"), 2)),
    ]
    cells = "".join(f'<div class="figure"><b>{text(value)}</b><span>{text(name)}</span></div>'
                    for name, value in entries if value)
    return f'<div class="figures">{cells}</div>' if cells else ""


def errors_table(summary):
    rows = [row for row in summary.get("errors") or [] if isinstance(row, dict)]
    if not rows:
        return ""
    cells = "".join(
        f'<tr><td>{text(row.get("quantity", ""))}</td><td class="number">{significant(row.get("computed"), 6)}</td>'
        f'<td class="number">{significant(row.get("exact"), 6)}</td>'
        f'<td class="number">{percent(row.get("relative_error"))}</td></tr>' for row in rows)
    return ('<div class="card"><h2>Against the exact solution</h2><table><tr><th>quantity</th>'
            '<th class="number">computed</th><th class="number">exact</th><th class="number">relative error</th></tr>'
            f"{cells}</table></div>")


def collisions_table(summary):
    """Who struck whom, when, and how it ended."""
    collisions = mapping(summary, "contact").get("collisions") or []
    cells = "".join(
        f'<tr><td>{text(entry.get("one"))} and {text(entry.get("other"))}</td>'
        f'<td class="number">{significant(entry.get("begin"))}</td><td class="number">{significant(entry.get("end"))}</td>'
        f'<td{BAD if entry.get("outcome") == "passed through" else ""}>{text(entry.get("outcome"))}</td></tr>'
        for entry in collisions[:MOST_COLLISIONS])
    more = len(collisions) - MOST_COLLISIONS
    return ('<div class="card"><h2>Collisions</h2><table><tr><th>of</th><th class="number">from [s]</th>'
            f'<th class="number">to [s]</th><th>outcome</th></tr>{cells}</table>'
            f'{f"<p>and {more} further ones, in summary.json</p>" if more > 0 else ""}</div>') if collisions else ""


def parts_table(summary):
    parts = mapping(summary, "parts")
    built = "".join(f"<tr><td>{text(part_name(part))}</td><td>built</td></tr>" for part in parts.get("built") or [])
    left_out = "".join(
        f'<tr><td class="note">{text(part_name(part))}</td><td class="note">left out: '
        f'{text(part.get("reason", "") if isinstance(part, dict) else "")}</td></tr>'
        for part in parts.get("left_out") or [])
    if not built and not left_out:
        return ""
    return f'<div class="card"><h2>Parts of the program</h2><table>{built}{left_out}</table></div>'


def quantities_table(summary):
    """Everything that the summary says about contact, energy, momentum and the error estimate."""
    rows = []
    for group, when in (("contact", ""), ("energy", ""), ("momentum", "greatest "), ("estimate", "")):
        for name, value in mapping(summary, group).items():
            if not isinstance(value, (dict, list)):
                rows.append((f"{group}: {when}{name.replace('_', ' ')}{UNITS.get(name, '')}", significant(value)))
    rows += [(f"contact: whole run\u2019s peak of {name.replace('_', ' ')}{UNITS.get(name, '')}", significant(value))
             for name, value in mapping(mapping(summary, "contact"), "peak").items()]
    return two_columns("Quantities (at the end, unless they say otherwise)", rows)


def forces_table(summary):
    """The last contact and support forces, by name."""
    rows = [(f"contact force on {entry.get('name')}", ", ".join(significant(value) for value in entry["force"]))
            for entry in mapping(summary, "contact").get("resultant") or []]
    rows += [(f"support force {entry.get('name')}", significant(entry.get("force")))
             for entry in summary.get("supports") or []]
    return two_columns("Forces at the end [N; N/m in two dimensions]", rows)


def two_columns(title, rows):
    cells = "".join(f'<tr><td>{text(name)}</td><td class="number">{text(value)}</td></tr>' for name, value in rows)
    return f'<div class="card"><h2>{text(title)}</h2><table>{cells}</table></div>' if rows else ""


def omissions_card(omissions):
    if not omissions:
        return ""
    items = "".join(f"<li>{text(omission)}</li>" for omission in omissions)
    return f'<div class="card note"><h2>Left out of this report</h2><ul>{items}</ul></div>'


def parameters_card(parameters):
    if not parameters.strip():
        return ""
    return (f'<details class="card"><summary>Parameters as used</summary><pre>{text(parameters)}</pre></details>')


def footer(summary):
    return (f'<footer>Written by {text(summary.get("program", "Signorini"))}. Fields over time: open solution.pvd in '
            'ParaView; curves: statistics.csv; figures for scripts: summary.json.</footer>')


def image(name, path):
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return f'<img alt="{text(ALTERNATIVES.get(name, name))}" src="data:image/png;base64,{data}">'


def mapping(summary, key):
    value = summary.get(key)
    return value if isinstance(value, dict) else {}


def part_name(part):
    return part.get("name", "") if isinstance(part, dict) else part


def text(value):
    return html.escape(str(value))


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def significant(value, digits=5):
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.{digits}g}" if is_number(value) else str(value)


def percent(value):
    if not is_number(value):
        return ""
    return f"{100 * value:+.3g} %" if math.isfinite(value) else str(value)


def count(value):
    return f"{value:,}".replace(",", "\u202f") if is_number(value) else ""


def plural(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def duration(seconds):
    if not is_number(seconds) or not math.isfinite(seconds):
        return ""
    if seconds < 120:
        return f"{seconds:.3g} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
