#!/usr/bin/env python3
"""TextWorld's cooking games as an `env/1` environment, without a word of text: their facts are the state.

    pip install textworld
    typelift run … --env 'python bench/worlds/cooking_game.py GAMES'

A game is made when it is asked for, by a seed and a scenario with the game's own settings, which takes some seconds, and is kept
in the folder GAMES. A call is named by the words of the game's command, `cook carrot with oven` is `cook_with(P, I, carrot,
oven)`: the player and the inventory come first in every call. What a rule of the game would need and does not find is the
reason why a call is refused, in the game's own words.
"""

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from serving import Call, serve
from textworld.challenges.tw_cooking import cooking
from textworld.generator.game import Game, GameOptions, GameProgression
from textworld.logic import Action, Placeholder, Proposition, Rule, Signature, Variable

PLAYER, INVENTORY = "P", "I"
LOOKING = ("look", "inventory", "examine")  # Commands that change nothing.
NOT_PROCESSED = ("raw", "uncut")


def make_game(folder: Path, seed: int, settings: dict[str, Any]) -> Game:
    """The game of a seed and settings: always the same, and made once."""
    words = "-".join(f"{key}_{settings[key]}" for key in sorted(settings))
    file = folder / f"{words}-seed_{seed}.json"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        options = GameOptions()
        options.seeds = seed
        game = cooking.make({"drop": False, "recipe_seed": 0, **settings}, options)
        unfinished = file.with_suffix(".part")
        game.save(str(unfinished))
        unfinished.rename(file)
    return Game.load(str(file))


class CookingGame:
    """A cooking game under way."""

    name = "textworld-cooking"

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def reset(self, seed: int, scenario: dict[str, Any]) -> None:
        self.game = make_game(self.folder, seed, scenario)
        self.progress = GameProgression(self.game)
        # The game's variables are called f_0, r_0 and so on; people say carrot and kitchen.
        self.said = {key: info.name or key for key, info in self.game.infos.items()}
        self.ids = {key: name.replace(" ", "_") for key, name in self.said.items()}
        self.keys = {name: key for key, name in self.ids.items()}

    def types(self) -> dict[str, str]:
        """The type above each type of the game's."""
        tree = self.game.kb.types
        return {name: tree[name].parent or "object" for name in tree if name != "object"}

    def state(self) -> dict[str, Any]:
        objects = {self.ids[key]: info.type for key, info in self.game.infos.items()}
        return {"objects": objects, "atoms": sorted(self.atom(fact) for fact in self.progress.state.facts)}

    def atom(self, fact: Proposition) -> str:
        return f"{fact.name}({','.join(self.ids[argument.name] for argument in fact.arguments)})"

    def goal(self) -> list[str]:
        """Everything of the recipe done as it says, and the meal eaten."""
        processed = [
            f"{done}({food.replace(' ', '_')})"
            for food, *processing in self.game.metadata["ingredients"]
            for done in processing
            if done not in NOT_PROCESSED
        ]
        return [*processed, "consumed(meal)"]

    def walkthrough(self) -> Iterator[Call]:
        """The game's own walkthrough, but for what only looks."""
        for command in self.game.metadata["walkthrough"]:
            if command.split()[0] not in LOOKING:
                yield self.parse(command)

    def parse(self, command: str) -> Call:
        ids = {name: self.ids[key] for key, name in self.said.items()}
        for template in self.game.kb.inform7_commands.values():
            pattern = re.sub(r"\\{.*?\\}", "(.+)", re.escape(template))
            match = re.fullmatch(pattern, command)
            if match and all(name in ids for name in match.groups()):
                return call_name(template), [PLAYER, INVENTORY, *(ids[name] for name in match.groups())]
        raise ValueError(f"there is no command `{command}`")

    def act(self, name: str, args: list[str]) -> str | None:
        if self.progress.failed:
            return "You lost!"
        if args[:2] != [PLAYER, INVENTORY]:
            return "Only the player acts, with what is in the inventory."
        things = [self.keys[argument] for argument in args[2:]]
        for action in list(self.progress.valid_actions):
            if call_of(action) == (name, things):
                self.progress.update(action)
                return None
        return self.refusal(name, things)

    def refusal(self, name: str, things: list[str]) -> str:
        """What the rule that comes nearest misses."""
        misses = []
        for rule in self.game.kb.rules.values():
            template = self.game.kb.inform7_commands.get(rule.name, "")
            mapping = self.mapping(rule, template, things)
            if call_name(template) == name and mapping is not None:
                misses.append([fact for fact in known_needs(rule, mapping) if not self.progress.state.is_fact(fact)])
        if not misses:
            return "That is not something you can do."
        missed = [words for fact in min(misses, key=len) if (words := self.words(fact))]
        return f"Not so: {missed[0]}." if missed else "You still miss something."

    def mapping(self, rule: Rule, template: str, things: list[str]) -> dict[Placeholder, Variable] | None:
        """What stands for a rule's placeholders, as far as a call says; nothing if a thing is not of the type it takes."""
        named = dict(zip(re.findall(r"{(.*?)}", template), things, strict=False))
        if len(named) != len(things):
            return None
        state, types, mapping = self.progress.state, self.game.kb.types, {}
        room = next(fact.arguments[1] for fact in state.facts if fact.name == "at" and fact.arguments[0].name == PLAYER)
        for placeholder in rule.placeholders:
            if placeholder.name in named:
                thing = state.variable_named(named[placeholder.name])
                if not types.is_descendant_of(thing.type, placeholder.type):
                    return None
                mapping[placeholder] = thing
            elif placeholder.name in (PLAYER, INVENTORY):
                mapping[placeholder] = Variable(placeholder.name, placeholder.type)
            elif placeholder.name == "r":
                mapping[placeholder] = room
        return mapping

    def words(self, fact: Proposition) -> str:
        signature = Signature(fact.name, tuple(argument.type for argument in fact.arguments))
        predicate, text = self.game.kb.inform7_predicates.get(signature, (None, ""))
        if not text:
            return ""
        names = (self.said[argument.name] for argument in fact.arguments)
        return text.format(**{each.name: name for each, name in zip(predicate.parameters, names, strict=True)})


def known_needs(rule: Rule, mapping: dict[Placeholder, Variable]) -> list[Proposition]:
    """What a rule needs, as far as it is known of which things."""
    known = (need for need in rule.preconditions if all(each in mapping for each in need.parameters))
    return [need.instantiate(mapping) for need in known]


def call_name(template: str) -> str:
    """The words of a command: `take {o} from {c}` is `take_from`."""
    return "_".join(re.sub(r"{.*?}", " ", template).split())


def call_of(action: Action) -> tuple[str, list[str]]:
    template = action.command_template or ""
    return call_name(template), re.findall(r"{(.*?)}", template)


if __name__ == "__main__":
    serve(CookingGame(Path(sys.argv[1])))
