#!/usr/bin/env python3
"""Records the demonstrations of docs/your-robot.md, and writes its tasks.

    demonstrate.py DIR             writes DIR/*.jsonl and DIR/*.json
    demonstrate.py DIR --flicker   the same with plain thresholds instead of hysteresis: not to be learned from
"""
import contextlib
import json
import pathlib
import sys

from adapter import Robot
from tabletop import Tabletop


# [record]
@contextlib.contextmanager
def record(robot, path, task, goal):
    """Writes a demonstration: `with record(…) as act:`, then act(name, *args), from a script or a joystick."""
    with open(path, "w") as out:

        def write(**line):
            print(json.dumps(line), file=out)

        def act(name, *args):
            refusal = robot.act(name, args)
            write(action={"name": name, "args": args}, executed=refusal is None, reason=refusal)
            write(state=robot.snapshot())

        write(format="trace/1", task=task, goal=goal)
        write(state=robot.snapshot())
        yield act
# [/record]


# [demonstrations]
def demonstrate(robot, folder):
    gripper, shown = "gripper_1", {"items": ["cup_1", "block_1", "sponge_1", "cloth_1"]}

    robot.reset(1, shown)
    goal = ["on_holds(cup_1,tray_1)", "on_holds(block_1,tray_1)"]
    with record(robot, folder / "fill-the-tray.jsonl", "put a cup and a block on the tray", goal) as act:
        for item in ("cup_1", "block_1"):
            act("pick", gripper, item)
            act("place", gripper, "tray_1", item)

    for seed, tool in ((2, "sponge_1"), (3, "cloth_1")):
        robot.reset(seed, shown)
        with record(robot, folder / f"wipe-with-{tool}.jsonl", "wipe the tray", ["surface_Clean(tray_1)"]) as act:
            act("pick", gripper, tool)
            act("wipe", gripper, tool, "tray_1")
            act("place", gripper, "table_1", tool)

    robot.reset(4, shown)
    goal = ["near_holds(block_1,cup_1)", "near_holds(sponge_1,cloth_1)"]
    with record(robot, folder / "pair-up.jsonl", "push the block to the cup, the sponge to the cloth", goal) as act:
        act("push", gripper, "cup_1", "block_1")
        act("push", gripper, "cloth_1", "sponge_1")
# [/demonstrations]


# What is asked afterwards: the goal, and what the simulator is to set up. No bottle was shown, and nothing in a box.
TASKS = {
    "bottle-on-tray": (["on_holds(bottle_1,tray_1)"], {}),
    "bottle-in-box": (["on_holds(bottle_1,box_1)"], {}),
    "slippery-cup": (["on_holds(cup_1,tray_1)"], {"slippery": ["cup_1"]}),
    "glued-cloth": (["surface_Clean(tray_1)"], {"glued": ["cloth_1"]}),
}


def write_tasks(robot, folder):
    for name, (goal, scenario) in TASKS.items():
        robot.reset(0, scenario)
        task = {"format": "task/1", "goal": goal, "scenario": scenario, "seed": 0, "state": robot.snapshot()}
        (folder / f"{name}.json").write_text(json.dumps(task) + "\n")


if __name__ == "__main__":
    arguments = [argument for argument in sys.argv[1:] if argument != "--flicker"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    if "--flicker" in sys.argv:
        Robot.NEAR = (0.13, 0.13)
    folder = pathlib.Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    robot = Robot(Tabletop())
    demonstrate(robot, folder)
    write_tasks(robot, folder)
