#!/usr/bin/env python3
"""Those who say whether a plan is one: programs that nobody here wrote.

unified-planning's validator reads most; where it does not read the files, mimir's successors tell, or executing what Fast
Downward's translator makes of them. Each is a process of its own, which answers on its standard output what it is asked
on its standard input: it may die, or never end.
"""

import collections
import json
import pathlib
import select
import subprocess
import sys
import tempfile

from problems import text_of

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
            command = [sys.executable, __file__, self.name]
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


if __name__ == "__main__":
    serve(sys.argv[1])
