#!/usr/bin/env python3
"""Gives every command of rollrig again: whether it says and writes the same bytes.

    tools/repeat_commands.py PROGRAM [--short] [--only NAME ...]

Each command is given with one thread, again, with two threads, and with two threads in a German locale and another
time zone. Exit status, standard output, standard error and all files must be the same. --short leaves out what takes
longer. Exit status: 1 where something differs.
"""
import argparse
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXAMPLES = os.path.join(ROOT, "assets", "examples")
ASSETS = os.path.join(ROOT, "assets")
BAD = os.path.join(ROOT, "tests", "bad_input")

# Names, and the lines to be given one after the other in an empty folder. "2: " before a line: the exit status.
# {e}, {a}, {b}: the folders above. {t}: --threads N.
QUICK = {
    "run": ["run skim --tire a50 --sensors source --out out --write-set set --json run.json --html run.html"],
    "run of a vehicle": ["run drive_cycle --tire a50 --vehicle volvo_ex30 --fidelity quasi_static --out out "
                         "--html run.html"],
    "run by multibody": ["run iso_28580 --tire a60 --out out --report report.html"],
    "budget": ["run iso_28580 --tire a50 --sensors source --fidelity quasi_static --uncertainty --monte-carlo 200 "
               "--json run.json --report run.html {t}"],
    "sweep": ["sweep skim --tire a50 --vary load_N=4000:6000:250 --out out --json sweep.json --html sweep.html {t}"],
    "campaign": ["campaign new sums skim --tire a50 --draw-sd tire --points 12 --fidelity quasi_static",
                 "campaign run sums --json run.json {t}", "campaign status sums",
                 "campaign export sums --csv sums.csv --mat sums.mat --hdf5 sums.h5", "campaign merge sums",
                 "campaign slurm sums --tasks 3"],
    "sensitivity": ["campaign new s skim --tire a50 --draw load_N=uniform:4000:6000 --draw speed_km_h=uniform:60:100 "
                    "--design sobol_indices --points 16 --fidelity quasi_static", "campaign run s {t}",
                    "campaign sensitivity s --result parasitic_N --json s.json --html s.html"],
    "fit road-load": ["fit road-load {e}/coastdowns.csv --mass 2203 --out out --json fit.json --html fit.html "
                      "--report fit.report.html --uncertainty --monte-carlo 300 {t}"],
    "fit road-load of the WLTP": ["fit road-load {e}/coastdowns.csv --mass 2203 --method wltp --json fit.json"],
    "fit j2452": ["fit j2452 {e}/j2452_points.csv --maximum-load 6000 --base-pressure 250 --uncertainty "
                  "--monte-carlo 300 --out out --html fit.html {t}",
                  "export out/fit.json --tydex t.tdx --simscape s.m --fastsim f.json --co2mpas c.json --tir t.tir "
                  "--tire-radius 0.32"],
    "fit j1269": ["fit j1269 {e}/j1269_points.csv --uncertainty --monte-carlo 300 --out out --html fit.html {t}"],
    "fit drum-coastdown": ["fit drum-coastdown {e}/drum_coastdown/coasts.toml --out out --json fit.json "
                           "--html fit.html"],
    "fit default-road-load": ["fit default-road-load --mass 1500 --width 1.8 --height 1.5 --out out --html fit.html"],
    "import": ["import {e}/logs/import.toml --out out --json import.json"],
    "import of guesses": ["import --guess {e}/own_logs --tire a50 --rig drum_2m --cold-pressure 280 --out out "
                          "--json import.json"],
    "new": ["new tire --size 205/55R16 --load-index 91 --rrc 8.2 --out tire.toml --json new.json",
            "new rig --diameter 1.7 --inertia 280 --out rig.toml",
            "new vehicle --mass 1900 --abc 147.7 -0.237 0.0345 --out vehicle.toml",
            "new set {e}/own_logs --tire a50 --rig drum_2m --cold-pressure 280 --out import.toml"],
    "export": ["run skim --tire a50 --sensors source --out out --write-set set --quiet",
               "export set --mat set.mat --hdf5 set.h5", "export out --mat out.mat --hdf5 out.h5"],
    "export for VECTO": ["export c3_315_80r22_5 --vecto tire.xml"],
    "export fmu": ["export fmu --tire a50 --out two.fmu", "export fmu --tire a50 --fmi 3 --out three.fmu"],
    "convert": ["convert --force 32 --from-drum 2.0 --to-drum 1.2 --tire a50 --json loss.json"],
    "label": ["label --rrc 8.4 --class C1 --json label.json", "label --tire c3_315_80r22_5"],
    "align": ["align {e}/alignment.csv --machine drum_B --reference-machine drum_A --reference 1.003 -0.05 "
              "--preliminary --out out --html a.html "
              "--report a.report.html --uncertainty --monte-carlo 300 {t}",
              "align --apply out/alignment.json --rrc 8.1 --on 2026-03-02 --json v.json"],
    "compare": ["compare a40 a50 --out out --json c.json --html c.html {t}"],
    "list, describe, help": ["list", "describe iso_28580", "describe a50", "describe bearing_warmup", "help run",
                             "man", "completion bash", "--version", "diagnose --explain bearing_warmup"],
    "validate": ["validate {e}/hidden_effect", "validate {a}/tires/a50.toml {a}/rigs/drum_2m.toml"],
    "wrong input": ["2: validate {b}/tire_class_and_index.toml", "2: run skim --tire a51 --out out",
                    "2: label --rrc 8,4 --class C1",
                    "2: fit road-load {b}/coastdown_bad_rows.csv --mass 2000"],
}
LONG = {
    "plan": ["plan --rig drum --hours 4 --out out --json plan.json --html plan.html {t}"],
    "diagnose": ["diagnose {e}/hidden_effect --plan next --json why.json --html why.html {t}"],
    "diagnoses": ["run warm_up --tire a50 --sensors source --fidelity quasi_static --write-set sets/a --quiet",
                  "run warm_up --tire a60 --sensors source --fidelity quasi_static --write-set sets/b --quiet",
                  "diagnose sets --only bearing_warmup,torque_gain --json why.json --html why.html {t}",
                  "run warm_up --tire a50 --sensors source --fidelity quasi_static --seed 2 --write-set other --quiet",
                  "diagnose sets/a --against other --only bearing_warmup --json pair.json --html pair.html {t}",
                  "campaign new-diagnoses d sets --only bearing_warmup", "campaign run d {t}",
                  "campaign summary d --json d.json --html d.html", "compare sets/a sets/b --html c.html {t}"],
    "fit tire": ["fit tire {e}/hidden_effect --out out --json fit.json --html fit.html {t}"],
    "regress": ["regress --json all.json --html all.html {t}"],
}


def make_locale(base):
    """Environment of the German locale; None where there is none to be had."""
    found = {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "TZ": "Asia/Kathmandu"}
    if b"de_DE.utf8" in subprocess.run(["locale", "-a"], stdout=subprocess.PIPE).stdout:
        return found
    if not shutil.which("localedef"):
        return None
    subprocess.call(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(base, "de_DE.UTF-8")],
                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return dict(found, LOCPATH=base) if os.path.isdir(os.path.join(base, "de_DE.UTF-8")) else None


def read_files(folder):
    """Content by name; without the results of a campaign's processes, which are in the order of their ends."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            if name.startswith("results_") and name.endswith(".sqlite"):
                continue
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


def without_progress(errors):
    """Lines of progress, such as "diagnose  4 %, about 9 min left", come and go with the load of the machine."""
    return b"".join(line for line in errors.splitlines(True) if not re.match(rb"[a-z]+( [a-z]+)*  \S", line))


def give(program, lines, threads, environment, base):
    """All bytes that the lines say and write, by name; what went wrong."""
    folder = os.path.join(base, "here")  # always the same, since pages and manifests name their inputs
    os.mkdir(folder)
    found, wrong = {}, []
    for line in lines:
        wanted, _, rest = line.rpartition(": ") if line[1:3] == ": " else ("0", "", line)
        words = [word.format(e=EXAMPLES, a=ASSETS, b=BAD, t="{t}") for word in rest.split()]
        words = sum((["--threads", str(threads)] if word == "{t}" else [word] for word in words), [])
        done = subprocess.run([program] + words, cwd=folder, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
        found["standard output of: " + rest] = done.stdout
        found["standard error of: " + rest] = without_progress(done.stderr)
        if done.returncode != int(wanted):
            wrong.append("%s: exit status %d: %s" % (rest, done.returncode, done.stderr.decode("utf-8", "replace")))
    found.update(read_files(folder))
    shutil.rmtree(folder)
    return found, wrong


def describe(first, second):
    a, b = (text.decode("utf-8", "replace").splitlines() for text in (first, second))
    changed = [line for line in difflib.unified_diff(a, b, n=0, lineterm="") if line[:3] not in ("---", "+++")]
    return "%d and %d bytes; %s" % (len(first), len(second), " | ".join(line[:160] for line in changed[:6]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--only", nargs="+", default=[])
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    base = tempfile.mkdtemp(prefix="rollrig-repeats-")
    plain = dict(os.environ, LC_ALL="C.UTF-8", TZ="UTC")
    german = make_locale(base)
    ways = [("given again", 1, plain), ("two threads", 2, plain)]
    if german is not None:
        ways.append(("German locale, other time zone, two threads", 2, dict(os.environ, **german)))
    else:
        print("German locale: skipped, since it is not installed and localedef cannot make it")
    commands = dict(QUICK) if options.short else dict(QUICK, **LONG)
    compared = differences = 0
    try:
        for name, lines in commands.items():
            if options.only and name not in options.only:
                continue
            first, wrong = give(program, lines, 1, plain, base)
            for way, threads, environment in ways:
                other, more = give(program, lines, threads, environment, base)
                wrong += more
                for file in sorted(set(first) | set(other)):
                    compared += 1
                    if first.get(file) == other.get(file):
                        continue
                    wrong.append("%s: %s differs: %s" %
                                 (way, file, describe(first.get(file, b""), other.get(file, b""))))
            print("%-32s %4d files and texts%s" % (name, len(first), "" if not wrong else ": WRONG"), flush=True)
            for what in wrong:
                print("  " + what, flush=True)
            differences += len(wrong)
    finally:
        shutil.rmtree(base, ignore_errors=True)
    print("%d comparisons, %d wrong" % (compared, differences))
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
