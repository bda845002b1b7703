#!/usr/bin/env python3
"""A small workshop: pieces are loaded into machines, and a machine works when the switch wired to it is pressed.

    workshop.py [--no-robot]                    an environment: answers env/1 requests on standard input
    workshop.py [--no-robot] demonstrate DIR    writes types.pddl, demonstrations and tasks into DIR

With a robot (the default) every action names it first: pick and put(robot, piece), load and unload(robot, machine,
piece), press(robot, switch). With --no-robot nobody acts in the state: load and unload(machine, piece) move pieces
between rack and machine, press(switch) is all that is said to start one. Python 3.8 or later; standard library only.
"""
import json
import pathlib
import random
import sys

# Every type with its parent; below `object` there are up to five levels.
TYPES = {
    "entity": "object",
    "robot": "entity", "equipment": "entity", "piece": "entity",
    "switch": "equipment", "machine": "equipment",
    "cutting_machine": "machine", "painting_machine": "machine", "drying_machine": "machine",
    "saw": "cutting_machine", "laser": "cutting_machine",
    "sprayer": "painting_machine", "dip_tank": "painting_machine",
    "oven": "drying_machine", "fan": "drying_machine",
    "wooden": "piece", "metal": "piece",
    "plank": "wooden", "beam": "wooden", "dowel": "wooden",
    "rod": "metal", "sheet": "metal",
}  # fmt: skip

# What each kind of machine does: the attribute of the piece that changes, from which value to which.
WORK = {
    "cutting_machine": ("shape", "Whole", "Cut"),
    "painting_machine": ("paint", "Bare", "Wet"),
    "drying_machine": ("paint", "Wet", "Dry"),
}
UNSUITABLE = {("saw", "sheet")}  # a saw does not cut thin metal

DEFAULT = {
    "machines": ["saw", "laser", "sprayer", "dip_tank", "oven", "fan"],
    "pieces": ["plank", "beam", "dowel", "rod", "sheet"],
    "broken": [],  # machines, such as saw_1, that do nothing when they are started; nothing shows it
}


class Refused(Exception):
    """The action cannot be done now; nothing changed."""


class Workshop:
    def __init__(self, with_robot):
        self.with_robot = with_robot
        self.types = {}  # no reset yet

    def reset(self, scenario, seed):
        """Sets up the workshop. The seed decides the wiring of the switches and the places on the rack."""
        unknown = set(scenario) - set(DEFAULT)
        if unknown:
            raise ValueError(f"the scenario has unknown fields: {', '.join(sorted(unknown))}")
        scenario = {**DEFAULT, **scenario}
        for field, parents in (("machines", set(WORK)), ("pieces", {"wooden", "metal"})):
            for kind in scenario[field]:
                if TYPES.get(kind) not in parents:
                    raise ValueError(f"in the scenario, {field}: there is no `{kind}`")
        machines = numbered(scenario["machines"])
        pieces = numbered(scenario["pieces"])
        for machine in scenario["broken"]:
            if machine not in machines:
                raise ValueError(f"in the scenario, broken: there is no machine `{machine}`")
        chance = random.Random(seed)
        wired = chance.sample(list(machines), len(machines))
        slots = chance.sample(range(len(pieces)), len(pieces))
        self.types = {**machines, **pieces}
        self.broken = set(scenario["broken"])
        self.wired = {f"switch_{i + 1}": machine for i, machine in enumerate(wired)}
        self.slot = dict(zip(pieces, slots))
        self.inside = dict.fromkeys(machines)  # the piece in each machine, or None
        self.done = dict.fromkeys(machines, False)  # whether the machine has worked on it
        self.piece = {piece: {"shape": "Whole", "paint": "Bare"} for piece in pieces}
        self.held = None  # what the robot holds

    def on_rack(self, piece):
        return piece != self.held and piece not in self.inside.values()

    def snapshot(self):
        """Everything that can be seen. That a machine is broken cannot."""
        entities = []

        def entity(name, kind, attributes, relations):
            entities.append({"id": name, "type": kind, "attributes": attributes, "relations": relations})

        if self.with_robot:
            entity("robot_1", "robot", {}, {"holding": self.held})
        for switch, machine in self.wired.items():
            entity(switch, "switch", {}, {"wired_to": [machine]})
        for machine, piece in self.inside.items():
            entity(machine, self.types[machine], {"status": "Done" if self.done[machine] else "Ready"}, {"load": piece})
        for piece, look in self.piece.items():
            on_rack = self.on_rack(piece)
            attributes = {**look, "on_rack": on_rack, **({"slot": self.slot[piece]} if on_rack else {})}
            entity(piece, self.types[piece], attributes, {})
        return {"entities": entities}

    # The actions. Each either happens or raises Refused before anything has changed.

    def act(self, name, args):
        if not self.types:
            raise ValueError("the workshop has not been set up: reset comes first")
        if self.with_robot:
            need(args[:1] == ["robot_1"], "the first argument is who acts: robot_1")
            args = args[1:]
        names = {"load": 2, "unload": 2, "press": 1, **({"pick": 1, "put": 1} if self.with_robot else {})}
        need(name in names, f"there is no action {name}")
        need(len(args) == names[name], f"{name} has {names[name]} arguments besides who acts, not {len(args)}")
        need(all(isinstance(arg, str) for arg in args), "arguments are names")
        getattr(self, name)(*args)

    def pick(self, piece):
        need(piece in self.piece, f"{piece} is no piece")
        need(self.held is None, f"robot_1 already holds {self.held}")
        need(self.on_rack(piece), f"{piece} is not on the rack")
        self.held = piece

    def put(self, piece):
        need(self.held == piece, f"robot_1 does not hold {piece}")
        self.held = None

    def load(self, machine, piece):
        need(machine in self.inside, f"{machine} is no machine")
        need(piece in self.piece, f"{piece} is no piece")
        if self.with_robot:
            need(self.held == piece, f"robot_1 does not hold {piece}")
        else:
            need(self.on_rack(piece), f"{piece} is not on the rack")
        need(self.inside[machine] is None, f"{machine} already holds {self.inside[machine]}")
        self.inside[machine], self.held = piece, None

    def unload(self, machine, piece):
        need(machine in self.inside, f"{machine} is no machine")
        need(self.inside[machine] == piece, f"{piece} is not in {machine}")
        need(self.held is None, f"robot_1 already holds {self.held}")
        self.inside[machine], self.done[machine] = None, False
        if self.with_robot:
            self.held = piece

    def press(self, switch):
        """Starts the machine wired to the switch. Neither it nor the piece in it is named."""
        need(switch in self.wired, f"{switch} is no switch")
        machine = self.wired[switch]
        piece = self.inside[machine]
        need(piece is not None, f"{machine} is empty")
        need(not self.done[machine], f"{machine} is done with {piece}")
        if machine in self.broken:
            return  # it was pressed, but nothing happens
        need((self.types[machine], self.types[piece]) not in UNSUITABLE, f"{machine} does not take {piece}")
        attribute, before, after = WORK[TYPES[self.types[machine]]]
        need(self.piece[piece][attribute] == before, f"{piece} is {self.piece[piece][attribute]}, not {before}")
        self.piece[piece][attribute] = after
        self.done[machine] = True


def need(condition, reason):
    if not condition:
        raise Refused(reason)


def numbered(kinds):
    """Names such as saw_1 and saw_2 for a list of types, with their types."""
    names = {}
    for kind in kinds:
        names[f"{kind}_{1 + list(names.values()).count(kind)}"] = kind
    return names


def answer(workshop, request):
    """The answer to one env/1 request, without its id."""
    op = request["op"]
    if op == "hello":
        if request["protocol"] != "env/1":
            raise ValueError("this environment speaks env/1")
        return {"name": "workshop", "reset": True}
    if op == "reset":
        workshop.reset(request.get("scenario") or {}, request["seed"])
        return {"state": workshop.snapshot()}
    if op == "observe":
        return {"state": workshop.snapshot()}
    if op == "act":
        try:
            workshop.act(request["action"]["name"], request["action"]["args"])
        except Refused as refused:
            return {"state": workshop.snapshot(), "executed": False, "reason": str(refused)}
        return {"state": workshop.snapshot(), "executed": True}
    if op == "close":
        return {}
    raise ValueError(f"unknown op `{op}`")


def serve(workshop):
    """Answers requests, one JSON object a line, until `close` or the end of the input."""
    for line in sys.stdin:
        request = {}
        try:
            request = json.loads(line)
            reply = {"ok": True, **answer(workshop, request)}
        except Exception as error:  # the conversation goes on
            reply = {"ok": False, "error": f"{type(error).__name__}: {error}"}
        print(json.dumps({"id": request.get("id", 0), **reply}, separators=(",", ":")), flush=True)
        if request.get("op") == "close":
            return


# What is demonstrated: the pieces and machines at hand, and what is done with each piece. A machine in brackets is
# loaded by mistake: the piece is taken out again unworked. "rack" puts a piece back on the rack.
DEMONSTRATIONS = {
    "cut-a-plank": (["plank"], ["saw", "sprayer"], {"plank_1": ["saw", "rack", "(sprayer)"]}),
    "cut-paint-and-dry-a-beam": (["beam"], ["saw", "sprayer", "oven"], {"beam_1": ["saw", "sprayer", "oven"]}),
    "paint-and-dry-a-rod": (["rod"], ["saw", "sprayer", "oven"], {"rod_1": ["sprayer", "(saw)", "oven"]}),
}

# Tasks: the scenario and the goal.
TASKS = {
    "finish-a-dowel": ({"machines": ["saw", "sprayer", "oven"]}, ["shape_Cut(dowel_1)", "paint_Dry(dowel_1)"]),
    "cut-a-rod": ({}, ["shape_Cut(rod_1)"]),
    "cut-a-sheet": ({}, ["shape_Cut(sheet_1)"]),
    "broken-saw": ({"broken": ["saw_1"]}, ["shape_Cut(plank_1)"]),
}


def demonstrate(workshop, folder):
    folder.mkdir(parents=True, exist_ok=True)
    types = {kind: parent for kind, parent in TYPES.items() if workshop.with_robot or kind != "robot"}
    lines = [f"  {kind} - {parent}" for kind, parent in types.items()]
    (folder / "types.pddl").write_text("(:types\n" + "\n".join(lines) + ")\n")
    for number, (task, (pieces, machines, work)) in enumerate(DEMONSTRATIONS.items(), start=1):
        workshop.reset({"pieces": pieces, "machines": machines}, number)
        records = [{"state": workshop.snapshot()}]
        for name, args in (action for piece, path in work.items() for action in steps(workshop, piece, path)):
            args = (["robot_1"] if workshop.with_robot else []) + args
            workshop.act(name, args)
            records += [{"action": {"name": name, "args": args}, "executed": True}, {"state": workshop.snapshot()}]
        goal = [f"{attribute}_{value}({piece})" for piece in work for attribute, value in workshop.piece[piece].items()]
        header = {"format": "trace/1", "task": task.replace("-", " "), "goal": goal}
        text = "".join(json.dumps(record, separators=(",", ":")) + "\n" for record in [header, *records])
        (folder / f"{task}.jsonl").write_text(text)
    for task, (scenario, goal) in TASKS.items():
        workshop.reset(scenario, 0)
        record = {"format": "task/1", "goal": goal, "scenario": scenario, "seed": 0, "state": workshop.snapshot()}
        (folder / f"{task}.json").write_text(json.dumps(record, indent=1) + "\n")


def steps(workshop, piece, path):
    """The actions that lead a piece from machine to machine."""
    for stop in [*path, "rack"]:
        if workshop.with_robot and stop == "rack":
            yield "put", [piece]
        elif stop != "rack":
            if workshop.with_robot and workshop.held is None:
                yield "pick", [piece]
            machine = stop.strip("()") + "_1"
            yield "load", [machine, piece]
            if stop[0] != "(":
                yield "press", [next(switch for switch, wired in workshop.wired.items() if wired == machine)]
            yield "unload", [machine, piece]


def main():
    args = sys.argv[1:]
    workshop = Workshop(with_robot="--no-robot" not in args)
    args = [arg for arg in args if arg != "--no-robot"]
    if not args:
        serve(workshop)
    elif len(args) == 2 and args[0] == "demonstrate":
        demonstrate(workshop, pathlib.Path(args[1]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
