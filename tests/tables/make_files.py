"""Writes logs with scipy and h5py, programs that share nothing with rollrig. make_files.py <folder>; status 77 where
one of them is not installed."""
import sys

try:
    import h5py
    import numpy as np
    import scipy.io
except ImportError:
    sys.exit(77)

folder = sys.argv[1] + "/"
n = 600
time_s = 0.5 * np.arange(n)
speed = 80.0 + 5.0 * np.sin(0.01 * time_s)
torque = 40.0 + 0.1 * speed
stamps = ["2024-05-06T10:%02d:%06.3f" % (10 + int(t // 60), t % 60) for t in time_s]

vectors = {"t": time_s, "v": speed.reshape(-1, 1), "M": torque.astype(np.float32), "n": np.arange(n, dtype=np.int16),
           "name": "drum 2", "other": np.arange(7.0), "c": time_s + 1j, "constant": 3.5}
scipy.io.savemat(folder + "vectors.mat", vectors, oned_as="column")
scipy.io.savemat(folder + "packed.mat", vectors, oned_as="row", do_compression=True)
scipy.io.savemat(folder + "struct.mat", {"rig": {"log": {"t": time_s, "v": speed, "M": torque,
                                                         "units": {"v": "km/h", "M": "N m"}}}}, do_compression=True)
records = np.zeros(n, dtype=[("t", "f8"), ("v", "f8"), ("M", "f8")])
records["t"], records["v"], records["M"] = time_s, speed, torque
scipy.io.savemat(folder + "records.mat", {"T": records})
scipy.io.savemat(folder + "stamps.mat", {"stamp": np.array(stamps, dtype=object), "v": speed, "M": torque},
                 oned_as="column")
scipy.io.savemat(folder + "matrix.mat", {"X": np.column_stack([time_s, speed, torque])})
scipy.io.savemat(folder + "old.mat", {"t": time_s, "v": speed, "M": torque}, format="4")

with h5py.File(folder + "flat.h5", "w") as file:
    for name, values, unit in [("t", time_s, "s"), ("v", speed, "km/h"), ("M", torque, "N m")]:
        file[name] = values
        file[name].attrs["unit"] = unit
with h5py.File(folder + "groups.h5", "w", libver="latest") as file:
    log = file.create_group("run 1/log")
    log.create_dataset("t", data=time_s, compression="gzip", shuffle=True, chunks=(64,))
    log.create_dataset("v", data=speed.astype("f4"), compression="gzip")
    log.create_dataset("M", data=torque.astype(">f8"), fletcher32=True)
    log["v"].attrs["units"] = np.bytes_("km/h")
    log["stamp"] = np.array(stamps, dtype=h5py.string_dtype())
    log["fixed"] = np.array(stamps, dtype="S")
    file["link"] = h5py.SoftLink("/nowhere")
    log["loop"] = file["run 1"]
    file["scalar"] = 3.5
    file["cube"] = np.zeros((3, 3, 3))
with h5py.File(folder + "matlab73.mat", "w", userblock_size=512) as file:  # laid out as MATLAB 7.3 does
    log = file.create_group("log")
    for name, values in [("t", time_s), ("v", speed), ("M", torque)]:
        log[name] = values.reshape(1, -1)
        log[name].attrs["MATLAB_class"] = np.bytes_("double")
    log["title"] = np.frombuffer("drum 2".encode("utf-16le"), dtype="u2").reshape(1, -1)
    log["title"].attrs["MATLAB_class"] = np.bytes_("char")
    file.create_group("#refs#")["a"] = time_s
with open(folder + "matlab73.mat", "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\0\2IM")
with h5py.File(folder + "records.h5", "w") as file:
    file["T"] = records
with h5py.File(folder + "matrix.h5", "w") as file:
    file["X"] = np.column_stack([time_s, speed, torque])
