#!/usr/bin/env python3
"""Writes problems of 30 domains of past planning competitions, seven each, in the competitions' sizes.

    pip install pypddl-datasets
    python bench/generate.py competition
    python bench/compare.py competition

The domains are the competitions'; the problems are made by that package's generators, with fixed seeds, since the
competitions' own are in no package. From the smallest to the largest they are about as large as those of the satisficing
tracks. Nothing says that each has a plan, though for most domains that is so by construction.
"""

import argparse
import importlib
import inspect
import pathlib
import re
import shutil

PACKAGE = "pypddl_datasets.generators.classical.ipc"


def curbs(*numbers):
    """As many cars as there can be."""
    return [(number, 2 * number - 2) for number in numbers]


# Folder: generator, domain file, what the numbers are, the numbers of each problem, what stays.

BARMAN = "num_cocktails num_ingredients num_shots"
FREECELL = "num_cards num_cells num_columns"
LOGISTICS = "num_cities city_size num_packages num_airplanes num_trucks num_goals"
PARKING = "num_curbs num_cars"
PIPESWORLD = "network num_batches num_goals"

DOMAINS = {
    "barman": (
        *("barman", "domain_barman11.pddl", BARMAN),
        [(3, 3, 4), (4, 3, 5), (5, 3, 7), (6, 3, 8), (7, 4, 9), (8, 4, 10), (9, 5, 12)],
        {"action_costs": True},
    ),
    "barman14": (
        *("barman", "domain.pddl", BARMAN),
        [(5, 3, 6), (6, 3, 7), (7, 3, 10), (8, 4, 11), (9, 4, 12), (10, 5, 14), (11, 5, 17)],
        {},
    ),
    "blocks": ("blocks_4", "domain.pddl", "num_blocks", [(4,), (6,), (8,), (10,), (12,), (15,), (17,)], {}),
    "childsnack": (
        *("childsnack", "domain.pddl", "num_children num_trays"),
        [(6, 2), (8, 2), (10, 3), (13, 3), (17, 3), (21, 4), (25, 4)],
        {"gluten_factor": 0.4, "const_ratio": 1.3},
    ),
    "depot": (
        *("depots", "domain.pddl", "num_depots num_distributors num_trucks num_pallets num_hoists num_crates"),
        [(1, 2, 2, 3, 3, 2), (1, 2, 2, 3, 3, 6), (1, 2, 2, 3, 3, 10), (2, 2, 2, 6, 6, 10), (3, 3, 2, 6, 6, 12)]
        + [(4, 4, 4, 8, 8, 15), (5, 5, 4, 15, 15, 20)],
        {},
    ),
    "driverlog": (
        *("driverlog", "domain.pddl", "num_locations num_drivers num_packages num_trucks"),
        [(3, 2, 2, 2), (6, 3, 5, 3), (8, 3, 6, 3), (10, 4, 10, 4), (12, 5, 15, 4), (16, 6, 20, 5), (20, 8, 25, 6)],
        {},
    ),
    "elevators": (
        *("elevators", "domain.pddl"),
        "num_areas area_size num_passengers num_fast_elevators fast_capacity slow_capacity",
        [(2, 4, 4, 2, 3, 2), (2, 4, 10, 2, 3, 2), (2, 6, 16, 2, 4, 3), (2, 8, 22, 2, 4, 3), (4, 6, 30, 3, 6, 4)]
        + [(4, 8, 40, 4, 6, 4), (4, 10, 60, 4, 6, 4)],
        {},
    ),
    "floortile": (
        *("floortile", "domain.pddl", "num_rows num_columns num_robots"),
        [(3, 3, 2), (4, 3, 2), (4, 4, 2), (5, 4, 2), (5, 5, 2), (6, 6, 3), (7, 6, 3)],
        {},
    ),
    "freecell": (
        *("freecell", "domain.pddl", "num_cards"),
        [(2,), (4,), (6,), (8,), (10,), (12,), (13,)],
        {},
    ),
    "freecell02": (
        *("freecell", "domain.pddl", FREECELL),
        [(2, 2, 4), (3, 2, 5), (4, 3, 5), (6, 4, 5), (8, 4, 6), (9, 4, 7), (11, 4, 8)],
        {"style": "ipc2002"},
    ),
    "grid": (
        *("grid", "domain.pddl", "width height num_shapes num_keys num_locks"),
        [(5, 5, 4, 9, 8), (5, 6, 4, 9, 8), (6, 6, 4, 10, 9), (7, 7, 4, 11, 12), (8, 8, 4, 12, 16), (8, 9, 4, 12, 18)]
        + [(9, 9, 4, 13, 20)],
        {},
    ),
    "gripper": ("gripper", "domain.pddl", "num_balls", [(4,), (10,), (16,), (22,), (30,), (36,), (42,)], {}),
    "hiking": (
        *("hiking", "domain.pddl", "num_couples num_cars num_places"),
        [(1, 2, 5), (2, 2, 5), (2, 3, 6), (2, 3, 8), (3, 4, 5), (3, 4, 7), (3, 4, 8)],
        {},
    ),
    "logistics00": (
        *("logistics", "domain_logistics00.pddl", LOGISTICS),
        [(2, 2, 6, 1, 2, 4), (2, 2, 6, 1, 2, 6), (3, 2, 9, 1, 3, 8), (4, 2, 12, 1, 4, 10), (4, 2, 12, 1, 4, 12)]
        + [(5, 2, 15, 2, 5, 13), (5, 2, 15, 2, 5, 15)],
        {"style": "00"},
    ),
    "logistics98": (
        *("logistics", "domain.pddl", LOGISTICS),
        [(4, 2, 5, 2, 5, 4), (8, 3, 8, 3, 10, 7), (10, 4, 14, 4, 14, 12), (14, 5, 20, 5, 20, 17)]
        + [(18, 6, 26, 6, 28, 22), (24, 6, 33, 8, 36, 28), (30, 7, 40, 10, 50, 34)],
        {"style": "98"},
    ),
    "miconic": (
        *("miconic", "domain.pddl", "num_floors num_passengers"),
        [(2 * number, number) for number in (1, 5, 10, 15, 20, 25, 30)],
        {},
    ),
    "nomystery": (
        *("nomystery", "domain.pddl", "num_locations num_packages constrainedness"),
        [(6, 6, 1.5), (7, 7, 1.1), (8, 8, 1.5), (10, 10, 1.1), (11, 11, 1.5), (13, 13, 1.5), (15, 15, 1.5)],
        {"edge_factor": 1.5, "max_edge_cost": 25},
    ),
    "parking": ("parking", "domain.pddl", PARKING, curbs(5, 7, 8, 9, 10, 11, 12), {}),
    "parking14": ("parking", "domain.pddl", PARKING, curbs(12, 13, 15, 16, 17, 19, 21), {}),
    "pipesworld-notankage": (
        *("pipesworld_tankage", "../pipesworld_notankage/domain.pddl", PIPESWORLD),
        [(1, 6, 2), (1, 10, 4), (1, 14, 6), (2, 10, 2), (2, 14, 5), (3, 14, 5), (3, 16, 5)],
        {"tankage": None},
    ),
    "pipesworld-tankage": (
        *("pipesworld_tankage", "domain.pddl", f"{PIPESWORLD} tankage"),
        [(1, 6, 2, 50), (1, 10, 4, 50), (1, 12, 5, 80), (2, 10, 2, 20), (2, 14, 5, 30), (3, 14, 3, 60), (3, 16, 5, 60)],
        {},
    ),
    "rovers": (
        *("rovers", "domain.pddl", "num_rovers num_waypoints num_objectives num_cameras num_goals"),
        [(1, 4, 2, 1, 2), (2, 6, 3, 3, 4), (4, 10, 4, 5, 5), (4, 15, 5, 6, 6), (6, 20, 8, 7, 8), (8, 40, 10, 10, 12)]
        + [(14, 80, 14, 16, 18)],
        {},
    ),
    "satellite": (
        *("satellite", "domain.pddl", "num_satellites max_instruments num_modes num_targets num_observations"),
        [(1, 3, 3, 3, 4), (2, 3, 3, 4, 6), (3, 3, 4, 5, 10), (5, 3, 4, 5, 15), (6, 3, 5, 5, 20), (10, 3, 6, 5, 30)]
        + [(15, 3, 8, 5, 40)],
        {},
    ),
    "sokoban": (
        *("sokoban", "domain.pddl", "width height num_floor num_stones"),
        [(8, 7, 20, 2), (9, 8, 26, 3), (10, 9, 32, 4), (11, 10, 42, 5), (12, 11, 50, 6), (14, 12, 60, 8)]
        + [(16, 13, 75, 10)],
        {},
    ),
    "storage": (
        *("storage", "domain.pddl", "num_crates num_hoists num_store_areas num_depots num_containers"),
        [(1, 1, 1, 1, 1), (3, 2, 6, 1, 1), (5, 2, 10, 1, 2), (8, 3, 16, 2, 2), (11, 3, 22, 2, 3), (15, 4, 30, 3, 4)]
        + [(20, 5, 40, 4, 5)],
        {},
    ),
    "termes": (
        *("termes", "domain.pddl", "size_x size_y min_height max_height num_towers"),
        [(4, 3, 2, 3, 1), (4, 3, 2, 3, 2), (4, 3, 2, 4, 3), (4, 4, 2, 5, 2), (4, 3, 2, 6, 3), (4, 4, 2, 7, 3)]
        + [(4, 4, 2, 8, 5)],
        {},
    ),
    "tpp": (
        *("tpp", "domain.pddl", "num_products num_markets num_trucks num_depots max_level"),
        [(1, 1, 1, 1, 1), (4, 1, 1, 1, 1), (6, 2, 2, 1, 2), (8, 3, 3, 1, 3), (11, 4, 3, 2, 4), (15, 6, 5, 2, 5)]
        + [(20, 8, 8, 3, 6)],
        {},
    ),
    "transport": (
        *("transport", "domain_action_costs.pddl", "kind num_nodes num_trucks num_packages"),
        [("city", 5, 2, 2), ("city", 20, 3, 6), ("two-cities", 10, 3, 10), ("city", 38, 4, 14)]
        + [("three-cities", 15, 4, 16), ("city", 60, 4, 20), ("two-cities", 33, 4, 22)],
        {"action_costs": True},
    ),
    "visitall": ("visitall", "domain.pddl", "width", [(6,), (12,), (18,), (24,), (30,), (35,), (40,)], {}),
    "zenotravel": (
        *("zenotravel", "domain.pddl", "num_cities num_planes num_people"),
        [(3, 1, 2), (4, 2, 5), (5, 2, 7), (8, 3, 10), (12, 4, 14), (16, 5, 20), (22, 5, 25)],
        {"distance": 1000},
    ),
}

# Where a seed gives stones that stand on goals already, or several transit areas, a later one is taken.
LATER_SEEDS = {"sokoban": [0, 0, 0, 1, 0, 1, 0], "storage": [0, 0, 0, 2, 2, 1, 4]}


def centered(problem):
    """The problem of visitall that begins in the centre, as the competition's do."""
    middle = int(re.search(r"problem grid-(\d+)", problem)[1]) // 2
    cell = f"loc-x{middle}-y{middle}"
    head, goal = re.sub(r"\(at-robot [^)]*\)", f"(at-robot {cell})", problem).split("(:goal", 1)
    return re.sub(r"\(visited [^)]*\)", f"(visited {cell})", head) + "(:goal" + goal


def problems(folder):
    """The texts of a folder's problems."""
    generator, _, names, rows, fixed = DOMAINS[folder]
    make = importlib.import_module(f"{PACKAGE}.{generator}.generator").make_problem
    later = LATER_SEEDS.get(folder, [0] * len(rows))
    for number, (row, shift) in enumerate(zip(rows, later), 1):
        arguments = {**dict(zip(names.split(), row)), **fixed}
        if "seed" in inspect.signature(make).parameters:
            arguments["seed"] = 1000 * number + 7 + shift
        problem = make(**arguments)
        yield centered(problem) if folder == "visitall" else problem


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=pathlib.Path, help="the folder to write to; it is made")
    output = parser.parse_args().output
    for folder, (generator, domain, *_) in DOMAINS.items():
        package = importlib.import_module(f"{PACKAGE}.{generator}")
        there = output / folder
        there.mkdir(parents=True, exist_ok=True)
        shutil.copy(pathlib.Path(package.__path__[0]) / domain, there / "domain.pddl")
        for number, text in enumerate(problems(folder), 1):
            (there / f"p{number:02}.pddl").write_text(text)
        print(folder, flush=True)


if __name__ == "__main__":
    main()
