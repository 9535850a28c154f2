# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds a wheel for `pip install .` (PEP 517) with CMake alone, so that nothing has to be downloaded."""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def _version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(alembert[^)]*VERSION\s+([0-9.]+)", file.read()).group(1)


def _metadata():
    with open(os.path.join(ROOT, "pyproject.toml"), encoding="utf-8") as file:
        description = re.search(r'^description = "(.*)"$', file.read(), re.M).group(1)
    return (f"Metadata-Version: 2.1\nName: alembert\nVersion: {_version()}\nSummary: {description}\n"
            "License: GPL-2.0-or-later\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")


def _python():
    """The interpreter that the module is for; not the one of a virtual environment, which may be removed."""
    return os.path.realpath(getattr(sys, "_base_executable", sys.executable))


def _is_for_this_python(build):
    try:
        with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as cache:
            found = re.search(r"^PYTHON_EXECUTABLE:\w+=(.+)$", cache.read(), re.M)
    except OSError:
        return False
    return bool(found) and os.path.realpath(found.group(1)) == _python()


def _build():
    """The folder of the built package: that of the program, where it was built for this interpreter, or one of its own."""
    build = os.path.join(ROOT, "build", "release")
    if not _is_for_this_python(build):
        build = os.path.join(ROOT, "build", "python-wheel")
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DALEMBERT_TESTS=OFF", f"-DPYTHON_EXECUTABLE={_python()}"],
                       check=True)
    subprocess.run(["cmake", "--build", build, "--target", "alembert_python"], check=True)
    return os.path.join(build, "python", "alembert")


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without this, pip would build the whole wheel to learn its name."""
    info = f"alembert-{_version()}.dist-info"
    os.makedirs(os.path.join(metadata_directory, info))
    with open(os.path.join(metadata_directory, info, "METADATA"), "w", encoding="utf-8") as file:
        file.write(_metadata())
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    abi = "cp" + sysconfig.get_config_var("py_version_nodot")
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    tag = f"{abi}-{abi}-{platform}"
    info = f"alembert-{_version()}.dist-info"
    package = _build()
    without = (config_settings or {}).get("without", "").split()  # files of the package: pip wheel --config-settings without=alembert-hdf5.so
    contents = {}
    for name in sorted(os.listdir(package)):
        path = os.path.join(package, name)
        if os.path.isfile(path) and name not in without:
            with open(path, "rb") as file:
                contents[f"alembert/{name}"] = file.read()
    contents[f"{info}/METADATA"] = _metadata().encode()
    contents[f"{info}/entry_points.txt"] = b"[console_scripts]\nalembert = alembert.__main__:main\n"
    contents[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: alembert\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    wheel = f"alembert-{_version()}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
            archive.writestr(name, content)
        archive.writestr(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("take the repository: there is no source distribution")
