"""The problems of a folder, or of a Python package that carries some."""

import collections
import importlib.util
import pathlib
import re
import sys


def folder_of(package):
    """The folder of an installed package, without importing it; or a folder as it is."""
    if pathlib.Path(package).is_dir():
        return pathlib.Path(package).resolve()
    spec = importlib.util.find_spec(package)
    if spec is None or not spec.submodule_search_locations:
        sys.exit(f"there is neither a folder nor a package {package}")
    return pathlib.Path(list(spec.submodule_search_locations)[0])


def text_of(path):
    text = path.read_text(encoding="ISO-8859-1")
    return "\n".join(line.split(";", 1)[0] for line in text.splitlines())


def named(text, key):
    """The name in `(domain NAME)` or `(:domain NAME)`."""
    found = re.search(r"\(\s*" + key + r"\s+([^\s()]+)", text, re.IGNORECASE)
    return found and found.group(1).lower()


def pairs(folder):
    """Each file with the domain it is to be read with: itself, if it is one."""
    files = sorted(folder.rglob("*.[bp]ddl"))
    texts = {path: text_of(path) for path in files}
    domains = [path for path in files if named(texts[path], "domain")]
    by_stem = collections.defaultdict(list)
    by_name = collections.defaultdict(list)
    for path in domains:
        by_stem[path.stem].append(path)
        by_name[named(texts[path], "domain")].append(path)
    for path in files:
        if path in domains:
            yield path, path
            continue
        # Problems of `X.pddl` are in folders `X`, `X_test`, `X_train`.
        stem = path.parent.name
        for ending in ["", "_test", "_train"]:
            found = by_stem.get(stem.removesuffix(ending) if ending else stem)
            if found:
                break
        found = found or by_name.get(named(texts[path], ":domain")) or []
        yield path, found[0] if found else None


def natural(path):
    """p10 after p9."""
    return [(int(part), "") if part.isdigit() else (0, part) for part in re.split(r"(\d+)", str(path))]
