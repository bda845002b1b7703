#!/usr/bin/env python3
"""Has typelift and other planners plan the problems of some folders, and compares them.

    pip install up-fast-downward pyperplan pymimir unified-planning fast-downward-translate
    python bench/compare.py FOLDER --core 1 --results results.jsonl

Each planner is a whole process, from the files to the plan, and has the same limits of time and memory. On each problem
they run in turn, on one core if --core is given, so that whatever else the machine does hits all of them. Their plans
are judged by others, as in bench/confirm_plans.py.

A folder holds problems, at any depth, each beside its `domain.pddl`; or it is, or is named by, a Python package that is
laid out as amlgym and pddlgym are. What is in --results already is not run again, unless it ran out of less time than
there is now, or --again is given; --stored adds results that are only read:

    python bench/compare.py FOLDER --planners typelift --results today.jsonl --stored peers.jsonl

Fast Downward is its driver with `--alias lama-first`. Any other planner, or another build of typelift, is a command:

    python bench/compare.py FOLDER --planner old='old/typelift -q plan {domain} {problem} -o {plan}' --reference old

Prints the problems that each planner solves, a row a domain, and then each planner's times and plans in relation to the
reference's. Exit code 1 if a plan is not valid.
"""

import argparse
import collections
import contextlib
import json
import math
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from importlib.util import find_spec

from judges import JUDGES, Judge, in_order, steps_of
from peers import MIMIR
from problems import folder_of, natural, pairs, text_of

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Where the processors' time counts, a process may wait for its turn so many times as long as it computes.
PATIENCE = 20
# Below this, in seconds, the reference's time is mostly that of starting.
NOTABLE = 0.5


# The problems.


def spread(things, count):
    """At most so many of them, the first and the last included."""
    if count is None or len(things) <= count:
        return things
    if count == 1:
        return [things[len(things) // 2]]
    return [things[round(i * (len(things) - 1) / (count - 1))] for i in range(count)]


def work_of(arguments):
    """For each problem its group, its name, its domain and its file."""
    groups = collections.defaultdict(list)
    for folder in map(folder_of, arguments.folders):
        for problem, domain in pairs(folder):
            beside = problem.parent / "domain.pddl"
            domain = beside if beside.exists() else domain
            name = f"{folder.name}/{problem.relative_to(folder)}"
            if domain not in (None, problem) and any(part in name for part in arguments.only or [""]):
                groups[os.path.dirname(name)].append((name, domain, problem))
    for group in sorted(groups, key=natural):
        problems = sorted(groups[group], key=lambda problem: natural(problem[0]))
        for problem in spread(problems, arguments.quick):
            yield group, *problem


# The planners: a command each, with {domain}, {problem}, {plan} and {seconds} to be filled in.


def known_planners(arguments):
    """The commands of those that are there."""
    commands = {}
    typelift = shutil.which(arguments.typelift)
    if typelift:
        limit = ["--time-limit", "{seconds}s"]
        command = [os.path.abspath(typelift), "-q", "plan", "{domain}", "{problem}", "-o", "{plan}", *limit]
        commands["typelift"] = command
    if find_spec("up_fast_downward"):
        driver = pathlib.Path(find_spec("up_fast_downward").origin).parent / "downward" / "fast-downward.py"
        options = ["--alias", "lama-first", "--plan-file", "{plan}"]
        commands["fast-downward"] = [sys.executable, str(driver), *options, "{domain}", "{problem}"]
    if find_spec("pymimir"):
        commands["mimir"] = [sys.executable, "-c", MIMIR, "{domain}", "{problem}", "{plan}", "{seconds}", "gbfs_lazy"]
    if find_spec("pyperplan"):
        options = ["-H", "hff", "-s", "gbf"]
        commands["pyperplan"] = [sys.executable, "-m", "pyperplan", *options, "{domain}", "{problem}"]
    ferroplan = shutil.which(arguments.ferroplan)
    if ferroplan:
        options = ["--threads", "1", "-o", "{domain}", "-f", "{problem}"]
        commands["ferroplan"] = [os.path.abspath(ferroplan), *options]
    return commands


def chosen_planners(arguments):
    """The commands of those that are to run."""
    commands = known_planners(arguments)
    for given in arguments.planner:
        name, equals, command = given.partition("=")
        if not equals:
            sys.exit(f"--planner takes NAME=COMMAND, not {given}")
        commands[name] = shlex.split(command)
    names = list(commands) if arguments.planners is None else arguments.planners.split(",")
    missing = [name for name in names if name not in commands]
    if missing:
        sys.exit(f"there is no {', '.join(missing)} here; there are: {', '.join(commands)}")
    return {name: commands[name] for name in names}


def fill(command, values):
    """The command, with each place filled that it has."""
    for name, value in values.items():
        command = [part.replace("{" + name + "}", str(value)) for part in command]
    return command


def written_plan(folder):
    """What a planner left as its plan: the file it was to write, pyperplan's, or steps printed as FF prints them."""
    for file in [folder / "plan", folder / "problem.pddl.soln"]:
        if file.exists():
            return file.read_text()
    steps = re.findall(r"^(?:step)?\s*\d+: *(\S.*?)\s*$", (folder / "log").read_text(errors="replace"), re.MULTILINE)
    return "".join(f"({step.lower()})\n" for step in steps) if steps else None


class Limits:
    """How long and with how much memory a planner may run."""

    def __init__(self, arguments):
        self.clock, self.seconds = arguments.clock, arguments.time_limit
        self.wall = self.seconds * (PATIENCE if self.clock == "cpu" else 1)
        self.bytes = arguments.memory_limit * 10**6

    def set(self):
        """In the process that is to become the planner."""
        resource.setrlimit(resource.RLIMIT_AS, (self.bytes, self.bytes))
        seconds = math.ceil(self.seconds) + 1  # More than is counted, so that it is seen who needs it.
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))

    def run(self, command, folder):
        """How a command ends, how long it took, and how long it computed."""
        before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        with open(folder / "log", "wb") as log:
            process = subprocess.Popen(
                command, cwd=folder, stdout=log, stderr=log, preexec_fn=self.set, start_new_session=True
            )
            try:
                code = process.wait(self.wall)
            except subprocess.TimeoutExpired:
                code = None
            finally:
                wall = time.monotonic() - begun
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return code, wall, cpu


# One problem.


def run_planner(command, limits, domain, problem, folder):
    """A record of one run; the plan, if there is one, is the file `folder/plan`."""
    shutil.copy(domain, folder / "domain.pddl")
    shutil.copy(problem, folder / "problem.pddl")
    files = {name: folder / file for name, file in [("domain", "domain.pddl"), ("problem", "problem.pddl")]}
    code, wall, cpu = limits.run(fill(command, {**files, "plan": folder / "plan", "seconds": limits.wall}), folder)
    record = {"outcome": "no plan", "exit": code, "seconds": round(wall, 3), "cpu": round(cpu, 3)}
    plan = written_plan(folder)
    if code is None or record["cpu" if limits.clock == "cpu" else "seconds"] > limits.seconds:
        record["outcome"] = "time"
    elif plan is not None:
        (folder / "plan").write_text(plan)
        stated = re.search(r"^;\s*cost\s*=\s*(\S+)", plan, re.MULTILINE)
        record["outcome"], record["length"] = "solved", len(steps_of(folder / "plan"))
        unit = ":metric" not in text_of(problem).lower()
        record["cost"] = float(stated.group(1)) if stated else record["length"] if unit else None
    else:
        record["said"] = " ".join((folder / "log").read_text(errors="replace").split())[-200:]
    return record


def judge(judges, domain, problem, solved):
    """Adds to each record of a plan who judged it, and what its cost is; if it is none, why."""
    files = [folder / "plan" for folder, _ in solved]
    for judge in judges if files else []:
        verdicts = judge.ask(domain, problem, files)
        if isinstance(verdicts, str):
            continue
        for (_, record), (valid, cost, why) in zip(solved, verdicts):
            record["judge"] = judge.name
            if not valid:
                record.update(outcome="invalid", why=why)
            elif cost is not None:
                numerator, _, denominator = cost.partition("/")
                record["cost"] = float(numerator) / float(denominator or 1)
        return


def run_problem(commands, limits, judges, domain, problem):
    """A record for each of the planners."""
    with tempfile.TemporaryDirectory() as top:
        records, solved = {}, []
        for number, (name, command) in enumerate(commands.items()):
            folder = pathlib.Path(top) / str(number)
            folder.mkdir()
            records[name] = run_planner(command, limits, domain, problem, folder)
            if records[name]["outcome"] == "solved":
                solved.append((folder, records[name]))
        ordered = in_order(problem)
        if ordered:
            problem = pathlib.Path(top) / "ordered.pddl"
            problem.write_text(ordered)
        judge(judges, domain, problem, solved)
    return records


def read_results(files):
    """The records by problem and planner; the last one counts."""
    lines = [line for file in files if file.exists() for line in file.read_text().splitlines()]
    return {(record["problem"], record["planner"]): record for record in map(json.loads, lines)}


def run_all(arguments, work, commands):
    """Runs what is not there yet, and gives all there is."""
    own = [arguments.results] if arguments.results else []
    done = read_results(arguments.stored + own)
    limits = Limits(arguments)
    there = {} if arguments.again else read_results(own)
    there = {key for key, record in there.items() if record["outcome"] != "time" or record["limit"] >= limits.seconds}
    judges = [] if arguments.no_validation else [Judge(name) for name in arguments.judges.split(",")]
    for number, (_, name, domain, problem) in enumerate(work, 1):
        missing = {planner: command for planner, command in commands.items() if (name, planner) not in there}
        if missing:
            print(f"{number}/{len(work)} {name}", file=sys.stderr, flush=True)
        for planner, record in run_problem(missing, limits, judges, domain, problem).items() if missing else []:
            record = {"problem": name, "planner": planner, "limit": limits.seconds, "clock": limits.clock, **record}
            done[name, planner] = record
            if arguments.results:
                with open(arguments.results, "a") as out:
                    print(json.dumps(record), file=out)
    for other in judges:
        other.stop()
    return done


# The tables.


def table(titles, rows):
    print(f"| {' | '.join(titles)} |\n|---|{'---:|' * (len(titles) - 1)}")
    for row in rows:
        print(f"| {' | '.join(map(str, row))} |")
    print()


def coverage(work, planners, solved):
    """How many problems of each group each planner solves."""
    groups = collections.defaultdict(list)
    for group, name, *_ in work:
        groups[group].append(name)
        groups["**all**"].append(name)
    everything = groups.pop("**all**", [])
    for group, names in [*groups.items(), ("**all**", everything)]:
        yield [group, len(names)] + [sum((name, planner) in solved for name in names) for planner in planners]


def geometric(ratios):
    return f"{statistics.geometric_mean(ratios):.3f}" if ratios else "–"


def arithmetic(ratios):
    return f"{statistics.fmean(ratios):.3f}" if ratios else "–"


def relation(planner, reference, solved, invalid, clock):
    """A row: a planner's numbers divided by the reference's, over what both solve."""
    both = [(solved[name, planner], solved[name, reference]) for name, who in solved if who == planner]
    times = [[max(record[clock], 0.001) for record in pair] for pair in both]
    notable = [pair for pair in times if pair[1] > NOTABLE]
    costs = [[record["cost"] for record in pair] for pair in both]
    lengths = [[record["length"] for record in pair] for pair in both]
    row = [planner, len(both), geometric([ours / theirs for ours, theirs in times])]
    row += [len(notable), geometric([ours / theirs for ours, theirs in notable])]
    for values in [costs, lengths]:
        ratios = [ours / theirs for ours, theirs in values if ours and theirs]
        row += [geometric(ratios), arithmetic(ratios)]
    return [*row, invalid[planner]]


def report(arguments, work, done):
    """Prints the tables; whether all plans are valid."""
    names = {name for _, name, *_ in work}
    records = {key: record for key, record in done.items() if key[0] in names}
    planners = list(dict.fromkeys(planner for _, planner in records))
    solved = {key: record for key, record in records.items() if record["outcome"] == "solved"}
    invalid = collections.Counter(key[1] for key, record in records.items() if record["outcome"] == "invalid")
    table(["domain", "problems", *planners], coverage(work, planners, solved))
    reference, clock = arguments.reference, "cpu" if arguments.clock == "cpu" else "seconds"
    if reference in planners:
        others = [planner for planner in planners if planner != reference]
        titles = ["planner", "solved by both", "time", f"where it takes over {NOTABLE} s", "time there"]
        titles += ["cost", "cost (arithmetic)", "length", "length (arithmetic)", "invalid plans"]
        print(f"In relation to {reference}, by geometric means but where it says arithmetic:\n")
        comparable = {key: record for key, record in solved.items() if (key[0], reference) in solved}
        table(titles, [relation(planner, reference, comparable, invalid, clock) for planner in others])
    unjudged = collections.Counter(key[1] for key, record in solved.items() if "judge" not in record)
    for planner, count in unjudged.items():
        print(f"{planner}: {count} plans that nobody judged")
    for (name, planner), record in records.items():
        if record["outcome"] == "invalid":
            print(f"{planner}: {name}: no plan, says {record['judge']}: {record['why']}")
    return not invalid


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folders", nargs="+", metavar="FOLDER", help="a folder, or the name of an installed package")
    add("--planners", metavar="NAMES", help="which to run, with commas between (default: all that are there)")
    add("--planner", action="append", default=[], metavar="NAME=COMMAND", help="another one")
    add("--reference", default="fast-downward", metavar="NAME", help="whom to compare with (default: %(default)s)")
    add("--typelift", default=str(ROOT / "target/release/typelift"), metavar="FILE", help="the program typelift")
    add("--ferroplan", default="ff", metavar="FILE", help="ferroplan-cli's program (default: %(default)s)")
    add("--results", type=pathlib.Path, metavar="FILE", help="go on from this file, and add to it")
    add("--again", action="store_true", help="run what is in --results again")
    add("--stored", type=pathlib.Path, action="append", default=[], metavar="FILE", help="results only to be read")
    add("--quick", type=int, metavar="N", help="at most so many problems of a domain, spread evenly")
    add("--only", action="append", metavar="TEXT", help="only problems whose path has it in it")
    add("--time-limit", type=float, default=30, metavar="S", help="seconds a run (default: %(default)s)")
    add("--memory-limit", type=int, default=8000, metavar="MB", help="megabytes (default: %(default)s)")
    add("--clock", choices=["wall", "cpu"], default="wall", help="cpu for a machine that does other things as well")
    add("--core", type=int, metavar="N", help="run everything on this core")
    add("--judges", default=",".join(JUDGES), metavar="NAMES", help="in which order to ask (default: %(default)s)")
    add("--no-validation", action="store_true", help="believe the planners")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # So that a planner is ended with it.
    if arguments.core is not None:
        os.sched_setaffinity(0, {arguments.core})
    work = list(work_of(arguments))
    if not work:
        sys.exit("there are no problems")
    done = run_all(arguments, work, chosen_planners(arguments))
    return 0 if report(arguments, work, done) else 1


if __name__ == "__main__":
    sys.exit(main())
