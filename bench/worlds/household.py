#!/usr/bin/env python3
"""A household that nobody here wrote: learned from programs that people wrote for VirtualHome, tried on classes never touched.

    pip install virtualhome-eval
    cargo build --release
    python bench/worlds/household.py target/release/typelift

Learns from the programs that touch none of a dozen classes, and has typelift do 72 things with one goal each, 24 each of picking
up, opening and switching on, 60 of them on those classes; then once more with the same memory. Printed is how many are
done, and how many steps failed on the way: refused by the simulator, or not as expected.

The classes and the tasks stand in `household.json`; `--choose` draws the tasks anew. A task is something that a program does: it
begins as the program begins, and its goal is what became of the object that the program picked up, opened or switched on.
"""

import json
import random
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from household_graph import Household, calls, household, programs
from measuring import Measure, Setting, Task, options, parse, report
from serving import reaches, record

HERE = Path(__file__).parent
LIST = HERE / "household.json"
ACTIONS = {"pick up": "grab", "open": "open", "switch on": "switchon"}
ON_HELD_OUT, ON_SEEN = 20, 4  # Tasks of each kind.


def goal_of(kind: str, thing: str, character: str) -> str:
    return {"pick up": f"holds_rh({character},{thing})", "open": f"open({thing})", "switch on": f"on({thing})"}[kind]


def choose(held_out: dict[str, list[str]]) -> Iterator[dict[str, str]]:
    """Tasks, drawn from what programs do, no two alike, as evenly over the classes as there are programs."""
    chance = random.Random("household")
    apart = {name for names in held_out.values() for name in names}
    for kind, action in ACTIONS.items():
        by_class: dict[str, list[dict[str, str]]] = defaultdict(list)
        for program in programs():
            done = dict.fromkeys(objects[0] for name, objects in calls(program) if name == action)
            for name, number in done:
                by_class[name].append({"kind": kind, "program": program, "thing": f"{name}_{number}"})
        seen = sorted(set(by_class) - apart, key=lambda name: (-len(by_class[name]), name))
        for names, count in ((held_out[kind], ON_HELD_OUT), (seen, ON_SEEN)):
            pools = [chance.sample(by_class[name], len(by_class[name])) for name in names]
            in_turn = (pool[turn] for turn in range(max(map(len, pools))) for pool in pools if turn < len(pool))
            yield from islice(filter(is_task, in_turn), count)


def is_task(task: dict[str, str]) -> bool:
    """Whether it is yet to be done where its program begins, and done by it: a thing may be picked up with the other hand."""
    home = Household()
    home.reset(0, {"program": task["program"]})
    goal = goal_of(task["kind"], task["thing"], home.ids[home.character])
    return goal not in home.state()["atoms"] and reaches(home, home.calls(task["program"]), [goal])


def types(names: Iterable[str]) -> dict[str, list[str]]:
    """The categories of each class, as the graphs name them."""
    categories: dict[str, set[str]] = defaultdict(set)
    for program in names:
        for node in household(program)["nodes"]:
            categories[node["class_name"]].add(f"any_{node['category'].lower()}")
    inner = {category: ["object"] for named in categories.values() for category in named}
    return {**inner, **{name: sorted(named) for name, named in categories.items()}}


def demonstrate(home: Household, folder: Path, names: Iterable[str]) -> list[Path]:
    """The programs, as traces."""
    traces = []
    folder.mkdir(parents=True, exist_ok=True)
    for program in names:
        trace = folder / f"{program}.jsonl"
        if not trace.exists():
            home.reset(0, {"program": program})
            record(home, trace, [], home.calls(program))
        traces.append(trace)
    return traces


def write_list(held_out: dict[str, list[str]]) -> None:
    """Draws the tasks, and writes them below the classes, one a line."""
    tasks = ",\n    ".join(json.dumps(task) for task in choose(held_out))
    classes = ",\n    ".join(f"{json.dumps(kind)}: {json.dumps(names)}" for kind, names in held_out.items())
    LIST.write_text(f'{{\n  "held_out": {{\n    {classes}\n  }},\n  "tasks": [\n    {tasks}\n  ]\n}}\n')


def pose(home: Household, listed: Iterable[dict[str, str]]) -> Iterator[Task]:
    """The tasks of the list, each of which people's program does."""
    for each in listed:
        home.reset(0, {"program": each["program"]})
        goal = goal_of(each["kind"], each["thing"], home.ids[home.character])
        if not reaches(home, home.calls(each["program"]), [goal]):
            sys.exit(f"{each['program']}: the program itself does not reach {goal}")
        name = f"{each['kind'].replace(' ', '_')}-{each['thing']}-{each['program']}"
        yield Task(name, each["kind"], [goal], {"program": each["program"]})


def main() -> None:
    parser = options(__doc__)
    parser.add_argument("--choose", action="store_true", help="draw the tasks anew, and do no more")
    parser.add_argument("--whole", action="store_true", help="tell all things of a household, in a --folder of its own")
    arguments = parse(parser, "household")
    listed: dict[str, Any] = json.loads(LIST.read_text())
    if arguments.choose:
        write_list(listed["held_out"])
        return

    home = Household(arguments.whole)
    tasks = list(pose(home, listed["tasks"][::12] if arguments.quick else listed["tasks"]))
    apart = {name for names in listed["held_out"].values() for name in names}
    shown = [name for name in programs() if apart.isdisjoint(each for _, objects in calls(name) for each, _ in objects)]
    demonstrations = demonstrate(home, arguments.folder / "demonstrations", shown)

    used = [*shown, *(task.scenario["program"] for task in tasks)]
    adapter = [str(HERE / "household_graph.py"), *(["--whole"] if arguments.whole else [])]
    measure = Measure(arguments, adapter, lambda: types(used))
    settings = [
        Setting(f"{len(demonstrations)} programs{', imagining' if imagining else ''}", demonstrations, imagining)
        for imagining in (((),) if arguments.quick else ((), ("--imagine",)))
    ]
    report(measure.run(settings, tasks), list(ACTIONS), arguments)


if __name__ == "__main__":
    main()
