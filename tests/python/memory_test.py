"""Many runs in one process."""

import os
import unittest

import rollrig

QUICK = {"fidelity": "quasi_static", "soak_h": 1, "warm_up_min": 2}


def measure_rss_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Memory(unittest.TestCase):
    def test_a_thousand_need_no_more_memory(self):
        for _ in range(100):
            rollrig.run("iso_28580", tire="a50", **QUICK).to_pandas()
        before = measure_rss_bytes()
        for _ in range(1000):
            rollrig.run("iso_28580", tire="a50", **QUICK).channels
        self.assertLess(measure_rss_bytes() - before, 2 * 2**20)


if __name__ == "__main__":
    unittest.main()
