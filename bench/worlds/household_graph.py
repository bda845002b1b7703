#!/usr/bin/env python3
"""VirtualHome's simulator of a household, a graph that evolves, as an `env/1` environment.

    pip install virtualhome-eval
    typelift run … --env 'python bench/worlds/household_graph.py'

A scenario names one of the package's programs, `{"program": "file1003_2"}`: the household is as it was before people's program
ran. A call is an action of such a program with the character before its objects, `[GRAB] <mouse> (1.413)` is
`grab(character_65, mouse_413)`. Refusals are the simulator's own words.

Nodes are objects of their class; their states and properties are atoms of one place, the edges of the graph atoms of two. Told
are the character, the rooms, the doors, the things of the program, and what these are on and in: some ten of 290 things, since
with all of them (`--whole`) too many actions would be possible for a plan to be found. Of CLOSE and FACING only the character's are
told: between things there are some 5,000 of them, which no action changes but by way of the character.
"""

import functools
import importlib.util
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from serving import Call, serve
from virtualhome_eval.simulation.evolving_graph.environment import EnvironmentGraph, EnvironmentState, Relation
from virtualhome_eval.simulation.evolving_graph.execution import ScriptExecutor
from virtualhome_eval.simulation.evolving_graph.scripts import Action, Script, ScriptLine, ScriptObject

LINE = re.compile(r"\[(\w+)\]")
OBJECT = re.compile(r"<(.+?)> \(\d+\.(\d+)\)")
OF_PLACE = ("CLOSE", "FACING")  # Relations that are told of the character only.
RESTING = ("ON", "INSIDE")
SHELL = ("Floor", "Floors", "Walls", "Ceiling")


@functools.cache
def programs() -> dict[str, Path]:
    """The programs that people wrote, by name; of those that are the same, the first."""
    spec = importlib.util.find_spec("virtualhome_eval")
    assert spec is not None and spec.submodule_search_locations
    folder = Path(spec.submodule_search_locations[0]) / "dataset" / "programs_processed_precond_nograb_morepreconds"
    by_text: dict[str, Path] = {}
    for file in sorted(folder.glob("executable_programs/*/*/*.txt")):
        by_text.setdefault(" ".join(lines(file)), file)
    return {file.stem: file for file in by_text.values()}


def lines(file: Path) -> list[str]:
    return [line.strip() for line in file.read_text().splitlines() if line.startswith("[")]


def calls(program: str) -> Iterator[tuple[str, list[tuple[str, int]]]]:
    """The actions of a program, each with the classes and numbers of its objects."""
    for line in lines(programs()[program]):
        action = LINE.match(line)
        assert action is not None
        yield action[1].lower(), [(name, int(number)) for name, number in OBJECT.findall(line)]


def household(program: str) -> dict[str, Any]:
    """The graph that a program begins with."""
    file = programs()[program]
    folder = file.parents[3] / "init_and_final_graphs" / file.parts[-3] / file.parts[-2]
    return json.loads((folder / f"{program}.json").read_text())["init_graph"]


class Household:
    """A household in which one character acts."""

    name = "virtualhome"

    def __init__(self, whole: bool = False) -> None:
        self.whole = whole

    def reset(self, seed: int, scenario: dict[str, Any]) -> None:
        self.graph = EnvironmentGraph(household(scenario["program"]))
        self.now = EnvironmentState(self.graph, {}, instance_selection=True)
        self.ids = {node.id: f"{node.class_name}_{node.id}" for node in self.graph.get_nodes()}
        self.nodes = {name: number for number, name in self.ids.items()}
        self.character = next(self.graph.get_nodes_by_attr("class_name", "character")).id
        self.told = set(self.ids) if self.whole else self.view(scenario["program"])

    def view(self, program: str) -> set[int]:
        """What a program is about."""
        everywhere = (node.id for node in self.graph.get_nodes() if node.category in ("Rooms", "Doors"))
        told = {self.character, *everywhere}
        beside = [number for _, objects in calls(program) for _, number in objects]
        while beside:
            number = beside.pop()
            if number not in told:
                told.add(number)
                below = (self.graph.get_node_ids_from(number, Relation[name]) for name in RESTING)
                beside += (each for ids in below for each in ids if self.graph.get_node(each).category not in SHELL)
        return told

    def state(self) -> dict[str, Any]:
        nodes = [self.now.get_node(number) for number in sorted(self.told)]
        atoms = {
            f"{word.name.lower()}({self.ids[node.id]})" for node in nodes for word in node.states | node.properties
        }
        for node in nodes:
            for relation in Relation:
                if relation.name not in OF_PLACE or node.id == self.character:
                    others = self.told.intersection(self.now.get_node_ids_from(node.id, relation))
                    atoms |= {f"{relation.name.lower()}({self.ids[node.id]},{self.ids[other]})" for other in others}
        return {"objects": {self.ids[node.id]: node.class_name for node in nodes}, "atoms": sorted(atoms)}

    def calls(self, program: str) -> Iterator[Call]:
        for name, objects in calls(program):
            yield name, [self.ids[self.character], *(self.ids[number] for _, number in objects)]

    def act(self, name: str, args: list[str]) -> str | None:
        if not args or self.nodes.get(args[0]) != self.character:
            return "only the character acts"
        action = Action.__members__.get(name.upper())
        if action is None or len(args) != action.value[1] + 1:
            return f"there is no action {name} of {len(args) - 1} objects"
        numbers = [self.nodes[argument] for argument in args[1:]]
        objects = [ScriptObject(self.graph.get_node(number).class_name, number) for number in numbers]
        executor = ScriptExecutor(self.graph, {})
        try:
            script = Script([ScriptLine(action, objects, 0)])
            done, self.now = executor.execute_one_step(script, self.now, in_place=True)
        except AssertionError as error:
            return str(error)
        if done:
            return None
        # All that matters is said before: … when executing "[GRAB] <mouse> (413) [0]".
        return executor.info.get_error_string().split(" when executing")[0] or "that is not possible"


if __name__ == "__main__":
    serve(Household(whole="--whole" in sys.argv))
