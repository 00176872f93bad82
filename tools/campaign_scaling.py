#!/usr/bin/env python3
"""How long a campaign takes on more cores than this machine has: a simulation of its processes.

Measured on this machine are the time of one item, of the start of a process, and of the merge of a record and of a
file. The simulation then carries out the campaign with fixed parts (--shard) and with items that are handed out (--mpi),
and says to what most time is lost. The process that hands out needs no core of its own.

  tools/campaign_scaling.py PROGRAM [--items 100000] [--seed 1]
"""
import argparse
import heapq
import math
import random
import subprocess
import tempfile
import time

# Assumed: what the process that hands out items needs for a question, over Ethernet (within a machine it is less).
QUESTION_S = 5e-5
# Assumed: a question waits for half of the pause of that process (campaigns/mpi/hand_out.cpp).
PAUSE_S = 5e-4
# Assumed: standard deviation of the time of an item over its mean, as for draws of the parameters of one test.
SPREAD = 0.2
WORK = {
    "ISO 28580, quasi-static": ["iso_28580", "--tire", "a50", "--fidelity", "quasi_static", "--draw-sd", "tire"],
    "multi-cycle test, multibody": ["sae_j1634", "--tire", "a50", "--draw-sd", "tire"],
}
CHEAP = "ISO 28580, quasi-static"
MEASURED_ITEMS = {"ISO 28580, quasi-static": 2000, "multi-cycle test, multibody": 2}


def time_command(*words):
    """Seconds. Status 3, of items that fail, is as good as 0."""
    start = time.perf_counter()
    status = subprocess.run(words, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if status.returncode not in (0, 3):
        raise SystemExit(status.stderr.decode())
    return time.perf_counter() - start


def make_campaign(program, name, points, folder):
    """Makes a campaign; returns its folder."""
    of = f"{folder}/{name}-{points}".replace(" ", "-")
    subprocess.run([program, "campaign", "new", of, *WORK[name], "--points", str(points), "--quiet"], check=True)
    return of


def measure_item(program, name, items, folder):
    """Seconds of an item, and of a process that finds nothing to do."""
    of = make_campaign(program, name, items, folder)
    whole = time_command(program, "campaign", "run", of, "--threads", "1")
    start = time_command(program, "campaign", "run", of, "--threads", "1")
    return (whole - start) / items, start


def measure_merge(program, folder):
    """Seconds for a record and for a file."""
    records, files = 2000, 20
    of = make_campaign(program, CHEAP, records, folder + "/one")
    time_command(program, "campaign", "run", of)
    per_record = (time_command(program, "campaign", "merge", of) - time_command(program, "campaign", "status", of)) / records
    of = make_campaign(program, CHEAP, files, folder + "/many")
    for part in range(files):
        time_command(program, "campaign", "run", of, "--shard", f"{part + 1}/{files}")
    per_file = (time_command(program, "campaign", "merge", of) - time_command(program, "campaign", "status", of)) / files
    return max(per_record, 0.0), max(per_file, 0.0)


def draw_times(count, mean, seed):
    """Lognormal, the same for any number of cores."""
    generator = random.Random(seed)
    sigma = math.sqrt(math.log(1.0 + SPREAD**2))
    return [mean * generator.lognormvariate(-0.5 * sigma**2, sigma) for _ in range(count)]


def simulate_parts(times, cores):
    return max(sum(times[part::cores]) for part in range(cores))


def simulate_queue(times, cores):
    """One process hands out, and the others, as many as there are cores, ask. Chunks as calc_chunk() has them."""
    free = [(0.0, worker) for worker in range(cores)]
    heapq.heapify(free)
    server_free = 0.0
    handed_out = 0
    end = 0.0
    while handed_out < len(times):
        asked, worker = heapq.heappop(free)
        answered = max(asked + PAUSE_S, server_free) + QUESTION_S
        server_free = answered
        chunk = min(max((len(times) - handed_out) // (4 * cores), 1), 64)
        done = answered + sum(times[handed_out:handed_out + chunk])
        handed_out += chunk
        end = max(end, done)
        heapq.heappush(free, (done, worker))
    return end


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="rollrig")
    parser.add_argument("--items", type=int, default=100000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print("| items | cores | ideal | `--shard` | `--mpi` | merge | efficiency of `--mpi` with merge | most is lost to |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        record, file = measure_merge(options.program, folder)
        measured = {name: measure_item(options.program, name, MEASURED_ITEMS[name], folder) for name in WORK}
    for name, (item, start) in measured.items():
        times = draw_times(options.items, item, options.seed)
        for cores in (1, 10, 100, 1000):
            merge = options.items * record + cores * file
            ideal = sum(times) / cores
            parts = start + simulate_parts(times, cores)
            queue = start + simulate_queue(times, cores)
            lost = {"start": start, "hand-out and unequal ends": queue - start - ideal, "merge": merge}
            worst = max(lost, key=lost.get)
            shown = [f"{seconds:.4g} s" for seconds in (ideal, parts, queue, merge)]
            print(f"| {name} | {cores} | {' | '.join(shown)} | {100.0 * ideal / (queue + merge):.0f} % | {worst} |")
        print(f"# {name}: item {1e3 * item:.3g} ms, start {1e3 * start:.3g} ms")
    print(f"# merge: {1e6 * record:.3g} us for a record, {1e3 * file:.3g} ms for a file")


if __name__ == "__main__":
    main()
