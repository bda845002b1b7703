#!/usr/bin/env python3
"""The tabletop as an environment of typelift: answers env/1 requests on standard input. Standard library only."""
import json
import os
import sys

from tabletop import Tabletop


# [hysteresis]
class Hysteresis:
    """Yes once a value falls below `enter`, no once it rises above `leave`; in between the answer stays."""

    def __init__(self, enter, leave):
        self.enter, self.leave, self.yes = enter, leave, set()

    def __call__(self, key, value):
        below = self.leave if key in self.yes else self.enter
        (self.yes.add if value < below else self.yes.discard)(key)
        return key in self.yes
# [/hysteresis]


# [adapter]
class Robot:
    NEAR, ON = (0.10, 0.16), (0.010, 0.020)  # enter and leave, in metres

    def __init__(self, sim):
        self.sim = sim

    def reset(self, seed, scenario):
        self.sim.reset(seed, **scenario)
        self.near, self.on = Hysteresis(*self.NEAR), Hysteresis(*self.ON)

    def snapshot(self):
        """Poses in, entities out."""
        bodies, entities = self.sim.observe(), []
        supports = {name: body for name, body in bodies.items() if "top" in body}
        items = {name: body for name, body in bodies.items() if name not in supports and "holds" not in body}
        for name, body in bodies.items():
            attributes, relations = {"xyz": list(body["xyz"])}, {}
            if "holds" in body:
                relations["holding"] = body["holds"]  # an id or None: at most one
            if "dirt" in body:
                attributes["surface"] = "Dirty" if body["dirt"] > 0.5 else "Clean"  # one of several words
            if name in items:
                on = [s for s in supports if self.on((name, s), gap(body, supports[s]))]
                relations["on"] = on[0] if on else None
                others = (other for other in items if other != name)
                relations["near"] = [o for o in others if self.near(frozenset((name, o)), apart(body, items[o]))]
            entities.append({"id": name, "type": body["kind"], "attributes": attributes, "relations": relations})
        return {"entities": entities}

    def act(self, name, args):
        """Returns when the world has settled: None, or why it could not be done."""
        return self.sim.act(name, args)

    def answer(self, request):
        op, outcome = request["op"], {}
        if op == "hello":
            return {"name": "tabletop", "reset": True}
        if op == "close":
            return {}
        if op == "reset":
            self.reset(request["seed"], request.get("scenario") or {})
        elif op == "act":
            refusal = self.act(request["action"]["name"], request["action"]["args"])
            outcome = {"executed": refusal is None, "reason": refusal}
        return {"state": self.snapshot(), **outcome}


def apart(a, b):
    return sum((p - q) ** 2 for p, q in zip(a["xyz"], b["xyz"])) ** 0.5


def gap(item, support):
    """How far the item is above what it might rest on; infinite if it is not above it at all."""
    (x, y, z), (sx, sy, sz) = item["xyz"], support["xyz"]
    inside = max(abs(x - sx), abs(y - sy)) <= support["reach"]
    return abs(z - sz - support["top"]) if inside else float("inf")


def serve(robot):
    answers = os.fdopen(os.dup(1), "w")  # standard output is for answers only:
    os.dup2(2, 1)  # what libraries print goes to standard error
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer = {"ok": True, **robot.answer(request)}
        except Exception as error:
            answer = {"ok": False, "error": repr(error)}
        print(json.dumps({"id": request["id"], **answer}), file=answers, flush=True)


if __name__ == "__main__":
    serve(Robot(Tabletop()))
# [/adapter]
