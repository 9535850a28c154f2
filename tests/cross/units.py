# SPDX-License-Identifier: MIT
"""A small master for functional mock-up units: loads the binary of one and calls it by FMI 2.0 or 3.0 through ctypes."""

import ctypes
import os
import xml.etree.ElementTree as xml
import zipfile
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p

_LOG2 = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)
_LOG3 = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)


class Callbacks(ctypes.Structure):
    _fields_ = [("log", _LOG2), ("allocate", c_void_p), ("free", c_void_p), ("finished", c_void_p), ("place", c_void_p)]


class UnitFailed(Exception):
    pass


class Unit:
    """One instance, in co-simulation or model exchange, initialized at the scene's start values."""

    count = 0

    def __init__(self, path, version, tolerance, exchange=False):
        with zipfile.ZipFile(path) as archive:
            description = xml.fromstring(archive.read("modelDescription.xml"))
            binary = next(n for n in archive.namelist() if n.startswith("binaries/") and n.endswith(".so"))
            Unit.count += 1  # a library of the path of one that is loaded would not be loaded
            object_file = f"{path}.{Unit.count}.so"
            with open(object_file, "wb") as file:
                file.write(archive.read(binary))
        self.library = ctypes.CDLL(os.path.abspath(object_file))
        self.version, self.said = version, []
        self.references = {v.get("name"): int(v.get("valueReference")) for v in description.iter()
                           if v.get("valueReference") and v.get("name")}
        token = description.get("guid" if version == 2 else "instantiationToken").encode()
        if version == 2:
            libc = ctypes.CDLL(None)
            self._log = _LOG2(lambda _, name, status, kind, text: self.said.append(text.decode(errors="replace")))
            self._callbacks = Callbacks(self._log, ctypes.cast(libc.calloc, c_void_p), ctypes.cast(libc.free, c_void_p))
            make = self.library.fmi2Instantiate
            make.restype = c_void_p
            self.me = c_void_p(make(c_char_p(b"one"), 0 if exchange else 1, c_char_p(token), None,
                                    byref(self._callbacks), 0, 0))
            self._call("fmi2SetupExperiment", 1, c_double(tolerance), c_double(0), 0, c_double(0))
            self._call("fmi2EnterInitializationMode")
        else:
            self._log = _LOG3(lambda _, status, kind, text: self.said.append(text.decode(errors="replace")))
            make = getattr(self.library, "fmi3InstantiateModelExchange" if exchange else "fmi3InstantiateCoSimulation")
            make.restype = c_void_p
            name, token = c_char_p(b"one"), c_char_p(token)
            flags = (c_bool(False),) * (2 if exchange else 4)
            rest = (None, self._log) if exchange else (None, c_size_t(0), None, self._log, None)
            self.me = c_void_p(make(name, token, None, *flags, *rest))
            self._call("fmi3EnterInitializationMode", c_bool(True), c_double(tolerance), c_double(0), c_bool(False), c_double(0))
        if not self.me:
            raise UnitFailed("no instance")
        self._call(f"fmi{version}ExitInitializationMode")
        if exchange:
            self._settle()
            self._call(f"fmi{version}EnterContinuousTimeMode")

    def _call(self, name, *values):
        status = getattr(self.library, name)(self.me, *values)
        if status > 1:
            raise UnitFailed(f"{name} returns {status}: {' '.join(self.said)}")

    def _settle(self):
        class EventInfo(ctypes.Structure):
            _fields_ = [(n, c_int) for n in "abcde"] + [("next", c_double)]

        info, flags, next_time = EventInfo(), [c_bool() for _ in range(5)], c_double()
        if self.version == 2:
            self._call("fmi2NewDiscreteStates", byref(info))
        else:
            self._call("fmi3UpdateDiscreteStates", *map(byref, flags), byref(next_time))

    def step(self, time, length):
        if self.version == 2:
            self._call("fmi2DoStep", c_double(time), c_double(length), 1)
        else:
            events, ended, early, last = c_bool(), c_bool(), c_bool(), c_double()
            self._call("fmi3DoStep", c_double(time), c_double(length), c_bool(True), byref(events), byref(ended),
                       byref(early), byref(last))

    def get(self, name):
        reference, value = c_uint(self.references[name]), c_double()
        if self.version == 2:
            self._call("fmi2GetReal", byref(reference), c_size_t(1), byref(value))
        else:
            self._call("fmi3GetFloat64", byref(reference), c_size_t(1), byref(value), c_size_t(1))
        return value.value

    def derivatives(self, count):
        values = (c_double * count)()
        self._call("fmi2GetDerivatives" if self.version == 2 else "fmi3GetContinuousStateDerivatives", values, c_size_t(count))
        return list(values)
