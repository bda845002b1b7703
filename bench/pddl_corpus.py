#!/usr/bin/env python3
"""Reads every PDDL file, BDDL's included, of Python packages with Fast Downward's translator and with typelift, and compares.

    pip install fast-downward-translate amlgym pddlgym bddl virtualhome-eval unified-planning
    python bench/pddl_corpus.py amlgym pddlgym bddl virtualhome_eval unified_planning --typelift target/release/typelift

Prints a Markdown table; with --list, also each file that one of the two refuses, with the reasons. Exit code 1 if they
disagree on a file. Writes no file.
"""

import argparse
import collections
import contextlib
import io
import json
import multiprocessing
import pathlib
import subprocess
import sys

from problems import folder_of, pairs


def read_with_fast_downward(pair):
    """The translator's reason to refuse a file, or None."""
    path, domain = pair
    if domain is None:
        return "there is no domain"
    sys.argv = ["translate", "domain", "problem"]
    sys.setrecursionlimit(100_000)
    from fast_downward.translate import options
    from fast_downward.translate.pddl_parser import parsing_functions, pddl_file

    options.set_options(["domain", "problem"])  # Some files are read only by an option's leave.
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
    parser.add_argument("--expect", type=pathlib.Path, help="fail unless this text has each row, instead of where they differ")
    arguments = parser.parse_args()
    expected = arguments.expect.read_text().splitlines() if arguments.expect else None
    unexpected = 0
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
        row = f"| {folder.name} | {len(work)} | {' | '.join(map(str, numbers))} |"
        print(row)
        unexpected += expected is not None and row not in expected
    if arguments.list:
        print("\n| file | typelift | Fast Downward |\n|---|---|---|")
        for path, ours, theirs in details:
            if ours or theirs:
                print(f"| {path} | {ours or 'reads it'} | {theirs or 'reads it'} |")
    return 1 if (disagreements if expected is None else unexpected) else 0


if __name__ == "__main__":
    sys.exit(main())
