"""A tire warms up at 80 km/h: the C API of rollrig from Python, without the Python package rollrig.

python3 examples/warm_tire.py librollrig.so
"""
import ctypes
import sys

rollrig = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else "librollrig.so")
rollrig.rollrig_last_error.restype = ctypes.c_char_p
rollrig.rollrig_wheel_create.restype = ctypes.c_void_p


def check(status):
    if status != 0:
        raise RuntimeError(rollrig.rollrig_last_error().decode())


class Tire:
    def __init__(self, tire, rig):
        self.wheel = ctypes.c_void_p(rollrig.rollrig_wheel_create(tire.encode(), rig.encode()))
        if not self.wheel:
            raise RuntimeError(rollrig.rollrig_last_error().decode())

    def find(self, name):
        return rollrig.rollrig_wheel_find_variable(self.wheel, name.encode())

    def set(self, name, value):
        check(rollrig.rollrig_wheel_set(self.wheel, self.find(name), ctypes.c_double(value)))

    def get(self, name):
        value = ctypes.c_double()
        check(rollrig.rollrig_wheel_get(self.wheel, self.find(name), ctypes.byref(value)))
        return value.value

    def start(self):
        check(rollrig.rollrig_wheel_start(self.wheel, ctypes.c_double(0.0)))

    def step(self, step_s):
        check(rollrig.rollrig_wheel_step(self.wheel, ctypes.c_double(step_s)))

    def __del__(self):
        rollrig.rollrig_wheel_free(self.wheel)


tire = Tire("a50", "road")
tire.start()
tire.set("speed_m_s", 80 / 3.6)
print("min  resistance N  liner degC  pressure kPa")
for minute in range(0, 31, 10):
    print("%3d  %12.2f  %10.1f  %12.1f" % (minute, tire.get("rolling_resistance_N"),
          tire.get("liner_temperature_K") - 273.15, 1e-3 * tire.get("cavity_pressure_Pa")))
    if minute < 30:
        tire.step(600)
