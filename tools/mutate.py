#!/usr/bin/env python3
"""Mutation test: changes one operator, sign, factor or index of the code at a time and asks whether a fast test fails.

Mutants are drawn at random (seeded), as many from each folder as it has code. Each is built and tested in a worktree of
HEAD under build/mutants; what is not committed is not tested. Results are appended to build/mutants/results.jsonl: a
run that was cut short goes on there. On two idle cores a mutant takes about 15 s, one in a header more.

  tools/mutate.py                         draws and judges 240 mutants, prints the share that is killed
  tools/mutate.py --survivors             judges those that survived again, with the tests as they are now
  tools/mutate.py --list                  prints survivors and the share, judges nothing
"""
import argparse
import concurrent.futures
import json
import queue
import random
import re
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutants"
RESULTS = WORK / "results.jsonl"
TIMES = WORK / "times.json"
FOLDERS = ("models", "rigs", "estimation", "diagnosis")
# Programs with tests of these folders, the quickest first; the own program of a mutant's folder runs before all others.
PROGRAMS = ("models_tests", "measurements_tests", "api_tests", "published_tests", "report_tests", "scenarios_tests",
            "estimation_tests", "scoring_tests", "cli_tests", "rigs_tests", "diagnosis_tests")

STARTERS = ("cli_tests", "api_tests", "scoring_tests", "report_tests", "published_tests")

# Kind, what is searched in code without its comments and texts, what stands there in a mutant.
CHANGES = (
    ("sign", re.compile(r"(?<=[\w)\]}]) \+ (?=[\w(!*&-])"), " - "),
    ("sign", re.compile(r"(?<=[\w)\]}]) - (?=[\w(!*&-])"), " + "),
    ("sign", re.compile(r" \+= "), " -= "),
    ("sign", re.compile(r" -= "), " += "),
    ("sign", re.compile(r"(?<=[(,=] )-(?=[A-Za-z_(])|(?<=[(\[])-(?=[A-Za-z_(])|(?<=return )-(?=[A-Za-z_(])"), ""),
    ("factor", re.compile(r"(?<=[\w)\]}]) \* (?=[\w(!*&-])"), " / "),
    ("factor", re.compile(r"(?<=[\w)\]}]) / (?=[\w(!*&-])"), " * "),
    ("factor", re.compile(r" \*= "), " /= "),
    ("operator", re.compile(r"(?<=[\w)\]}]) < (?=[\w(!*&-])"), " >= "),
    ("operator", re.compile(r"(?<=[\w)\]}]) > (?=[\w(!*&-])"), " <= "),
    ("operator", re.compile(r" <= "), " > "),
    ("operator", re.compile(r" >= "), " < "),
    ("operator", re.compile(r" == "), " != "),
    ("operator", re.compile(r" != "), " == "),
    ("operator", re.compile(r" && "), " || "),
    ("operator", re.compile(r" \|\| "), " && "),
    ("operator", re.compile(r"std::max(?=\()"), "std::min"),
    ("operator", re.compile(r"std::min(?=\()"), "std::max"),
    ("index", re.compile(r"\[0\]"), "[1]"),
    ("index", re.compile(r"\[1\]"), "[0]"),
    ("index", re.compile(r"\.front\(\)"), ".back()"),
    ("index", re.compile(r"\.back\(\)"), ".front()"),
)
# Lines that declare, or only word a message.
NO_CODE = re.compile(r"^\s*(#|template|using|namespace|class |struct |enum |friend|static_assert|throw |case .*:$)"
                     r"|auto&& ")


def mask(text):
    """The text with comments and literals of texts blanked, each character kept in place."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def find_mutants(source, folder):
    mutants = []
    for path in sorted((source / folder).rglob("*")):
        if path.suffix not in (".cpp", ".h"):
            continue
        originals = path.read_text().split("\n")
        lines = mask(path.read_text()).split("\n")
        for number, line in enumerate(lines, 1):
            if NO_CODE.search(line):
                continue
            for kind, searched, put in CHANGES:
                for match in searched.finditer(line):
                    mutants.append({"folder": folder, "file": str(path.relative_to(source)), "line": number,
                                    "column": match.start(), "kind": kind, "from": match.group().strip(),
                                    "to": put.strip(), "length": len(match.group()), "put": put,
                                    "text": originals[number - 1].strip()})
    return mutants


def draw(source, count, seed):
    """Mutants of the code in a folder in a drawn order; of each part of it the share that it has of all code."""
    found = [mutant for folder in FOLDERS for mutant in find_mutants(source, folder)]
    random.Random(seed).shuffle(found)
    return found[:2 * count]  # some do not compile


def key_of(mutant):
    return f"{mutant['file']}:{mutant['line']}:{mutant['column']}:{mutant['from']}>{mutant['to']}"


def find_line(lines, mutant):
    """Index of the line that a mutant changes, wherever it has moved to; None where it is not there, or twice."""
    found = [i for i, line in enumerate(lines) if line.strip() == mutant["text"]]
    at_place = [i for i in found if i == mutant["line"] - 1]
    index = (at_place or found)[0] if at_place or len(found) == 1 else None
    column = mutant["column"]
    is_there = index is not None and lines[index][column:column + mutant["length"]].strip() == mutant["from"]
    return index if is_there else None


class Tree:
    """A worktree with a build of its own."""

    def __init__(self, number):
        self.source = WORK / f"tree_{number}"
        self.build = self.source / "build" / "release"

    def run(self, command, limit_s=None):
        return subprocess.run(command, cwd=self.source, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              stdin=subprocess.DEVNULL, timeout=limit_s, check=False).returncode

    def prepare(self, head):
        if not self.source.exists():
            subprocess.run(["git", "worktree", "prune"], cwd=ROOT, check=True)
            subprocess.run(["git", "worktree", "add", "--quiet", "--detach", str(self.source), head], cwd=ROOT,
                           check=True)
        subprocess.run(["git", "checkout", "--quiet", "--force", "--detach", head], cwd=self.source, check=True)
        linker = ["-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld"] if shutil.which("ld.lld") else []
        if self.run(["cmake", "--preset", "release", *linker]) != 0:
            sys.exit(f"mutate: {self.source} cannot be configured")
        if self.run(["cmake", "--build", str(self.build), "--parallel", "--target", *PROGRAMS]) != 0:
            sys.exit(f"mutate: {self.source} cannot be built")
        self.originals = {program: self.path_of(program).read_bytes() for program in PROGRAMS}

    def path_of(self, program):
        return self.build / "tests" / program

    def test(self, program, limit_s):
        """Whether all fast tests of a program pass within a time."""
        try:
            return self.run([str(self.path_of(program)), "[fast]", "--abort"], limit_s) == 0
        except subprocess.TimeoutExpired:
            return False

    def judge(self, mutant, times_s):
        path = self.source / mutant["file"]
        original = path.read_text()
        lines = original.split("\n")
        index = find_line(lines, mutant)
        if index is None:
            return "invalid", "the code has changed since"
        line, column = lines[index], mutant["column"]
        lines[index] = line[:column] + mutant["put"] + line[column + mutant["length"]:]
        path.write_text("\n".join(lines))
        try:
            own = mutant["folder"] + "_tests"
            for program in [own] + [other for other in PROGRAMS if other != own]:
                if self.run(["cmake", "--build", str(self.build), "--target", program]) != 0:
                    return "invalid", "does not compile"
                # Which does not hold the changed code; a program that starts rollrig always counts.
                if program not in STARTERS and self.path_of(program).read_bytes() == self.originals[program]:
                    continue
                # A mutant that loops for ever is killed by the clock.
                if not self.test(program, 30.0 + 3.0 * times_s[program]):
                    return "killed", program
            return "survived", ""
        finally:
            path.write_text(original)


def read_results():
    if not RESULTS.exists():
        return {}
    results = [json.loads(line) for line in RESULTS.read_text().splitlines()]
    return {key_of(result): result for result in results}


def measure_times(tree):
    """Time of each program without a mutant; all must pass."""
    if TIMES.exists():
        return json.loads(TIMES.read_text())
    times_s = {}
    for program in PROGRAMS:
        start_s = time.monotonic()
        if not tree.test(program, 3600.0):
            sys.exit(f"mutate: {program} fails without a mutant")
        times_s[program] = time.monotonic() - start_s
    TIMES.write_text(json.dumps(times_s, indent=1))
    return times_s


def prepare_trees(jobs):
    WORK.mkdir(parents=True, exist_ok=True)
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    trees = [Tree(number) for number in range(1, jobs + 1)]
    for tree in trees:
        print(f"building {tree.source.relative_to(ROOT)}", flush=True)
        tree.prepare(head.stdout.strip())
    return trees


def judge_all(mutants, wanted, trees):
    """Judges mutants until `wanted` are valid."""
    times_s = measure_times(trees[0])
    free = queue.Queue()
    for tree in trees:
        free.put(tree)
    lock = threading.Lock()
    valid = 0

    def judge(mutant):
        nonlocal valid
        if valid >= wanted:
            return
        tree = free.get()
        try:
            verdict, by = tree.judge(mutant, times_s)
        finally:
            free.put(tree)
        with lock:
            valid += verdict != "invalid"
            with RESULTS.open("a") as file:
                file.write(json.dumps({**mutant, "verdict": verdict, "by": by}) + "\n")
            print(f"{valid:4} {verdict:8} {key_of(mutant)}  {by}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(len(trees)) as pool:
        list(pool.map(judge, mutants))


def print_summary(results):
    valid = [result for result in results.values() if result["verdict"] != "invalid"]
    survivors = [result for result in valid if result["verdict"] == "survived"]
    for folder in FOLDERS:
        of_folder = [result for result in valid if result["folder"] == folder]
        killed = sum(result["verdict"] == "killed" for result in of_folder)
        print(f"{folder:12} {killed:4} of {len(of_folder):4} killed")
    killed = len(valid) - len(survivors)
    share = f" ({100 * killed / len(valid):.1f} %)" if valid else ""
    print(f"{'all':12} {killed:4} of {len(valid):4} killed{share}")
    for result in sorted(survivors, key=key_of):
        change = f"{result['from']} -> {result['to'] or 'nothing'}"
        print(f"survived: {result['file']}:{result['line']}: {change}: {result['text']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=240, help="valid mutants to judge (240)")
    parser.add_argument("--seed", type=int, default=1, help="seed of the draw (1)")
    parser.add_argument("--jobs", type=int, default=2, help="worktrees that are built side by side (2)")
    parser.add_argument("--survivors", action="store_true", help="judge those that survived again")
    parser.add_argument("--list", action="store_true", help="print the results, judge nothing")
    options = parser.parse_args()
    results = read_results()
    if not options.list:
        trees = prepare_trees(options.jobs)
        if options.survivors:
            again = [result for result in results.values() if result["verdict"] == "survived"]
            judge_all(again, len(again), trees)
        else:
            valid = sum(result["verdict"] != "invalid" for result in results.values())
            drawn = draw(trees[0].source, options.count, options.seed)
            new = [mutant for mutant in drawn if key_of(mutant) not in results]
            judge_all(new, options.count - valid, trees)
    print_summary(read_results())


if __name__ == "__main__":
    main()
