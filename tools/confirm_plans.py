#!/usr/bin/env python3
"""Has typelift plan every problem of some Python packages, and others judge its plans.

    pip install unified-planning pymimir fast-downward-translate up-fast-downward amlgym pddlgym
    python tools/confirm_plans.py target/release/typelift amlgym pddlgym --results results.jsonl

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
import select
import subprocess
import sys
import tempfile
import threading
import time
from importlib.util import find_spec

from pddl_corpus import folder_of, pairs, text_of

KNOWN_EXITS = {0: "solved", 11: "unsolvable", 12: "limit", 22: "limit", 23: "limit", 31: "refused", 34: "refused"}
JUDGES = ["unified-planning", "mimir", "Fast Downward"]
JUDGE_SECONDS = 300


# Sections of a problem in the order that other readers insist on.

ORDER = [":domain", ":requirements", ":objects", ":init", ":goal", ":metric"]


def in_order(problem):
    """The text of a problem whose sections stand in the usual order; None if they do."""
    text = text_of(problem)
    sections, depth, start = [], 0, 0
    for at, sign in enumerate(text):
        if sign == "(":
            start = at if depth == 1 else start
            depth += 1
        elif sign == ")":
            depth -= 1
            if depth == 1:
                sections.append(text[start : at + 1])
    names = [section.strip("( \n\t").split(None, 1)[0].lower() for section in sections]
    places = [ORDER.index(name) if name in ORDER else -1 for name in names]
    if places == sorted(places):
        return None
    ordered = [section for _, section in sorted(zip(places, sections), key=lambda pair: pair[0])]
    return "(define\n" + "\n".join(ordered) + ")\n"


# Judges run in a process of their own: they may die, or never end.


def steps_of(plan):
    lines = pathlib.Path(plan).read_text().splitlines()
    return [line.strip("() ").lower().split() for line in lines if line.strip() and not line.startswith(";")]


def judge_with_unified_planning(domain, problem, plans):
    import fractions
    import warnings

    import unified_planning.shortcuts as up
    from unified_planning.engines import SequentialPlanValidator
    from unified_planning.io import PDDLReader

    warnings.simplefilter("ignore")
    environment = up.get_environment()
    environment.credits_stream = None
    environment.error_used_name = False
    reader = PDDLReader()
    problem = reader.parse_problem(domain, problem)
    validator = SequentialPlanValidator()
    validator.skip_checks = True
    verdicts = []
    for plan in plans:
        try:
            plan = reader.parse_plan(problem, plan)
        except Exception as error:  # An object of a wrong type, for instance.
            verdicts.append([False, None, f"{type(error).__name__}: {error}"])
            continue
        result = validator.validate(problem, plan)
        cost = None
        if result:
            values = list((result.metric_evaluations or {}).values())
            cost = str(fractions.Fraction(str(values[0]))) if values else str(len(plan.actions))
        verdicts.append([bool(result), cost, " ".join(m.message for m in result.log_messages or [])])
    return verdicts


def judge_with_mimir(domain, problem, plans):
    import pymimir

    domain = pymimir.Domain(domain)
    problem = pymimir.Problem(domain, problem)
    verdicts = []
    for plan in plans:
        state, why = problem.get_initial_state(), None
        for name, *args in steps_of(plan):
            calls = {
                (call.get_action().get_name(), *(thing.get_name() for thing in call.get_objects())): call
                for call in state.generate_applicable_actions(False)
            }
            call = calls.get((name, *args))
            if call is None:
                why = f"{name} {' '.join(args)} is not applicable"
                break
            state = call.apply(state)
        if why is None and not problem.get_goal_condition().holds(state):
            why = "the goal does not hold"
        verdicts.append([why is None, None, why])
    return verdicts


class Translated:
    """A task as Fast Downward's translator writes it, every operator kept."""

    def __init__(self, lines):
        self.lines = iter(lines)
        self.skip_to("begin_metric")
        self.has_costs = next(self.lines) == "1"
        next(self.lines)
        self.layers = [self.variable() for _ in range(int(next(self.lines)))]
        self.skip_to("begin_state")
        self.init = [int(next(self.lines)) for _ in self.layers]
        self.skip_to("begin_goal")
        self.goal = self.pairs()
        next(self.lines)
        self.operators = collections.defaultdict(list)
        for _ in range(int(next(self.lines))):
            name, operator = self.operator()
            self.operators[name].append(operator)
        self.rules = sorted((self.rule() for _ in range(int(next(self.lines)))), key=lambda rule: rule[0])

    def skip_to(self, line):
        while next(self.lines) != line:
            pass

    def numbers(self):
        return list(map(int, next(self.lines).split()))

    def pairs(self):
        return [self.numbers() for _ in range(int(next(self.lines)))]

    def variable(self):
        """Its layer, -1 if it is not derived."""
        next(self.lines), next(self.lines)
        layer = int(next(self.lines))
        self.skip_to("end_variable")
        return layer

    def operator(self):
        next(self.lines)
        name, condition, effects = tuple(next(self.lines).split()), self.pairs(), []
        for _ in range(int(next(self.lines))):
            count, *rest = self.numbers()
            variable, before, after = rest[2 * count :]
            if before != -1:
                condition.append([variable, before])
            effects.append((list(zip(rest[: 2 * count : 2], rest[1 : 2 * count : 2])), variable, after))
        cost = int(next(self.lines))
        next(self.lines)
        return name, (condition, effects, cost if self.has_costs else 1)

    def rule(self):
        next(self.lines)
        condition = self.pairs()
        variable, _, after = self.numbers()
        next(self.lines)
        return self.layers[variable], condition, variable, after

    def close(self, state):
        """Derived variables follow from the others, layer by layer."""
        state = [value if layer == -1 else start for value, layer, start in zip(state, self.layers, self.init)]
        for layer in sorted({rule[0] for rule in self.rules}):
            rules, changed = [rule for rule in self.rules if rule[0] == layer], True
            while changed:
                changed = False
                for _, condition, variable, after in rules:
                    if state[variable] != after and holds(condition, state):
                        state[variable], changed = after, True
        return state

    def judge(self, steps):
        state, cost = self.close(self.init), 0
        for step in steps:
            usable = [o for o in self.operators.get(tuple(step), []) if holds(o[0], state)]
            if not usable:
                return [False, None, f"{' '.join(step)} is not applicable"]
            after = list(state)
            for condition, variable, value in usable[0][1]:
                if holds(condition, state):
                    after[variable] = value
            state, cost = self.close(after), cost + usable[0][2]
        return [True, str(cost), None] if holds(self.goal, state) else [False, None, "the goal does not hold"]


def holds(condition, state):
    return all(state[variable] == value for variable, value in condition)


def judge_with_fast_downward(domain, problem, plans):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "sas"
        options = ["--keep-no-ops", "--keep-unimportant-variables", "--invariant-generation-max-candidates", "0"]
        command = [sys.executable, "-m", "fast_downward.translate", domain, problem, "--sas-file", file, *options]
        ended = subprocess.run(command, capture_output=True, text=True)
        if ended.returncode != 0:
            raise ValueError(" ".join((ended.stdout + ended.stderr).split())[-200:])
        task = Translated(file.read_text().splitlines())
    return [task.judge(steps_of(plan)) for plan in plans]


def serve(name):
    """Answers questions, a line each."""
    functions = [judge_with_unified_planning, judge_with_mimir, judge_with_fast_downward]
    judge = dict(zip(JUDGES, functions))[name]
    answers, sys.stdout = sys.stdout, sys.stderr
    sys.setrecursionlimit(100_000)
    for line in sys.stdin:
        try:
            answer = judge(**json.loads(line))
        except BaseException as error:
            answer = f"{type(error).__name__}: {error}"[:300]
        print(json.dumps(answer), file=answers, flush=True)


class Judge:
    """A process that judges plans."""

    def __init__(self, name):
        self.name, self.process = name, None

    def ask(self, domain, problem, plans):
        """For each plan whether it is valid, its cost, and why not; or a text that says why nobody can tell."""
        if self.process is None:
            command = [sys.executable, __file__, "--serve", self.name]
            pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
            self.process = subprocess.Popen(command, text=True, **pipes)
        question = {"domain": str(domain), "problem": str(problem), "plans": [str(plan) for plan in plans]}
        print(json.dumps(question), file=self.process.stdin, flush=True)
        ready, _, _ = select.select([self.process.stdout], [], [], JUDGE_SECONDS)
        answer = self.process.stdout.readline() if ready else ""
        if answer:
            return json.loads(answer)
        self.stop()
        return "it died" if ready else f"no answer in {JUDGE_SECONDS} s"

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None


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
    if sys.argv[1:2] == ["--serve"]:
        return serve(sys.argv[2])
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
