# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads a .expect file and judges results against it; README.md describes the format."""
import dataclasses
import math
import re
import shlex

KINDS = ("exact", "published", "stored")
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
TOLERANCE = rf"(?:(?:±|\+-)\s*{NUMBER}\s*(?:%|rel\b)?\s*)+"


class ExpectError(Exception):
    """A .expect file that cannot be understood, or a quantity that is not there."""


@dataclasses.dataclass
class Run:
    name: str
    n_ranks: int
    options: list


@dataclasses.dataclass
class Tolerance:
    absolute: float = 0.0
    relative: float = 0.0

    def admits(self, value, reference):
        return abs(value - reference) <= max(self.absolute, self.relative * abs(reference))


@dataclasses.dataclass
class Check:
    line: int
    text: str
    kind: str
    reason: str
    runs: list
    judge: object  # results by run name -> list of (passed, what was found)


@dataclasses.dataclass
class Expectations:
    head: dict
    runs: list
    checks: list


def parse(text):
    lines = text.splitlines()
    head = parse_head(lines[0] if lines else "")
    runs, pending = [], []
    for number, line in enumerate(lines[1:], start=2):
        statement, _, comment = split_comment(line)
        if not statement:
            continue
        try:
            if re.match(r"run\s+\S+?:", statement):
                runs.append(parse_run(statement, [run.name for run in runs]))
            else:
                pending.append((number, statement, *parse_comment(comment)))
        except (ExpectError, ValueError) as error:
            raise ExpectError(f"line {number}: {error}\n    {line.strip()}") from error
    runs = runs or [Run("run", 1, [])]
    names = [run.name for run in runs]
    checks = []
    for number, statement, kind, reason in pending:
        try:
            scope, judge = parse_check(statement, names)
        except ExpectError as error:
            raise ExpectError(f"line {number}: {error}\n    {statement}") from error
        checks.append(Check(number, statement, kind, reason, scope, judge))
    if not checks:
        raise ExpectError("the file checks nothing")
    return Expectations(head, runs, checks)


def parse_head(line):
    head = dict(re.findall(r"(\w+)=(\S+)", line)) if line.startswith("#") else {}
    for key in ("prm", "label", "timeout"):
        if key not in head:
            raise ExpectError(f"line 1 must be a comment with prm=, label= and timeout=; {key}= is missing")
    unknown = set(head) - {"prm", "label", "timeout", "processors"}
    if unknown:
        raise ExpectError(f"line 1: unknown {', '.join(sorted(unknown))}")
    return head


def split_comment(line):
    """The statement and the comment of a line; a # inside quotes is no comment."""
    match = re.fullmatch(r"""((?:[^#"']|"[^"]*"|'[^']*')*)(#?)(.*)""", line.strip())
    if not match:
        raise ExpectError("a quote is not closed")
    return match.group(1).strip(), match.group(2), match.group(3).strip()


def parse_comment(comment):
    kind, colon, reason = comment.partition(":")
    if not colon or kind.strip() not in KINDS or not reason.strip():
        raise ExpectError(f"a check ends with '# KIND: reason', KIND one of {', '.join(KINDS)}")
    return kind.strip(), reason.strip()


def parse_run(statement, taken):
    name, options = re.fullmatch(r"run\s+(\S+?):\s*(.*)", statement).groups()
    if not re.fullmatch(r"[\w-]+", name) or name in taken:
        raise ExpectError(f"run names are made of letters, digits, _ and -, and each is used once; got '{name}'")
    words, n_ranks = shlex.split(options), 1
    if "-np" in words:
        place = words.index("-np")
        if place + 1 >= len(words) or not words[place + 1].isdigit() or int(words[place + 1]) < 1:
            raise ExpectError("-np needs a number of ranks")
        n_ranks = int(words[place + 1])
        del words[place:place + 2]
    return Run(name, n_ranks, words)


def parse_names(text, known, least):
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in known:
            raise ExpectError(f"no run is called '{name}'; there are: {', '.join(known)}")
    if len(names) < least:
        raise ExpectError(f"needs {least} runs or more")
    return names


def parse_tolerance(text):
    tolerance = Tolerance()
    for value, suffix in re.findall(rf"(?:±|\+-)\s*({NUMBER})\s*(%|rel\b)?", text or ""):
        if suffix == "%":
            tolerance.relative = max(tolerance.relative, float(value) / 100)
        elif suffix == "rel":
            tolerance.relative = max(tolerance.relative, float(value))
        else:
            tolerance.absolute = max(tolerance.absolute, float(value))
    return tolerance


def parse_check(statement, names):
    """The runs that a check needs, and the function that judges their results."""
    for start, parser in (("order", parse_order), ("agree", parse_agree)):
        if re.match(rf"{start}\s", statement):
            return parser(statement, names)
    return parse_comparison(statement, names)


def parse_order(statement, names):
    match = re.fullmatch(rf"order\s+(differences\s+)?(.+?)\s+of\s+(\S+)\s+over\s+ratio\s+({NUMBER})\s*=\s*({NUMBER})"
                         rf"\s*({TOLERANCE})", statement)
    if not match:
        raise ExpectError("expected: order [differences] PATH of a,b over ratio R = VALUE ± TOLERANCE")
    differences, path, runs, ratio, expected, tolerance = match.groups()
    runs = parse_names(runs, names, 3 if differences else 2)
    if not float(ratio) > 0 or float(ratio) == 1:
        raise ExpectError("the ratio must be positive and not 1")
    tolerance = parse_tolerance(tolerance)

    def judge(results):
        values = [number_at(results[run], path) for run in runs]
        if differences:
            values = [one - other for one, other in zip(values, values[1:])]
        if 0 in values:
            return [(False, "a value is zero: it has no order")]
        orders = [math.log(abs(one / other)) / math.log(float(ratio)) for one, other in zip(values, values[1:])]
        return [(tolerance.admits(order, float(expected)), f"{order:.6g}") for order in orders]

    return runs, judge


def parse_agree(statement, names):
    match = re.fullmatch(rf"agree\s+(\S+)\s+(.+?)\s*({TOLERANCE})", statement)
    if not match:
        raise ExpectError("expected: agree a,b PATH ± TOLERANCE")
    runs, path, tolerance = match.groups()
    runs = parse_names(runs, names, 2)
    tolerance = parse_tolerance(tolerance)

    def judge(results):
        first, *others = [number_at(results[run], path) for run in runs]
        return [(tolerance.admits(other, first), f"{run}: {other!r} against {first!r} (off by {other - first:.2g})")
                for run, other in zip(runs[1:], others)]

    return runs, judge


def parse_comparison(statement, names):
    match = re.fullmatch(rf'(?:\[([\w\s,-]+)\]\s*)?(.+?)\s*(<=|>=|=)\s*(?:({NUMBER})\s*({TOLERANCE})?|"([^"]*)")',
                         statement)
    if not match:
        raise ExpectError('expected: PATH <= VALUE, PATH >= VALUE, PATH = VALUE ± TOLERANCE or PATH = "text"')
    scope, path, relation, expected, tolerance, word = match.groups()
    runs = parse_names(scope, names, 1) if scope else list(names)
    if word is not None:
        if relation != "=":
            raise ExpectError("a text can only be compared with =")
    elif (relation == "=") != bool(tolerance):
        raise ExpectError("'=' needs a tolerance (± 0 for equality), '<=' and '>=' take none")
    tolerance = parse_tolerance(tolerance)
    if tolerance.relative and float(expected) == 0:
        raise ExpectError("a relative tolerance means nothing beside zero")

    def judge_one(result):
        if word is not None:
            found = value_at(result, path)
            return found == word, repr(found)
        found, bound = number_at(result, path), float(expected)
        passed = {"<=": found <= bound, ">=": found >= bound, "=": tolerance.admits(found, bound)}[relation]
        return passed, f"{found:.8g}"

    return runs, lambda results: [judge_one(results[run]) for run in runs]


def number_at(result, path):
    value = value_at(result, path)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ExpectError(f"{path} is {value!r}, not a number")
    if not math.isfinite(value):
        raise ExpectError(f"{path} is {value}")
    return value


def value_at(result, path):
    """What stands at a path; see README.md for paths."""
    wrapped = re.fullmatch(r"(abs|norm)\((.*)\)", path)
    if wrapped and wrapped.group(1) == "abs":
        return abs(number_at(result, wrapped.group(2)))
    if wrapped:
        entries = value_at(result, wrapped.group(2))
        if not isinstance(entries, list):
            raise ExpectError(f"{wrapped.group(2)} is not a list")
        return math.sqrt(sum(entry * entry for entry in entries))
    if not re.fullmatch(r"[^.\[\]]+(?:\.[^.\[\]]+|\[[^\]]+\])*", path):
        raise ExpectError(f"'{path}' is not a path")
    steps = re.findall(r"\[([^\]]+)\]|([^.\[\]]+)", path)
    value, passed = result, ""
    for key, name in steps:
        step = key or name
        value = step_into(value, step, passed)
        passed += f"[{key}]" if key else ("." if passed else "") + name
    return value


def step_into(value, step, passed):
    where = passed or "summary.json"
    if isinstance(value, dict):
        if step in value:
            return value[step]
        raise ExpectError(f"{where} has no '{step}'; it has: {', '.join(map(str, value)) or 'nothing'}")
    if isinstance(value, list):
        for entry in value:
            if isinstance(entry, dict) and step in (entry.get("quantity"), entry.get("name")):
                return entry
        if re.fullmatch(r"-?\d+", step) and -len(value) <= int(step) < len(value):
            return value[int(step)]
        known = [str(entry.get("quantity", entry.get("name"))) for entry in value if isinstance(entry, dict)]
        raise ExpectError(f"{where} has no '{step}'; it has {len(value)} entries: {', '.join(known)}")
    raise ExpectError(f"{where} is {value!r}: there is no '{step}' in it")
