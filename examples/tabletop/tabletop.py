"""A toy simulator: a gripper over a table. Everything it reports is a noisy pose; it knows no symbols.

Lengths are metres. Items stand in a row on the table, about 13 cm apart, and cloths lie on a shelf. Python 3.8 or later;
standard library only.
"""
import random

NOISE = 0.003  # each reported coordinate is off by up to this

# name: its kind, where it stands, how far it reaches to either side, and how far above its own base things rest on it
FURNITURE = {
    "table_1": ("table", (0.0, 0.0, 0.0), 0.80, 0.00),
    "shelf_1": ("shelf", (0.0, 0.70, 0.30), 0.40, 0.00),
    "tray_1": ("tray", (-0.35, -0.15, 0.0), 0.20, 0.03),
    "box_1": ("box", (0.35, -0.15, 0.0), 0.15, 0.03),
}
ITEMS = ["cup_1", "block_1", "bottle_1", "sponge_1", "cloth_1"]
SLOTS = (-0.13, 0.0, 0.13)  # places on a tray or in a box, from its middle
HOME = (0.0, -0.60, 0.40)  # where the gripper waits


def kind_of(item):
    return item.rsplit("_", 1)[0]


class Tabletop:
    def reset(self, seed=0, items=ITEMS, slippery=(), glued=()):
        """Puts these items onto the table. A slippery one slips at the first grasp, a glued one never comes off."""
        self.random = random.Random(seed)
        row = self.random.sample(list(items), len(items))
        self.at = {item: (0.13 * i - 0.065 * (len(row) - 1), 0.25, 0.0) for i, item in enumerate(row)}
        self.at.update((item, (0.0, 0.70, 0.30)) for item in row if kind_of(item) == "cloth")
        self.dirt = {"tray_1": 1.0, "box_1": 1.0}
        self.slippery, self.glued = set(slippery), set(glued)
        self.held = None

    def observe(self):
        """What cameras and the gripper report: name, kind, noisy pose, and what else can be measured."""
        bodies = {"gripper_1": {"kind": "gripper", "xyz": HOME, "holds": self.held}}
        for name, (kind, xyz, reach, top) in FURNITURE.items():
            bodies[name] = {"kind": kind, "xyz": xyz, "reach": reach, "top": top}
            if name in self.dirt:
                bodies[name]["dirt"] = self.dirt[name]
        for item, xyz in self.at.items():
            xyz = HOME if item == self.held else xyz
            noisy = [round(value + self.random.uniform(-NOISE, NOISE), 4) for value in xyz]
            bodies[item] = {"kind": kind_of(item), "xyz": noisy}
        return bodies

    def act(self, name, args):
        """Runs a motion to its end. Returns None, or why the controller could not do it."""
        motion = {"pick": self.pick, "place": self.place, "push": self.push, "wipe": self.wipe}.get(name)
        if motion is None or len(args) != (2 if name == "pick" else 4 if name == "push" else 3):
            return f"no such motion: {name} {' '.join(args)}"
        return motion(*args[1:])  # there is only one gripper

    # The motions, in the order in which their arguments are given. Each happens, or leaves all as it was.

    def pick(self, item):
        if self.held is not None or item not in self.at:
            return f"cannot grasp {item}"
        if item in self.glued:
            return f"{item} does not come off"
        if item in self.slippery:
            self.slippery.discard(item)  # it slips out of the fingers, and the controller does not notice
            return None
        self.held = item

    def place(self, support, item):
        if self.held != item or support not in FURNITURE:
            return f"cannot place {item} on {support}"
        _, (x, y, z), _, top = FURNITURE[support]
        taken = [spot for other, spot in self.at.items() if other != item]
        free = [spot for spot in ((x + slot, y, z + top) for slot in SLOTS) if spot not in taken]
        if not free:
            return f"{support} is full"
        self.at[item], self.held = free[0], None

    def push(self, table, target, item):
        """Pushes an item over the table until it stands beside the target."""
        if self.held is not None or table not in FURNITURE or not {target, item} <= self.at.keys() or target == item:
            return f"cannot push {item} to {target}"
        (x, y, z), (_, _, level) = self.at[target], FURNITURE[table][1]
        if {z, self.at[item][2]} != {level} or item in self.glued:
            return f"{item} does not get to {target}"
        self.at[item] = (x, y - 0.07, z)

    def wipe(self, tool, target):
        if self.held != tool or kind_of(tool) not in ("sponge", "cloth") or target not in self.dirt:
            return f"cannot wipe {target} with {tool}"
        self.dirt[target] = 0.0
