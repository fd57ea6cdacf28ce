"""Builds the extension by CMake. From the top of the repository, without network, in an environment of its own:

/usr/bin/python3 -m venv --system-site-packages build/venv
build/venv/bin/pip install --no-build-isolation --no-index --no-deps ./apps/python
"""

import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
top = here.parent.parent


class CMakeBuild(build_ext):
    """Asks CMake for the component `python`."""

    def run(self):
        folder = top / "build" / "release"
        options = ["-DREPRISE_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"]
        subprocess.run(["cmake", "--preset", "release", *options], cwd=top, check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "reprise_python"], check=True)
        target = here if self.inplace else Path(self.build_lib)
        command = ["cmake", "--install", str(folder), "--component", "python", "--prefix", str(target.resolve())]
        subprocess.run(command, check=True)


(top / "build" / "wheel").mkdir(parents=True, exist_ok=True)
setup(ext_modules=[Extension("reprise._core", [])], cmdclass={"build_ext": CMakeBuild})
