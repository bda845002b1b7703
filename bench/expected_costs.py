#!/usr/bin/env python3
"""Has Fast Downward find the cheapest plans of tests/pddl.

    pip install up-fast-downward
    python bench/expected_costs.py tests/pddl > tests/pddl/expected.txt

Prints a line a folder: its name, and the cost of a cheapest plan of `problem.pddl`, or `unsolvable`. The domain is
`equivalent.pddl` where there is one, else `domain.pddl`.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec

# The translator's code and the search's for what has no plan.
UNSOLVABLE = [10, 11]


def cheapest(folder):
    driver = pathlib.Path(find_spec("up_fast_downward").origin).parent / "downward" / "fast-downward.py"
    domain = folder / "equivalent.pddl"
    domain = domain if domain.exists() else folder / "domain.pddl"
    with tempfile.TemporaryDirectory() as out:
        files = ["--plan-file", f"{out}/plan", "--sas-file", f"{out}/sas", domain, folder / "problem.pddl"]
        command = [sys.executable, driver, *files, "--search", "astar(blind())"]
        ended = subprocess.run(command, capture_output=True, text=True)
    # The search does not promise its own answer where it reads conditional effects or derived predicates; a blind one
    # that has seen every state may.
    if ended.returncode in UNSOLVABLE or "Completely explored state space" in ended.stdout:
        return "unsolvable"
    found = re.search(r"Plan cost: (\d+)", ended.stdout)
    return found.group(1) if found else sys.exit(f"{folder}\n{ended.stdout}\n{ended.stderr}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for folder in sorted(path for path in pathlib.Path(sys.argv[1]).iterdir() if path.is_dir()):
        print(folder.name, cheapest(folder), flush=True)


if __name__ == "__main__":
    main()
