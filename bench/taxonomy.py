#!/usr/bin/env python3
"""Which classes of a real taxonomy does an action accept? Held against what nobody here wrote.

    pip install bddl
    cargo build --release
    python bench/taxonomy.py target/release/typelift

The taxonomy is WordNet as BEHAVIOR has it (3,481 classes, 129 of them with several parents); the truth are its annotations
of abilities. An action is learned that works on things with an ability and is refused by others: from so many examples
of each, drawn at random. Then `typelift why` is asked about every other class, which counts as accepted from p = 0.5 on.
Printed is F1 over the classes that were not seen, the mean over abilities and draws, beside that of the lowest common
ancestor of what worked, which takes the classes below it.

Classes are leaves that are things: no substances, and nothing that is half, diced or cooked of another.
"""

import argparse
import json
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ABILITIES = """cookable sliceable openable toggleable fillable slicer heatSource breakable freezable drapeable flammable
mixingTool particleRemover attachable diceable needsOrientation""".split()
SETTINGS = [(3, 0), (3, 3), (8, 8), (20, 20)]
LEAST_LEFT = 2  # Positive classes that are left to find.


def installed():
    """The folder of what `bddl` carries, without importing it: it wants more packages than are needed here."""
    import importlib.util

    spec = importlib.util.find_spec("bddl")
    if spec is None:
        sys.exit("there is no Python package bddl: pip install --no-deps bddl")
    return Path(spec.submodule_search_locations[0]) / "generated_data"


class Taxonomy:
    def __init__(self, folder):
        self.abilities = json.loads((folder / "propagated_annots_canonical.json").read_text())
        self.parents = {}
        self._walk(json.loads((folder / "output_hierarchy.json").read_text()), None)
        inner = {parent for parents in self.parents.values() for parent in parents}
        derived = ("half__", "diced__", "cooked__")
        self.leaves = sorted(
            name
            for name in self.parents
            if name not in inner
            and "nonSubstance" in self.abilities[name]
            and not any(part in name for part in derived)
        )
        self.above = {}
        for name in self.parents:
            self._above(name)
        self.size = {name: 0 for name in self.parents}
        for leaf in (name for name in self.parents if name not in inner):
            for above in self.above[leaf]:
                self.size[above] += 1

    def _walk(self, node, parent):
        known = self.parents.setdefault(node["name"], [])
        if parent and parent not in known:
            known.append(parent)
        for child in node.get("children", []):
            self._walk(child, node["name"])

    def _above(self, name):
        if name not in self.above:
            self.above[name] = {name}.union(*(self._above(parent) for parent in self.parents[name]))
        return self.above[name]

    def lowest_common_ancestor(self, names):
        common = set.intersection(*(self.above[name] for name in names))
        return min(common, key=lambda name: (self.size[name], name))

    def types(self):
        return {name: parents for name, parents in self.parents.items() if parents}


def trace(worked, refused):
    """A thing of each class is used, one after the other."""
    objects = {f"thing_{number}": name for number, name in enumerate(worked + refused)}
    done = []
    lines = [{"format": "trace/1"}, {"state": {"objects": objects, "atoms": []}}]
    for number in range(len(objects)):
        thing = f"thing_{number}"
        action = {"name": "use", "args": [thing]}
        if number < len(worked):
            done.append(f"used({thing})")
        else:
            action["executed"] = False
        lines += [{"action": action}, {"state": {"objects": objects, "atoms": list(done)}}]
    return "".join(json.dumps(line) + "\n" for line in lines)


def accepted(typelift, folder, types, worked, refused, asked):
    (folder / "trace.jsonl").write_text(trace(worked, refused))
    model, calls = folder / "model.json", folder / "calls.jsonl"
    learn = [typelift, "learn", folder / "trace.jsonl", "--types", types, "-o", model, "-q"]
    subprocess.run(learn, check=True, stdout=subprocess.DEVNULL)
    question = lambda name: {"call": {"name": "use", "args": ["it"]}, "types": {"it": name}}
    calls.write_text("".join(json.dumps(question(name)) + "\n" for name in asked))
    why = subprocess.run([typelift, "why", model, "--calls", calls, "--json"], capture_output=True, text=True)
    answers = [json.loads(line) for line in why.stdout.splitlines()]
    if len(answers) != len(asked):
        sys.exit(why.stderr)
    return {name for name, answer in zip(asked, answers) if answer["p"] >= 0.5}


def f1(said, true):
    both = len(said & true)
    return 2 * both / (len(said) + len(true)) if both else 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("typelift")
    parser.add_argument("--draws", type=int, default=12, help="draws of examples for each ability")
    parser.add_argument("--per-ability", action="store_true", help="print each ability's own means, too")
    arguments = parser.parse_args()
    taxonomy = Taxonomy(installed())
    print(f"{len(taxonomy.parents)} classes, {len(taxonomy.leaves)} of them asked")
    print("worked/refused  lowest common ancestor  typelift")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        types = folder / "types.json"
        types.write_text(json.dumps(taxonomy.types()))
        for works, fails in SETTINGS:
            means = []
            for ability in ABILITIES:
                true = {name for name in taxonomy.leaves if ability in taxonomy.abilities[name]}
                false = [name for name in taxonomy.leaves if name not in true]
                if len(true) < works + LEAST_LEFT:
                    continue
                chance = random.Random(f"{ability} {works} {fails}")
                scores = []
                for _ in range(arguments.draws):
                    worked, refused = chance.sample(sorted(true), works), chance.sample(false, fails)
                    asked = [name for name in taxonomy.leaves if name not in worked + refused]
                    ancestor = taxonomy.lowest_common_ancestor(worked)
                    below = {name for name in asked if ancestor in taxonomy.above[name]}
                    said = accepted(arguments.typelift, folder, types, worked, refused, asked)
                    scores.append((f1(below, true & set(asked)), f1(said, true & set(asked))))
                means.append([statistics.mean(column) for column in zip(*scores)])
                if arguments.per_ability:
                    print(f"  {ability:16} {means[-1][0]:.2f} {means[-1][1]:.2f}")
            lowest, ours = (statistics.mean(column) for column in zip(*means))
            print(f"+{works}/-{fails}".ljust(16) + f"{lowest:.2f}".ljust(24) + f"{ours:.2f}", flush=True)


if __name__ == "__main__":
    main()
