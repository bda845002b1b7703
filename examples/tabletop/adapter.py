#!/usr/bin/env python3
"""The tabletop as an environment of typelift: answers env/1 requests on standard input. Standard library only."""
import json
import os
import sys

from tabletop import Tabletop

SUPPORTS = {"table", "shelf", "tray", "box"}
ITEMS = {"cup", "bottle", "block", "sponge", "cloth"}


# [hysteresis]
class Hysteresis:
    """Yes once a value falls below `enter`, no once it rises above `leave`; in between, as before."""

    def __init__(self, enter, leave):
        self.enter, self.leave, self.yes = enter, leave, set()

    def __call__(self, pair, value):
        pair = frozenset(pair)
        limit = self.leave if pair in self.yes else self.enter
        self.yes = self.yes | {pair} if value < limit else self.yes - {pair}
        return pair in self.yes
# [/hysteresis]


# [adapter]
class Robot:
    ON, NEAR = (0.010, 0.020), (0.10, 0.16)  # enter and leave, in metres

    def __init__(self, sim):
        self.sim = sim
        self.reset(0, {})

    def reset(self, seed, scenario):
        self.sim.reset(seed, **scenario)
        self.on, self.near = Hysteresis(*self.ON), Hysteresis(*self.NEAR)

    def snapshot(self):
        bodies, entities = self.sim.observe(), []
        supports = [name for name, body in bodies.items() if body["kind"] in SUPPORTS]
        items = [name for name, body in bodies.items() if body["kind"] in ITEMS]
        for name, body in bodies.items():
            entity = {"id": name, "type": body["kind"], "attributes": {}, "relations": {}}
            entity["attributes"]["xyz"] = body["xyz"]  # numbers: they give no atoms
            if "dirt" in body:
                entity["attributes"]["surface"] = "Dirty" if body["dirt"] > 0.5 else "Clean"
            if "holds" in body:
                entity["relations"]["holding"] = body["holds"]  # an id, or None
            if name in items:
                on = [s for s in supports if self.on((name, s), gap(body, bodies[s]))]
                near = [i for i in items if i != name and self.near({name, i}, apart(body, bodies[i]))]
                entity["relations"].update(on=on[0] if on else None, near=near)  # near: a list of ids
            entities.append(entity)
        return {"entities": entities}


def serve(robot):
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what the simulator prints must not go where the answers go
    for request in map(json.loads, sys.stdin):
        answer, refusal = {"id": request["id"], "ok": True}, None
        if request["op"] == "hello":
            answer.update(name="tabletop", reset=True)
        elif request["op"] == "reset":
            robot.reset(request["seed"], request.get("scenario") or {})
        elif request["op"] == "act":
            refusal = robot.sim.act(**request["action"])  # returns when the world has settled
        answer.update(state=robot.snapshot(), executed=refusal is None, reason=refusal)
        print(json.dumps(answer), file=answers, flush=True)
# [/adapter]


def apart(a, b):
    return sum((p - q) ** 2 for p, q in zip(a["xyz"], b["xyz"])) ** 0.5


def gap(item, support):
    """How far an item's base is from the height at which things rest on a support; infinite beside the support."""
    (x, y, z), (sx, sy, sz) = item["xyz"], support["xyz"]
    above = max(abs(x - sx), abs(y - sy)) <= support["reach"]
    return abs(z - sz - support["top"]) if above else float("inf")


if __name__ == "__main__":
    serve(Robot(Tabletop()))
