#!/usr/bin/env python3
"""Has other planners solve what typelift exports, and holds their plans against typelift's own model.

    python3 bench/peers.py target/release/typelift FOLDER

The kitchen's demonstrations and tasks are written to FOLDER, a model is learned, and each task is exported at both
levels; tasks that need imagination are exported with it. Each planner that is installed solves each. Whatever level a
plan was found at, it counts if it is one in the problem as level adl states it, by unified-planning, and in the model
that was exported, by `typelift validate`. Then it is carried out in the kitchen, by `typelift run`; where the kitchen
refuses a step, the same planner is asked for another plan without what failed: with --restart, from the beginning; if
that leads nowhere, since objects are then excluded from everything, again from where the kitchen stands.

The planners are looked for in the Python that runs this:

    pip install pyperplan up-fast-downward pymimir unified-planning

Prints a Markdown table of plan lengths; beside a length, how many proposals it took if the first was not carried out to
the goal. Exit code 1 if a planner that is installed does not solve a task, or its plans do not in the kitchen. Models
and tasks that are given are not carried out.
"""

import argparse
import itertools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

from problems import natural

LEVELS = ["strips", "adl"]

# The first argument of this script where `typelift run` calls it as a planner.
AGAIN = "--again"

# An exit code of Fast Downward.
OUT_OF_TIME = 23

MIMIR = """
import sys, pymimir
domain, problem, plan, seconds, search = sys.argv[1:]
domain = pymimir.Domain(domain)
problem = pymimir.Problem(domain, problem)
search = getattr(pymimir, search)
found = search(problem, problem.get_initial_state(), pymimir.FFHeuristic(problem), float(seconds))
if found.solution is None:
    print(f"mimir: {found.status}")
    sys.exit(11 if "UNSOLVABLE" in str(found.status).upper() or "EXHAUSTED" in str(found.status).upper() else 12)
with open(plan, "w") as out:
    for action in found.solution:
        names = [action.get_action().get_name()] + [thing.get_name() for thing in action.get_objects()]
        print(f"({' '.join(names)})", file=out)
"""

VALIDATE = """
import sys, unified_planning.shortcuts as up
from unified_planning.engines import SequentialPlanValidator
from unified_planning.io import PDDLReader
up.get_environment().credits_stream = None
up.get_environment().error_used_name = False
domain, problem, *plans = sys.argv[1:]
reader = PDDLReader()
problem = reader.parse_problem(domain, problem)
for plan in plans:
    result = SequentialPlanValidator().validate(problem, reader.parse_plan(problem, plan))
    print(bool(result))
"""


def run(command, seconds, log, **variables):
    """The code with which a command ends, Fast Downward's if it takes too long; what it says goes to a file."""
    try:
        with open(log, "w") as out:
            ended = subprocess.run(command, stdout=out, stderr=out, timeout=seconds, env=os.environ | variables)
            return ended.returncode
    except subprocess.TimeoutExpired:
        return OUT_OF_TIME


def output(command):
    """What a command prints that must not fail."""
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{ended.stderr}")
    return ended.stdout


def steps(plan):
    """The steps of a plan file."""
    return [line for line in plan.read_text().splitlines() if line.strip() and not line.startswith(";")]


class Planner:
    """A planner and the levels that it reads."""

    def __init__(self, name, levels, solve):
        self.name, self.levels, self.solve = name, levels, solve


# Enforced hill-climbing succeeds or fails within seconds, or gets lost on a plateau; which of these depends on the order
# in which operators come out of Python's sets, and so on the seed of its hashes. So it is begun again with other seeds.
PYPERPLAN = [("hadd", "ehs"), ("hff", "ehs")]
PYPERPLAN_SECONDS = 15


def pyperplan(seconds):
    def solve(domain, problem, plan, log):
        written = Path(f"{problem}.soln")
        written.unlink(missing_ok=True)
        until = time.monotonic() + seconds
        for seed in itertools.count():
            for heuristic, search in PYPERPLAN:
                left = until - time.monotonic()
                if left <= 0:
                    return OUT_OF_TIME
                command = [sys.executable, "-m", "pyperplan", "-H", heuristic, "-s", search, domain, problem]
                ended = run(command, min(left, PYPERPLAN_SECONDS), log, PYTHONHASHSEED=str(seed))
                if ended == 0 and written.exists():
                    written.rename(plan)
                    return 0

    return Planner("pyperplan", ["strips"], solve)


def fast_downward(driver, seconds):
    def solve(domain, problem, plan, log):
        files = ["--plan-file", plan, "--sas-file", f"{plan}.sas", domain, problem]
        return run([sys.executable, driver, "--alias", "lama-first", *files], seconds, log)

    return Planner("Fast Downward", LEVELS, solve)


# A* finds short plans or none soon; longer ones go ways that nobody showed, and that lead nowhere in the kitchen.
MIMIR_SECONDS = 10


def mimir(seconds):
    def solve(domain, problem, plan, log):
        for search, limit in [("astar_lazy", MIMIR_SECONDS), ("gbfs_lazy", seconds)]:
            command = [sys.executable, "-c", MIMIR, domain, problem, plan, str(limit), search]
            ended = run(command, limit, log)
            if ended == 0:
                break
        return ended

    return Planner("mimir", LEVELS, solve)


def planners(seconds, driver):
    """Those that are installed."""
    found = [pyperplan(seconds)] if find_spec("pyperplan") else []
    if driver is None and find_spec("up_fast_downward"):
        driver = Path(find_spec("up_fast_downward").origin).parent / "downward" / "fast-downward.py"
    if driver is not None:
        found.append(fast_downward(driver, seconds))
    return found + ([mimir(seconds)] if find_spec("pymimir") else [])


def plan_name(planner):
    """The file of a planner's plan."""
    return f"{planner.replace(' ', '-').lower()}.plan"


def prepare(typelift, folder, given):
    """The model and the tasks: those given, else the kitchen's."""
    if given:
        return given[0], [Path(task) for task in given[1:]]
    kitchen, model = folder / "K", folder / "kitchen.json"
    output([typelift, "kitchen", "export", kitchen])
    output([typelift, "learn", kitchen / "demos", "--types", kitchen / "types.pddl", "-o", model])
    return model, sorted((kitchen / "tasks").glob("*.json"), key=natural)


def own_plan(typelift, model, task):
    """typelift's own plan length, and whether it takes imagination."""
    for imagine in [[], ["--imagine"]]:
        ended = subprocess.run([typelift, "plan", model, task, "--json", *imagine], capture_output=True, text=True)
        plans = json.loads(ended.stdout)["plans"] if ended.returncode == 0 else []
        if plans:
            return len(plans[0]["steps"]), imagine
    return None, []


def are_valid(domain, problem, plans):
    """For each plan whether it is one; `None` if nobody can tell."""
    if not find_spec("unified_planning"):
        return [None for _ in plans]
    return [line == "True" for line in output([sys.executable, "-c", VALIDATE, domain, problem, *plans]).split()]


def come_back(typelift, model, task, plans, imagine):
    """For each plan whether it is one in the model that was exported, by `typelift validate`."""
    command = [typelift, "validate", model, task, "-q", *imagine]
    return [subprocess.run([*command, plan], capture_output=True).returncode == 0 for plan in plans]


def content(pddl):
    """What a PDDL file says, whatever it and its domain are called."""
    text = re.sub(r";.*", "", pddl.read_text())
    return re.sub(r"\((domain|problem|:domain) [^()]*\)", "", text).split()


def again(arguments):
    """As the command of `typelift run --planner`: the plan that was found before, if the problem is the same; else, a
    new one."""
    folder, name, seconds, domain, problem, plan = arguments
    folder, domain, problem, plan = Path(folder), Path(domain), Path(problem), Path(plan)
    before = [folder / "domain.pddl", folder / "problem.pddl"]
    if [content(file) for file in before] == [content(domain), content(problem)]:
        shutil.copy(folder / plan_name(name), plan)
        return 0
    planner = next(planner for planner in planners(float(seconds), None) if planner.name == name)
    # As it ended: where there is no plan, typelift lifts what it had excluded.
    return planner.solve(domain, problem, plan, plan.with_suffix(".log"))


def carried_out(arguments, model, task, plan, planner, level, imagine):
    """What `typelift run` says of a plan in the kitchen."""
    words = [sys.executable, Path(__file__).resolve(), AGAIN, plan.parent.resolve(), planner, arguments.seconds]
    command = f"{shlex.join(map(str, words))} {{domain}} {{problem}} {{plan}}"
    options = ["--kitchen", "--json", "--planner", command, "--planner-level", level, *imagine]
    for restart in [["--restart"], []]:
        run_it = [arguments.typelift, "run", model, task, *options, *restart]
        ended = subprocess.run(run_it, capture_output=True, text=True)
        plan.with_suffix(".run").write_text(ended.stdout + ended.stderr)
        report = json.loads(ended.stdout) if ended.stdout else {"solved": False}
        if report["solved"]:
            how = "" if restart else " without restart"
            return "" if report["proposals"] == 1 else f" ({report['proposals']} proposals{how})"
    return " (not achieved)"


def solve_task(arguments, found, model, task):
    """A row of the table, and how many cells of it are no valid plan, or none that leads to the goal."""
    length, imagine = own_plan(arguments.typelift, model, task)
    cells, plans = {}, {}
    for level in LEVELS:
        folder = arguments.folder / "exported" / f"{task.stem}-{level}"
        output([arguments.typelift, "export", model, task, "--level", level, "-o", folder, *imagine])
        for planner in found:
            if level not in planner.levels:
                continue
            plan = folder / plan_name(planner.name)
            plan.unlink(missing_ok=True)
            solved = planner.solve(folder / "domain.pddl", folder / "problem.pddl", plan, plan.with_suffix(".log"))
            cells[planner.name, level] = None
            if solved == 0 and plan.exists():
                plans[planner.name, level] = plan
    stated = arguments.folder / "exported" / f"{task.stem}-adl"
    judged = are_valid(stated / "domain.pddl", stated / "problem.pddl", list(plans.values()))
    returned = come_back(arguments.typelift, model, task, plans.values(), imagine)
    for (key, plan), valid, back in zip(plans.items(), judged, returned):
        if valid is False or not back:
            cells[key] = "not a plan"
            continue
        ran = "" if arguments.given else carried_out(arguments, model, task, plan, *key, imagine)
        cells[key] = f"{len(steps(plan))}{ran}"
    bad = sum(cell is None or cell.startswith("not") or cell.endswith("(not achieved)") for cell in cells.values())
    own = "–" if length is None else f"{length}{' imagined' if imagine else ''}"
    return [task.stem, own] + [cell or "–" for cell in cells.values()], list(cells), bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("typelift", help="the program typelift")
    parser.add_argument("folder", type=Path, help="where to write; made if it is not there")
    parser.add_argument("given", nargs="*", metavar="MODEL TASK…", help="another model and tasks for it")
    parser.add_argument("--fast-downward", metavar="FILE", help="the driver, fast-downward.py")
    parser.add_argument("--seconds", type=float, default=120, help="the time for one task (default: %(default)s)")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    found = planners(arguments.seconds, arguments.fast_downward)
    if not found:
        sys.exit("no planner is installed for this Python")
    model, tasks = prepare(arguments.typelift, arguments.folder, arguments.given)
    bad = 0
    for number, task in enumerate(tasks):
        row, columns, missing = solve_task(arguments, found, model, task)
        if number == 0:
            titles = ["task", "typelift"] + [f"{name}, {level}" for name, level in columns]
            print(f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}")
        print(f"| {' | '.join(row)} |", flush=True)
        bad += missing
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    if sys.argv[1:2] == [AGAIN]:
        sys.exit(again(sys.argv[2:]))
    main()
