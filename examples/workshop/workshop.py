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

# The types below each type: up to five levels below `object`.
TYPES = {
    "object": ["entity"],
    "entity": ["robot", "equipment", "piece"],
    "equipment": ["switch", "machine"],
    "machine": ["cutting_machine", "painting_machine", "drying_machine"],
    "cutting_machine": ["saw", "laser"],
    "painting_machine": ["sprayer", "dip_tank"],
    "drying_machine": ["oven", "fan"],
    "piece": ["wooden", "metal"],
    "wooden": ["plank", "beam", "dowel"],
    "metal": ["rod", "sheet"],
}

# What each kind of machine does: the attribute of the piece that changes, from which value to which.
WORK = {
    "cutting_machine": ("shape", "Whole", "Cut"),
    "painting_machine": ("paint", "Bare", "Wet"),
    "drying_machine": ("paint", "Wet", "Dry"),
}
UNSUITABLE = {("saw", "sheet")}  # a saw does not cut thin metal
ACTIONS = {"pick": 1, "put": 1, "load": 2, "unload": 2, "press": 1}  # each with the number of things it is done to

DEFAULT = {
    "machines": ["saw", "laser", "sprayer", "dip_tank", "oven", "fan"],
    "pieces": ["plank", "beam", "dowel", "rod", "sheet"],
    "broken": [],  # machines, such as saw_1, that do nothing when they are started; nothing shows it
}


class Refused(Exception):
    """The action cannot be done now."""


def need(condition, reason):
    if not condition:
        raise Refused(reason)


class Workshop:
    def __init__(self, with_robot):
        self.with_robot = with_robot
        self.reset({}, 0)

    def reset(self, scenario, seed):
        """Sets up the workshop. The seed decides the wiring of the switches and the places on the rack."""
        scenario = {**DEFAULT, **scenario}
        machines, pieces = numbered(scenario["machines"]), numbered(scenario["pieces"])
        known = {"machines": DEFAULT["machines"], "pieces": DEFAULT["pieces"], "broken": machines}
        for field, names in scenario.items():
            for name in names:
                if name not in known.get(field, ()):
                    raise ValueError(f"the scenario's {field}: there is no `{name}`")
        chance = random.Random(seed)
        self.types = {**machines, **pieces}
        self.broken = set(scenario["broken"])
        wired = enumerate(chance.sample(list(machines), len(machines)), start=1)
        self.wired = {f"switch_{number}": machine for number, machine in wired}
        self.slot = dict(zip(pieces, chance.sample(range(len(pieces)), len(pieces))))
        self.inside = dict.fromkeys(machines)  # the piece in each machine, or None
        self.done = dict.fromkeys(machines, False)  # whether the machine has worked on it
        self.piece = {piece: {"shape": "Whole", "paint": "Bare"} for piece in pieces}
        self.held = None  # what the robot holds

    def on_rack(self, piece):
        return piece != self.held and piece not in self.inside.values()

    def snapshot(self):
        """Everything that can be seen. That a machine is broken cannot."""
        seen = [("robot_1", "robot", {}, {"holding": self.held})] if self.with_robot else []
        seen += [(switch, "switch", {}, {"wired_to": [machine]}) for switch, machine in self.wired.items()]
        for machine, piece in self.inside.items():
            status = "Done" if self.done[machine] else "Ready"
            seen.append((machine, self.types[machine], {"status": status}, {"load": piece}))
        for piece, look in self.piece.items():
            place = {"on_rack": True, "slot": self.slot[piece]} if self.on_rack(piece) else {"on_rack": False}
            seen.append((piece, self.types[piece], {**look, **place}, {}))
        return {"entities": [dict(zip(("id", "type", "attributes", "relations"), entity)) for entity in seen]}

    # The actions. Each either happens or raises Refused before anything has changed.

    def act(self, name, args):
        if self.with_robot:
            need(args[:1] == ["robot_1"], "the first argument is who acts: robot_1")
            args = args[1:]
        known = name in ACTIONS and (self.with_robot or name not in ("pick", "put"))
        need(known and len(args) == ACTIONS[name], f"there is no action {name} of {len(args)} things")
        getattr(self, name)(*args)

    def pick(self, piece):
        need(self.held is None, f"robot_1 already holds {self.held}")
        need(piece in self.piece and self.on_rack(piece), f"{piece} is not on the rack")
        self.held = piece

    def put(self, piece):
        need(self.held == piece, f"robot_1 does not hold {piece}")
        self.held = None

    def load(self, machine, piece):
        need(machine in self.inside and piece in self.piece, f"{piece} cannot be loaded into {machine}")
        at_hand = self.held == piece if self.with_robot else self.on_rack(piece)
        need(at_hand, f"{piece} is not at hand")
        need(self.inside[machine] is None, f"{self.inside[machine]} is in {machine}")
        self.inside[machine], self.held = piece, None

    def unload(self, machine, piece):
        need(machine in self.inside and self.inside[machine] == piece, f"{piece} is not in {machine}")
        need(self.held is None, f"robot_1 already holds {self.held}")
        self.inside[machine], self.done[machine] = None, False
        self.held = piece if self.with_robot else None

    def press(self, switch):
        """Starts the machine wired to the switch. Neither it nor the piece in it is named."""
        need(switch in self.wired, f"{switch} is no switch")
        machine, piece = self.wired[switch], self.inside[self.wired[switch]]
        need(piece is not None, f"{machine} is empty")
        need(not self.done[machine], f"{machine} is done with {piece}")
        if machine in self.broken:
            return  # it was pressed, but nothing happens
        need((self.types[machine], self.types[piece]) not in UNSUITABLE, f"{machine} does not take {piece}")
        kind = next(kind for kind in WORK if self.types[machine] in TYPES[kind])
        attribute, before, after = WORK[kind]
        need(self.piece[piece][attribute] == before, f"{piece} is {self.piece[piece][attribute]}, not {before}")
        self.piece[piece][attribute] = after
        self.done[machine] = True


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
        return {"name": "workshop", "reset": True, "protocol": "env/1"}
    if op == "close":
        return {}
    outcome = {}
    if op == "reset":
        workshop.reset(request.get("scenario") or {}, request["seed"])
    elif op == "act":
        try:
            workshop.act(request["action"]["name"], request["action"]["args"])
            outcome = {"executed": True}
        except Refused as refused:
            outcome = {"executed": False, "reason": str(refused)}
    elif op != "observe":
        raise ValueError(f"unknown op `{op}`")
    return {"state": workshop.snapshot(), **outcome}


def serve(workshop):
    """Answers requests, one JSON object a line, until `close` or the end of the input."""
    for line in sys.stdin:
        request = json.loads(line)
        try:
            reply = {"ok": True, **answer(workshop, request)}
        except Exception as error:  # the conversation goes on
            reply = {"ok": False, "error": f"{type(error).__name__}: {error}"}
        print(json.dumps({"id": request["id"], **reply}), flush=True)
        if request["op"] == "close":
            return


# What is demonstrated: the way of a piece. In a machine it is worked on; in one in brackets it is not, since that was
# the wrong machine: it is taken out as it was. In the end it is put on the rack.
DEMONSTRATIONS = {
    "cut-a-plank": ("plank", ["saw", "rack", "(sprayer)", "rack"]),
    "cut-paint-and-dry-a-beam": ("beam", ["saw", "sprayer", "oven", "rack"]),
    "paint-and-dry-a-rod": ("rod", ["sprayer", "(saw)", "oven", "rack"]),
}

# The scenario and the goal of each task.
TASKS = {
    "cut-a-dowel": ({}, ["shape_Cut(dowel_1)"]),
    "finish-a-dowel": ({}, ["shape_Cut(dowel_1)", "paint_Dry(dowel_1)"]),
    "cut-a-rod": ({}, ["shape_Cut(rod_1)"]),
    "cut-a-sheet": ({}, ["shape_Cut(sheet_1)"]),
    "broken-saw": ({"broken": ["saw_1"]}, ["shape_Cut(plank_1)"]),
}


def demonstrate(workshop, folder):
    """Writes the types, a trace/1 file for each demonstration and a task/1 file for each task."""
    folder.mkdir(parents=True, exist_ok=True)
    types = "".join(f"\n  {' '.join(children)} - {parent}" for parent, children in TYPES.items())
    types = types if workshop.with_robot else types.replace("robot ", "")
    (folder / "types.pddl").write_text(f"(:types{types})\n")
    for seed, (name, (kind, way)) in enumerate(DEMONSTRATIONS.items()):
        machines = [stop.strip("()") for stop in way if stop != "rack"]
        workshop.reset({"pieces": [kind], "machines": machines}, seed)
        piece, records = f"{kind}_1", [{"state": workshop.snapshot()}]
        for action, args in steps(workshop, piece, way):
            args = ["robot_1", *args] if workshop.with_robot else args
            workshop.act(action, args)
            records += [{"action": {"name": action, "args": args}, "executed": True}, {"state": workshop.snapshot()}]
        goal = [f"{attribute}_{value}({piece})" for attribute, value in workshop.piece[piece].items()]
        records.insert(0, {"format": "trace/1", "task": name.replace("-", " "), "goal": goal})
        (folder / f"{name}.jsonl").write_text("".join(json.dumps(record) + "\n" for record in records))
    for name, (scenario, goal) in TASKS.items():
        workshop.reset(scenario, seed=0)
        task = {"format": "task/1", "goal": goal, "scenario": scenario, "seed": 0, "state": workshop.snapshot()}
        (folder / f"{name}.json").write_text(json.dumps(task).replace('{"id"', '\n{"id"') + "\n")


def steps(workshop, piece, way):
    """The actions that lead a piece along its way."""
    for stop in way:
        if stop == "rack":
            yield from [("put", [piece])] if workshop.with_robot else []
            continue
        if workshop.with_robot and workshop.held is None:
            yield "pick", [piece]
        machine = f"{stop.strip('()')}_1"
        yield "load", [machine, piece]
        if stop[0] != "(":
            yield "press", [next(switch for switch, wired in workshop.wired.items() if wired == machine)]
        yield "unload", [machine, piece]


if __name__ == "__main__":
    arguments = [argument for argument in sys.argv[1:] if argument != "--no-robot"]
    the_workshop = Workshop(with_robot="--no-robot" not in sys.argv)
    if not arguments:
        serve(the_workshop)
    elif arguments[0] == "demonstrate" and len(arguments) == 2:
        demonstrate(the_workshop, pathlib.Path(arguments[1]))
    else:
        sys.exit(__doc__)
