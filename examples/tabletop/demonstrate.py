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
            refusal = robot.sim.act(name, args)
            write(action={"name": name, "args": args}, executed=refusal is None, reason=refusal)
            write(state=robot.snapshot())

        write(format="trace/1", task=task, goal=goal)
        write(state=robot.snapshot())
        yield act
# [/record]


# [demonstration]
SHOWN = {"items": ["cup_1", "cup_2", "block_1", "sponge_1", "cloth_1"]}  # no bottle


def fill_the_tray(robot, folder):
    robot.reset(21, SHOWN)
    goal = ["on_holds(cup_1,tray_1)", "on_holds(block_1,tray_1)"]
    with record(robot, folder / "fill-the-tray.jsonl", "put a cup and a block on the tray", goal) as act:
        for item in ("cup_1", "block_1"):
            act("pick", "gripper_1", item)
            act("place", "gripper_1", "tray_1", item)
# [/demonstration]


def wipe_the_tray(robot, folder, seed, tool):
    robot.reset(seed, SHOWN)
    goal = ["surface_Clean(tray_1)"]
    with record(robot, folder / f"wipe-with-{tool}.jsonl", f"wipe the tray with {tool}", goal) as act:
        act("pick", "gripper_1", tool)
        act("wipe", "gripper_1", tool, "tray_1")
        act("place", "gripper_1", "table_1", tool)


def pair_up(robot, folder):
    robot.reset(24, SHOWN)
    goal = ["near_holds(block_1,cup_1)", "near_holds(cup_2,sponge_1)"]
    with record(robot, folder / "pair-up.jsonl", "push things together", goal) as act:
        act("push", "gripper_1", "table_1", "cup_1", "block_1")
        act("push", "gripper_1", "table_1", "sponge_1", "cup_2")


# What is asked afterwards: the goal, and what the simulator is to set up. No bottle was shown, and nothing in a box.
TASKS = {
    "bottle-on-tray": (["on_holds(bottle_1,tray_1)"], {}),
    "bottle-in-box": (["on_holds(bottle_1,box_1)"], {}),
    "slippery-cup": (["on_holds(cup_1,tray_1)"], {"slippery": ["cup_1"]}),
    "glued-cloth": (["surface_Clean(tray_1)"], {"glued": ["cloth_1"]}),
    "bottle-beside-cup": (["near_holds(bottle_1,cup_1)"], {}),
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
    fill_the_tray(robot, folder)
    wipe_the_tray(robot, folder, 22, "sponge_1")
    wipe_the_tray(robot, folder, 23, "cloth_1")
    pair_up(robot, folder)
    write_tasks(robot, folder)
