"""How much longer an ISO 28580 run takes in Python than in C++: python_run.py API_RUN, the program of api_run.cpp.

Both take turns, so that other work on the machine slows both. It prints the shortest and the median time of each.
"""

import statistics
import subprocess
import sys
import time

import rollrig

TURNS, RUNS = 10, 10


def time_python():
    taken = []
    for _ in range(RUNS):
        start_s = time.perf_counter()
        rollrig.run("iso_28580", tire="a50")
        taken.append(time.perf_counter() - start_s)
    return taken


def time_cpp(program):
    return [float(line) for line in subprocess.check_output([program, str(RUNS)], text=True).splitlines()]


def main(program):
    python, cpp = [], []
    for _ in range(TURNS):
        python += time_python()[1:]  # the first loads the multibody library
        cpp += time_cpp(program)[1:]
    for name, taken in (("C++", cpp), ("Python", python)):
        print(f"{name:8} shortest {1e3 * min(taken):7.2f} ms, median {1e3 * statistics.median(taken):7.2f} ms")


if __name__ == "__main__":
    main(sys.argv[1])
