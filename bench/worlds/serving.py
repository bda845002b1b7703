"""What both worlds have in common: they are served to typelift as `env/1`, and demonstrations in them are recorded as traces."""

import json
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Protocol

Call = tuple[str, list[str]]


class World(Protocol):
    """A simulator, as an adapter sees it."""

    name: str

    def reset(self, seed: int, scenario: dict[str, Any]) -> None:
        """Begins anew."""

    def state(self) -> dict[str, Any]:
        """Objects with their types, and the atoms that hold."""

    def act(self, name: str, args: list[str]) -> str | None:
        """Does it, or changes nothing and says why not."""


def serve(world: World) -> None:
    """Answers requests on standard input until it is closed."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # What a simulator prints must not go where the answers go.
    for line in sys.stdin:
        request = json.loads(line)
        answer: dict[str, Any] = {"id": request["id"], "ok": True}
        try:
            if request["op"] == "hello":
                answer.update(name=world.name, reset=True)
            elif request["op"] == "reset":
                world.reset(request["seed"], request.get("scenario") or {})
                answer.update(state=world.state())
            elif request["op"] == "observe":
                answer.update(state=world.state())
            elif request["op"] == "act":
                refusal = world.act(request["action"]["name"], request["action"]["args"])
                answer.update(state=world.state(), executed=refusal is None, reason=refusal)
        except (KeyError, OSError, ValueError) as error:
            answer = {"id": request["id"], "ok": False, "error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=answers, flush=True)


def reaches(world: World, calls: Iterable[Call], goal: list[str]) -> bool:
    """Whether a goal comes about on the way, as the world stands."""
    for name, args in calls:
        world.act(name, args)
        if set(goal) <= set(world.state()["atoms"]):
            return True
    return False


def record(world: World, path: Path, goal: list[str], calls: Iterable[Call]) -> None:
    """Writes a demonstration: the calls, one after the other, from where the world stands. What is refused is recorded, too."""
    lines: list[dict[str, Any]] = [{"format": "trace/1", "task": path.stem, "goal": goal}, {"state": world.state()}]
    for name, args in calls:
        refusal = world.act(name, args)
        lines.append({"action": {"name": name, "args": args}, "executed": refusal is None, "reason": refusal})
        lines.append({"state": world.state()})
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
