#!/usr/bin/env python3
"""Kills rollrig, fills its disk and takes its folders away while it writes.

    tools/inject_faults.py PROGRAM [--kills 200] [--seed 1] [--short]

The commands of make_commands() are run undisturbed. Then each is disturbed in every way below. After each disturbance
its outputs must be whole, with the bytes of the undisturbed run, or absent; the exit status must be the documented one
(docs/formats.md); and the same command, given again, must succeed with the same bytes. A command that takes more than
10 minutes is killed, and counts as wrong.

"campaign run" and "campaign merge" change a folder that is there: they are killed, stopped and left without room. After
each of these, "campaign status" must count all items (merge) or at most all (run), and the same command, given again,
must lead to the exported table of an undisturbed campaign.

"serve" is killed and stopped while it writes pages that are kept: each must be whole, and after SIGINT and SIGTERM its
folder of dropped files must be gone.

rollrig_validation is left out.

--short takes the quick commands alone. Faults that this machine cannot have (no root for a small disk, no German
locale) are skipped, which is said. Exit status: 1 where something was wrong.
"""
import argparse
import contextlib
import hashlib
import http.client
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXAMPLES = os.path.join(ROOT, "assets", "examples")
DONE, DIFFERS, WRONG, STOPPED = 0, 1, 2, 130
MOST_TIME_S = 600.0  # of a command


class Command:
    """A command with its outputs, which lie in the folder {o} of its arguments."""

    def __init__(self, name, arguments, outputs, quick=True, has_threads=False, refuses_again=False, inputs=None):
        self.name, self.arguments, self.outputs = name, arguments, outputs
        self.inputs = inputs  # folder whose content is copied to {o} before each run
        self.quick, self.has_threads = quick, has_threads
        self.refuses_again = refuses_again  # if its outputs exist
        self.takes_force = arguments[0] in ("run", "sweep", "fit", "import", "new", "plan", "diagnose", "align",
                                            "compare") and not refuses_again
        self.statuses = (DONE, WRONG) if arguments[0] != "regress" else (DONE, DIFFERS, WRONG)
        self.reference, self.takes_s = None, 0.0

    def words(self, folder, outputs=None, force=False):
        words = [word.replace("{o}", folder) for word in self.arguments]
        for ours, theirs in (outputs or {}).items():
            words = [word.replace(folder + "/" + ours, folder + "/" + theirs) for word in words]
        return words + (["--force"] if force and self.takes_force else [])

    def prepare(self, folder):
        """Puts the files in place that the command needs in its folder."""
        if self.inputs:
            shutil.copytree(self.inputs, folder, dirs_exist_ok=True)

    def has_folder(self):
        return any("." not in output for output in self.outputs)

    def refuses_existing(self):
        """Whether the second of two processes at a time is refused."""
        return self.has_folder() or self.arguments[0] == "new" or self.refuses_again


def make_commands(inputs):
    logs = os.path.join(EXAMPLES, "logs", "import.toml")
    coastdowns = os.path.join(EXAMPLES, "coastdowns.csv")
    return [
        Command("run", ["run", "skim", "--tire", "a50", "--sensors", "source", "--out", "{o}/out", "--write-set",
                        "{o}/set", "--json", "{o}/run.json", "--html", "{o}/run.html"],
                ["out", "set", "run.json", "run.html"]),
        Command("sweep", ["sweep", "skim", "--tire", "a50", "--vary", "load_N=4000:6000:100", "--out", "{o}/out",
                          "--json", "{o}/sweep.json", "--html", "{o}/sweep.html"],
                ["out", "sweep.json", "sweep.html"], has_threads=True),
        Command("fit", ["fit", "road-load", coastdowns, "--mass", "2203", "--out", "{o}/out", "--json", "{o}/fit.json",
                        "--html", "{o}/fit.html"], ["out", "fit.json", "fit.html"]),
        Command("import", ["import", logs, "--out", "{o}/out", "--json", "{o}/import.json"], ["out", "import.json"]),
        Command("export", ["export", inputs + "/set", "--mat", "{o}/set.mat", "--hdf5", "{o}/set.h5"],
                ["set.mat", "set.h5"]),
        Command("new", ["new", "tire", "--size", "205/55R16", "--load-index", "91", "--rrc", "8.2", "--out",
                        "{o}/tire.toml", "--json", "{o}/new.json"], ["tire.toml", "new.json"]),
        Command("new set", ["new", "set", os.path.join(EXAMPLES, "own_logs"), "--tire", "a50", "--rig", "drum_2m",
                            "--cold-pressure", "280", "--out", "{o}/import.toml", "--json", "{o}/new.json"],
                ["import.toml", "new.json"]),
        Command("label", ["label", "--rrc", "8.4", "--class", "C1", "--json", "{o}/label.json"], ["label.json"]),
        Command("align", ["align", os.path.join(EXAMPLES, "alignment.csv"), "--machine", "drum_B",
                          "--reference-machine", "drum_A", "--reference", "1.003", "-0.05", "--preliminary", "--out",
                          "{o}/out", "--json", "{o}/align.json", "--html", "{o}/align.html", "--report",
                          "{o}/report.html"], ["out", "align.json", "align.html", "report.html"], has_threads=True),
        Command("compare", ["compare", "a40", "a50", "--out", "{o}/out", "--json", "{o}/compare.json", "--html",
                            "{o}/compare.html"], ["out", "compare.json", "compare.html"], has_threads=True),
        Command("campaign new", ["campaign", "new", "{o}/campaign", "skim", "--tire", "a50", "--vary",
                                 "load_N=4000:6000:500"], ["campaign"], refuses_again=True),
        Command("campaign export", ["campaign", "export", inputs + "/campaign", "--csv", "{o}/all.csv", "--mat",
                                    "{o}/all.mat", "--hdf5", "{o}/all.h5"], ["all.csv", "all.mat", "all.h5"]),
        Command("convert", ["convert", "--force", "32", "--from-drum", "2.0", "--to-drum", "1.2", "--tire", "a50",
                            "--json", "{o}/loss.json"], ["loss.json"]),
        Command("plan", ["plan", "--rig", "drum", "--hours", "4", "--out", "{o}/out", "--json", "{o}/plan.json",
                         "--html", "{o}/plan.html"], ["out", "plan.json", "plan.html"], quick=False,
                has_threads=True),
        Command("diagnose", ["diagnose", EXAMPLES + "/hidden_effect", "--only", "bearing_warmup,torque_gain", "--plan",
                             "{o}/next", "--json", "{o}/why.json", "--html", "{o}/why.html"],
                ["next", "why.json", "why.html"], quick=False, has_threads=True),
        Command("fit", ["fit", "drum-coastdown", EXAMPLES + "/drum_coastdown/coasts.toml", "--out", "{o}/out", "--json",
                        "{o}/fit.json", "--html", "{o}/fit.html"], ["out", "fit.json", "fit.html"], quick=False),
        Command("fit", ["fit", "tire", EXAMPLES + "/hidden_effect", "--out", "{o}/out", "--json", "{o}/fit.json",
                        "--html", "{o}/fit.html"], ["out", "fit.json", "fit.html"], quick=False, has_threads=True),
        Command("regress", ["regress", "--json", "{o}/all.json", "--html", "{o}/all.html"], ["all.json", "all.html"],
                quick=False, has_threads=True),
        Command("regress --update", ["regress", "{o}/runs", "--update"], ["runs/a.golden.csv", "runs/b.golden.csv"],
                quick=False, has_threads=True, inputs=inputs + "/regression"),
        Command("fit j2452", ["fit", "j2452", os.path.join(EXAMPLES, "j2452_points.csv"), "--out", "{o}/out", "--json",
                              "{o}/fit.json", "--html", "{o}/fit.html", "--report", "{o}/report.html"],
                ["out", "fit.json", "fit.html", "report.html"], quick=False, has_threads=True),
        Command("fit j1269", ["fit", "j1269", os.path.join(EXAMPLES, "j1269_points.csv"), "--out", "{o}/out", "--json",
                              "{o}/fit.json", "--html", "{o}/fit.html"], ["out", "fit.json", "fit.html"], quick=False,
                has_threads=True),
        Command("fit default-road-load", ["fit", "default-road-load", "--mass", "1500", "--width", "1.8", "--height",
                                          "1.5", "--out", "{o}/out", "--json", "{o}/fit.json"], ["out", "fit.json"],
                quick=False),
        Command("new rig", ["new", "rig", "--diameter", "1.7", "--inertia", "280", "--out", "{o}/rig.toml", "--json",
                            "{o}/new.json"], ["rig.toml", "new.json"], quick=False),
        Command("new vehicle", ["new", "vehicle", "--mass", "1900", "--abc", "147.7", "-0.237", "0.0345", "--out",
                                "{o}/vehicle.toml", "--json", "{o}/new.json"], ["vehicle.toml", "new.json"],
                quick=False),
        Command("export of a fit", ["export", inputs + "/j2452/fit.json", "--tydex", "{o}/fit.tdx", "--tir",
                                    "{o}/fit.tir", "--tire-radius", "0.32", "--simscape", "{o}/fit.m", "--fastsim",
                                    "{o}/fastsim.json", "--co2mpas", "{o}/co2mpas.json"],
                ["fit.tdx", "fit.tir", "fit.m", "fastsim.json", "co2mpas.json"], quick=False),
        Command("export --vecto", ["export", "c3_315_80r22_5", "--vecto", "{o}/tire.xml"], ["tire.xml"], quick=False),
        Command("campaign new-diagnoses", ["campaign", "new-diagnoses", "{o}/campaign", inputs + "/sets"],
                ["campaign"], quick=False, refuses_again=True),
        Command("campaign summary", ["campaign", "summary", inputs + "/diagnoses", "--json", "{o}/all.json", "--html",
                                     "{o}/all.html"], ["all.json", "all.html"], quick=False),
        Command("campaign sensitivity", ["campaign", "sensitivity", inputs + "/draws", "--result", "drum_torque_Nm",
                                         "--json", "{o}/all.json", "--html", "{o}/all.html"], ["all.json", "all.html"],
                quick=False),
    ]


def hash_output(path):
    """SHA-256 of a file, or of all names and files of a folder; None where it is absent."""
    if not os.path.lexists(path):
        return None
    if not os.path.isdir(path):
        with open(path, "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()
    found = hashlib.sha256()
    for folder, folders, files in os.walk(path):
        folders[:] = sorted(name for name in folders if ".partial-" not in name)
        for name in sorted(files):
            full = os.path.join(folder, name)
            found.update(os.path.relpath(full, path).encode("utf-8", "surrogateescape") + b"\0")
            found.update(hash_output(full).encode())
    return found.hexdigest()


def list_files(folder):
    """Paths of all files and of empty folders below a folder, relative to it."""
    found = []
    for path, folders, files in os.walk(folder):
        names = files + [name for name in folders if not os.listdir(os.path.join(path, name))]
        found += [os.path.relpath(os.path.join(path, name), folder) for name in names]
    return sorted(found)


class Faults:
    def __init__(self, program, seed, base):
        self.program, self.base = os.path.abspath(program), base
        self.random = random.Random(seed)
        self.wrong, self.counts, self.skipped = [], {}, []
        self.number = 0

    def new_folder(self, command=None):
        self.number += 1
        folder = os.path.join(self.base, "w%d" % self.number)
        os.mkdir(folder)
        if command:
            command.prepare(folder)
        return folder

    def start(self, words, **options):
        options.setdefault("stdout", subprocess.DEVNULL)
        options.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen([self.program] + words, **options)

    def finish(self, process):
        """Exit status and standard error. A process that hangs is killed, so that its status is none of the allowed."""
        try:
            errors = process.communicate(timeout=MOST_TIME_S)[1] or b""
        except subprocess.TimeoutExpired:
            process.kill()
            errors = (process.communicate()[1] or b"") + b"\nkilled after %d s" % MOST_TIME_S
        return process.returncode, errors.decode("utf-8", "replace")

    def run(self, words, **options):
        return self.finish(self.start(words, **options))

    def check(self, fault, command, is_right, what):
        self.counts[fault] = self.counts.get(fault, 0) + 1
        if not is_right:
            self.wrong.append("%s, %s: %s" % (fault, command.name, what))

    def find_states(self, command, folder, outputs=None):
        """Of each output: whole, absent or broken."""
        names = outputs or {}
        states = {}
        for output, expected in command.reference.items():
            found = hash_output(os.path.join(folder, names.get(output, output)))
            states[output] = "absent" if found is None else "whole" if found == expected else "broken"
        return states

    def check_states(self, fault, command, folder, allowed, outputs=None):
        states = self.find_states(command, folder, outputs)
        self.check(fault, command, set(states.values()) <= set(allowed), "outputs are %s" % states)
        known = set((outputs or {}).get(name, name) for name in command.reference)
        if command.name == "sweep" and "absent" in allowed:
            known |= {name + ".unfinished" for name in known}  # what is done, for the same command to go on with
        if command.inputs:
            known |= set(list_files(command.inputs))
        others = [name for name in list_files(folder) if ".partial-" not in name and
                  not any(name == one or name.startswith(one + os.sep) for one in known)]
        self.check(fault, command, not others, "left %s" % others)
        return states

    def check_no_leftover(self, fault, command, folder):
        left = [name for name in list_files(folder) if ".partial-" in name]
        self.check(fault, command, not left, "left %s" % left)

    def check_repeats(self, fault, command, folder):
        """The same command again, over what is there."""
        there = "whole" in self.find_states(command, folder).values()
        status, errors = self.run(command.words(folder, force=there))
        expected = WRONG if there and command.refuses_again else DONE
        self.check(fault, command, status == expected, "given again it exits with %d: %s" % (status, errors))
        self.check_states(fault, command, folder, ["whole"])

    def make_reference(self, command):
        for is_second in (False, True):
            folder = self.new_folder(command)
            start = time.time()
            status, errors = self.run(command.words(folder))
            command.takes_s = time.time() - start
            if status != DONE:
                sys.exit("%s does not even run undisturbed: exit %d\n%s" % (command.name, status, errors))
            found = {output: hash_output(os.path.join(folder, output)) for output in command.outputs}
            self.check("undisturbed", command, None not in found.values(), "outputs are missing: %s" % found)
            if is_second:
                self.check("undisturbed", command, found == command.reference, "two runs differ")
            command.reference = found
            shutil.rmtree(folder)

    def draw_moment_s(self, command):
        """Any time of a run, or, as often, one near its end, where it writes."""
        if self.random.random() < 0.5:
            return self.random.uniform(0.0, 1.1 * command.takes_s)
        return max(0.0, command.takes_s * self.random.uniform(0.75, 1.1))

    def kill(self, command):
        folder = self.new_folder(command)
        process = self.start(command.words(folder))
        time.sleep(self.draw_moment_s(command))
        process.kill()
        status, errors = self.finish(process)
        self.check("kill -9", command, status in (-signal.SIGKILL, DONE), "exits with %d: %s" % (status, errors))
        states = self.check_states("kill -9", command, folder, ["whole", "absent"])
        met = status != DONE
        self.check_repeats("kill -9", command, folder)
        shutil.rmtree(folder)
        return met, set(states.values()) == {"whole"}

    def stop(self, command, number):
        fault = signal.Signals(number).name
        folder = self.new_folder(command)
        process = self.start(command.words(folder))
        time.sleep(self.draw_moment_s(command))
        process.send_signal(number)
        status, errors = self.finish(process)
        # Before it listens to signals the signal itself ends it.
        done = status == DONE
        self.check(fault, command, status in (DONE, STOPPED, -number), "exits with %d: %s" % (status, errors))
        self.check_states(fault, command, folder, ["whole"] if done else ["absent"])
        self.check_no_leftover(fault, command, folder)
        self.check_repeats(fault, command, folder)
        shutil.rmtree(folder)

    @contextlib.contextmanager
    def mounted_folder(self, options):
        """A new folder, and whether it is a tmpfs of its own, which is unmounted at the end in any case."""
        folder = self.new_folder()
        is_mounted = os.geteuid() == 0 and subprocess.call(
            ["mount", "-t", "tmpfs", "-o", options, "rollrig-faults", folder], stderr=subprocess.DEVNULL) == 0
        try:
            yield folder, is_mounted
        finally:
            if is_mounted:
                is_mounted = subprocess.call(["umount", folder]) != 0
            if is_mounted:
                self.wrong.append("%s cannot be unmounted" % folder)
            else:
                for path, _, _ in os.walk(folder):
                    os.chmod(path, 0o755)
                shutil.rmtree(folder)

    def fill_disk(self, command):
        if os.geteuid() != 0:
            return self.skip("full disk", "not root")
        inputs_kB = 4 * len(list_files(command.inputs)) + 4 if command.inputs else 0  # each is smaller than a page
        for size_kB in (4 + inputs_kB, 16 + inputs_kB, 64 + inputs_kB, 256 + inputs_kB):
            with self.mounted_folder("size=%dk" % size_kB) as (folder, is_mounted):
                if not is_mounted:
                    return self.skip("full disk", "no tmpfs can be mounted")
                command.prepare(folder)
                status, errors = self.run(command.words(folder))
                self.check("full disk", command, status in (DONE, WRONG), "exits with %d: %s" % (status, errors))
                self.check("full disk", command, status == DONE or "cannot write" in errors, "says: %s" % errors)
                self.check_states("full disk", command, folder, ["whole"] if status == DONE else ["absent"])
                self.check_no_leftover("full disk", command, folder)

    def lock_folder(self, command):
        with self.mounted_folder("size=4m") as (folder, is_mounted):
            command.prepare(folder)
            before = list_files(folder)
            if is_mounted:
                subprocess.check_call(["mount", "-o", "remount,ro", folder])
            for path, _, _ in os.walk(folder):
                if not is_mounted:
                    os.chmod(path, 0o555)
            if os.access(folder, os.W_OK):
                return self.skip("read-only folder", "root may write everywhere, and no tmpfs can be mounted")
            status, errors = self.run(command.words(folder))
            self.check("read-only folder", command, status == WRONG and "cannot write" in errors,
                       "exits with %d: %s" % (status, errors))
            self.check("read-only folder", command, list_files(folder) == before, "wrote %s" % list_files(folder))

    def take_folder_away(self, command):
        fault = "vanishing folder"
        folder = self.new_folder(command)
        process = self.start(command.words(folder))
        time.sleep(self.draw_moment_s(command))
        shutil.rmtree(folder, ignore_errors=True)
        status, errors = self.finish(process)
        self.check(fault, command, status in command.statuses, "exits with %d: %s" % (status, errors))
        shutil.rmtree(folder, ignore_errors=True)
        os.mkdir(folder)
        command.prepare(folder)
        self.check_repeats(fault, command, folder)
        shutil.rmtree(folder)

    def lose_output(self, command):
        closed = {"preexec_fn": lambda: os.close(1), "stdout": None}
        with open("/dev/full", "w") as full:
            for fault, options in (("closed standard output", closed), ("full standard output", {"stdout": full})):
                folder = self.new_folder(command)
                status, errors = self.run(command.words(folder), **options)
                self.check(fault, command, status in (WRONG, DONE), "exits with %d: %s" % (status, errors))
                self.check_states(fault, command, folder, ["whole"] if status == DONE else ["absent", "whole"])
                self.check_no_leftover(fault, command, folder)
                self.check_repeats(fault, command, folder)
                shutil.rmtree(folder)

    def break_pipe(self, command):
        fault = "broken pipe"
        folder = self.new_folder(command)
        read_end, write_end = os.pipe()
        os.close(read_end)
        status, errors = self.run(command.words(folder), stdout=write_end)
        os.close(write_end)
        self.check(fault, command, status in (DONE, -signal.SIGPIPE) and not errors,
                   "exits with %d: %s" % (status, errors))
        self.check_states(fault, command, folder, ["whole"])
        shutil.rmtree(folder)

    def run_twice(self, command):
        fault = "two processes"
        folder = self.new_folder(command)
        processes = [self.start(command.words(folder)) for _ in range(2)]
        statuses = sorted(self.finish(process)[0] for process in processes)
        expected = [DONE, WRONG] if command.refuses_existing() else [DONE, DONE]
        self.check(fault, command, statuses == expected, "exit with %s" % statuses)
        self.check_states(fault, command, folder, ["whole"])
        self.check_no_leftover(fault, command, folder)
        shutil.rmtree(folder)

    def go_abroad(self, command, locales):
        fault = "German locale, other time zone"
        folder = self.new_folder(command)
        environment = dict(os.environ, TZ="Asia/Kathmandu", LC_ALL="de_DE.UTF-8", LANG="de_DE.UTF-8")
        if locales:
            environment["LOCPATH"] = locales
        status, errors = self.run(command.words(folder), env=environment)
        self.check(fault, command, status == DONE, "exits with %d: %s" % (status, errors))
        self.check_states(fault, command, folder, ["whole"])
        shutil.rmtree(folder)

    def change_threads(self, command):
        fault = "number of threads"
        for threads in ("1", "2", "3"):
            folder = self.new_folder(command)
            status, errors = self.run(command.words(folder) + ["--threads", threads])
            self.check(fault, command, status == DONE, "exits with %d: %s" % (status, errors))
            self.check_states(fault, command, folder, ["whole"])
            shutil.rmtree(folder)

    def use_odd_names(self, command):
        if command.inputs:
            return  # its outputs have the names of its inputs
        fault = "odd names"
        for odd in ("with space", "new\nline", "größe", "<script>", "a'b\"c", "-", "%s{}"):
            folder = self.new_folder(command)
            names = {output: odd + " " + output for output in command.outputs}
            status, errors = self.run(command.words(folder, names))
            self.check(fault, command, status == DONE, "%r: exits with %d: %s" % (odd, status, errors))
            self.check_states(fault, command, folder, ["whole"], names)
            self.check_no_leftover(fault, command, folder)
            shutil.rmtree(folder)

    def copy_campaign(self, action, campaigns, folder):
        """Makes a campaign in `folder`, and returns the command that changes it."""
        shutil.copytree(os.path.join(campaigns, action), os.path.join(folder, "campaign"))
        return Command("campaign " + action, ["campaign", action, "{o}/campaign", "--quiet"], [])

    def export_campaign(self, folder):
        """SHA-256 of the table of a campaign; the error message where there is none."""
        status, errors = self.run(["campaign", "export", folder + "/campaign", "--csv", folder + "/all.csv", "--quiet"])
        return hash_output(folder + "/all.csv") if status == DONE else errors

    def check_campaign(self, fault, command, folder, items, table):
        """After a disturbance: the counts, then the same command again, and the table that it leads to."""
        status, errors = self.run(["campaign", "status", folder + "/campaign", "--json", folder + "/state.json"])
        self.check(fault, command, status == DONE, "status exits with %d: %s" % (status, errors))
        if status == DONE:
            with open(folder + "/state.json") as file:
                done = json.load(file)["done"]
            self.check(fault, command, done == items if command.name == "campaign merge" else 0 <= done <= items,
                       "status counts %d of %d" % (done, items))
        status, errors = self.run(command.words(folder))
        self.check(fault, command, status == DONE, "given again it exits with %d: %s" % (status, errors))
        self.check(fault, command, self.export_campaign(folder) == table, "the table is another one")
        ends = ("-wal", "-shm", "-journal", ".progress", ".partial")
        left = [name for name in os.listdir(folder + "/campaign") if name.endswith(ends)]
        self.check(fault, command, not left, "left %s" % left)

    def disturb_campaigns(self, campaigns, items, kills):
        """`campaigns` holds a campaign in each of the states before "run" and "merge"."""
        for action in ("run", "merge"):
            folder = self.new_folder()
            command = self.copy_campaign(action, campaigns, folder)
            start = time.time()
            status, errors = self.run(command.words(folder))
            command.takes_s = time.time() - start
            if status != DONE:
                sys.exit("%s does not even run undisturbed: exit %d\n%s" % (command.name, status, errors))
            table = self.export_campaign(folder)
            if not os.path.exists(folder + "/all.csv"):
                sys.exit("an undisturbed campaign cannot be exported: %s" % table)
            shutil.rmtree(folder)
            met = 0
            signals = [signal.SIGKILL] * kills + [signal.SIGINT, signal.SIGTERM]
            for number in signals:
                fault = "kill -9" if number == signal.SIGKILL else signal.Signals(number).name
                folder = self.new_folder()
                self.copy_campaign(action, campaigns, folder)
                process = self.start(command.words(folder))
                time.sleep(self.draw_moment_s(command))
                process.send_signal(number)
                status, errors = self.finish(process)
                allowed = (DONE, -number) if number == signal.SIGKILL else (DONE, STOPPED, -number)
                self.check(fault, command, status in allowed, "exits with %d: %s" % (status, errors))
                met += status != DONE
                self.check_campaign(fault, command, folder, items, table)
                shutil.rmtree(folder)
            print("%s: %d of %d signals met it before its end" % (command.name, met, len(signals)))
            self.leave_campaign_no_room(command, action, campaigns, items, table)

    def leave_campaign_no_room(self, command, action, campaigns, items, table):
        fault = "full disk"
        for room_kB in (0, 4, 12, 40):
            with self.mounted_folder("size=4m") as (folder, is_mounted):
                if not is_mounted:
                    return self.skip(fault, "not root, or no tmpfs can be mounted")
                self.copy_campaign(action, campaigns, folder)
                filler = os.path.join(folder, "filler")
                with open(filler, "wb") as file:
                    disk = os.statvfs(folder)
                    file.write(b"0" * max(0, disk.f_bavail * disk.f_frsize - 1024 * room_kB))
                status, errors = self.run(command.words(folder))
                self.check(fault, command, status in (DONE, WRONG), "exits with %d: %s" % (status, errors))
                left = [name for name in os.listdir(folder + "/campaign") if ".partial" in name]
                self.check(fault, command, not left, "left %s" % left)
                status, errors = self.run(["campaign", "status", folder + "/campaign", "--quiet"])
                self.check(fault, command, status == DONE, "status exits with %d: %s" % (status, errors))
                os.remove(filler)
                self.check_campaign(fault, command, folder, items, table)

    def disturb_server(self, kills):
        """Each time, pages are asked for and kept until the signal."""
        command = Command("serve", ["serve", "--keep", "{o}/kept"], ["kept"])
        met = 0
        signals = [signal.SIGKILL] * kills + [signal.SIGINT, signal.SIGTERM]
        for number in signals:
            fault = "kill -9" if number == signal.SIGKILL else signal.Signals(number).name
            folder = self.new_folder()
            os.mkdir(folder + "/temporary")
            process, port, token = self.start_server(command, folder)
            is_signaled = threading.Event()

            def send_signal():
                is_signaled.set()
                process.send_signal(number)

            timer = threading.Timer(self.random.uniform(0.0, 1.5), send_signal)
            timer.start()
            kept = 0
            while self.keep_page(port, token):
                kept += 1
            self.check(fault, command, is_signaled.is_set(), "keeps no page, though it runs")
            timer.join()
            met += kept > 0
            status, errors = self.finish(process)
            self.check(fault, command, status == (-number if number == signal.SIGKILL else DONE),
                       "exits with %d: %s" % (status, errors))
            self.check_kept_pages(fault, command, folder, kept, may_leave_files=number == signal.SIGKILL)
            shutil.rmtree(folder)
        print("serve: %d of %d signals met it after it had kept a page" % (met, len(signals)))

    def start_server(self, command, folder):
        """A server, its port and its token."""
        process = self.start(command.words(folder), stdout=subprocess.PIPE,
                             env=dict(os.environ, TMPDIR=folder + "/temporary"))
        for line in process.stdout:
            address = re.search(rb"http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]+)", line)
            if address:
                return process, address.group(1).decode(), address.group(2).decode()
        sys.exit("serve prints no address: %s" % self.finish(process)[1])

    def check_kept_pages(self, fault, command, folder, kept, may_leave_files):
        """After a server that said `kept` times that it kept a page."""
        pages = os.listdir(folder + "/kept") if os.path.exists(folder + "/kept") else []
        whole = [name for name in pages if ".partial-" not in name]
        for name in whole:
            with open(os.path.join(folder, "kept", name)) as file:
                self.check(fault, command, file.read().endswith("</html>\n"), "%s is half written" % name)
        self.check(fault, command, len(whole) >= kept, "%d pages were said to be kept, %d are there" %
                   (kept, len(whole)))
        if not may_leave_files:
            self.check(fault, command, len(whole) == len(pages), "left %s" % pages)
            left = os.listdir(folder + "/temporary")
            self.check(fault, command, not left, "left %s" % left)

    def keep_page(self, port, token):
        """Whether the server said that it kept a page. One that is about to end answers with 503."""
        request = urllib.request.Request("http://127.0.0.1:%s/api/keep" % port, method="POST",
                                         data=json.dumps({"scenario": "skim", "tire": "a50"}).encode(),
                                         headers={"Content-Type": "application/json", "X-Rollrig-Token": token})
        try:
            with urllib.request.urlopen(request, timeout=MOST_TIME_S) as answer:
                return "kept" in json.load(answer)
        except urllib.error.HTTPError as error:
            if error.code != 503:
                self.wrong.append("serve: %d %s" % (error.code, error.read()[:500]))
            return False
        except (OSError, http.client.HTTPException, ValueError):
            return False

    def skip(self, fault, why):
        if (fault, why) not in self.skipped:
            self.skipped.append((fault, why))


def make_locale(base):
    """A folder with the German locale; empty where the system has it, None where there is none to be had."""
    if b"de_DE.utf8" in subprocess.run(["locale", "-a"], stdout=subprocess.PIPE).stdout:
        return ""
    made = subprocess.call(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(base, "de_DE.UTF-8")],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) if shutil.which("localedef") else 1
    return base if made == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--short", action="store_true")
    options = parser.parse_args()
    base = tempfile.mkdtemp(prefix="rollrig-faults-")
    try:
        faults = Faults(options.program, options.seed, base)
        inputs = os.path.join(base, "inputs")
        os.mkdir(inputs)
        os.mkdir(inputs + "/sets")
        shutil.copytree(EXAMPLES + "/hidden_effect", inputs + "/sets/hidden_effect")
        os.makedirs(inputs + "/regression/runs")
        for name, load_N in (("a", 4000), ("b", 5000)):
            with open("%s/regression/runs/%s.toml" % (inputs, name), "w") as file:
                file.write('format = "rollrig-run/1"\nscenario = "skim"\ntire = "a50"\n')
                file.write('[settings]\nload_N = %d\n' % load_N)
        campaigns, loads, items = os.path.join(base, "campaigns"), "load_N=4000:6000:50", 41
        os.mkdir(campaigns)
        for words in (
                ["run", "skim", "--tire", "a50", "--sensors", "source", "--write-set", inputs + "/set", "--quiet"],
                ["campaign", "new", inputs + "/campaign", "skim", "--tire", "a50", "--vary", "load_N=4000:6000:500",
                 "--fidelity", "quasi_static", "--quiet"],
                ["campaign", "run", inputs + "/campaign", "--quiet"],
                ["campaign", "new", campaigns + "/run", "skim", "--tire", "a50", "--vary", loads, "--quiet"],
                ["campaign", "new", campaigns + "/merge", "skim", "--tire", "a50", "--vary", loads, "--quiet"],
                ["campaign", "run", campaigns + "/merge", "--shard", "1/2", "--quiet"],
                ["campaign", "run", campaigns + "/merge", "--shard", "2/2", "--quiet"],
                ["fit", "j2452", os.path.join(EXAMPLES, "j2452_points.csv"), "--maximum-load", "6570",
                 "--base-pressure", "260", "--out", inputs + "/j2452", "--quiet"],
                ["campaign", "new", inputs + "/draws", "skim", "--tire", "a50", "--draw", "load_N=uniform:4000:6000",
                 "--draw", "speed_km_h=uniform:60:100", "--design", "sobol_indices", "--points", "16", "--quiet"],
                ["campaign", "run", inputs + "/draws", "--quiet"],
                ["campaign", "new-diagnoses", inputs + "/diagnoses", inputs + "/sets", "--only", "torque_gain",
                 "--quiet"],
                ["campaign", "run", inputs + "/diagnoses", "--quiet"]):
            status, errors = faults.run(words)
            if status != DONE:
                sys.exit("%s does not even run undisturbed: exit %d\n%s" % (" ".join(words), status, errors))
        commands = [command for command in make_commands(inputs) if command.quick or not options.short]
        for command in commands:
            faults.make_reference(command)
        met = whole = 0
        for i in range(options.kills):
            was_met, was_whole = faults.kill(commands[i % len(commands)])
            met += was_met
            whole += was_whole
        faults.disturb_campaigns(campaigns, items, max(2, options.kills // 10))
        if not options.short:
            faults.disturb_server(options.kills // 10)
        locales = make_locale(base)
        if locales is None:
            faults.skip("German locale", "it is not installed, and localedef cannot make it")
        for i, command in enumerate(commands):
            faults.stop(command, signal.SIGTERM if i % 2 else signal.SIGINT)
            faults.lose_output(command)
            faults.break_pipe(command)
            faults.run_twice(command)
            faults.take_folder_away(command)
            faults.lock_folder(command)
            faults.go_abroad(command, locales)
            if command.has_threads:
                faults.change_threads(command)
            if options.short and i > 0:
                continue
            faults.fill_disk(command)
            faults.use_odd_names(command)
        print("%d kills: %d met the command before its end, %d found all outputs whole" % (options.kills, met, whole))
        for fault, count in faults.counts.items():
            print("  %-32s %5d checks" % (fault, count))
        for fault, why in faults.skipped:
            print("  %-32s skipped: %s" % (fault, why))
        for wrong in faults.wrong:
            print("WRONG  " + wrong)
        print("%d wrong" % len(faults.wrong))
        return 1 if faults.wrong else 0
    finally:
        shutil.rmtree(base, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
