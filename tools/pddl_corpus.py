#!/usr/bin/env python3
"""Reads every PDDL file of two Python packages with Fast Downward's translator and with typelift, and compares.

    pip install fast-downward-translate amlgym pddlgym
    python tools/pddl_corpus.py amlgym pddlgym --typelift target/release/typelift

Prints a Markdown table; with --list, also each file that one of the two refuses, with the reasons. Exit code 1 if they
disagree on a file. Writes no file.
"""

import argparse
import collections
import contextlib
import importlib.util
import io
import json
import multiprocessing
import pathlib
import re
import subprocess
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
    files = sorted(folder.rglob("*.pddl"))
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


def read_with_fast_downward(pair):
    """The translator's reason to refuse a file, or None."""
    path, domain = pair
    if domain is None:
        return "there is no domain"
    sys.argv = ["translate", "domain", "problem"]
    sys.setrecursionlimit(100_000)
    from fast_downward.translate.pddl_parser import parsing_functions, pddl_file

    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            if path == domain:
                lisp = pddl_file.parse_pddl_file("domain", str(path))
                list(parsing_functions.parse_domain_pddl(parsing_functions.Context(), lisp))
            else:
                pddl_file.open(str(domain), str(path))
    except BaseException as error:  # The translator also ends by SystemExit and AssertionError.
        lines = [line for line in str(error).splitlines() if line and not line.startswith("\t->")]
        return f"{type(error).__name__}: {' '.join(lines[-3:])}".replace("|", "/")[:200]
    return None


def read_with_typelift(program, work):
    """typelift's report on each file."""
    groups = collections.defaultdict(list)
    for path, domain in work:
        groups[domain].append(path)
    reports = {}
    for domain, paths in groups.items():
        files = ([domain] if domain and domain not in paths else []) + paths
        command = [program, "pddl", "check", "--json", *map(str, files)]
        ended = subprocess.run(command, capture_output=True, text=True)
        for line in ended.stdout.splitlines():
            report = json.loads(line)
            reports[pathlib.Path(report["file"])] = report
    return reports


def reason(report):
    error = report.get("error")
    if not error:
        return None
    return ("not supported: " if error["unsupported"] else "") + error["message"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", nargs="+", help="folders, or names of installed packages")
    parser.add_argument("--typelift", default="typelift", help="the program")
    parser.add_argument("--list", action="store_true", help="name each file that one of the two refuses")
    arguments = parser.parse_args()
    print("| package | files | read by both | refused by both | read by typelift only | read by Fast Downward only |")
    print("|---|---:|---:|---:|---:|---:|")
    details = []
    disagreements = 0
    for package in arguments.packages:
        folder = folder_of(package)
        work = list(pairs(folder))
        with multiprocessing.Pool() as pool:
            theirs = pool.map(read_with_fast_downward, work, chunksize=16)
        reports = read_with_typelift(arguments.typelift, work)
        groups = collections.Counter()
        for (path, _), their_reason in zip(work, theirs):
            our_reason = reason(reports[path])
            groups[(our_reason is None, their_reason is None)] += 1
            details.append((path.relative_to(folder), our_reason, their_reason))
            disagreements += (our_reason is None) != (their_reason is None)
        numbers = [groups[key] for key in [(True, True), (False, False), (True, False), (False, True)]]
        print(f"| {folder.name} | {len(work)} | {' | '.join(map(str, numbers))} |")
    if arguments.list:
        print("\n| file | typelift | Fast Downward |\n|---|---|---|")
        for path, ours, theirs in details:
            if ours or theirs:
                print(f"| {path} | {ours or 'reads it'} | {theirs or 'reads it'} |")
    return 1 if disagreements else 0


if __name__ == "__main__":
    sys.exit(main())
