#!/usr/bin/env python3
"""Has typelift plan every problem of some Python packages, and others judge its plans.

    pip install unified-planning pymimir fast-downward-translate up-fast-downward amlgym pddlgym
    python bench/confirm_plans.py target/release/typelift amlgym pddlgym --results results.jsonl

Each plan, and some that are made from it by dropping a step, swapping two, or putting another object in the place of
one, is judged by `typelift validate` and by unified-planning's validator; where that one cannot read the files, by
mimir's successors, or by executing what Fast Downward's translator makes of them. All have to agree, on the cost too.
What typelift calls unsolvable, Fast Downward has to; what typelift does not read, Fast Downward's translator may not.

Prints a Markdown table, then every disagreement. Exit code 1 if there is one. With --results, each problem is a line of
that file, and problems that are in it already are not planned again.
"""

import argparse
import collections
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time
from importlib.util import find_spec

from judges import JUDGE_SECONDS, JUDGES, Judge, in_order, steps_of
from problems import folder_of, pairs

KNOWN_EXITS = {0: "solved", 11: "unsolvable", 12: "limit", 22: "limit", 23: "limit", 31: "refused", 34: "refused"}

# Mutants.


def mutants(steps, seed):
    """Plans that differ a little, each with what was done to it."""
    choose = random.Random(seed)
    if not steps:
        return
    gone = choose.randrange(len(steps))
    yield f"without step {gone + 1}", steps[:gone] + steps[gone + 1 :]
    different = [i for i in range(1, len(steps)) if steps[i] != steps[i - 1]]
    if different:
        at = choose.choice(different)
        yield f"steps {at} and {at + 1} swapped", [*steps[: at - 1], steps[at], steps[at - 1], *steps[at + 1 :]]
    objects = sorted({thing for step in steps for thing in step[1:]})
    places = [(i, k) for i, step in enumerate(steps) for k in range(1, len(step))]
    if len(objects) > 1:
        i, k = choose.choice(places)
        other = choose.choice([thing for thing in objects if thing != steps[i][k]])
        changed = [*steps[i][:k], other, *steps[i][k + 1 :]]
        yield f"{other} in step {i + 1}", [*steps[:i], changed, *steps[i + 1 :]]


# One problem.


class Confirmation:
    """What is needed to plan and to have judged."""

    def __init__(self, arguments):
        self.typelift, self.arguments = arguments.typelift, arguments
        self.judges = [Judge(name) for name in JUDGES]

    def run(self, domain, problem, name):
        with tempfile.TemporaryDirectory() as folder:
            return {"problem": name, **self.record(domain, problem, name, pathlib.Path(folder))}

    def record(self, domain, problem, name, folder):
        plan = folder / "plan"
        limits = ["--time-limit", f"{self.arguments.time_limit}s", "--memory-limit", str(self.arguments.memory_limit)]
        begun = time.monotonic()
        command = [self.typelift, "-q", "plan", domain, problem, "-o", plan, *limits]
        ended = subprocess.run(command, capture_output=True, text=True)
        seconds = time.monotonic() - begun
        outcome = KNOWN_EXITS.get(ended.returncode, "defect")
        record = {"exit": ended.returncode, "outcome": outcome, "seconds": round(seconds, 3), "disagreements": []}
        last = " ".join(ended.stderr.split())[:300]
        if outcome == "defect":
            record["disagreements"].append(f"exit {ended.returncode}: {last}")
        elif outcome == "refused":
            record["refusal"] = last
            answers = [(judge.name, judge.ask(domain, problem, [])) for judge in self.judges]
            record["readers"] = [name for name, answer in answers if not isinstance(answer, str)]
            if "Fast Downward" in record["readers"]:
                record["disagreements"].append(f"Fast Downward reads what typelift refuses: {last}")
        elif outcome == "unsolvable":
            other = self.fast_downward(domain, problem, folder)
            record["confirmed"] = "Fast Downward" if other == 11 else None
            if other == 0:
                record["disagreements"].append("Fast Downward solves what typelift calls unsolvable")
        elif outcome == "solved":
            self.judge(domain, problem, name, plan, record)
        # A limit is overstepped by a tenth at most, and the time that ending takes.
        if seconds > 1.1 * self.arguments.time_limit + 0.5:
            record["late"] = True
        return record

    def judge(self, domain, problem, name, plan, record):
        files, changes = [plan], ["the plan"]
        for change, steps in mutants(steps_of(plan), name):
            changes.append(change)
            files.append(plan.with_suffix(f".{len(files)}"))
            files[-1].write_text("".join(f"({' '.join(step)})\n" for step in steps))
        command = [self.typelift, "validate", "--json", domain, problem, *files]
        ended = subprocess.run(command, capture_output=True, text=True)
        ours = [json.loads(line) for line in ended.stdout.splitlines()]
        if len(ours) != len(files):
            record["disagreements"].append(f"validate: exit {ended.returncode}: {ended.stderr[:200]}")
            return
        record["mutants"] = len(files) - 1
        ordered = in_order(problem)
        if ordered:
            problem = plan.with_suffix(".pddl")
            problem.write_text(ordered)
            record["reordered"] = True
        record["valid mutants"] = sum(verdict["valid"] for verdict in ours[1:])
        for judge in self.judges:
            theirs = judge.ask(domain, problem, files)
            if isinstance(theirs, str):
                record.setdefault("cannot tell", {})[judge.name] = theirs
                continue
            differing = list(differences(judge.name, changes, ours, theirs))
            record["disagreements"] += differing
            record["confirmed"] = judge.name if ours[0]["valid"] and theirs[0][0] else None
            if not differing:
                break
        if not ours[0]["valid"]:
            record["disagreements"].append(f"typelift validate: {ours[0]['reason']}")

    def fast_downward(self, domain, problem, folder):
        driver = pathlib.Path(find_spec("up_fast_downward").origin).parent / "downward" / "fast-downward.py"
        files = ["--plan-file", folder / "other", "--sas-file", folder / "sas", domain, problem]
        limit = ["--overall-time-limit", f"{JUDGE_SECONDS}s"]
        command = [sys.executable, driver, *limit, *files, "--search", "astar(blind())"]
        ended = subprocess.run(list(map(str, command)), capture_output=True)
        # 10 is the translator's, for what cannot be reached at all; blind search that has seen every state exits as if it had not.
        proved = ended.returncode == 10 or b"Completely explored state space" in ended.stdout
        return 11 if proved else ended.returncode


def differences(judge, changes, ours, theirs):
    for change, verdict, (valid, cost, why) in zip(changes, ours, theirs):
        if verdict["valid"] != valid:
            yield f"{change}: typelift: {verdict.get('reason', 'valid')}; {judge}: {why or 'valid'}"
        elif valid and cost is not None and cost != str(verdict["value"]):
            yield f"{change}: typelift: cost {verdict['value']}; {judge}: cost {cost}"


# All of them.


def work_of(arguments):
    """The problems: a group, a domain, a file, a name."""
    first = arguments.first
    for package in arguments.packages:
        folder = folder_of(package)
        taken = collections.Counter()
        for path, domain in pairs(folder):
            if domain is None or path == domain or not any(part in str(path) for part in arguments.only or [""]):
                continue
            group = f"{folder.name} {domain.stem}"
            taken[group, path.parent] += 1
            if first is None or taken[group, path.parent] <= first:
                yield group, domain, path, f"{folder.name}/{path.relative_to(folder)}"


def run_all(arguments, work, done, results):
    lock, queue = threading.Lock(), iter(work)

    def worker():
        confirmation = Confirmation(arguments)
        while True:
            with lock:
                job = next(queue, None)
            if job is None:
                break
            _, domain, problem, name = job
            if name in done:
                continue
            record = confirmation.run(domain, problem, name)
            with lock:
                done[name] = record
                if results:
                    print(json.dumps(record), file=results, flush=True)
        for judge in confirmation.judges:
            judge.stop()

    threads = [threading.Thread(target=worker) for _ in range(arguments.jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def report(work, done):
    columns = ["problems", "solved"] + [f"confirmed by {name}" for name in JUDGES] + ["by nobody", "mutants"]
    columns += ["unsolvable", "of these confirmed", "limit", "refused", "disagreements", "seconds"]
    print(f"| domain | {' | '.join(columns)} |\n|---|{'---:|' * len(columns)}")
    groups = collections.defaultdict(list)
    for group, _, _, name in work:
        groups[group].append(done[name])
        groups[f"**{group.split()[0]}**"].append(done[name])
    for group, records in groups.items():
        numbers = [len(records), sum(r["outcome"] == "solved" for r in records)]
        solved = [r for r in records if r["outcome"] == "solved"]
        numbers += [sum(r.get("confirmed") == judge for r in solved) for judge in JUDGES]
        numbers += [sum(not r.get("confirmed") for r in solved), sum(r.get("mutants", 0) for r in solved)]
        unsolvable = [r for r in records if r["outcome"] == "unsolvable"]
        numbers += [len(unsolvable), sum(bool(r["confirmed"]) for r in unsolvable)]
        numbers += [sum(r["outcome"] == outcome for r in records) for outcome in ["limit", "refused"]]
        numbers += [sum(bool(r["disagreements"]) for r in records), round(sum(r["seconds"] for r in records))]
        print(f"| {group} | {' | '.join(map(str, numbers))} |")
    bad = [done[name] for _, _, _, name in work if done[name]["disagreements"]]
    for record in bad:
        for disagreement in record["disagreements"]:
            print(f"\n- {record['problem']}: {disagreement}", end="")
    print()
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("typelift", help="the program")
    parser.add_argument("packages", nargs="+", help="folders, or names of installed packages")
    parser.add_argument("--time-limit", type=float, default=2, metavar="S", help="seconds a problem (default: 2)")
    parser.add_argument("--memory-limit", type=int, default=1000, metavar="MB", help="megabytes (default: 1000)")
    parser.add_argument("--jobs", type=int, default=2, help="problems at a time (default: 2)")
    parser.add_argument("--first", type=int, metavar="N", help="only so many problems of each folder")
    parser.add_argument("--only", action="append", metavar="TEXT", help="only files whose path has it in it")
    parser.add_argument("--results", metavar="FILE", help="go on from this file, and add to it")
    arguments = parser.parse_args()
    work = list(work_of(arguments))
    done = {}
    if arguments.results:
        path = pathlib.Path(arguments.results)
        lines = path.read_text().splitlines() if path.exists() else []
        done = {record["problem"]: record for record in map(json.loads, lines)}
    results = open(arguments.results, "a") if arguments.results else None
    run_all(arguments, work, done, results)
    return report(work, done)


if __name__ == "__main__":
    sys.exit(main())
