#!/usr/bin/env python3
"""Games of cooking that nobody here wrote: learned from TextWorld's own walkthroughs, played with foods never seen.

    pip install textworld
    cargo build --release
    python bench/worlds/cooking.py target/release/typelift

Learns from eight walkthroughs of the training split, and from four of them, and has typelift play 30 other games until the meal is
eaten, ten each with foods of the training, validation and test split; then once more with the same memory. Printed is how
many games are won, and how many steps failed on the way: refused by the game, or not as expected. Settings and seeds stand in
`cooking.json`.
"""

import json
import sys
from pathlib import Path

from cooking_game import CookingGame
from measuring import Measure, Setting, Task, options, parse, report
from serving import reaches, record

HERE = Path(__file__).parent


def main() -> None:
    arguments = parse(options(__doc__), "cooking")
    games = json.loads((HERE / "cooking.json").read_text())
    of_each = 2 if arguments.quick else 10
    kept = (
        arguments.folder.parent / "cooking-games"
    )  # Making them takes longer than all else, so that a quick look keeps them, too.
    game = CookingGame(kept)

    demonstrations = []
    for seed in games["demonstrations"]["seeds"]:
        game.reset(seed, {**games["settings"], "split": games["demonstrations"]["split"]})
        trace = arguments.folder / "demonstrations" / f"game_{seed}.jsonl"
        if not trace.exists():
            trace.parent.mkdir(parents=True, exist_ok=True)
            record(game, trace, game.goal(), game.walkthrough())
        demonstrations.append(trace)

    tasks = []
    for split, seeds in games["unseen"].items():
        for seed in seeds[:of_each]:
            scenario = {**games["settings"], "split": split}
            game.reset(seed, scenario)
            if not reaches(game, game.walkthrough(), game.goal()):
                sys.exit(f"{split}, seed {seed}: the game's own walkthrough does not win it")
            tasks.append(Task(f"{split}_{seed}", split, game.goal(), scenario, seed))

    measure = Measure(arguments, [str(HERE / "cooking_game.py"), str(kept)], game.types)
    settings = [
        Setting(f"{number} demonstrations{', imagining' if imagining else ''}", demonstrations[:number], imagining)
        for number in ((8,) if arguments.quick else (8, 4))
        for imagining in (((),) if arguments.quick else ((), ("--imagine",)))
    ]
    report(measure.run(settings, tasks), list(games["unseen"]), arguments)


if __name__ == "__main__":
    main()
