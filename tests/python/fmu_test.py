"""An importer in Python, independent of rollrig's own declarations, runs FMUs of FMI 3.0 as the standard says.

Functions, their arguments and their order are written down from FMI 3.0.2; nothing of rollrig's headers is used.
"""

import ctypes
import io
import threading
import unittest
import xml.etree.ElementTree
import zipfile

import numpy as np
import rollrig
from support import InFolder

OK, ERROR = 0, 3  # fmi3Status
ZERO_K = 273.15
Float64, Boolean, Handle = ctypes.c_double, ctypes.c_bool, ctypes.c_void_p
Reference, Text, Size, Flag = ctypes.c_uint32, ctypes.c_char_p, ctypes.c_size_t, ctypes.POINTER(ctypes.c_bool)
Floats, References = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_uint32)
LogMessage = ctypes.CFUNCTYPE(None, Handle, ctypes.c_int, Text, Text)

ARGUMENTS = {
    "fmi3EnterInitializationMode": [Handle, Boolean, Float64, Float64, Boolean, Float64],
    "fmi3ExitInitializationMode": [Handle],
    "fmi3EnterContinuousTimeMode": [Handle],
    "fmi3EnterEventMode": [Handle],
    "fmi3UpdateDiscreteStates": [Handle, Flag, Flag, Flag, Flag, Flag, Floats],
    "fmi3Terminate": [Handle],
    "fmi3Reset": [Handle],
    "fmi3SetFloat64": [Handle, References, Size, Floats, Size],
    "fmi3GetFloat64": [Handle, References, Size, Floats, Size],
    "fmi3DoStep": [Handle, Float64, Float64, Boolean, Flag, Flag, Flag, Floats],
    "fmi3SetTime": [Handle, Float64],
    "fmi3GetNumberOfContinuousStates": [Handle, ctypes.POINTER(Size)],
    "fmi3GetContinuousStates": [Handle, Floats, Size],
    "fmi3SetContinuousStates": [Handle, Floats, Size],
    "fmi3GetContinuousStateDerivatives": [Handle, Floats, Size],
    "fmi3GetNominalsOfContinuousStates": [Handle, Floats, Size],
    "fmi3CompletedIntegratorStep": [Handle, Boolean, Flag, Flag],
    "fmi3GetDirectionalDerivative": [Handle, References, Size, References, Size, Floats, Size, Floats, Size],
    "fmi3GetFMUState": [Handle, ctypes.POINTER(Handle)],
    "fmi3SetFMUState": [Handle, Handle],
    "fmi3FreeFMUState": [Handle, ctypes.POINTER(Handle)],
    "fmi3SerializedFMUStateSize": [Handle, Handle, ctypes.POINTER(Size)],
    "fmi3SerializeFMUState": [Handle, Handle, ctypes.POINTER(ctypes.c_uint8), Size],
    "fmi3DeserializeFMUState": [Handle, ctypes.POINTER(ctypes.c_uint8), Size, ctypes.POINTER(Handle)],
}


def references(values):
    return (Reference * len(values))(*values)


def floats(values):
    return (Float64 * len(values))(*values)


class Fmu:
    """An FMU, unpacked and loaded."""

    def __init__(self, content, folder):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            self.description = xml.etree.ElementTree.fromstring(archive.read("modelDescription.xml"))
            identifier = self.description.find("CoSimulation").get("modelIdentifier")
            library = archive.extract(f"binaries/x86_64-linux/{identifier}.so", folder)
        assert self.description.get("fmiVersion") == "3.0"
        self.token = self.description.get("instantiationToken").encode()
        self.variables = {at.get("name"): at for at in self.description.find("ModelVariables")}
        self.library = ctypes.CDLL(library)
        self.library.fmi3InstantiateCoSimulation.restype = Handle
        self.library.fmi3InstantiateModelExchange.restype = Handle
        self.library.fmi3GetVersion.restype = Text
        self.library.fmi3FreeInstance.argtypes = [Handle]
        for name, arguments in ARGUMENTS.items():
            getattr(self.library, name).argtypes = arguments

    def find(self, name):
        return int(self.variables[name].get("valueReference"))


class Tire:
    """An instance of an FMU."""

    def __init__(self, fmu, is_co_simulation):
        self.fmu, self.messages = fmu, []
        self.log = LogMessage(lambda environment, status, category, message: self.messages.append(message.decode()))
        none = Handle()
        begin = [b"tire", fmu.token, None, Boolean(False), Boolean(True)]
        if is_co_simulation:
            make, more = fmu.library.fmi3InstantiateCoSimulation, [Boolean(False), Boolean(False), none, Size(0)]
            self.handle = make(*begin, *more, none, self.log, none)
        else:
            self.handle = fmu.library.fmi3InstantiateModelExchange(*begin, none, self.log)
        assert self.handle

    def __enter__(self):
        return self

    def __exit__(self, *raised):
        self.fmu.library.fmi3FreeInstance(self.handle)

    def ask(self, function, *arguments):
        return getattr(self.fmu.library, function)(self.handle, *arguments)

    def call(self, function, *arguments):
        status = self.ask(function, *arguments)
        if status != OK:
            raise AssertionError(f"{function}: {status}, {self.messages}")

    def set(self, **values):
        names = references([self.fmu.find(name.replace("__", ".")) for name in values])
        self.call("fmi3SetFloat64", names, len(values), floats(list(values.values())), len(values))

    def get(self, *names):
        values = floats([0.0] * len(names))
        self.call("fmi3GetFloat64", references(list(map(self.fmu.find, names))), len(names), values, len(names))
        return values[0] if len(names) == 1 else list(values)

    def initialize(self, start_s=0.0):
        self.call("fmi3EnterInitializationMode", False, 0.0, start_s, False, 0.0)
        self.call("fmi3ExitInitializationMode")

    def step(self, time_s, step_s):
        flags, last_s = [ctypes.c_bool(True) for _ in range(3)], Float64()
        self.call("fmi3DoStep", time_s, step_s, True, *map(ctypes.byref, flags), ctypes.byref(last_s))
        if any(flag.value for flag in flags) or last_s.value != self.get("time_s"):
            raise AssertionError(f"step from {time_s}: {flags}, {last_s}")


class CityCycle(InFolder):
    """One wheel of a car on the dynamometer through the city cycle, by the FMU and by rollrig.run()."""

    @classmethod
    def setUpClass(cls):
        cls.expected = rollrig.run("drive_cycle", tire="a50", rig="dyno_1m2", vehicle="source_car",
                                   fidelity="quasi_static", cycle="udds", wheels=1)
        channels = cls.expected.channels
        cls.speed_m_s = np.asarray(channels["speed_km_h"]) / 3.6
        cls.tread_K = np.asarray(channels["tread_temperature_degC"]) + ZERO_K
        # of the first of the run's sections, as the C++ test of FMI 2.0 has it
        (first, *_) = cls.expected.records.values()
        cls.lost_J = 3600 * first[0]["rr_energy_Wh"]

    def setUp(self):
        super().setUp()
        self.fmu = Fmu(rollrig.make_fmu("a50", rig="dyno_1m2", fmi_version=3), self.folder)

    def begin(self, tire):
        names = ("cavity_pressure_kPa", "ambient_degC", "load_N")
        first = {name: float(self.expected.channels[name][0]) for name in names}
        air_K = first["ambient_degC"] + ZERO_K
        tire.set(start__cold_pressure_kPa=first["cavity_pressure_kPa"],
                 start__tire_temperature_degC=first["ambient_degC"], load_N=first["load_N"],
                 ambient_temperature_K=air_K, surface_temperature_K=air_K)
        tire.initialize()

    def check(self, largest_K, lost_J):
        rise_K = self.tread_K[-1] - self.tread_K[0]
        self.assertGreater(rise_K, 2)
        self.assertLess(largest_K, 1e-6 * rise_K)
        self.assertLess(abs(lost_J / self.lost_J - 1), 1e-6)

    def drive(self, tire):
        """By steps of a second, through which the speed goes straight."""
        largest_K = 0.0
        for row in range(1, len(self.tread_K)):
            before, after = self.speed_m_s[row - 1:row + 1]
            tire.set(speed_m_s=before, acceleration_m_s2=after - before)
            tire.step(row - 1.0, 1.0)
            largest_K = max(largest_K, abs(tire.get("tread_temperature_K") - self.tread_K[row]))
        return largest_K, tire.get("tire_loss_J")

    def test_in_co_simulation(self):
        with Tire(self.fmu, True) as tire:
            self.begin(tire)
            driven = self.drive(tire)
            self.check(*driven)
            tire.call("fmi3Terminate")
            tire.call("fmi3Reset")
            self.begin(tire)
            self.assertEqual(self.drive(tire), driven)  # as new, to the bit
            self.assertEqual(tire.messages, [])

    def test_in_co_simulation_from_a_state_that_was_kept_as_bytes(self):
        half = len(self.tread_K) // 2
        with Tire(self.fmu, True) as first, Tire(self.fmu, True) as second:
            self.begin(first)
            for row in range(1, half):
                before, after = self.speed_m_s[row - 1:row + 1]
                first.set(speed_m_s=before, acceleration_m_s2=after - before)
                first.step(row - 1.0, 1.0)
            state, size = Handle(), Size()
            first.call("fmi3GetFMUState", ctypes.byref(state))
            first.call("fmi3SerializedFMUStateSize", state, ctypes.byref(size))
            kept = (ctypes.c_uint8 * size.value)()
            first.call("fmi3SerializeFMUState", state, kept, size)
            first.call("fmi3FreeFMUState", ctypes.byref(state))
            self.assertFalse(state)
            second.call("fmi3DeserializeFMUState", kept, size, ctypes.byref(state))
            second.call("fmi3SetFMUState", state)
            second.call("fmi3FreeFMUState", ctypes.byref(state))
            for row in range(half, len(self.tread_K)):
                before, after = self.speed_m_s[row - 1:row + 1]
                for tire in (first, second):
                    tire.set(speed_m_s=before, acceleration_m_s2=after - before)
                    tire.step(row - 1.0, 1.0)
            self.assertEqual(first.get(*self.fmu.variables), second.get(*self.fmu.variables))
            self.check(abs(second.get("tread_temperature_K") - self.tread_K[-1]), second.get("tire_loss_J"))

    def test_in_model_exchange(self):
        """Integrated here, by the Runge-Kutta method of order 4 in steps of a second, as rollrig does."""
        with Tire(self.fmu, False) as tire:
            self.begin(tire)
            flags, next_s = [ctypes.c_bool(True) for _ in range(5)], Float64()
            tire.call("fmi3UpdateDiscreteStates", *map(ctypes.byref, flags), ctypes.byref(next_s))
            self.assertFalse(any(flag.value for flag in flags))
            tire.call("fmi3EnterContinuousTimeMode")
            size = Size()
            tire.call("fmi3GetNumberOfContinuousStates", ctypes.byref(size))
            count = size.value
            rates_in_file = [at for at in self.fmu.variables.values() if at.get("derivative") is not None]
            self.assertEqual(len(rates_in_file), count)
            buffer, done = floats([0.0] * count), [ctypes.c_bool(), ctypes.c_bool()]

            def get(function):
                tire.call(function, buffer, count)
                return np.array(buffer)

            def find_rates(time_s, states, speed_m_s):
                tire.call("fmi3SetTime", time_s)
                tire.set(speed_m_s=speed_m_s)
                tire.call("fmi3SetContinuousStates", floats(states), count)
                return get("fmi3GetContinuousStateDerivatives")

            self.assertTrue(np.all(get("fmi3GetNominalsOfContinuousStates") > 0))
            states, largest_K = get("fmi3GetContinuousStates"), 0.0
            for row in range(1, len(self.tread_K)):
                before, after = self.speed_m_s[row - 1:row + 1]
                tire.set(acceleration_m_s2=after - before)
                # Near standstill the loss fades, and rollrig takes steps through which the speed changes by 0.01 m/s.
                is_near = min(before, after) < 0.4 and before != after
                steps = int(np.ceil(abs(after - before) / 0.01)) if is_near else 1
                for i in range(steps):
                    start_s, length_s = row - 1 + i / steps, 1 / steps
                    speeds = [before + (after - before) * (i + share) / steps for share in (0, 0.5, 1)]
                    a = find_rates(start_s, states, speeds[0])
                    b = find_rates(start_s + length_s / 2, states + length_s / 2 * a, speeds[1])
                    c = find_rates(start_s + length_s / 2, states + length_s / 2 * b, speeds[1])
                    d = find_rates(start_s + length_s, states + length_s * c, speeds[2])
                    states = states + length_s / 6 * (a + 2 * b + 2 * c + d)
                tire.call("fmi3SetContinuousStates", floats(states), count)
                tire.call("fmi3CompletedIntegratorStep", True, *map(ctypes.byref, done))
                self.assertFalse(done[0].value or done[1].value)
                largest_K = max(largest_K, abs(tire.get("tread_temperature_K") - self.tread_K[row]))
            self.check(largest_K, tire.get("tire_loss_J"))
            self.assertEqual(tire.messages, [])

    def test_directional_derivatives_are_slopes(self):
        with Tire(self.fmu, True) as tire:
            self.begin(tire)
            tire.set(speed_m_s=25.0)
            tire.step(0.0, 60.0)
            unknown = ["rolling_resistance_N", "cavity_pressure_Pa", "der(liner_temperature_K)"]
            known = {"load_N": 1.0, "speed_m_s": 1e-3, "ambient_temperature_K": 1e-2}
            for name, change in known.items():
                found = floats([0.0] * len(unknown))
                tire.call("fmi3GetDirectionalDerivative", references(list(map(self.fmu.find, unknown))), len(unknown),
                          references([self.fmu.find(name)]), 1, floats([1.0]), 1, found, len(unknown))
                usual = tire.get(name)
                tire.set(**{name: usual + change})
                above = np.array(tire.get(*unknown))
                tire.set(**{name: usual - change})
                below = np.array(tire.get(*unknown))
                tire.set(**{name: usual})
                # central differences: of order 2 in the change, and rounding of about 1e-16 over it
                np.testing.assert_allclose(list(found), (above - below) / (2 * change), rtol=1e-5, atol=1e-9)

    def test_in_threads_as_alone(self):
        found = []

        def drive():
            with Tire(self.fmu, True) as tire:
                self.begin(tire)
                for i in range(300):
                    tire.set(speed_m_s=self.speed_m_s[i])
                    tire.step(float(i), 1.0)
                found.append(tire.get("tread_temperature_K", "tire_loss_J"))

        drive()
        threads = [threading.Thread(target=drive) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, 9 * found[:1])

    def test_wrong_calls_are_errors_with_a_message(self):
        self.assertEqual(self.fmu.library.fmi3GetVersion(), b"3.0")
        with Tire(self.fmu, True) as tire:
            speed, nan = references([self.fmu.find("speed_m_s")]), floats([float("nan")])
            flags, last_s = [ctypes.c_bool() for _ in range(3)], Float64()
            outs = [*map(ctypes.byref, flags), ctypes.byref(last_s)]
            for words, function, *arguments in (
                    ("before the initialization", "fmi3DoStep", 0.0, 1.0, True, *outs),
                    ("speed_m_s", "fmi3SetFloat64", speed, 1, nan, 1),
                    ("number of values", "fmi3SetFloat64", speed, 1, floats([1.0, 2.0]), 2),
                    ("null", "fmi3SetFloat64", None, 1, nan, 1),
                    ("time", "fmi3EnterInitializationMode", False, 0.0, 1e15, False, 0.0),
                    ("model exchange", "fmi3GetContinuousStateDerivatives", nan, 1)):
                told = len(tire.messages)
                self.assertEqual(tire.ask(function, *arguments), ERROR, function)
                self.assertEqual(len(tire.messages), told + 1)
                self.assertIn(words, tire.messages[-1])
                self.assertIn(function, tire.messages[-1])
            tire.initialize()
            tire.set(speed_m_s=20.0)
            tire.step(0.0, 1.0)


if __name__ == "__main__":
    unittest.main()
