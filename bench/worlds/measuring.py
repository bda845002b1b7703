"""Learns from demonstrations, has typelift carry out tasks, and counts what is solved and what fails: without a memory, each task
as if it were the first, then twice with one memory.

Each task is a process of its own: what is known in the next one comes from the memory. What was measured stands in a file of
results, a line a task, and is not measured again: a measure that was stopped goes on where it was.
"""

import argparse
import hashlib
import json
import re
import shlex
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ALONE = "no memory"
PASSES = (ALONE, "first pass", "second pass")
SUCCEEDED, NOT_ACHIEVED = 0, 12


@dataclass(frozen=True)
class Task:
    """What is to be done, and in which column of the table it counts."""

    name: str
    group: str
    goal: list[str]
    scenario: dict[str, Any]
    seed: int = 0

    def write(self, folder: Path) -> Path:
        file = folder / f"{self.name}.json"
        file.parent.mkdir(parents=True, exist_ok=True)
        content = {"format": "task/1", "goal": self.goal, "scenario": self.scenario, "seed": self.seed}
        file.write_text(json.dumps(content) + "\n")
        return file


@dataclass(frozen=True)
class Setting:
    """What is known before the first task, and with which options tasks are carried out."""

    name: str
    demonstrations: Sequence[Path]
    options: tuple[str, ...] = ()


class Measure:
    """A measure in a folder: memories, tasks, events, results."""

    def __init__(
        self, arguments: argparse.Namespace, adapter: Sequence[str], types: Callable[[], dict[str, Any]]
    ) -> None:
        self.typelift, self.folder = arguments.typelift, arguments.folder
        self.task_limit = arguments.task_limit
        self.environment = shlex.join([sys.executable, *adapter])
        self.types = self.folder / "types.json"
        self.folder.mkdir(parents=True, exist_ok=True)
        if not self.types.exists():
            self.types.write_text(json.dumps(types(), sort_keys=True) + "\n")
        self._begin(adapter)

    def _begin(self, adapter: Sequence[str]) -> None:
        """Refuses to mix the results of one build or adapter with those of another."""
        files = (Path(self.typelift), Path(adapter[0]))
        about: dict[str, Any] = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}
        about["arguments"] = [Path(argument).name for argument in adapter[1:]]
        known = self.folder / "about.json"
        if not known.exists():
            known.write_text(json.dumps(about) + "\n")
        elif json.loads(known.read_text()) != about:
            sys.exit(
                f"{self.folder} holds the results of another build or adapter: take another --folder, or remove it"
            )

    def learn(self, demonstrations: Sequence[Path]) -> Path:
        """The model of some demonstrations."""
        model = self.folder / f"model-{len(demonstrations)}.json"
        if not model.exists():
            begun = time.monotonic()
            learn = [self.typelift, "learn", *demonstrations, "--types", self.types, "-o", model]
            said = subprocess.run(learn, check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
            transitions = next(line for line in said.splitlines() if "transitions" in line)
            print(f"{transitions}: learned in {time.monotonic() - begun:.1f} s", flush=True)
        return model

    def run(self, settings: Sequence[Setting], tasks: Sequence[Task]) -> list[dict[str, Any]]:
        """The results of all tasks, in all settings and passes: those that there are, and those that were missing."""
        file = self.folder / "results.jsonl"
        known = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
        results = {(result["setting"], result["pass"], result["task"]): result for result in known}
        asked = [(setting, number, task) for setting in settings for number in PASSES for task in tasks]
        with file.open("a") as out:
            for done, (setting, number, task) in enumerate(asked):
                key = (setting.name, number, task.name)
                if key not in results:
                    show(f"{done} of {len(asked)}: {setting.name}, {number}, {task.name}")
                    results[key] = self.carry_out(setting, number, task)
                    out.write(json.dumps(results[key]) + "\n")
                    out.flush()
        show("")
        return [results[setting.name, number, task.name] for setting, number, task in asked]

    def carry_out(self, setting: Setting, number: str, task: Task) -> dict[str, Any]:
        """Has a task carried out, and counts."""
        folder = self.folder / setting.name.replace(", ", "-").replace(" ", "-")
        events = folder / number.replace(" ", "-") / f"{task.name}.events"
        events.parent.mkdir(parents=True, exist_ok=True)
        memory = folder / "memory"
        known = ["--memory", memory] if number != ALONE else []
        known += [] if known and memory.exists() else [self.learn(setting.demonstrations)]
        command = [self.typelift, "run", *known, task.write(self.folder / "tasks"), "--env", self.environment]
        command += ["--events", events, "--time-limit", f"{self.task_limit}s", "--json", "-q"]
        begun = time.monotonic()
        ran = subprocess.run([*command, *setting.options], check=False, capture_output=True, text=True)
        if ran.returncode not in (SUCCEEDED, NOT_ACHIEVED):
            sys.exit(f"{shlex.join(map(str, command))}\nended with exit code {ran.returncode}:\n{ran.stderr}")
        account = json.loads(ran.stdout)
        steps = list(failed_steps(events))
        return {
            "setting": setting.name,
            "pass": number,
            "task": task.name,
            "group": task.group,
            "solved": account["solved"],
            "failed": len(steps),
            "refused": sum(step["result"] == "refused" for step in steps),
            "proposals": account["proposals"],
            "seconds": round(time.monotonic() - begun, 2),
            "ending": account["ending"],
            "why": account.get("why"),
            "failures": [f"{step['call']} {step['result']}: {step['reason'] or ''}".rstrip(": ") for step in steps],
        }


def failed_steps(events: Path) -> Iterator[dict[str, Any]]:
    """The steps that the world was told to do and that did not become what was expected; each retry counts."""
    for event in map(json.loads, events.read_text().splitlines()):
        if event["event"] == "stepped" and event["result"] not in ("as-expected", "rejected"):
            call = event["call"]
            said = f"{call['name']}({', '.join(call['args'])})"
            yield {"call": said, "result": event["result"], "reason": event.get("reason")}


def show(progress: str) -> None:
    if sys.stderr.isatty():
        print(f"\r\033[K{progress}", end="", file=sys.stderr, flush=True)


def table(results: Sequence[dict[str, Any]], groups: Sequence[str]) -> str:
    """A row a setting and pass: how many of each group of tasks are solved, and what they cost."""
    width = max(len(result["setting"]) for result in results) + len("  second pass")
    lines = [" " * width + "".join(f"{head:>12}" for head in (*groups, "all", "failed", "refused", "seconds"))]
    for setting in dict.fromkeys(result["setting"] for result in results):
        for number in PASSES:
            rows = [result for result in results if (result["setting"], result["pass"]) == (setting, number)]
            cells = [solved([row for row in rows if row["group"] == group]) for group in groups]
            sums = [sum(row[key] for row in rows) for key in ("failed", "refused", "seconds")]
            cells += [solved(rows), *(f"{each:.0f}" for each in sums)]
            lines.append(f"{setting}  {number}".ljust(width) + "".join(f"{cell:>12}" for cell in cells))
    return "\n".join(lines)


def solved(rows: Sequence[dict[str, Any]]) -> str:
    return f"{sum(row['solved'] for row in rows)}/{len(rows)}"


def options(description: str | None) -> argparse.ArgumentParser:
    """The options that both measures have."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("typelift", help="the program, such as target/release/typelift")
    parser.add_argument("--folder", type=Path, help="what is measured, to go on with [target/worlds/…]")
    parser.add_argument("--quick", action="store_true", help="few tasks, to see that it works")
    parser.add_argument("--task-limit", type=int, default=120, metavar="SECONDS", help="of one task [%(default)s]")
    parser.add_argument("--least", type=int, default=0, metavar="N", help="fail if a pass does fewer tasks than this")
    parser.add_argument("--explain", action="store_true", help="say why tasks were not solved, and what failed")
    return parser


def parse(parser: argparse.ArgumentParser, name: str) -> argparse.Namespace:
    """What the user wants. A quick look has a folder of its own, so that no memory is of both."""
    arguments = parser.parse_args()
    if arguments.folder is None:
        arguments.folder = Path("target", "worlds", f"{name}-quick" if arguments.quick else name)
    return arguments


def report(results: Sequence[dict[str, Any]], groups: Sequence[str], arguments: argparse.Namespace) -> None:
    """Prints what came of it, and fails where too little did."""
    if arguments.explain:
        print("\n".join([*explain(results), *kinds(results)]))
    print(table(results, groups))
    done = Counter((result["setting"], result["pass"]) for result in results if result["solved"])
    for setting, number in dict.fromkeys((result["setting"], result["pass"]) for result in results):
        if done[setting, number] < arguments.least:
            sys.exit(f"{setting}, {number}: fewer than {arguments.least} done")


def explain(results: Sequence[dict[str, Any]]) -> Iterator[str]:
    """What did not go well, task by task."""
    for result in results:
        if not result["solved"] or result["failures"]:
            ending = "solved" if result["solved"] else f"{result['ending']}: {result['why']}"
            yield f"{result['setting']}, {result['pass']}, {result['task']}: {ending}"
            yield from (f"    {failure}" for failure in result["failures"])


def kinds(results: Sequence[dict[str, Any]]) -> Iterator[str]:
    """How often which actions failed for which reason, whatever things they were done to."""
    for setting, number in dict.fromkeys((result["setting"], result["pass"]) for result in results):
        rows = [result for result in results if (result["setting"], result["pass"]) == (setting, number)]
        failures = [failure for row in rows for failure in row["failures"]]
        counts = Counter(re.sub(r"<\w+> \(\d+\)", "_", re.sub(r"\(.*?\)", "", each, count=1)) for each in failures)
        yield from (f"{setting}, {number}: {count} {kind}" for kind, count in counts.most_common())
